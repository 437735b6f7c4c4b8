// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 333c8cc6e2fc

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
  input  wire [11:0] tri_x0,            // Q9.3 px, x of vertex 0
  input  wire [11:0] tri_y0,            // Q9.3 px, y of vertex 0
  input  wire [15:0] tri_z0,            // UQ16.0 LSB, depth of vertex 0
  input  wire  [4:0] tri_r0,            // UQ5.0 LSB, red of vertex 0
  input  wire  [4:0] tri_g0,            // UQ5.0 LSB, green of vertex 0
  input  wire  [4:0] tri_b0,            // UQ5.0 LSB, blue of vertex 0
  input  wire [11:0] tri_x1,            // Q9.3 px, x of vertex 1
  input  wire [11:0] tri_y1,            // Q9.3 px, y of vertex 1
  input  wire [15:0] tri_z1,            // UQ16.0 LSB, depth of vertex 1
  input  wire  [4:0] tri_r1,            // UQ5.0 LSB, red of vertex 1
  input  wire  [4:0] tri_g1,            // UQ5.0 LSB, green of vertex 1
  input  wire  [4:0] tri_b1,            // UQ5.0 LSB, blue of vertex 1
  input  wire [11:0] tri_x2,            // Q9.3 px, x of vertex 2
  input  wire [11:0] tri_y2,            // Q9.3 px, y of vertex 2
  input  wire [15:0] tri_z2,            // UQ16.0 LSB, depth of vertex 2
  input  wire  [4:0] tri_r2,            // UQ5.0 LSB, red of vertex 2
  input  wire  [4:0] tri_g2,            // UQ5.0 LSB, green of vertex 2
  input  wire  [4:0] tri_b2,            // UQ5.0 LSB, blue of vertex 2
  input  wire        prim_ready,

  output wire        tri_ready,
  output wire        prim_valid,
  output wire  [7:0] prim_jm,           // first line
  output reg   [8:0] prim_n1,           // lines of the upper part
  output reg   [8:0] prim_n2,           // lines of the lower part
  output wire        prim_major_right,  // the major edge is the right one
  output reg   [9:0] prim_major_c,      // signed, first column on or right of the edge
  output reg  [11:0] prim_major_dist,   // distance from the edge to that column, 1/M column
  output reg   [9:0] prim_major_q,      // signed, whole columns a line, step of c
  output reg  [11:0] prim_major_f,      // 1/M column a line
  output wire [11:0] prim_major_m,      // modulus of dist and f: the edge's height; a line has 2^3 units
  output reg   [9:0] prim_minor1_c,     // signed, first column on or right of the edge
  output reg  [11:0] prim_minor1_dist,  // distance from the edge to that column, 1/M column
  output reg   [9:0] prim_minor1_q,     // signed, whole columns a line, step of c
  output reg  [11:0] prim_minor1_f,     // 1/M column a line
  output wire [11:0] prim_minor1_m,     // modulus of dist and f: the edge's height; a line has 2^3 units
  output reg   [9:0] prim_minor2_c,     // signed, first column on or right of the edge
  output reg  [11:0] prim_minor2_dist,  // distance from the edge to that column, 1/M column
  output reg   [9:0] prim_minor2_q,     // signed, whole columns a line, step of c
  output reg  [11:0] prim_minor2_f,     // 1/M column a line
  output wire [11:0] prim_minor2_m,     // modulus of dist and f: the edge's height; a line has 2^3 units
  output reg  [25:0] prim_z_start,      // UQ16.10 LSB, modular, value at the first pixel of the first line
  output reg  [25:0] prim_z_d0,         // UQ16.10 LSB, modular, step to the next line, edge without carry
  output reg  [25:0] prim_z_d1,         // UQ16.10 LSB, modular, step to the next line, edge with carry
  output reg  [25:0] prim_z_g,          // UQ16.10 LSB, modular, step to the next pixel of the span
  output reg  [14:0] prim_r_start,      // UQ5.10 LSB, modular, value at the first pixel of the first line
  output reg  [14:0] prim_r_d0,         // UQ5.10 LSB, modular, step to the next line, edge without carry
  output reg  [14:0] prim_r_d1,         // UQ5.10 LSB, modular, step to the next line, edge with carry
  output reg  [14:0] prim_r_g,          // UQ5.10 LSB, modular, step to the next pixel of the span
  output reg  [14:0] prim_g_start,      // UQ5.10 LSB, modular, value at the first pixel of the first line
  output reg  [14:0] prim_g_d0,         // UQ5.10 LSB, modular, step to the next line, edge without carry
  output reg  [14:0] prim_g_d1,         // UQ5.10 LSB, modular, step to the next line, edge with carry
  output reg  [14:0] prim_g_g,          // UQ5.10 LSB, modular, step to the next pixel of the span
  output reg  [14:0] prim_b_start,      // UQ5.10 LSB, modular, value at the first pixel of the first line
  output reg  [14:0] prim_b_d0,         // UQ5.10 LSB, modular, step to the next line, edge without carry
  output reg  [14:0] prim_b_d1,         // UQ5.10 LSB, modular, step to the next line, edge with carry
  output reg  [14:0] prim_b_g           // UQ5.10 LSB, modular, step to the next pixel of the span
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
  reg [1:0] round;       // of the jobs the lanes do in turn

  // A number outside ±M pauses the sequence for two clocks, plus one for each pair of digits.
  reg [3:0] pause;                           // clocks of the pause that are left
  reg paused;                                // the operation is not over
  wire advance = !paused;
  assign tri_ready = state == IDLE;
  wire take = tri_valid && tri_ready;
  wire works = state == WORK;
  assign prim_valid = state == DONE;
  wire begins = works && (at == SUBTRACT);   // the first clock of a triangle
  wire gives_up = works && (at == TAKE_DX) && (round == 2'd0) && nothing;  // the triangle has no line or no column
  wire last = left == 5'd0;                  // last clock of the operation
  wire edges_end = last && (at == SUM) && (round == 2'd2);
  wire round_ends = last && (at == SUM_START) && !(round == 2'd3);
  wire waits = (edges_end || round_ends) && !area_known;  // for the area or its scale
  wire goes = works && !waits && !gives_up;  // a step of the operation is done in this clock
  wire ends = goes && last;                  // it ends
  wire leaves = ends && advance;
  wire channels_end = (at == SUM_START) && (round == 2'd3);

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
    if (leaves) begin
      at <= ((at == SUM_START) && !channels_end) ? TAKE12
          : ((at == SUM) && !edges_end) ? TAKE_DX
          : at + 5'd1;
    end
    if (take) at <= SUBTRACT;
  end

  always @(posedge clk) begin
    first <= leaves || (first && waits);
  end

  always @(posedge clk) begin
    if (leaves && ((at == SUM) || (at == SUM_START))) round <= round + 2'd1;
    if ((leaves && edges_end) || take) round <= 2'd0;
  end

  // How long the next operation takes.
  always @(posedge clk) begin
    if (advance && works) left <= left - 5'd1;
    if (leaves) begin
      left <= (at == SIGN_START) ? top_digit
            : (at == SUM_LINE) ? 5'd6 + {1'b0, scale}
            : (at == SIGN_LINE) ? top_digit
            : (at == SUM_X) ? 5'd6 + {1'b0, scale}
            : (at == WAIT) ? top_digit
            : (at == WAIT_DX) ? top_digit
            : (at == ADD_DX) ? 5'd1
            : (at == TAKE_DX) ? 5'd1
            : 5'd0;
    end
    if (leaves && channels_end) left <= 5'd3;
    if (state == STORE) left <= left - 5'd1;
    if (waits) left <= 5'd0;
    if (take) left <= 5'd0;
  end

  // The way of an operation: named, its addends formed, its step done, the rest and then the whole of the result.
  reg [4:0] at_next;
  reg [1:0] round_next;
  reg ends_next;
  wire resumes = pause == 4'd1;  // the step after the numbers is formed again
  wire [4:0] at_formed = advance ? at_next : resumes ? DOUBLE_DX : TAKE_DX;
  wire [1:0] round_formed = round_next;
  wire ends_formed = advance ? ends_next : resumes ? 1'b0 : pause == 4'd2;
  reg [4:0] at_stepped;
  reg [1:0] round_stepped;
  reg ends_stepped;
  reg [4:0] at_rest;
  reg [1:0] round_rest;
  reg ends_rest;
  reg [4:0] at_whole;
  reg [1:0] round_whole;
  reg ends_whole;
  reg worked;                    // works, a clock ago
  wire rests = !goes;

  always @(posedge clk) begin
    if (advance) begin
      at_next <= at;
      round_next <= round;
      ends_next <= ends;
    end
  end

  always @(posedge clk) begin
    at_stepped <= at_formed;
    round_stepped <= round_formed;
    ends_stepped <= ends_formed;
    at_rest <= at_stepped;
    round_rest <= round_stepped;
    ends_rest <= ends_stepped;
    at_whole <= at_rest;
    round_whole <= round_rest;
    ends_whole <= ends_rest;
    pause <= advance ? 4'd8 : pause - 4'd1;
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
  reg [11:0] p0_u;      // Q9.3, signed
  reg [11:0] p0_v;      // Q9.3, signed
  reg [11:0] p1_u;      // Q9.3, signed
  reg [11:0] p1_v;      // Q9.3, signed
  reg [11:0] p2_u;      // Q9.3, signed
  reg [11:0] p2_v;      // Q9.3, signed
  reg [1:0] p0_vertex;  // the vertex at this place: 0, 1 or 2
  reg [1:0] p1_vertex;  // the vertex at this place: 0, 1 or 2
  reg [1:0] p2_vertex;  // the vertex at this place: 0, 1 or 2
  wire both = y1_above_y0 && !y2_above_y1;
  wire both_2 = y2_above_y0 && y2_above_y1;
  wire both_3 = !y1_above_y0 && y2_above_y1;
  wire both_4 = !y2_above_y0 && !y2_above_y1;
  wire [11:0] choice = (!both && !both_3) ? tri_x1 : (!both_2 && !both_4) ? tri_x2 : tri_x0;
  wire [11:0] choice_2 = (!both && !both_3) ? tri_y1 : (!both_2 && !both_4) ? tri_y2 : tri_y0;

  always @(posedge clk) begin
    if (take) begin
      p0_u <= (both ? tri_x1 : both_2 ? tri_x2 : tri_x0) - 12'd4;
      p0_v <= (both ? tri_y1 : both_2 ? tri_y2 : tri_y0) - 12'd4;
      p1_u <= choice - 12'd4;
      p1_v <= choice_2 - 12'd4;
      p2_u <= (both_3 ? tri_x1 : both_4 ? tri_x2 : tri_x0) - 12'd4;
      p2_v <= (both_3 ? tri_y1 : both_4 ? tri_y2 : tri_y0) - 12'd4;
      p0_vertex <= {both_2, both};
      p1_vertex <= {!both_2 && !both_4, !both && !both_3};
      p2_vertex <= {both_4, both_3};
    end
  end

  // Values at the vertices, as tri has them.
  reg [15:0] vertex0_z;  // UQ16.0 LSB
  reg [4:0] vertex0_r;   // UQ5.0 LSB
  reg [4:0] vertex0_g;   // UQ5.0 LSB
  reg [4:0] vertex0_b;   // UQ5.0 LSB
  reg [15:0] vertex1_z;  // UQ16.0 LSB
  reg [4:0] vertex1_r;   // UQ5.0 LSB
  reg [4:0] vertex1_g;   // UQ5.0 LSB
  reg [4:0] vertex1_b;   // UQ5.0 LSB
  reg [15:0] vertex2_z;  // UQ16.0 LSB
  reg [4:0] vertex2_r;   // UQ5.0 LSB
  reg [4:0] vertex2_g;   // UQ5.0 LSB
  reg [4:0] vertex2_b;   // UQ5.0 LSB

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
  wire [11:0] tall = p2_v - p0_v;
  reg [11:0] dv02;  // from vertex 0 down to vertex 2, 1/8 px
  reg [11:0] dv01;  // from vertex 0 down to vertex 1, 1/8 px
  reg [11:0] dv12;  // from vertex 1 down to vertex 2, 1/8 px
  reg [12:0] du02;  // from vertex 0 right to vertex 2, 1/8 px, signed
  reg [12:0] du01;  // from vertex 0 right to vertex 1, 1/8 px, signed
  reg [12:0] du12;  // from vertex 1 right to vertex 2, 1/8 px, signed

  always @(posedge clk) begin
    dv02 <= p2_v - p0_v;
    dv01 <= p1_v - p0_v;
    dv12 <= p2_v - p1_v;
    du02 <= {p2_u[11], p2_u} - {p0_u[11], p0_u};
    du01 <= {p1_u[11], p1_u} - {p0_u[11], p0_u};
    du12 <= {p2_u[11], p2_u} - {p1_u[11], p1_u};
  end

  // Twice the area: du1 dv2 - du2 dv1, over the bits of dv2 and dv1.
  reg [3:0] area_digit;  // place of the digits added
  reg area_adds;         // digits are added
  wire [11:0] shifted = dv02 >> area_digit;
  wire [11:0] shifted_2 = dv01 >> area_digit;
  wire [13:0] area_part = (shifted[0] ? {du01[12], du01} : 14'd0)
                        - (shifted_2[0] ? {du02[12], du02} : 14'd0);
  reg [24:0] area;       // twice the area, 1/64 px^2, signed
  assign no_area = !(|area);
  wire [11:0] either = tall | 12'd2;
  wire [3:0] part = either[11:8];
  wire any = |part;
  wire [1:0] part_2 = part[3:2];
  wire any_2 = |part_2;
  wire [1:0] part_3 = part[1:0];
  wire [7:0] part_5 = either[7:0];
  wire [3:0] part_4 = part_5[7:4];
  wire any_3 = |part_4;
  wire [1:0] part_6 = part_4[3:2];
  wire any_4 = |part_6;
  wire [1:0] part_7 = part_4[1:0];
  wire [3:0] part_9 = part_5[3:0];
  wire [1:0] part_8 = part_9[3:2];
  wire any_5 = |part_8;
  wire [1:0] part_10 = part_9[1:0];
  wire [1:0] choice_3 = any_3 ? {any_4, any_4 ? part_6[1] : part_7[1]}
                      : {any_5, any_5 ? part_8[1] : part_10[1]};
  wire [2:0] choice_4 = any ? {1'b0, {any_2, any_2 ? part_2[1] : part_3[1]}} : {any_3, choice_3};

  always @(posedge clk) begin
    area_digit <= area_digit - 4'd1;
    if (begins) area_digit <= {any, choice_4};
  end

  wire equal = area_digit == 4'd0;

  always @(posedge clk) begin
    if (equal) area_adds <= 1'b0;
    if (begins) area_adds <= 1'b1;
  end

  always @(posedge clk) begin
    if (area_adds) area <= (area << 1) + {{11{area_part[13]}}, area_part};
    if (begins) area <= 25'd0;
  end

  // The area as modulus: fourfold, i times, until the differences of the next round's values fit.
  reg [15:0] differences;  // their bits, or those of complements
  reg [24:0] scaled;       // -M or -M - 1, signed
  reg scale_taken;         // the area is taken
  reg scaling;             // the scaled modulus is compared with the differences
  reg [3:0] scale_next;    // how many times the modulus is multiplied by 4
  wire [25:0] less_m = {{9'd0, differences}, 1'b1} + {scaled, 1'b1};  // and a carry out of the lowest bit
  wire [24:0] part_11 = less_m[25:1];
  wire fits = (|area) ? part_11[24] : 1'b1;
  wire grows = scaling && !fits;
  assign area_known = !area_adds && !scale_taken && !scaling;
  reg [3:0] scale_now;     // of the round
  assign scale = scale_now;
  wire either_2 = (area_adds && equal) || ((at == SIGN_LINE) && first && !(round == 2'd3));

  always @(posedge clk) begin
    scale_taken <= either_2 && !begins;
  end

  always @(posedge clk) begin
    if (fits) scaling <= 1'b0;
    if (scale_taken) scaling <= 1'b1;
  end

  wire inverse = !area[24];
  wire [24:0] extended = area;

  always @(posedge clk) begin
    if (grows) begin
      scaled <= {scaled[22:0], inverse, inverse};
      scale_next <= scale_next + 4'd1;
    end
    if (scale_taken) begin
      scaled <= inverse ? ~extended : extended;
      scale_next <= 4'd0;
    end
  end

  always @(posedge clk) begin
    if (at_next == TAKE12) scale_now <= scale_next;
  end

  // Lines: those whose centres lie at or below the upper end and above the lower end, on the screen.
  wire [10:0] part_12 = p0_v[10:0];
  wire [9:0] line0 = {2'd0, part_12[10:3]} + {9'd0, |p0_v[2:0]};  // the first line of centres at or below the vertex, if that is not above the screen
  reg [9:0] j0;        // line of the screen
  wire [10:0] part_13 = p1_v[10:0];
  wire [9:0] line1 = {2'd0, part_13[10:3]} + {9'd0, |p1_v[2:0]};  // the first line of centres at or below the vertex, if that is not above the screen
  reg [9:0] j1;        // line of the screen
  wire [10:0] part_14 = p2_v[10:0];
  wire [9:0] line2 = {2'd0, part_14[10:3]} + {9'd0, |p2_v[2:0]};  // the first line of centres at or below the vertex, if that is not above the screen
  reg [9:0] end_line;  // line of the screen
  wire [9:0] difference = j1 - j0;
  wire [9:0] difference_2 = end_line - j1;

  always @(posedge clk) begin
    j0 <= p0_v[11] ? 10'd0 : (part_12 <= 11'd1272) ? line0 : 10'd160;
    j1 <= p1_v[11] ? 10'd0 : (part_13 <= 11'd1272) ? line1 : 10'd160;
    end_line <= p2_v[11] ? 10'd0 : (part_14 <= 11'd1272) ? line2 : 10'd160;
    prim_n1 <= difference[8:0];
    prim_n2 <= difference_2[8:0];
  end

  // Columns: is there a column centre of the screen from the leftmost up to before the rightmost vertex?
  wire [8:0] column0 = p0_u[11:3] + {8'd0, |p0_u[2:0]};  // the first column of centres at or right of the vertex
  wire [8:0] column1 = p1_u[11:3] + {8'd0, |p1_u[2:0]};  // the first column of centres at or right of the vertex
  wire [8:0] column2 = p2_u[11:3] + {8'd0, |p2_u[2:0]};  // the first column of centres at or right of the vertex
  wire none_between = (column0 == column1) && (column1 == column2);
  wire before_screen = (p0_u[11] || !(|p0_u)) && (p1_u[11] || !(|p1_u)) && (p2_u[11] || !(|p2_u));  // no vertex lies right of the first column of centres
  wire behind_screen = !($signed(p0_u) <= 12'sd1912)  // every vertex lies right of the last column of centres
                    && !($signed(p1_u) <= 12'sd1912)
                    && !($signed(p2_u) <= 12'sd1912);
  reg no_column;                                 // no column of the screen
  assign nothing = (j0 == end_line) || no_column;
  wire upper = |prim_n1;
  wire [9:0] jm = upper ? j0 : j1;               // first line of the triangle
  wire [12:0] joined = {jm, 3'd0};
  wire [10:0] h0 = joined[10:0] - p0_v[10:0];    // from vertex 0 down to the first line, 1/8 px
  wire [12:0] joined_2 = {j1, 3'd0};
  wire [10:0] h1 = joined_2[10:0] - p1_v[10:0];  // from vertex 1 down to the first line of part 2, 1/8 px

  always @(posedge clk) begin
    no_column <= none_between || before_screen || behind_screen;
  end

  // Factors of the next sum, signed. Its first digit is the highest in which one of them differs from its sign.
  reg [13:0] q_times_f;      // q of the major edge, times the factor's digits so far
  reg [13:0] q_times_g;      // q of the major edge, times the factor's digits so far
  reg [13:0] first_sheared;  // from vertex 0 right to the first pixel, less q px a line; 1/8 px, signed
  reg [13:0] f;              // factor, signed
  reg [13:0] g;              // factor, signed
  wire [12:0] digits = (f[12:0] ^ f[13:1]) | (g[12:0] ^ g[13:1]);  // digits of the factors that differ from their signs
  wire any_6 = |digits[12:8];
  wire [4:0] part_15 = digits[12:8];
  wire any_7 = part_15[4];
  wire [3:0] part_17 = part_15[3:0];
  wire [1:0] part_16 = part_17[3:2];
  wire any_8 = |part_16;
  wire [1:0] part_18 = part_17[1:0];
  wire [7:0] part_20 = digits[7:0];
  wire [3:0] part_19 = part_20[7:4];
  wire any_9 = |part_19;
  wire [1:0] part_21 = part_19[3:2];
  wire any_10 = |part_21;
  wire [1:0] part_22 = part_19[1:0];
  wire [3:0] part_24 = part_20[3:0];
  wire [1:0] part_23 = part_24[3:2];
  wire any_11 = |part_23;
  wire [1:0] part_25 = part_24[1:0];
  wire [1:0] choice_5 = any_9 ? {any_10, any_10 ? part_21[1] : part_22[1]}
                      : {any_11, any_11 ? part_23[1] : part_25[1]};
  wire [2:0] choice_6 = any_6 ? {any_7, any_7 ? 2'd0 : {any_8, any_8 ? part_16[1] : part_18[1]}}
                      : {any_9, choice_5};
  assign top_digit = {1'b0, {any_6, choice_6}};
  wire [13:0] shifted_3 = f >> left;
  wire digit_f = shifted_3[0];
  wire [13:0] shifted_4 = g >> left;
  wire digit_g = shifted_4[0];
  wire [12:0] joined_3 = {prim_major_c - {9'd0, area[24]}, 3'd0};

  always @(posedge clk) begin
    if ((at_next == WAIT) && (round_next == 2'd0)) begin
      first_sheared <= {joined_3[12], joined_3} - {{2{p0_u[11]}}, p0_u} - q_times_g;
    end
  end

  always @(posedge clk) begin
    if (at == WAIT_DX) begin
      f <= (round == 2'd2) ? {11'd0, p1_u[2:0]} & {14{|prim_n2}}
         : (round == 2'd1) ? {11'd0, p0_u[2:0]} & {14{|prim_n1}}
         : {11'd0, p0_u[2:0]};
      g <= (round == 2'd2) ? {3'd0, h1} & {14{|prim_n2}}
         : (round == 2'd1) ? {3'd0, h0} & {14{|prim_n1}}
         : {3'd0, h0};
    end
    if (at == TAKE2) begin
      f <= {2'd0, dv02};
      g <= {2'd0, dv01};
    end
    if (at == DOUBLE_X) begin
      f <= q_times_f - {du02[12], du02};
      g <= q_times_g - {du01[12], du01};
    end
    if (at == ADD_X) begin
      f <= first_sheared;
      g <= {3'd0, h0};
    end
  end

  always @(posedge clk) begin
    if (((at == SUM_X) || ((at == SUM) && (round == 2'd0))) && !rests) begin
      q_times_f <= (first ? 14'd0 : q_times_f << 1)
                 + (digit_f ? {{4{prim_major_q[9]}}, prim_major_q} : 14'd0);
      q_times_g <= (first ? 14'd0 : q_times_g << 1)
                 + (digit_g ? {{4{prim_major_q[9]}}, prim_major_q} : 14'd0);
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
  wire negated = (at_rest == DOUBLE_X) && area[24];

  // Lane 0: its steps.
  wire [4:0] choice_7 = (round == 2'd3) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                      : (round == 2'd2) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                      : (round == 2'd1) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                      : (left == 5'd0) ? STEP_DOUBLE1
                      : STEP_DOUBLE2;
  wire [4:0] choice_8 = (round == 2'd3) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                      : (round == 2'd2) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                      : (round == 2'd1) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                      : (left == 5'd0) ? STEP_DOUBLE1
                      : STEP_DOUBLE2;
  wire [4:0] step0 = rests ? STEP_REST
                   : (at == DOUBLE_LINE) ? choice_7
                   : (at == DOUBLE_X) ? choice_8
                   : (at == DOUBLE_DX) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                   : step;
  reg [4:0] step_next0;
  reg [4:0] step_of_pause0;
  wire [4:0] step_formed0 = advance ? step_next0 : step_of_pause0;

  always @(posedge clk) begin
    if (advance) step_next0 <= step0;
  end

  always @(posedge clk) begin
    step_of_pause0 <= (pause == 4'd2) ? STEP_DOUBLE2 : advance ? STEP_BEGIN : STEP_DIGITS;
  end

  // Inputs of the lanes in the next clock.
  reg [1:0] from_place;
  wire [1:0] from_vertex = (from_place == 2'd2) ? p2_vertex
                         : (from_place == 2'd1) ? p1_vertex
                         : p0_vertex;
  reg [1:0] to_place;
  wire [1:0] to_vertex = (to_place == 2'd2) ? p2_vertex : (to_place == 2'd1) ? p1_vertex : p0_vertex;
  reg single_value;
  reg values_of_round1;
  reg values_of_round2;
  reg values_of_round3;
  reg number_of_edge;
  reg number_is_height;
  wire both_5 = area[24] && ((at == TAKE12) || (at == TAKE1) || (at == TAKE2));
  wire either_6 = (at == SUBTRACT) || (at == TAKE12) || (at == WAIT);
  wire either_7 = (at == DOUBLE_DX) || (at == TAKE2) || (at == DOUBLE_X);
  wire [1:0] choice_9 = either_6 ? 2'd1 : either_7 ? 2'd0 : 2'd1;
  wire [1:0] choice_10 = either_6 ? 2'd2 : either_7 ? 2'd2 : 2'd0;
  wire equal_2 = at == SIGN_START;
  wire either_8 = (at == WAIT) || (at == SUM_X) || (at == DOUBLE_X);
  wire either_9 = (at == SUBTRACT) || (at == TAKE_DX) || (at == DOUBLE_DX);

  always @(posedge clk) begin
    from_place <= both_5 ? choice_9 : choice_10;
    to_place <= equal_2 ? 2'd0 : both_5 ? choice_10 : choice_9;
    single_value <= equal_2;
    values_of_round1 <= (either_8 ? round == 2'd0 : round == 2'd1) && !either_9;
    values_of_round2 <= (either_8 ? round == 2'd1 : round == 2'd2) && !either_9;
    values_of_round3 <= (either_8 ? round == 2'd2 : round == 2'd3) && !either_9;
  end

  always @(posedge clk) begin
    if (advance) begin
      number_of_edge <= (at == TAKE_DX) || (at == TAKE_DY);
      number_is_height <= at == TAKE_DY;
    end
  end

  // Lane 0: what it takes in.
  wire [12:0] extended_2 = {1'b0, dv12};
  wire [12:0] extended_3 = {1'b0, dv01};
  wire [12:0] extended_4 = {1'b0, dv02};
  wire [16:0] choice_11 = (round_next == 2'd2) ? {{4{extended_2[12]}}, extended_2}
                        : (round_next == 2'd1) ? {{4{extended_3[12]}}, extended_3}
                        : {{4{extended_4[12]}}, extended_4};
  wire [16:0] choice_12 = number_is_height ? choice_11
                        : (round_next == 2'd2) ? {{4{du12[12]}}, du12}
                        : (round_next == 2'd1) ? {{4{du01[12]}}, du01}
                        : {{4{du02[12]}}, du02};
  wire [16:0] choice_13 = values_of_round3 ? {12'd0, vertex2_b}
                        : values_of_round2 ? {12'd0, vertex2_g}
                        : values_of_round1 ? {12'd0, vertex2_r}
                        : {1'b0, vertex2_z};
  wire [16:0] choice_14 = values_of_round3 ? {12'd0, vertex1_b}
                        : values_of_round2 ? {12'd0, vertex1_g}
                        : values_of_round1 ? {12'd0, vertex1_r}
                        : {1'b0, vertex1_z};
  wire [16:0] choice_15 = values_of_round3 ? {12'd0, vertex0_b}
                        : values_of_round2 ? {12'd0, vertex0_g}
                        : values_of_round1 ? {12'd0, vertex0_r}
                        : {1'b0, vertex0_z};
  wire [16:0] choice_16 = values_of_round3 ? 17'd0
                        : values_of_round2 ? 17'd0
                        : values_of_round1 ? 17'd0
                        : 17'd0;
  wire [16:0] choice_17 = single_value ? choice_16
                        : from_vertex[1] ? choice_13
                        : from_vertex[0] ? choice_14
                        : choice_15;
  wire [16:0] difference_3 = (to_vertex[1] ? choice_13 : to_vertex[0] ? choice_14 : choice_15)
                           - choice_17;
  wire [16:0] number0 = number_of_edge ? choice_12 : difference_3;  // signed
  reg [16:0] kept0;  // a number that may not fit, or a first value; signed
  wire [15:0] shown = difference_3[15:0] ^ {16{difference_3[16]}};
  wire lane0_unfit;
  wire choice_18 = (round_stepped == 2'd2) ? |prim_n2 : (round_stepped == 2'd1) ? |prim_n1 : 1'b1;
  assign unfit = lane0_unfit && choice_18;

  always @(posedge clk) begin
    if ((at_next == TAKE_DX) || (at_next == SIGN_START)) kept0 <= number0;
  end

  always @(posedge clk) begin
    if ((at_next == SUBTRACT)
     || (at_next == TAKE_DX)
     || (at_next == DOUBLE_DX)
     || (at_next == WAIT)
     || (at_next == SUM_X)
     || (at_next == DOUBLE_X)) begin
      differences <= differences | shown;
    end
    if (begins || (at_next == TAKE12)) differences <= 16'd0;
  end

  // Edge: major.
  wire [23:0] lane0_rest_out;
  wire [28:0] lane0_value;
  wire choice_19 = is_sign ? f[13] : digit_f;
  wire choice_20 = is_sign ? g[13] : digit_g;
  wire [16:0] shifted_5 = $signed(kept0) >>> {pause - 4'd2, 1'b0};
  wire [8:0] part_26 = p1_u[11:3];
  wire [8:0] part_27 = p0_u[11:3];
  wire [8:0] part_28 = p0_u[11:3];
  wire [28:0] choice_21 = (round_rest == 2'd2) ? {{20{part_26[8]}}, part_26}
                        : (round_rest == 2'd1) ? {{20{part_27[8]}}, part_27}
                        : {{20{part_28[8]}}, part_28};
  wire [29:0] joined_4 = {{{kept0, 1'b1}, 9'd0}, 3'd4};
  wire [29:0] joined_5 = {{{kept0, 1'b1}, 9'd0}, 3'd4};
  wire [29:0] joined_6 = {{{kept0, 1'b1}, 9'd0}, 3'd4};
  wire [29:0] joined_7 = {{{kept0, 1'b1}, 9'd0}, 3'd4};
  wire [28:0] choice_22 = (round_rest == 2'd3) ? joined_4[28:0]
                        : (round_rest == 2'd2) ? joined_5[28:0]
                        : (round_rest == 2'd1) ? joined_6[28:0]
                        : joined_7[28:0];
  wire equal_3 = at == TAKE12;

  edgewalk_setup_lane0 lane0 (
    .clk           (clk),
    .read_at       ((is_sum || is_sign) ? {of_gradients && (choice_19 || choice_20), choice_20, choice_19}
: read_single_at),
    .step          (step_formed0),
    .number        (number0),
    .digits        (shifted_5[1:0]),
    .write         (write),
    .write_at      (write_at),
    .whole_in      ((at_rest == SUM) ? choice_21 : (at_rest == SUM_START) ? choice_22 : 29'd0),
    .take_modulus  (take_modulus),
    .modulus_in    (equal_3 ? scaled
: (round == 2'd2) ? ~{10'd0, {dv12, 3'd0}}
: (round == 2'd1) ? ~{10'd0, {dv01, 3'd0}}
: ~{10'd0, {dv02, 3'd0}}),
    .modulus_short (!(equal_3 && area[24])),
    .give          (ends_rest),
    .nearest       (nearest),
    .upwards       (upwards),
    .negate        (negated),
    .unfit         (lane0_unfit),
    .rest_out      (lane0_rest_out),
    .value         (lane0_value)
  );

  wire any_12 = |dv02[11:3];
  wire [20:0] part_29 = lane0_rest_out[23:3];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == DOUBLE_DX) && (round_rest == 2'd0)) begin
      prim_major_f <= any_12 ? part_29[11:0] : 12'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_DX) && (round_whole == 2'd0)) begin
      prim_major_q <= any_12 ? lane0_value[9:0] : 10'd0;
    end
  end

  wire [14:0] difference_4 = {dv02, 3'd0} - lane0_rest_out[14:0];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == SUM) && (round_rest == 2'd0)) begin
      prim_major_dist <= (|lane0_rest_out) ? difference_4[14:3] : 12'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == SUM) && (round_whole == 2'd0)) prim_major_c <= lane0_value[9:0];
  end

  // Edge: minor1.
  wire both_6 = (|prim_n1) && (|dv01[11:3]);
  wire [20:0] part_30 = lane0_rest_out[23:3];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == DOUBLE_DX) && (round_rest == 2'd1)) begin
      prim_minor1_f <= both_6 ? part_30[11:0] : 12'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_DX) && (round_whole == 2'd1)) begin
      prim_minor1_q <= both_6 ? lane0_value[9:0] : 10'd0;
    end
  end

  wire [14:0] difference_5 = {dv01, 3'd0} - lane0_rest_out[14:0];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == SUM) && (round_rest == 2'd1)) begin
      prim_minor1_dist <= (|prim_n1) ? ((|lane0_rest_out) ? difference_5[14:3] : 12'd0) : 12'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == SUM) && (round_whole == 2'd1)) begin
      prim_minor1_c <= (|prim_n1) ? lane0_value[9:0] : 10'd0;
    end
  end

  // Edge: minor2.
  wire both_7 = (|prim_n2) && (|dv12[11:3]);
  wire [20:0] part_31 = lane0_rest_out[23:3];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == DOUBLE_DX) && (round_rest == 2'd2)) begin
      prim_minor2_f <= both_7 ? part_31[11:0] : 12'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_DX) && (round_whole == 2'd2)) begin
      prim_minor2_q <= both_7 ? lane0_value[9:0] : 10'd0;
    end
  end

  wire [14:0] difference_6 = {dv12, 3'd0} - lane0_rest_out[14:0];

  always @(posedge clk) begin
    if (ends_rest && (at_rest == SUM) && (round_rest == 2'd2)) begin
      prim_minor2_dist <= (|prim_n2) ? ((|lane0_rest_out) ? difference_6[14:3] : 12'd0) : 12'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == SUM) && (round_whole == 2'd2)) begin
      prim_minor2_c <= (|prim_n2) ? lane0_value[9:0] : 10'd0;
    end
  end

  // Channel: z.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X) && (round_whole == 2'd0)) prim_z_g <= lane0_value[25:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_LINE) && (round_whole == 2'd0)) begin
      prim_z_d0 <= lane0_value[25:0];
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == ADD_X) && (round_whole == 2'd0)) prim_z_d1 <= lane0_value[25:0];
  end

  always @(posedge clk) begin
    if ((at_whole == SUM_START) && (round_whole == 2'd0)) prim_z_start <= lane0_value[28:3];
  end

  // Channel: r.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X) && (round_whole == 2'd1)) prim_r_g <= lane0_value[14:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_LINE) && (round_whole == 2'd1)) begin
      prim_r_d0 <= lane0_value[14:0];
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == ADD_X) && (round_whole == 2'd1)) prim_r_d1 <= lane0_value[14:0];
  end

  always @(posedge clk) begin
    if ((at_whole == SUM_START) && (round_whole == 2'd1)) prim_r_start <= lane0_value[17:3];
  end

  // Channel: g.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X) && (round_whole == 2'd2)) prim_g_g <= lane0_value[14:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_LINE) && (round_whole == 2'd2)) begin
      prim_g_d0 <= lane0_value[14:0];
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == ADD_X) && (round_whole == 2'd2)) prim_g_d1 <= lane0_value[14:0];
  end

  always @(posedge clk) begin
    if ((at_whole == SUM_START) && (round_whole == 2'd2)) prim_g_start <= lane0_value[17:3];
  end

  // Channel: b.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X) && (round_whole == 2'd3)) prim_b_g <= lane0_value[14:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_LINE) && (round_whole == 2'd3)) begin
      prim_b_d0 <= lane0_value[14:0];
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == ADD_X) && (round_whole == 2'd3)) prim_b_d1 <= lane0_value[14:0];
  end

  always @(posedge clk) begin
    if ((at_whole == SUM_START) && (round_whole == 2'd3)) prim_b_start <= lane0_value[17:3];
  end

  assign prim_jm = jm[7:0];
  assign prim_major_right = area[24];
  assign prim_major_m = dv02;
  assign prim_minor1_m = dv01;
  assign prim_minor2_m = dv12;

  // Not needed, on purpose.
  wire unused = &{
    1'b0, WAIT_LINE, less_m[0], part_3[0], part_7[0], part_10[0], shifted[11:1], shifted_2[11:1],
    part_11[23:0], difference[9], difference_2[9], joined[12:11], joined_2[12:11], part_18[0],
    part_22[0], part_25[0], shifted_3[13:1], shifted_4[13:1], shifted_5[16:2], joined_7[29],
    joined_6[29], joined_5[29], joined_4[29], part_29[20:12], difference_4[2:0], part_30[20:12],
    difference_5[2:0], part_31[20:12], difference_6[2:0]
  };

endmodule

`default_nettype wire
