// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 4f0c71f00838

// edgewalk_setup: SETUP turns three vertices into edges and increments.
//
//   tri ─> [sorted by v] ─┬─> lines j0 j1 n1 n2, columns ─> none? culled
//                         ├─> area ─> major_right; 0? culled; fourfold till values fit: M
//                         └─> differences ─> lanes ─┬─> three edges: q f, C R ──────────────┬─> prim
//                                                   └─> N channels: g, d0, d1, start ───────┘
//             a lane holds a pair, whole + rest / M: quotient and exact remainder, doubled and added to
//
// Formats: see the ports; in centre coordinates pixel centres lie on whole numbers.
// Timing: the edges, then the channels, as many side by side as there are lanes. How long they take follows the triangle: a sum
// takes a clock for a bit of its factors. prim_valid is high four clocks after the last operation.
// Rules: all results are those of exact division, rounded once; a word keeps its low bits.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_setup (
  input  wire        clk,
  input  wire        rst,

  input  wire        tri_valid,
  input  wire [21:0] tri_x0,            // Q14.8 px, x of vertex 0
  input  wire [21:0] tri_y0,            // Q14.8 px, y of vertex 0
  input  wire [27:0] tri_z0,            // UQ24.4 LSB, depth of vertex 0
  input  wire [11:0] tri_r0,            // UQ8.4 LSB, red of vertex 0
  input  wire [11:0] tri_g0,            // UQ8.4 LSB, green of vertex 0
  input  wire [11:0] tri_b0,            // UQ8.4 LSB, blue of vertex 0
  input  wire [21:0] tri_x1,            // Q14.8 px, x of vertex 1
  input  wire [21:0] tri_y1,            // Q14.8 px, y of vertex 1
  input  wire [27:0] tri_z1,            // UQ24.4 LSB, depth of vertex 1
  input  wire [11:0] tri_r1,            // UQ8.4 LSB, red of vertex 1
  input  wire [11:0] tri_g1,            // UQ8.4 LSB, green of vertex 1
  input  wire [11:0] tri_b1,            // UQ8.4 LSB, blue of vertex 1
  input  wire [21:0] tri_x2,            // Q14.8 px, x of vertex 2
  input  wire [21:0] tri_y2,            // Q14.8 px, y of vertex 2
  input  wire [27:0] tri_z2,            // UQ24.4 LSB, depth of vertex 2
  input  wire [11:0] tri_r2,            // UQ8.4 LSB, red of vertex 2
  input  wire [11:0] tri_g2,            // UQ8.4 LSB, green of vertex 2
  input  wire [11:0] tri_b2,            // UQ8.4 LSB, blue of vertex 2
  input  wire        prim_ready,

  output wire        tri_ready,
  output wire        prim_valid,
  output wire  [8:0] prim_jm,           // first line
  output reg   [9:0] prim_n1,           // lines of the upper part
  output reg   [9:0] prim_n2,           // lines of the lower part
  output wire        prim_major_right,  // the major edge is the right one
  output reg  [14:0] prim_major_c,      // signed, first column on or right of the edge
  output reg  [21:0] prim_major_dist,   // distance from the edge to that column, 1/M column
  output reg  [14:0] prim_major_q,      // signed, whole columns a line, step of c
  output reg  [21:0] prim_major_f,      // 1/M column a line
  output wire [21:0] prim_major_m,      // modulus of dist and f: the edge's height; a line has 2^8 units
  output reg  [14:0] prim_minor1_c,     // signed, first column on or right of the edge
  output reg  [21:0] prim_minor1_dist,  // distance from the edge to that column, 1/M column
  output reg  [14:0] prim_minor1_q,     // signed, whole columns a line, step of c
  output reg  [21:0] prim_minor1_f,     // 1/M column a line
  output wire [21:0] prim_minor1_m,     // modulus of dist and f: the edge's height; a line has 2^8 units
  output reg  [14:0] prim_minor2_c,     // signed, first column on or right of the edge
  output reg  [21:0] prim_minor2_dist,  // distance from the edge to that column, 1/M column
  output reg  [14:0] prim_minor2_q,     // signed, whole columns a line, step of c
  output reg  [21:0] prim_minor2_f,     // 1/M column a line
  output wire [21:0] prim_minor2_m,     // modulus of dist and f: the edge's height; a line has 2^8 units
  output reg  [37:0] prim_z_start,      // UQ24.14 LSB, modular, value at the first pixel of the first line
  output reg  [37:0] prim_z_d0,         // UQ24.14 LSB, modular, step to the next line, edge without carry
  output reg  [37:0] prim_z_d1,         // UQ24.14 LSB, modular, step to the next line, edge with carry
  output reg  [37:0] prim_z_g,          // UQ24.14 LSB, modular, step to the next pixel of the span
  output reg  [21:0] prim_r_start,      // UQ8.14 LSB, modular, value at the first pixel of the first line
  output reg  [21:0] prim_r_d0,         // UQ8.14 LSB, modular, step to the next line, edge without carry
  output reg  [21:0] prim_r_d1,         // UQ8.14 LSB, modular, step to the next line, edge with carry
  output reg  [21:0] prim_r_g,          // UQ8.14 LSB, modular, step to the next pixel of the span
  output reg  [21:0] prim_g_start,      // UQ8.14 LSB, modular, value at the first pixel of the first line
  output reg  [21:0] prim_g_d0,         // UQ8.14 LSB, modular, step to the next line, edge without carry
  output reg  [21:0] prim_g_d1,         // UQ8.14 LSB, modular, step to the next line, edge with carry
  output reg  [21:0] prim_g_g,          // UQ8.14 LSB, modular, step to the next pixel of the span
  output reg  [21:0] prim_b_start,      // UQ8.14 LSB, modular, value at the first pixel of the first line
  output reg  [21:0] prim_b_d0,         // UQ8.14 LSB, modular, step to the next line, edge without carry
  output reg  [21:0] prim_b_d1,         // UQ8.14 LSB, modular, step to the next line, edge with carry
  output reg  [21:0] prim_b_g           // UQ8.14 LSB, modular, step to the next pixel of the span
);

  // Control: the operations one after the other, a clock each or more; in rounds where there are more jobs than lanes.
  localparam [1:0] IDLE = 2'd0;
  localparam [1:0] WORK = 2'd1;
  localparam [1:0] STORE = 2'd2;
  localparam [1:0] DONE = 2'd3;
  localparam [4:0] SUBTRACT = 5'd0;
  localparam [4:0] TAKE_DX = 5'd1;
  localparam [4:0] DOUBLE_DX = 5'd2;
  localparam [4:0] TAKE_DY = 5'd3;
  localparam [4:0] ADD_DX = 5'd4;
  localparam [4:0] WAIT_DX = 5'd5;
  localparam [4:0] SUM = 5'd6;
  localparam [4:0] TAKE12 = 5'd7;
  localparam [4:0] TAKE1 = 5'd8;
  localparam [4:0] TAKE2 = 5'd9;
  localparam [4:0] WAIT = 5'd10;
  localparam [4:0] SUM_X = 5'd11;
  localparam [4:0] DOUBLE_X = 5'd12;
  localparam [4:0] SIGN_LINE = 5'd13;
  localparam [4:0] SUM_LINE = 5'd14;
  localparam [4:0] DOUBLE_LINE = 5'd15;
  localparam [4:0] ADD_X = 5'd16;
  localparam [4:0] WAIT_LINE = 5'd17;
  localparam [4:0] SIGN_START = 5'd18;
  localparam [4:0] SUM_START = 5'd19;
  wire nothing;          // no line, or no column, of the screen
  wire area_known;       // and scaled for the next round of channels
  wire no_area;
  wire [3:0] scale;      // the modulus is the area 4^scale times
  wire unfit;            // a number was taken in that is not between -M and M
  wire [4:0] top_digit;  // place of the first digit of a sum
  reg [1:0] state;
  reg [4:0] at;          // operation
  reg [4:0] left;        // clocks of the operation after this one
  reg first;             // first clock of an operation, except of a triangle's first

  // A number outside ±M pauses the sequence for two clocks, plus one for each pair of digits.
  reg [3:0] pause;                           // clocks of the pause that are left
  reg paused;                                // the operation is not over
  wire advance = !paused;
  assign tri_ready = state == IDLE;
  wire take = tri_valid && tri_ready;
  wire works = state == WORK;
  assign prim_valid = state == DONE;
  wire begins = works && (at == SUBTRACT);   // the first clock of a triangle
  wire gives_up = works && (at == TAKE_DX) && nothing;  // the triangle has no line or no column
  wire last = left == 5'd0;                  // last clock of the operation
  wire edges_end = last && (at == SUM);
  wire waits = edges_end && !area_known;     // for the area or its scale
  wire goes = works && !waits && !gives_up;  // a step of the operation is done in this clock
  wire ends = goes && last;                  // it ends
  wire leaves = ends && advance;
  wire channels_end = at == SUM_START;

  always @(posedge clk) begin
    if (rst) begin
      state <= IDLE;
    end else begin
      if (take) state <= WORK;
      if (gives_up && advance) state <= IDLE;
      if (edges_end && leaves && no_area) state <= IDLE;
      if (leaves && channels_end) state <= STORE;
      if ((state == STORE) && last) state <= DONE;
      if (prim_valid && prim_ready) state <= IDLE;
    end
  end

  always @(posedge clk) begin
    if (leaves) at <= at + 5'd1;
    if (take) at <= SUBTRACT;
  end

  always @(posedge clk) begin
    first <= leaves || (first && waits);
  end

  // How long the next operation takes.
  always @(posedge clk) begin
    if (advance && works) left <= left - 5'd1;
    if (leaves) begin
      left <= (at == SIGN_START) ? top_digit
            : (at == SUM_LINE) ? 5'd8 + {1'b0, scale}
            : (at == SIGN_LINE) ? top_digit
            : (at == SUM_X) ? 5'd8 + {1'b0, scale}
            : (at == WAIT) ? top_digit
            : (at == WAIT_DX) ? top_digit
            : (at == ADD_DX) ? 5'd1
            : (at == TAKE_DX) ? 5'd3
            : 5'd0;
    end
    if (leaves && channels_end) left <= 5'd3;
    if (state == STORE) left <= left - 5'd1;
    if (waits) left <= 5'd0;
    if (take) left <= 5'd0;
  end

  // The way of an operation: named, its addends formed, its step done, the rest and then the whole of the result.
  reg [4:0] at_next;
  reg ends_next;
  wire resumes = pause == 4'd1;  // the step after the numbers is formed again
  wire [4:0] at_formed = advance ? at_next : resumes ? DOUBLE_DX : TAKE_DX;
  wire ends_formed = advance ? ends_next : resumes ? 1'b0 : pause == 4'd2;
  reg [4:0] at_stepped;
  reg ends_stepped;
  reg [4:0] at_rest;
  reg ends_rest;
  reg [4:0] at_whole;
  reg ends_whole;
  reg worked;                    // works, a clock ago
  wire rests = !goes;

  always @(posedge clk) begin
    if (advance) begin
      at_next <= at;
      ends_next <= ends;
    end
  end

  always @(posedge clk) begin
    at_stepped <= at_formed;
    ends_stepped <= ends_formed;
    at_rest <= at_stepped;
    ends_rest <= ends_stepped;
    at_whole <= at_rest;
    ends_whole <= ends_rest;
    pause <= advance ? 4'd13 : pause - 4'd1;
  end

  always @(posedge clk) begin
    if (rst) begin
      worked <= 1'b0;
    end else begin
      worked <= works;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      paused <= 1'b0;
    end else begin
      if (resumes) paused <= 1'b0;
      if (worked && unfit) paused <= 1'b1;
    end
  end

  // The vertices sorted by line, in centre coordinates: pixel centres lie on whole numbers.
  wire y1_above_y0 = $signed(tri_y1) < $signed(tri_y0);
  wire y2_above_y0 = $signed(tri_y2) < $signed(tri_y0);
  wire y2_above_y1 = $signed(tri_y2) < $signed(tri_y1);
  reg [21:0] p0_u;      // Q14.8, signed
  reg [21:0] p0_v;      // Q14.8, signed
  reg [21:0] p1_u;      // Q14.8, signed
  reg [21:0] p1_v;      // Q14.8, signed
  reg [21:0] p2_u;      // Q14.8, signed
  reg [21:0] p2_v;      // Q14.8, signed
  reg [1:0] p0_vertex;  // the vertex at this place: 0, 1 or 2
  reg [1:0] p1_vertex;  // the vertex at this place: 0, 1 or 2
  reg [1:0] p2_vertex;  // the vertex at this place: 0, 1 or 2
  wire both = y1_above_y0 && !y2_above_y1;
  wire both_2 = y2_above_y0 && y2_above_y1;
  wire both_3 = !y1_above_y0 && y2_above_y1;
  wire both_4 = !y2_above_y0 && !y2_above_y1;
  wire [21:0] choice = (!both && !both_3) ? tri_x1 : (!both_2 && !both_4) ? tri_x2 : tri_x0;
  wire [21:0] choice_2 = (!both && !both_3) ? tri_y1 : (!both_2 && !both_4) ? tri_y2 : tri_y0;

  always @(posedge clk) begin
    if (take) begin
      p0_u <= (both ? tri_x1 : both_2 ? tri_x2 : tri_x0) - 22'd128;
      p0_v <= (both ? tri_y1 : both_2 ? tri_y2 : tri_y0) - 22'd128;
      p1_u <= choice - 22'd128;
      p1_v <= choice_2 - 22'd128;
      p2_u <= (both_3 ? tri_x1 : both_4 ? tri_x2 : tri_x0) - 22'd128;
      p2_v <= (both_3 ? tri_y1 : both_4 ? tri_y2 : tri_y0) - 22'd128;
      p0_vertex <= {both_2, both};
      p1_vertex <= {!both_2 && !both_4, !both && !both_3};
      p2_vertex <= {both_4, both_3};
    end
  end

  // Values at the vertices, as tri has them.
  reg [27:0] vertex0_z;  // UQ24.4 LSB
  reg [11:0] vertex0_r;  // UQ8.4 LSB
  reg [11:0] vertex0_g;  // UQ8.4 LSB
  reg [11:0] vertex0_b;  // UQ8.4 LSB
  reg [27:0] vertex1_z;  // UQ24.4 LSB
  reg [11:0] vertex1_r;  // UQ8.4 LSB
  reg [11:0] vertex1_g;  // UQ8.4 LSB
  reg [11:0] vertex1_b;  // UQ8.4 LSB
  reg [27:0] vertex2_z;  // UQ24.4 LSB
  reg [11:0] vertex2_r;  // UQ8.4 LSB
  reg [11:0] vertex2_g;  // UQ8.4 LSB
  reg [11:0] vertex2_b;  // UQ8.4 LSB

  always @(posedge clk) begin
    if (take) begin
      vertex0_z <= tri_z0;
      vertex0_r <= tri_r0;
      vertex0_g <= tri_g0;
      vertex0_b <= tri_b0;
      vertex1_z <= tri_z1;
      vertex1_r <= tri_r1;
      vertex1_g <= tri_g1;
      vertex1_b <= tri_b1;
      vertex2_z <= tri_z2;
      vertex2_r <= tri_r2;
      vertex2_g <= tri_g2;
      vertex2_b <= tri_b2;
    end
  end

  // Differences of the sorted vertices, from upper to lower ends of edges.
  wire [21:0] tall = p2_v - p0_v;
  reg [21:0] dv02;  // from vertex 0 down to vertex 2, 1/256 px
  reg [21:0] dv01;  // from vertex 0 down to vertex 1, 1/256 px
  reg [21:0] dv12;  // from vertex 1 down to vertex 2, 1/256 px
  reg [22:0] du02;  // from vertex 0 right to vertex 2, 1/256 px, signed
  reg [22:0] du01;  // from vertex 0 right to vertex 1, 1/256 px, signed
  reg [22:0] du12;  // from vertex 1 right to vertex 2, 1/256 px, signed

  always @(posedge clk) begin
    dv02 <= p2_v - p0_v;
    dv01 <= p1_v - p0_v;
    dv12 <= p2_v - p1_v;
    du02 <= {p2_u[21], p2_u} - {p0_u[21], p0_u};
    du01 <= {p1_u[21], p1_u} - {p0_u[21], p0_u};
    du12 <= {p2_u[21], p2_u} - {p1_u[21], p1_u};
  end

  // Twice the area: du1 dv2 - du2 dv1, over the bits of dv2 and dv1.
  reg [4:0] area_digit;  // place of the digits added
  reg area_adds;         // digits are added
  wire [21:0] shifted = dv02 >> area_digit;
  wire [21:0] shifted_2 = dv01 >> area_digit;
  wire [23:0] area_part = (shifted[0] ? {du01[22], du01} : 24'd0)
                        - (shifted_2[0] ? {du02[22], du02} : 24'd0);
  reg [44:0] area;       // twice the area, 1/65536 px^2, signed
  assign no_area = !(|area);
  wire [21:0] either = tall | 22'd2;
  wire [5:0] part = either[21:16];
  wire any = |part;
  wire [1:0] part_2 = part[5:4];
  wire any_2 = |part_2;
  wire [3:0] part_4 = part[3:0];
  wire [1:0] part_3 = part_4[3:2];
  wire any_3 = |part_3;
  wire [1:0] part_5 = part_4[1:0];
  wire [1:0] choice_3 = any_2 ? {1'b0, part_2[1]} : {any_3, any_3 ? part_3[1] : part_5[1]};
  wire [15:0] part_7 = either[15:0];
  wire [7:0] part_6 = part_7[15:8];
  wire any_4 = |part_6;
  wire [3:0] part_8 = part_6[7:4];
  wire any_5 = |part_8;
  wire [1:0] part_9 = part_8[3:2];
  wire any_6 = |part_9;
  wire [1:0] part_10 = part_8[1:0];
  wire [3:0] part_12 = part_6[3:0];
  wire [1:0] part_11 = part_12[3:2];
  wire any_7 = |part_11;
  wire [1:0] part_13 = part_12[1:0];
  wire [1:0] choice_4 = any_5 ? {any_6, any_6 ? part_9[1] : part_10[1]}
                      : {any_7, any_7 ? part_11[1] : part_13[1]};
  wire [7:0] part_15 = part_7[7:0];
  wire [3:0] part_14 = part_15[7:4];
  wire any_8 = |part_14;
  wire [1:0] part_16 = part_14[3:2];
  wire any_9 = |part_16;
  wire [1:0] part_17 = part_14[1:0];
  wire [3:0] part_19 = part_15[3:0];
  wire [1:0] part_18 = part_19[3:2];
  wire any_10 = |part_18;
  wire [1:0] part_20 = part_19[1:0];
  wire [1:0] choice_5 = any_8 ? {any_9, any_9 ? part_16[1] : part_17[1]}
                      : {any_10, any_10 ? part_18[1] : part_20[1]};
  wire [3:0] choice_6 = any ? {1'b0, {any_2, choice_3}}
                      : {any_4, any_4 ? {any_5, choice_4} : {any_8, choice_5}};

  always @(posedge clk) begin
    area_digit <= area_digit - 5'd1;
    if (begins) area_digit <= {any, choice_6};
  end

  wire equal = area_digit == 5'd0;

  always @(posedge clk) begin
    if (equal) area_adds <= 1'b0;
    if (begins) area_adds <= 1'b1;
  end

  always @(posedge clk) begin
    if (area_adds) area <= (area << 1) + {{21{area_part[23]}}, area_part};
    if (begins) area <= 45'd0;
  end

  // The area as modulus: fourfold, i times, until the differences of the next round's values fit.
  reg [27:0] differences;  // their bits, or those of complements
  reg [44:0] scaled;       // -M or -M - 1, signed
  reg scale_taken;         // the area is taken
  reg scaling;             // the scaled modulus is compared with the differences
  reg [3:0] scale_next;    // how many times the modulus is multiplied by 4
  wire [45:0] less_m = {{17'd0, differences}, 1'b1} + {scaled, 1'b1};  // and a carry out of the lowest bit
  wire [44:0] part_21 = less_m[45:1];
  wire fits = (|area) ? part_21[44] : 1'b1;
  wire grows = scaling && !fits;
  assign area_known = !area_adds && !scale_taken && !scaling;
  assign scale = scale_next;

  always @(posedge clk) begin
    scale_taken <= area_adds && equal && !begins;
  end

  always @(posedge clk) begin
    if (fits) scaling <= 1'b0;
    if (scale_taken) scaling <= 1'b1;
  end

  wire inverse = !area[44];
  wire [44:0] extended = area;

  always @(posedge clk) begin
    if (grows) begin
      scaled <= {scaled[42:0], inverse, inverse};
      scale_next <= scale_next + 4'd1;
    end
    if (scale_taken) begin
      scaled <= inverse ? ~extended : extended;
      scale_next <= 4'd0;
    end
  end

  // Lines: those whose centres lie at or below the upper end and above the lower end, on the screen.
  wire [20:0] part_22 = p0_v[20:0];
  wire [14:0] line0 = {2'd0, part_22[20:8]} + {14'd0, |p0_v[7:0]};  // the first line of centres at or below the vertex, if that is not above the screen
  reg [14:0] j0;        // line of the screen
  wire [20:0] part_23 = p1_v[20:0];
  wire [14:0] line1 = {2'd0, part_23[20:8]} + {14'd0, |p1_v[7:0]};  // the first line of centres at or below the vertex, if that is not above the screen
  reg [14:0] j1;        // line of the screen
  wire [20:0] part_24 = p2_v[20:0];
  wire [14:0] line2 = {2'd0, part_24[20:8]} + {14'd0, |p2_v[7:0]};  // the first line of centres at or below the vertex, if that is not above the screen
  reg [14:0] end_line;  // line of the screen
  wire [14:0] difference = j1 - j0;
  wire [14:0] difference_2 = end_line - j1;

  always @(posedge clk) begin
    j0 <= p0_v[21] ? 15'd0 : (part_22 <= 21'h1df00) ? line0 : 15'd480;
    j1 <= p1_v[21] ? 15'd0 : (part_23 <= 21'h1df00) ? line1 : 15'd480;
    end_line <= p2_v[21] ? 15'd0 : (part_24 <= 21'h1df00) ? line2 : 15'd480;
    prim_n1 <= difference[9:0];
    prim_n2 <= difference_2[9:0];
  end

  // Columns: is there a column centre of the screen from the leftmost up to before the rightmost vertex?
  wire [13:0] column0 = p0_u[21:8] + {13'd0, |p0_u[7:0]};  // the first column of centres at or right of the vertex
  wire [13:0] column1 = p1_u[21:8] + {13'd0, |p1_u[7:0]};  // the first column of centres at or right of the vertex
  wire [13:0] column2 = p2_u[21:8] + {13'd0, |p2_u[7:0]};  // the first column of centres at or right of the vertex
  wire none_between = (column0 == column1) && (column1 == column2);
  wire before_screen = (p0_u[21] || !(|p0_u)) && (p1_u[21] || !(|p1_u)) && (p2_u[21] || !(|p2_u));  // no vertex lies right of the first column of centres
  wire behind_screen = !($signed(p0_u) <= 22'sh27f00)  // every vertex lies right of the last column of centres
                    && !($signed(p1_u) <= 22'sh27f00)
                    && !($signed(p2_u) <= 22'sh27f00);
  reg no_column;                                 // no column of the screen
  assign nothing = (j0 == end_line) || no_column;
  wire upper = |prim_n1;
  wire [14:0] jm = upper ? j0 : j1;              // first line of the triangle
  wire [22:0] joined = {jm, 8'd0};
  wire [20:0] h0 = joined[20:0] - p0_v[20:0];    // from vertex 0 down to the first line, 1/256 px
  wire [22:0] joined_2 = {j1, 8'd0};
  wire [20:0] h1 = joined_2[20:0] - p1_v[20:0];  // from vertex 1 down to the first line of part 2, 1/256 px

  always @(posedge clk) begin
    no_column <= none_between || before_screen || behind_screen;
  end

  // Factors of the next sum, signed. Its first digit is the highest in which one of them differs from its sign.
  reg [23:0] q_times_f;                     // q of the major edge, times the factor's digits so far
  reg [23:0] q_times_g;                     // q of the major edge, times the factor's digits so far
  reg [23:0] first_sheared;                 // from vertex 0 right to the first pixel, less q px a line; 1/256 px, signed
  reg [23:0] f;                             // factor, signed
  reg [23:0] g;                             // factor, signed
  wire second_counts = (at == WAIT_DX) && (|prim_n2);
  wire [23:0] either_2 = {16'd0, p1_u[7:0]} | {3'd0, h1};
  wire [22:0] digits = (f[22:0] ^ f[23:1])  // digits of the factors that differ from their signs
                     | (g[22:0] ^ g[23:1])
                     | (second_counts ? either_2[22:0] : 23'd0);
  wire any_11 = |digits[22:16];
  wire [6:0] part_26 = digits[22:16];
  wire [2:0] part_25 = part_26[6:4];
  wire any_12 = |part_25;
  wire any_13 = part_25[2];
  wire [1:0] part_27 = part_25[1:0];
  wire [3:0] part_29 = part_26[3:0];
  wire [1:0] part_28 = part_29[3:2];
  wire any_14 = |part_28;
  wire [1:0] part_30 = part_29[1:0];
  wire [1:0] choice_7 = any_12 ? {any_13, any_13 ? 1'b0 : part_27[1]}
                      : {any_14, any_14 ? part_28[1] : part_30[1]};
  wire [15:0] part_32 = digits[15:0];
  wire [7:0] part_31 = part_32[15:8];
  wire any_15 = |part_31;
  wire [3:0] part_33 = part_31[7:4];
  wire any_16 = |part_33;
  wire [1:0] part_34 = part_33[3:2];
  wire any_17 = |part_34;
  wire [1:0] part_35 = part_33[1:0];
  wire [3:0] part_37 = part_31[3:0];
  wire [1:0] part_36 = part_37[3:2];
  wire any_18 = |part_36;
  wire [1:0] part_38 = part_37[1:0];
  wire [1:0] choice_8 = any_16 ? {any_17, any_17 ? part_34[1] : part_35[1]}
                      : {any_18, any_18 ? part_36[1] : part_38[1]};
  wire [7:0] part_40 = part_32[7:0];
  wire [3:0] part_39 = part_40[7:4];
  wire any_19 = |part_39;
  wire [1:0] part_41 = part_39[3:2];
  wire any_20 = |part_41;
  wire [1:0] part_42 = part_39[1:0];
  wire [3:0] part_44 = part_40[3:0];
  wire [1:0] part_43 = part_44[3:2];
  wire any_21 = |part_43;
  wire [1:0] part_45 = part_44[1:0];
  wire [1:0] choice_9 = any_19 ? {any_20, any_20 ? part_41[1] : part_42[1]}
                      : {any_21, any_21 ? part_43[1] : part_45[1]};
  wire [3:0] choice_10 = any_11 ? {1'b0, {any_12, choice_7}}
                       : {any_15, any_15 ? {any_16, choice_8} : {any_19, choice_9}};
  assign top_digit = {any_11, choice_10};
  wire [23:0] shifted_3 = f >> left;
  wire digit_f = shifted_3[0];
  wire [23:0] shifted_4 = g >> left;
  wire digit_g = shifted_4[0];
  wire [22:0] joined_3 = {prim_major_c - {14'd0, area[44]}, 8'd0};

  always @(posedge clk) begin
    if (at_next == WAIT) begin
      first_sheared <= {joined_3[22], joined_3} - {{2{p0_u[21]}}, p0_u} - q_times_g;
    end
  end

  always @(posedge clk) begin
    if (at == WAIT_DX) begin
      f <= {16'd0, p0_u[7:0]};
      g <= {3'd0, h0};
    end
    if (at == TAKE2) begin
      f <= {2'd0, dv02};
      g <= {2'd0, dv01};
    end
    if (at == DOUBLE_X) begin
      f <= q_times_f - {du02[22], du02};
      g <= q_times_g - {du01[22], du01};
    end
    if (at == ADD_X) begin
      f <= first_sheared;
      g <= {3'd0, h0};
    end
  end

  always @(posedge clk) begin
    if (((at == SUM_X) || (at == SUM)) && !rests) begin
      q_times_f <= (first ? 24'd0 : q_times_f << 1)
                 + (digit_f ? {{9{prim_major_q[14]}}, prim_major_q} : 24'd0);
      q_times_g <= (first ? 24'd0 : q_times_g << 1)
                 + (digit_g ? {{9{prim_major_q[14]}}, prim_major_q} : 24'd0);
    end
  end

  // The steps of a lane. Bit 4: a stored pair is added. Bit 3: M is taken off. Bits 1 and 0: it subtracts.
  localparam [4:0] STEP_REST = 5'd0;
  localparam [4:0] STEP_DOUBLE1 = 5'd1;
  localparam [4:0] STEP_TAKE = 5'd3;
  localparam [4:0] STEP_BEGIN = 5'd7;
  localparam [4:0] STEP_DOUBLE2 = 5'd8;
  localparam [4:0] STEP_DIGITS = 5'd9;
  localparam [4:0] STEP_ADD = 5'd16;
  localparam [4:0] STEP_FIRST = 5'd17;
  localparam [4:0] STEP_NEXT = 5'd18;
  localparam [4:0] STEP_SIGN = 5'd19;

  // Commands of all lanes.
  wire either_3 = (at == TAKE_DX)
               || (at == TAKE_DY)
               || (at == TAKE12)
               || (at == TAKE1)
               || (at == TAKE2);
  wire [4:0] step = ((at == SUM) || (at == SUM_X)) ? (first ? STEP_FIRST : STEP_NEXT)
                  : ((at == ADD_DX) || (at == ADD_X)) ? STEP_ADD
                  : ((at == SIGN_LINE) || (at == SIGN_START)) ? STEP_SIGN
                  : ((at == SUM_LINE) || (at == SUM_START)) ? STEP_NEXT
                  : ((at == DOUBLE_DX) || (at == DOUBLE_X) || (at == DOUBLE_LINE)) ? STEP_DOUBLE2
                  : either_3 ? STEP_TAKE
                  : STEP_REST;
  wire is_sum = (at == SUM) || (at == SUM_X) || (at == SUM_LINE) || (at == SUM_START);
  wire is_sign = (at == SIGN_LINE) || (at == SIGN_START);
  wire of_gradients = (at == SIGN_START) || (at == SUM_START);
  wire [2:0] read_single_at = (at == ADD_X) ? 3'd5 : (at == ADD_DX) ? 3'd2 : 3'd0;
  wire either_4 = (at_stepped == TAKE_DX)
               || (at_stepped == TAKE_DY)
               || (at_stepped == ADD_DX)
               || (at_stepped == TAKE12)
               || (at_stepped == TAKE1)
               || (at_stepped == TAKE2)
               || (at_stepped == DOUBLE_X)
               || (at_stepped == DOUBLE_LINE)
               || (at_stepped == ADD_X);
  wire write = ends_stepped && either_4;
  wire [2:0] write_at = (at_stepped == ADD_X) ? 3'd7
                      : (at_stepped == DOUBLE_LINE) ? 3'd6
                      : (at_stepped == DOUBLE_X) ? 3'd5
                      : ((at_stepped == ADD_DX) || (at_stepped == TAKE12)) ? 3'd3
                      : ((at_stepped == TAKE_DX) || (at_stepped == TAKE2)) ? 3'd2
                      : 3'd1;
  wire take_modulus = (at == TAKE_DX) || (at == TAKE12);
  wire either_5 = (at_rest == SUM_START) || (at_rest == DOUBLE_DX) || (at_rest == SUM);
  wire nearest = !either_5;
  wire upwards = at_rest == SUM;
  wire negated = (at_rest == DOUBLE_X) && area[44];

  // Lane 0: its steps.
  wire [4:0] step0 = rests ? STEP_REST : step;
  reg [4:0] step_next0;
  reg [4:0] step_of_pause0;
  wire [4:0] step_formed0 = advance ? step_next0 : step_of_pause0;

  always @(posedge clk) begin
    if (advance) step_next0 <= step0;
  end

  wire [4:0] choice_11 = advance ? STEP_BEGIN : STEP_DIGITS;

  always @(posedge clk) begin
    step_of_pause0 <= (pause == 4'd2) ? STEP_DOUBLE2 : choice_11;
  end

  // Lane 1: its steps.
  wire [4:0] step1 = rests ? STEP_REST : step;
  reg [4:0] step_next1;
  reg [4:0] step_of_pause1;
  wire [4:0] step_formed1 = advance ? step_next1 : step_of_pause1;

  always @(posedge clk) begin
    if (advance) step_next1 <= step1;
  end

  always @(posedge clk) begin
    step_of_pause1 <= (pause == 4'd2) ? STEP_DOUBLE2 : choice_11;
  end

  // Lane 2: its steps.
  wire [4:0] step2 = rests ? STEP_REST : step;
  reg [4:0] step_next2;
  reg [4:0] step_of_pause2;
  wire [4:0] step_formed2 = advance ? step_next2 : step_of_pause2;

  always @(posedge clk) begin
    if (advance) step_next2 <= step2;
  end

  always @(posedge clk) begin
    step_of_pause2 <= (pause == 4'd2) ? STEP_DOUBLE2 : choice_11;
  end

  // Lane 3: its steps.
  wire [4:0] step3 = rests ? STEP_REST : step;
  reg [4:0] step_next3;

  always @(posedge clk) begin
    step_next3 <= step3;
  end

  // Inputs of the lanes in the next clock.
  reg [1:0] from_place;
  wire [1:0] from_vertex = (from_place == 2'd2) ? p2_vertex
                         : (from_place == 2'd1) ? p1_vertex
                         : p0_vertex;
  reg [1:0] to_place;
  wire [1:0] to_vertex = (to_place == 2'd2) ? p2_vertex : (to_place == 2'd1) ? p1_vertex : p0_vertex;
  reg single_value;
  reg number_of_edge;
  reg number_is_height;
  wire both_5 = area[44] && ((at == TAKE12) || (at == TAKE1) || (at == TAKE2));
  wire either_6 = (at == SUBTRACT) || (at == TAKE12) || (at == WAIT);
  wire either_7 = (at == DOUBLE_DX) || (at == TAKE2) || (at == DOUBLE_X);
  wire [1:0] choice_12 = either_6 ? 2'd1 : either_7 ? 2'd0 : 2'd1;
  wire [1:0] choice_13 = either_6 ? 2'd2 : either_7 ? 2'd2 : 2'd0;
  wire equal_2 = at == SIGN_START;

  always @(posedge clk) begin
    from_place <= both_5 ? choice_12 : choice_13;
    to_place <= equal_2 ? 2'd0 : both_5 ? choice_13 : choice_12;
    single_value <= equal_2;
  end

  always @(posedge clk) begin
    if (advance) begin
      number_of_edge <= (at == TAKE_DX) || (at == TAKE_DY);
      number_is_height <= at == TAKE_DY;
    end
  end

  // Lane 0: what it takes in.
  wire [22:0] extended_2 = {1'b0, dv02};
  wire [28:0] choice_14 = number_is_height ? {{6{extended_2[22]}}, extended_2}
                        : {{6{du02[22]}}, du02};
  wire [28:0] choice_15 = to_vertex[1] ? {1'b0, vertex2_z}
                        : to_vertex[0] ? {1'b0, vertex1_z}
                        : {1'b0, vertex0_z};
  wire [28:0] choice_16 = single_value ? 29'h1ffffff8
                        : from_vertex[1] ? {1'b0, vertex2_z}
                        : from_vertex[0] ? {1'b0, vertex1_z}
                        : {1'b0, vertex0_z};
  wire [28:0] difference_3 = choice_15 - choice_16;
  wire [28:0] number0 = number_of_edge ? choice_14 : difference_3;  // signed
  reg [28:0] kept0;  // a number that may not fit, or a first value; signed

  always @(posedge clk) begin
    if ((at_next == TAKE_DX) || (at_next == SIGN_START)) kept0 <= number0;
  end

  // Lane 1: what it takes in.
  wire [22:0] choice_17 = to_vertex[1] ? {11'd0, vertex2_r}
                        : to_vertex[0] ? {11'd0, vertex1_r}
                        : {11'd0, vertex0_r};
  wire [22:0] choice_18 = single_value ? 23'h7ffff8
                        : from_vertex[1] ? {11'd0, vertex2_r}
                        : from_vertex[0] ? {11'd0, vertex1_r}
                        : {11'd0, vertex0_r};
  wire [22:0] difference_4 = choice_17 - choice_18;
  wire [22:0] number1 = number_of_edge ? (number_is_height ? {1'b0, dv01} : du01) : difference_4;  // signed
  reg [22:0] kept1;  // a number that may not fit, or a first value; signed

  always @(posedge clk) begin
    if ((at_next == TAKE_DX) || (at_next == SIGN_START)) kept1 <= number1;
  end

  // Lane 2: what it takes in.
  wire [22:0] choice_19 = to_vertex[1] ? {11'd0, vertex2_g}
                        : to_vertex[0] ? {11'd0, vertex1_g}
                        : {11'd0, vertex0_g};
  wire [22:0] choice_20 = single_value ? 23'h7ffff8
                        : from_vertex[1] ? {11'd0, vertex2_g}
                        : from_vertex[0] ? {11'd0, vertex1_g}
                        : {11'd0, vertex0_g};
  wire [22:0] difference_5 = choice_19 - choice_20;
  wire [22:0] number2 = number_of_edge ? (number_is_height ? {1'b0, dv12} : du12) : difference_5;  // signed
  reg [22:0] kept2;  // a number that may not fit, or a first value; signed

  always @(posedge clk) begin
    if ((at_next == TAKE_DX) || (at_next == SIGN_START)) kept2 <= number2;
  end

  // Lane 3: what it takes in.
  wire [22:0] choice_21 = to_vertex[1] ? {11'd0, vertex2_b}
                        : to_vertex[0] ? {11'd0, vertex1_b}
                        : {11'd0, vertex0_b};
  wire [22:0] choice_22 = single_value ? 23'h7ffff8
                        : from_vertex[1] ? {11'd0, vertex2_b}
                        : from_vertex[0] ? {11'd0, vertex1_b}
                        : {11'd0, vertex0_b};
  wire [22:0] number3 = choice_21 - choice_22;  // signed
  reg [22:0] kept3;                             // a number that may not fit, or a first value; signed
  wire [27:0] shown = (difference_3[27:0] ^ {28{difference_3[28]}})
                    | {5'd0, difference_4 ^ {23{difference_4[22]}}}
                    | {5'd0, difference_5 ^ {23{difference_5[22]}}}
                    | {5'd0, number3 ^ {23{number3[22]}}};
  wire lane0_unfit;
  wire lane1_unfit;
  wire lane2_unfit;
  wire lane3_unfit;
  assign unfit = lane0_unfit || (lane1_unfit && (|prim_n1)) || (lane2_unfit && (|prim_n2));

  always @(posedge clk) begin
    if (at_next == SIGN_START) kept3 <= number3;
  end

  always @(posedge clk) begin
    differences <= differences | shown;
    if (begins) differences <= 28'd0;
  end

  // Edge: major.
  wire [43:0] lane0_rest_out;
  wire [45:0] lane0_value;
  wire choice_23 = is_sign ? f[23] : digit_f;
  wire choice_24 = is_sign ? g[23] : digit_g;
  wire [28:0] shifted_5 = $signed(kept0) >>> {pause - 4'd2, 1'b0};
  wire [13:0] part_46 = p0_u[21:8];
  wire [46:0] joined_4 = {{kept0, 10'd0}, 8'd128};
  wire equal_3 = at == TAKE12;

  edgewalk_setup_lane0 lane0 (
    .clk           (clk),
    .read_at       ((is_sum || is_sign) ? {of_gradients && (choice_23 || choice_24), choice_24, choice_23}
: read_single_at),
    .step          (step_formed0),
    .number        (number0),
    .digits        (shifted_5[1:0]),
    .write         (write),
    .write_at      (write_at),
    .whole_in      ((at_rest == SUM) ? {{32{part_46[13]}}, part_46} : (at_rest == SUM_START) ? joined_4[45:0] : 46'd0),
    .take_modulus  (take_modulus),
    .modulus_in    (equal_3 ? scaled : ~{15'd0, {dv02, 8'd0}}),
    .modulus_short (!(equal_3 && area[44])),
    .give          (ends_rest),
    .nearest       (nearest),
    .upwards       (upwards),
    .negate        (negated),
    .unfit         (lane0_unfit),
    .rest_out      (lane0_rest_out),
    .value         (lane0_value)
  );

  wire any_22 = |dv02[21:8];
  wire [35:0] part_47 = lane0_rest_out[43:8];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == DOUBLE_DX)) prim_major_f <= any_22 ? part_47[21:0] : 22'd0;
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_DX)) prim_major_q <= any_22 ? lane0_value[14:0] : 15'd0;
  end

  wire [29:0] difference_6 = {dv02, 8'd0} - lane0_rest_out[29:0];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == SUM)) begin
      prim_major_dist <= (|lane0_rest_out) ? difference_6[29:8] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == SUM)) prim_major_c <= lane0_value[14:0];
  end

  // Edge: minor1.
  wire [43:0] lane1_rest_out;
  wire [29:0] lane1_value;
  wire choice_25 = is_sign ? f[23] : digit_f;
  wire choice_26 = is_sign ? g[23] : digit_g;
  wire [22:0] shifted_6 = $signed(kept1) >>> {pause - 4'd2, 1'b0};
  wire [13:0] part_48 = p0_u[21:8];
  wire [40:0] joined_5 = {{kept1, 10'd0}, 8'd128};
  wire equal_4 = at == TAKE12;

  edgewalk_setup_lane1 lane1 (
    .clk           (clk),
    .read_at       ((is_sum || is_sign) ? {of_gradients && (choice_25 || choice_26), choice_26, choice_25}
: read_single_at),
    .step          (step_formed1),
    .number        (number1),
    .digits        (shifted_6[1:0]),
    .write         (write),
    .write_at      (write_at),
    .whole_in      ((at_rest == SUM) ? {{16{part_48[13]}}, part_48} : (at_rest == SUM_START) ? joined_5[29:0] : 30'd0),
    .take_modulus  (take_modulus),
    .modulus_in    (equal_4 ? scaled : ~{15'd0, {dv01, 8'd0}}),
    .modulus_short (!(equal_4 && area[44])),
    .give          (ends_rest),
    .nearest       (nearest),
    .upwards       (upwards),
    .negate        (negated),
    .unfit         (lane1_unfit),
    .rest_out      (lane1_rest_out),
    .value         (lane1_value)
  );

  wire both_6 = (|prim_n1) && (|dv01[21:8]);
  wire [35:0] part_49 = lane1_rest_out[43:8];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == DOUBLE_DX)) prim_minor1_f <= both_6 ? part_49[21:0] : 22'd0;
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_DX)) prim_minor1_q <= both_6 ? lane1_value[14:0] : 15'd0;
  end

  wire [29:0] difference_7 = {dv01, 8'd0} - lane1_rest_out[29:0];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == SUM)) begin
      prim_minor1_dist <= (|prim_n1) ? ((|lane1_rest_out) ? difference_7[29:8] : 22'd0) : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == SUM)) prim_minor1_c <= (|prim_n1) ? lane1_value[14:0] : 15'd0;
  end

  // Edge: minor2.
  wire [43:0] lane2_rest_out;
  wire [29:0] lane2_value;
  wire equal_5 = at == SUM;
  wire [7:0] shifted_7 = p1_u[7:0] >> left;
  wire choice_27 = is_sign ? f[23] : equal_5 ? shifted_7[0] : digit_f;
  wire [20:0] shifted_8 = h1 >> left;
  wire choice_28 = is_sign ? g[23] : equal_5 ? shifted_8[0] : digit_g;
  wire [22:0] shifted_9 = $signed(kept2) >>> {pause - 4'd2, 1'b0};
  wire [13:0] part_50 = p1_u[21:8];
  wire [40:0] joined_6 = {{kept2, 10'd0}, 8'd128};
  wire equal_6 = at == TAKE12;

  edgewalk_setup_lane1 lane2 (
    .clk           (clk),
    .read_at       ((is_sum || is_sign) ? {of_gradients && (choice_27 || choice_28), choice_28, choice_27}
: read_single_at),
    .step          (step_formed2),
    .number        (number2),
    .digits        (shifted_9[1:0]),
    .write         (write),
    .write_at      (write_at),
    .whole_in      ((at_rest == SUM) ? {{16{part_50[13]}}, part_50} : (at_rest == SUM_START) ? joined_6[29:0] : 30'd0),
    .take_modulus  (take_modulus),
    .modulus_in    (equal_6 ? scaled : ~{15'd0, {dv12, 8'd0}}),
    .modulus_short (!(equal_6 && area[44])),
    .give          (ends_rest),
    .nearest       (nearest),
    .upwards       (upwards),
    .negate        (negated),
    .unfit         (lane2_unfit),
    .rest_out      (lane2_rest_out),
    .value         (lane2_value)
  );

  wire both_7 = (|prim_n2) && (|dv12[21:8]);
  wire [35:0] part_51 = lane2_rest_out[43:8];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == DOUBLE_DX)) prim_minor2_f <= both_7 ? part_51[21:0] : 22'd0;
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_DX)) prim_minor2_q <= both_7 ? lane2_value[14:0] : 15'd0;
  end

  wire [29:0] difference_8 = {dv12, 8'd0} - lane2_rest_out[29:0];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == SUM)) begin
      prim_minor2_dist <= (|prim_n2) ? ((|lane2_rest_out) ? difference_8[29:8] : 22'd0) : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == SUM)) prim_minor2_c <= (|prim_n2) ? lane2_value[14:0] : 15'd0;
  end

  // Channel: z.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X)) prim_z_g <= lane0_value[37:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_LINE)) prim_z_d0 <= lane0_value[37:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == ADD_X)) prim_z_d1 <= lane0_value[37:0];
  end

  always @(posedge clk) begin
    if (at_whole == SUM_START) prim_z_start <= lane0_value[45:8];
  end

  // Channel: r.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X)) prim_r_g <= lane1_value[21:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_LINE)) prim_r_d0 <= lane1_value[21:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == ADD_X)) prim_r_d1 <= lane1_value[21:0];
  end

  always @(posedge clk) begin
    if (at_whole == SUM_START) prim_r_start <= lane1_value[29:8];
  end

  // Channel: g.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X)) prim_g_g <= lane2_value[21:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_LINE)) prim_g_d0 <= lane2_value[21:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == ADD_X)) prim_g_d1 <= lane2_value[21:0];
  end

  always @(posedge clk) begin
    if (at_whole == SUM_START) prim_g_start <= lane2_value[29:8];
  end

  // Channel: b.
  wire [29:0] lane3_value;
  wire choice_29 = is_sign ? f[23] : digit_f;
  wire choice_30 = is_sign ? g[23] : digit_g;
  wire [40:0] joined_7 = {{kept3, 10'd0}, 8'd128};
  wire [43:0] lane3_rest_out_unused;

  edgewalk_setup_lane1 lane3 (
    .clk           (clk),
    .read_at       ((is_sum || is_sign) ? {of_gradients && (choice_29 || choice_30), choice_30, choice_29}
: read_single_at),
    .step          (step_next3),
    .number        (number3),
    .digits        (2'd0),
    .write         (write),
    .write_at      (write_at),
    .whole_in      ((at_rest == SUM_START) ? joined_7[29:0] : 30'd0),
    .take_modulus  (take_modulus),
    .modulus_in    (scaled),
    .modulus_short (!area[44]),
    .give          (ends_rest),
    .nearest       (nearest),
    .upwards       (upwards),
    .negate        (negated),
    .unfit         (lane3_unfit),
    .rest_out      (lane3_rest_out_unused),
    .value         (lane3_value)
  );

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X)) prim_b_g <= lane3_value[21:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_LINE)) prim_b_d0 <= lane3_value[21:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == ADD_X)) prim_b_d1 <= lane3_value[21:0];
  end

  always @(posedge clk) begin
    if (at_whole == SUM_START) prim_b_start <= lane3_value[29:8];
  end

  assign prim_jm = jm[8:0];
  assign prim_major_right = area[44];
  assign prim_major_m = dv02;
  assign prim_minor1_m = dv01;
  assign prim_minor2_m = dv12;

  // Not needed, on purpose.
  wire unused = &{
    1'b0, WAIT_LINE, less_m[0], STEP_DOUBLE1, lane3_unfit, part_5[0], part_10[0], part_13[0],
    part_17[0], part_20[0], shifted[21:1], shifted_2[21:1], part_21[43:0], difference[14:10],
    difference_2[14:10], joined[22:21], joined_2[22:21], either_2[23], part_27[0], part_30[0],
    part_35[0], part_38[0], part_42[0], part_45[0], shifted_3[23:1], shifted_4[23:1], shifted_7[7:1],
    shifted_8[20:1], shifted_5[28:2], joined_4[46], shifted_6[22:2], joined_5[40:30], shifted_9[22:2],
    joined_6[40:30], joined_7[40:30], part_47[35:22], difference_6[7:0], part_49[35:22],
    difference_7[7:0], part_51[35:22], difference_8[7:0]
  };

endmodule

`default_nettype wire
