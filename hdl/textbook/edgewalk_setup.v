// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 0ee73237105a

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
  input  wire [13:0] tri_x0,            // Q14.0 px, x of vertex 0
  input  wire [13:0] tri_y0,            // Q14.0 px, y of vertex 0
  input  wire [15:0] tri_z0,            // UQ16.0 LSB, depth of vertex 0
  input  wire  [7:0] tri_r0,            // UQ8.0 LSB, red of vertex 0
  input  wire  [7:0] tri_g0,            // UQ8.0 LSB, green of vertex 0
  input  wire  [7:0] tri_b0,            // UQ8.0 LSB, blue of vertex 0
  input  wire [13:0] tri_x1,            // Q14.0 px, x of vertex 1
  input  wire [13:0] tri_y1,            // Q14.0 px, y of vertex 1
  input  wire [15:0] tri_z1,            // UQ16.0 LSB, depth of vertex 1
  input  wire  [7:0] tri_r1,            // UQ8.0 LSB, red of vertex 1
  input  wire  [7:0] tri_g1,            // UQ8.0 LSB, green of vertex 1
  input  wire  [7:0] tri_b1,            // UQ8.0 LSB, blue of vertex 1
  input  wire [13:0] tri_x2,            // Q14.0 px, x of vertex 2
  input  wire [13:0] tri_y2,            // Q14.0 px, y of vertex 2
  input  wire [15:0] tri_z2,            // UQ16.0 LSB, depth of vertex 2
  input  wire  [7:0] tri_r2,            // UQ8.0 LSB, red of vertex 2
  input  wire  [7:0] tri_g2,            // UQ8.0 LSB, green of vertex 2
  input  wire  [7:0] tri_b2,            // UQ8.0 LSB, blue of vertex 2
  input  wire        prim_ready,

  output wire        tri_ready,
  output wire        prim_valid,
  output wire  [8:0] prim_jm,           // first line
  output reg   [9:0] prim_n1,           // lines of the upper part
  output reg   [9:0] prim_n2,           // lines of the lower part
  output wire        prim_major_right,  // the major edge is the right one
  output reg  [14:0] prim_major_c,      // signed, first column on or right of the edge
  output reg  [15:0] prim_major_dist,   // distance from the edge to that column, 2^-F column
  output reg  [14:0] prim_major_q,      // signed, whole columns a line, step of c
  output reg  [15:0] prim_major_f,      // 2^-F column a line
  output reg  [14:0] prim_minor1_c,     // signed, first column on or right of the edge
  output reg  [15:0] prim_minor1_dist,  // distance from the edge to that column, 2^-F column
  output reg  [14:0] prim_minor1_q,     // signed, whole columns a line, step of c
  output reg  [15:0] prim_minor1_f,     // 2^-F column a line
  output reg  [14:0] prim_minor2_c,     // signed, first column on or right of the edge
  output reg  [15:0] prim_minor2_dist,  // distance from the edge to that column, 2^-F column
  output reg  [14:0] prim_minor2_q,     // signed, whole columns a line, step of c
  output reg  [15:0] prim_minor2_f,     // 2^-F column a line
  output reg  [29:0] prim_z_start_a,    // UQ16.14 LSB, modular, value on the left edge, first line of part 1
  output reg  [29:0] prim_z_d_a,        // UQ16.14 LSB, modular, step to the next line, part 1
  output reg  [29:0] prim_z_start_b,    // UQ16.14 LSB, modular, value on the left edge, first line of part 2
  output reg  [29:0] prim_z_d_b,        // UQ16.14 LSB, modular, step to the next line, part 2
  output reg  [29:0] prim_z_g,          // UQ16.14 LSB, modular, step to the next pixel of the span
  output reg  [21:0] prim_r_start_a,    // UQ8.14 LSB, modular, value on the left edge, first line of part 1
  output reg  [21:0] prim_r_d_a,        // UQ8.14 LSB, modular, step to the next line, part 1
  output reg  [21:0] prim_r_start_b,    // UQ8.14 LSB, modular, value on the left edge, first line of part 2
  output reg  [21:0] prim_r_d_b,        // UQ8.14 LSB, modular, step to the next line, part 2
  output reg  [21:0] prim_r_g,          // UQ8.14 LSB, modular, step to the next pixel of the span
  output reg  [21:0] prim_g_start_a,    // UQ8.14 LSB, modular, value on the left edge, first line of part 1
  output reg  [21:0] prim_g_d_a,        // UQ8.14 LSB, modular, step to the next line, part 1
  output reg  [21:0] prim_g_start_b,    // UQ8.14 LSB, modular, value on the left edge, first line of part 2
  output reg  [21:0] prim_g_d_b,        // UQ8.14 LSB, modular, step to the next line, part 2
  output reg  [21:0] prim_g_g,          // UQ8.14 LSB, modular, step to the next pixel of the span
  output reg  [21:0] prim_b_start_a,    // UQ8.14 LSB, modular, value on the left edge, first line of part 1
  output reg  [21:0] prim_b_d_a,        // UQ8.14 LSB, modular, step to the next line, part 1
  output reg  [21:0] prim_b_start_b,    // UQ8.14 LSB, modular, value on the left edge, first line of part 2
  output reg  [21:0] prim_b_d_b,        // UQ8.14 LSB, modular, step to the next line, part 2
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
  localparam [4:0] DOUBLE_COLUMNS = 5'd7;
  localparam [4:0] ROUND_COLUMNS = 5'd8;
  localparam [4:0] TAKE12 = 5'd9;
  localparam [4:0] TAKE1 = 5'd10;
  localparam [4:0] TAKE2 = 5'd11;
  localparam [4:0] WAIT = 5'd12;
  localparam [4:0] SUM_X = 5'd13;
  localparam [4:0] DOUBLE_X = 5'd14;
  localparam [4:0] ROUND_X = 5'd15;
  localparam [4:0] TAKE_A = 5'd16;
  localparam [4:0] DOUBLE_A = 5'd17;
  localparam [4:0] WAIT_A = 5'd18;
  localparam [4:0] SUM_A = 5'd19;
  localparam [4:0] DOUBLE_START_A = 5'd20;
  localparam [4:0] ROUND_A = 5'd21;
  localparam [4:0] TAKE_B = 5'd22;
  localparam [4:0] DOUBLE_B = 5'd23;
  localparam [4:0] WAIT_B = 5'd24;
  localparam [4:0] SUM_B = 5'd25;
  localparam [4:0] DOUBLE_START_B = 5'd26;
  localparam [4:0] ROUND_B = 5'd27;
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
  wire edges_end = last && (at == ROUND_COLUMNS) && (round == 2'd2);
  wire round_ends = last && (at == ROUND_B) && !(round == 2'd3);
  wire waits = (edges_end || round_ends) && !area_known;  // for the area or its scale
  wire goes = works && !waits && !gives_up;  // a step of the operation is done in this clock
  wire ends = goes && last;                  // it ends
  wire leaves = ends && advance;
  wire channels_end = (at == ROUND_B) && (round == 2'd3);

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
      at <= ((at == ROUND_B) && !channels_end) ? TAKE12
          : ((at == ROUND_COLUMNS) && !edges_end) ? TAKE_DX
          : at + 5'd1;
    end
    if (take) at <= SUBTRACT;
  end

  always @(posedge clk) begin
    if (advance) first <= leaves || (first && waits);
  end

  always @(posedge clk) begin
    if (leaves && ((at == ROUND_COLUMNS) || (at == ROUND_B))) round <= round + 2'd1;
    if ((leaves && edges_end) || take) round <= 2'd0;
  end

  // How long the next operation takes.
  always @(posedge clk) begin
    if (advance && works) left <= left - 5'd1;
    if (leaves) begin
      left <= (at == DOUBLE_START_B) ? 5'd1
            : (at == SUM_B) ? 5'd7
            : (at == WAIT_B) ? top_digit
            : (at == TAKE_B) ? 5'd7
            : (at == DOUBLE_START_A) ? 5'd1
            : (at == SUM_A) ? 5'd7
            : (at == WAIT_A) ? top_digit
            : (at == TAKE_A) ? 5'd7
            : (at == DOUBLE_X) ? 5'd1
            : (at == SUM_X) ? 5'd7 + {1'b0, scale}
            : (at == WAIT) ? top_digit
            : (at == DOUBLE_COLUMNS) ? 5'd1
            : (at == SUM) ? 5'd7
            : (at == WAIT_DX) ? top_digit
            : (at == ADD_DX) ? 5'd1
            : (at == TAKE_DX) ? 5'd8
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
  reg [4:0] at_again;
  reg [1:0] round_again;
  reg ends_again;
  reg [4:0] at_taken;
  wire [4:0] at_formed = advance ? at_next : resumes ? at_again : at_taken;
  wire [1:0] round_formed = advance ? round_next : round_again;
  wire ends_formed = advance ? ends_next : resumes ? ends_again : pause == 4'd2;
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
      at_again <= at_formed;
      round_again <= round_formed;
      ends_again <= ends_formed;
      at_taken <= at_stepped;
    end
  end

  wire [3:0] choice = (at_stepped == TAKE_DX) ? 4'd10
                    : (round_stepped == 2'd3) ? 4'd6
                    : (round_stepped == 2'd2) ? 4'd6
                    : (round_stepped == 2'd1) ? 4'd6
                    : 4'd10;

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
    pause <= advance ? choice : pause - 4'd1;
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
  reg [14:0] p0_u;      // Q14.1, signed
  reg [14:0] p0_v;      // Q14.1, signed
  reg [14:0] p1_u;      // Q14.1, signed
  reg [14:0] p1_v;      // Q14.1, signed
  reg [14:0] p2_u;      // Q14.1, signed
  reg [14:0] p2_v;      // Q14.1, signed
  reg [1:0] p0_vertex;  // the vertex at this place: 0, 1 or 2
  reg [1:0] p1_vertex;  // the vertex at this place: 0, 1 or 2
  reg [1:0] p2_vertex;  // the vertex at this place: 0, 1 or 2
  wire both = y1_above_y0 && !y2_above_y1;
  wire both_2 = y2_above_y0 && y2_above_y1;
  wire both_3 = !y1_above_y0 && y2_above_y1;
  wire both_4 = !y2_above_y0 && !y2_above_y1;
  wire [13:0] choice_2 = (!both && !both_3) ? tri_x1 : (!both_2 && !both_4) ? tri_x2 : tri_x0;
  wire [13:0] choice_3 = (!both && !both_3) ? tri_y1 : (!both_2 && !both_4) ? tri_y2 : tri_y0;

  always @(posedge clk) begin
    if (take) begin
      p0_u <= {both ? tri_x1 : both_2 ? tri_x2 : tri_x0, 1'b0};
      p0_v <= {both ? tri_y1 : both_2 ? tri_y2 : tri_y0, 1'b0};
      p1_u <= {choice_2, 1'b0};
      p1_v <= {choice_3, 1'b0};
      p2_u <= {both_3 ? tri_x1 : both_4 ? tri_x2 : tri_x0, 1'b0};
      p2_v <= {both_3 ? tri_y1 : both_4 ? tri_y2 : tri_y0, 1'b0};
      p0_vertex <= {both_2, both};
      p1_vertex <= {!both_2 && !both_4, !both && !both_3};
      p2_vertex <= {both_4, both_3};
    end
  end

  // Values at the vertices, as tri has them.
  reg [15:0] vertex0_z;  // UQ16.0 LSB
  reg [7:0] vertex0_r;   // UQ8.0 LSB
  reg [7:0] vertex0_g;   // UQ8.0 LSB
  reg [7:0] vertex0_b;   // UQ8.0 LSB
  reg [15:0] vertex1_z;  // UQ16.0 LSB
  reg [7:0] vertex1_r;   // UQ8.0 LSB
  reg [7:0] vertex1_g;   // UQ8.0 LSB
  reg [7:0] vertex1_b;   // UQ8.0 LSB
  reg [15:0] vertex2_z;  // UQ16.0 LSB
  reg [7:0] vertex2_r;   // UQ8.0 LSB
  reg [7:0] vertex2_g;   // UQ8.0 LSB
  reg [7:0] vertex2_b;   // UQ8.0 LSB

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
  wire [14:0] tall = p2_v - p0_v;
  reg [14:0] dv02;  // from vertex 0 down to vertex 2, 1/2 px
  reg [14:0] dv01;  // from vertex 0 down to vertex 1, 1/2 px
  reg [14:0] dv12;  // from vertex 1 down to vertex 2, 1/2 px
  reg [15:0] du02;  // from vertex 0 right to vertex 2, 1/2 px, signed
  reg [15:0] du01;  // from vertex 0 right to vertex 1, 1/2 px, signed
  reg [15:0] du12;  // from vertex 1 right to vertex 2, 1/2 px, signed

  always @(posedge clk) begin
    dv02 <= p2_v - p0_v;
    dv01 <= p1_v - p0_v;
    dv12 <= p2_v - p1_v;
    du02 <= {p2_u[14], p2_u} - {p0_u[14], p0_u};
    du01 <= {p1_u[14], p1_u} - {p0_u[14], p0_u};
    du12 <= {p2_u[14], p2_u} - {p1_u[14], p1_u};
  end

  // Twice the area: du1 dv2 - du2 dv1, over the bits of dv2 and dv1.
  reg [3:0] area_digit;  // place of the digits added
  reg area_adds;         // digits are added
  wire [14:0] shifted = dv02 >> area_digit;
  wire [14:0] shifted_2 = dv01 >> area_digit;
  wire [16:0] area_part = (shifted[0] ? {du01[15], du01} : 17'd0)
                        - (shifted_2[0] ? {du02[15], du02} : 17'd0);
  reg [30:0] area;       // twice the area, 1/4 px^2, signed
  assign no_area = !(|area);
  wire [14:0] either = tall | 15'd2;
  wire [6:0] part = either[14:8];
  wire any = |part;
  wire [2:0] part_2 = part[6:4];
  wire any_2 = |part_2;
  wire any_3 = part_2[2];
  wire [1:0] part_3 = part_2[1:0];
  wire [3:0] part_5 = part[3:0];
  wire [1:0] part_4 = part_5[3:2];
  wire any_4 = |part_4;
  wire [1:0] part_6 = part_5[1:0];
  wire [1:0] choice_4 = any_2 ? {any_3, any_3 ? 1'b0 : part_3[1]}
                      : {any_4, any_4 ? part_4[1] : part_6[1]};
  wire [7:0] part_8 = either[7:0];
  wire [3:0] part_7 = part_8[7:4];
  wire any_5 = |part_7;
  wire [1:0] part_9 = part_7[3:2];
  wire any_6 = |part_9;
  wire [1:0] part_10 = part_7[1:0];
  wire [3:0] part_12 = part_8[3:0];
  wire [1:0] part_11 = part_12[3:2];
  wire any_7 = |part_11;
  wire [1:0] part_13 = part_12[1:0];
  wire [1:0] choice_5 = any_5 ? {any_6, any_6 ? part_9[1] : part_10[1]}
                      : {any_7, any_7 ? part_11[1] : part_13[1]};

  always @(posedge clk) begin
    area_digit <= area_digit - 4'd1;
    if (begins) area_digit <= {any, any ? {any_2, choice_4} : {any_5, choice_5}};
  end

  wire equal = area_digit == 4'd0;

  always @(posedge clk) begin
    if (equal) area_adds <= 1'b0;
    if (begins) area_adds <= 1'b1;
  end

  always @(posedge clk) begin
    if (area_adds) area <= (area << 1) + {{14{area_part[16]}}, area_part};
    if (begins) area <= 31'd0;
  end

  // The area as modulus: fourfold, i times, until the differences of the next round's values fit.
  reg [15:0] differences;  // their bits, or those of complements
  reg [30:0] scaled;       // -M or -M - 1, signed
  reg scale_taken;         // the area is taken
  reg scaling;             // the scaled modulus is compared with the differences
  reg [3:0] scale_next;    // how many times the modulus is multiplied by 4
  wire [31:0] less_m = {{15'd0, differences}, 1'b1} + {scaled, 1'b1};  // and a carry out of the lowest bit
  wire [30:0] part_14 = less_m[31:1];
  wire fits = (|area) ? part_14[30] : 1'b1;
  wire grows = scaling && !fits;
  assign area_known = !area_adds && !scale_taken && !scaling;
  reg [3:0] scale_now;     // of the round
  assign scale = scale_now;
  wire either_2 = (area_adds && equal) || ((at == ROUND_X) && first && !(round == 2'd3));

  always @(posedge clk) begin
    scale_taken <= either_2 && !begins;
  end

  always @(posedge clk) begin
    if (fits) scaling <= 1'b0;
    if (scale_taken) scaling <= 1'b1;
  end

  wire inverse = !area[30];
  wire [30:0] extended = area;

  always @(posedge clk) begin
    if (grows) begin
      scaled <= {scaled[28:0], inverse, inverse};
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

  // Lines of each part: from Y of the upper to Y of the lower end, both drawn, on the screen.
  wire [13:0] part_15 = p0_v[14:1];
  wire [14:0] extended_2 = {part_15[13], part_15};
  wire [14:0] j0_next = ($signed(extended_2) < 15'sd0) ? 15'd0 : extended_2;
  wire [13:0] part_16 = p1_v[14:1];
  wire [14:0] extended_3 = {part_16[13], part_16};
  wire [14:0] last0 = ($signed(extended_3) < 15'sd479) ? extended_3 : 15'd479;
  wire [13:0] part_17 = p0_v[14:1];
  wire [13:0] part_18 = p1_v[14:1];
  wire less = $signed({part_17[13], part_17}) < $signed({part_18[13], part_18});
  wire some0 = less && ($signed(j0_next) <= $signed(last0));
  reg [14:0] j0;                                 // line, signed
  wire [13:0] part_19 = p1_v[14:1];
  wire [14:0] extended_4 = {part_19[13], part_19};
  wire [14:0] j1_next = ($signed(extended_4) < 15'sd0) ? 15'd0 : extended_4;
  wire [13:0] part_20 = p2_v[14:1];
  wire [14:0] extended_5 = {part_20[13], part_20};
  wire [14:0] last1 = ($signed(extended_5) < 15'sd479) ? extended_5 : 15'd479;
  wire [13:0] part_21 = p1_v[14:1];
  wire [13:0] part_22 = p2_v[14:1];
  wire less_2 = $signed({part_21[13], part_21}) < $signed({part_22[13], part_22});
  wire some1 = less_2 && ($signed(j1_next) <= $signed(last1));
  reg [14:0] j1;                                 // line, signed
  assign nothing = !(|prim_n1) && !(|prim_n2);
  wire upper = |prim_n1;
  wire [14:0] jm = upper ? j0 : j1;              // first line of the triangle
  wire [15:0] joined = {jm, 1'b0};
  wire [13:0] h0 = joined[13:0] - p0_v[13:0];    // from vertex 0 down to the first line, 1/2 px
  wire [15:0] joined_2 = {j1, 1'b0};
  wire [13:0] h1 = joined_2[13:0] - p1_v[13:0];  // from vertex 1 down to the first line of part 2, 1/2 px
  wire [15:0] left_a = {j0, 1'b0} - {p0_v[14], p0_v};  // from vertex 0 down to the first line of part 1, 1/2 px
  wire [15:0] left_b = {j1, 1'b0} - {p0_v[14], p0_v};  // from vertex 0 down to the first line of part 2, 1/2 px
  wire [14:0] choice_6 = some0 ? last0 - j0_next + 15'd1 : 15'd0;
  wire [14:0] choice_7 = some1 ? last1 - j1_next + 15'd1 : 15'd0;

  always @(posedge clk) begin
    if (begins) begin
      prim_n1 <= choice_6[9:0];
      j0 <= j0_next;
      prim_n2 <= choice_7[9:0];
      j1 <= j1_next;
    end
  end

  // Factors of the next sum, signed. Its first digit is the highest in which one of them differs from its sign.
  reg [16:0] f;  // factor, signed
  reg [16:0] g;  // factor, signed
  wire [15:0] digits = (f[15:0] ^ f[16:1]) | (g[15:0] ^ g[16:1]);  // digits of the factors that differ from their signs
  wire any_8 = |digits[15:8];
  wire [7:0] part_24 = digits[15:8];
  wire [3:0] part_23 = part_24[7:4];
  wire any_9 = |part_23;
  wire [1:0] part_25 = part_23[3:2];
  wire any_10 = |part_25;
  wire [1:0] part_26 = part_23[1:0];
  wire [3:0] part_28 = part_24[3:0];
  wire [1:0] part_27 = part_28[3:2];
  wire any_11 = |part_27;
  wire [1:0] part_29 = part_28[1:0];
  wire [1:0] choice_8 = any_9 ? {any_10, any_10 ? part_25[1] : part_26[1]}
                      : {any_11, any_11 ? part_27[1] : part_29[1]};
  wire [7:0] part_31 = digits[7:0];
  wire [3:0] part_30 = part_31[7:4];
  wire any_12 = |part_30;
  wire [1:0] part_32 = part_30[3:2];
  wire any_13 = |part_32;
  wire [1:0] part_33 = part_30[1:0];
  wire [3:0] part_35 = part_31[3:0];
  wire [1:0] part_34 = part_35[3:2];
  wire any_14 = |part_34;
  wire [1:0] part_36 = part_35[1:0];
  wire [1:0] choice_9 = any_12 ? {any_13, any_13 ? part_32[1] : part_33[1]}
                      : {any_14, any_14 ? part_34[1] : part_36[1]};
  assign top_digit = {1'b0, {any_8, any_8 ? {any_9, choice_8} : {any_12, choice_9}}};
  wire [16:0] shifted_3 = f >> left;
  wire digit_f = shifted_3[0];
  wire [16:0] shifted_4 = g >> left;
  wire digit_g = shifted_4[0];

  always @(posedge clk) begin
    if (at == WAIT_DX) begin
      f <= (round == 2'd2) ? {16'd0, 1'b1} & {17{|prim_n2}}
         : (round == 2'd1) ? {16'd0, 1'b1} & {17{|prim_n1}}
         : {16'd0, 1'b1};
      g <= (round == 2'd2) ? {3'd0, h1} & {17{|prim_n2}}
         : (round == 2'd1) ? {3'd0, h0} & {17{|prim_n1}}
         : {3'd0, h0};
    end
    if (at == TAKE2) begin
      f <= {2'd0, dv02};
      g <= {2'd0, dv01};
    end
    if ((at == DOUBLE_A) || (at == WAIT_A)) begin
      f <= (|prim_n1) ? {1'b0, left_a} : 17'd0;
      g <= 17'd0;
    end
    if ((at == DOUBLE_B) || (at == WAIT_B)) begin
      f <= (|prim_n2) ? {1'b0, area[30] ? {2'd0, h1} : left_b} : 17'd0;
      g <= 17'd0;
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
  wire either_3 = (at == DOUBLE_DX)
               || (at == DOUBLE_COLUMNS)
               || (at == DOUBLE_X)
               || (at == DOUBLE_A)
               || (at == DOUBLE_START_A)
               || (at == DOUBLE_B)
               || (at == DOUBLE_START_B);
  wire either_4 = (at == TAKE_DX)
               || (at == TAKE_DY)
               || (at == TAKE12)
               || (at == TAKE1)
               || (at == TAKE2)
               || (at == TAKE_A)
               || (at == TAKE_B);
  wire [4:0] step = ((at == SUM) || (at == SUM_X) || (at == SUM_A) || (at == SUM_B)) ? (first ? STEP_FIRST : STEP_NEXT) : (at == ADD_DX) ? STEP_ADD : either_3 ? STEP_DOUBLE2 : either_4 ? STEP_TAKE : STEP_REST;
  wire is_sum = (at == SUM) || (at == SUM_X) || (at == SUM_A) || (at == SUM_B);
  wire is_sign = 1'b0;
  wire of_gradients = 1'b0;
  wire [2:0] read_single_at = (at == ADD_DX) ? 3'd2 : 3'd0;
  wire either_5 = (at_stepped == TAKE_DX)
               || (at_stepped == TAKE_DY)
               || (at_stepped == ADD_DX)
               || (at_stepped == TAKE12)
               || (at_stepped == TAKE1)
               || (at_stepped == TAKE2)
               || (at_stepped == DOUBLE_X)
               || (at_stepped == TAKE_A)
               || (at_stepped == TAKE_B);
  wire write = ends_stepped && either_5;
  wire [2:0] write_at = (at_stepped == DOUBLE_X) ? 3'd5
                      : ((at_stepped == ADD_DX) || (at_stepped == TAKE12)) ? 3'd3
                      : ((at_stepped == TAKE_DX) || (at_stepped == TAKE2)) ? 3'd2
                      : 3'd1;
  wire take_modulus = (at == TAKE_DX) || (at == TAKE12) || (at == TAKE_A) || (at == TAKE_B);
  wire nearest = !1'b0;
  wire upwards = 1'b0;
  wire negated = 1'b0;

  // Lane 0: its steps.
  wire [4:0] choice_10 = (round == 2'd3) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                       : (round == 2'd2) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                       : (round == 2'd1) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                       : (left == 5'd0) ? STEP_DOUBLE1
                       : STEP_DOUBLE2;
  wire [4:0] choice_11 = (round == 2'd3) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                       : (round == 2'd2) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                       : (round == 2'd1) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                       : (left == 5'd0) ? STEP_DOUBLE1
                       : STEP_DOUBLE2;
  wire [4:0] choice_12 = (round == 2'd3) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                       : (round == 2'd2) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                       : (round == 2'd1) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                       : (left == 5'd0) ? STEP_DOUBLE1
                       : STEP_DOUBLE2;
  wire [4:0] step0 = rests ? STEP_REST
                   : (at == DOUBLE_START_B) ? choice_10
                   : (at == DOUBLE_START_A) ? choice_11
                   : (at == DOUBLE_X) ? choice_12
                   : (at == DOUBLE_DX) ? ((left == 5'd0) ? STEP_DOUBLE1 : STEP_DOUBLE2)
                   : step;
  reg [4:0] step_next0;
  reg [4:0] step_again0;
  reg [4:0] step_of_pause0;
  wire [4:0] step_formed0 = advance ? step_next0 : step_of_pause0;

  always @(posedge clk) begin
    if (advance) begin
      step_next0 <= step0;
      step_again0 <= step_formed0;
    end
  end

  always @(posedge clk) begin
    step_of_pause0 <= (pause == 4'd2) ? step_again0 : advance ? STEP_BEGIN : STEP_DIGITS;
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
  wire equal_2 = at == TAKE_A;
  wire equal_3 = at == TAKE_B;
  wire both_5 = area[30] && ((at == TAKE12) || (at == TAKE1) || (at == TAKE2));
  wire either_6 = (at == SUBTRACT) || (at == TAKE12) || (at == WAIT);
  wire either_7 = (at == DOUBLE_DX) || (at == TAKE2) || (at == DOUBLE_X);
  wire [1:0] choice_13 = either_6 ? 2'd1 : either_7 ? 2'd0 : 2'd1;
  wire [1:0] choice_14 = either_6 ? 2'd2 : either_7 ? 2'd2 : 2'd0;
  wire either_8 = (at == DOUBLE_START_A) || (at == DOUBLE_START_B);
  wire either_9 = (at == WAIT) || (at == SUM_X) || (at == DOUBLE_X);
  wire either_10 = (at == SUBTRACT) || (at == TAKE_DX) || (at == DOUBLE_DX);

  always @(posedge clk) begin
    if (advance) begin
      from_place <= (equal_2 || equal_3) ? ((equal_3 && area[30]) ? 2'd1 : 2'd0)
                  : both_5 ? choice_13
                  : choice_14;
      to_place <= (equal_2 || equal_3) ? ((equal_2 && area[30]) ? 2'd1 : 2'd2)
                : ((at == DOUBLE_START_B) && area[30]) ? 2'd1
                : either_8 ? 2'd0
                : both_5 ? choice_14
                : choice_13;
      single_value <= either_8;
      values_of_round1 <= (either_9 ? round == 2'd0 : round == 2'd1) && !either_10;
      values_of_round2 <= (either_9 ? round == 2'd1 : round == 2'd2) && !either_10;
      values_of_round3 <= (either_9 ? round == 2'd2 : round == 2'd3) && !either_10;
      number_of_edge <= (at == TAKE_DX) || (at == TAKE_DY);
      number_is_height <= at == TAKE_DY;
    end
  end

  // Lane 0: what it takes in.
  wire [15:0] extended_6 = {1'b0, dv12};
  wire [15:0] extended_7 = {1'b0, dv01};
  wire [15:0] extended_8 = {1'b0, dv02};
  wire [16:0] choice_15 = (round_next == 2'd2) ? {extended_6[15], extended_6}
                        : (round_next == 2'd1) ? {extended_7[15], extended_7}
                        : {extended_8[15], extended_8};
  wire [16:0] choice_16 = number_is_height ? choice_15
                        : (round_next == 2'd2) ? {du12[15], du12}
                        : (round_next == 2'd1) ? {du01[15], du01}
                        : {du02[15], du02};
  wire [16:0] choice_17 = values_of_round3 ? {9'd0, vertex2_b}
                        : values_of_round2 ? {9'd0, vertex2_g}
                        : values_of_round1 ? {9'd0, vertex2_r}
                        : {1'b0, vertex2_z};
  wire [16:0] choice_18 = values_of_round3 ? {9'd0, vertex1_b}
                        : values_of_round2 ? {9'd0, vertex1_g}
                        : values_of_round1 ? {9'd0, vertex1_r}
                        : {1'b0, vertex1_z};
  wire [16:0] choice_19 = values_of_round3 ? {9'd0, vertex0_b}
                        : values_of_round2 ? {9'd0, vertex0_g}
                        : values_of_round1 ? {9'd0, vertex0_r}
                        : {1'b0, vertex0_z};
  wire [16:0] choice_20 = values_of_round3 ? 17'd0
                        : values_of_round2 ? 17'd0
                        : values_of_round1 ? 17'd0
                        : 17'd0;
  wire [16:0] choice_21 = single_value ? choice_20
                        : from_vertex[1] ? choice_17
                        : from_vertex[0] ? choice_18
                        : choice_19;
  wire [16:0] difference = (to_vertex[1] ? choice_17 : to_vertex[0] ? choice_18 : choice_19)
                         - choice_21;
  wire [16:0] number0 = number_of_edge ? choice_16 : difference;  // signed
  reg [16:0] kept0;  // a number that may not fit, or a first value; signed
  wire [15:0] shown = difference[15:0] ^ {16{difference[16]}};
  wire lane0_unfit;
  wire choice_22 = (round_stepped == 2'd2) ? |prim_n2 : (round_stepped == 2'd1) ? |prim_n1 : 1'b1;
  wire either_11 = ((at_stepped == TAKE_A) && (|prim_n1)) || ((at_stepped == TAKE_B) && (|prim_n2));
  wire choice_23 = (round_stepped == 2'd3) ? 1'b1
                 : (round_stepped == 2'd2) ? 1'b1
                 : (round_stepped == 2'd1) ? 1'b1
                 : 1'b1;
  wire either_12 = ((at_stepped == TAKE_DX) && choice_22) || (either_11 && choice_23);
  assign unfit = lane0_unfit && either_12;

  always @(posedge clk) begin
    if ((at_next == TAKE_DX)
     || (at_next == TAKE_A)
     || (at_next == DOUBLE_START_A)
     || (at_next == TAKE_B)
     || (at_next == DOUBLE_START_B)) begin
      kept0 <= number0;
    end
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
  wire [30:0] lane0_value;
  wire choice_24 = is_sign ? f[16] : digit_f;
  wire choice_25 = is_sign ? g[16] : digit_g;
  wire [16:0] shifted_5 = $signed(kept0) >>> {pause - 4'd2, 1'b0};
  wire [29:0] joined_3 = {p1_u[14:1], 16'd0};
  wire [29:0] joined_4 = {p0_u[14:1], 16'd0};
  wire [29:0] joined_5 = {p0_u[14:1], 16'd0};
  wire [30:0] choice_26 = (round_rest == 2'd2) ? {joined_3[29], joined_3}
                        : (round_rest == 2'd1) ? {joined_4[29], joined_4}
                        : {joined_5[29], joined_5};
  wire [30:0] choice_27 = (round_rest == 2'd3) ? {{kept0, 1'b1}, 13'd0}
                        : (round_rest == 2'd2) ? {{kept0, 1'b1}, 13'd0}
                        : (round_rest == 2'd1) ? {{kept0, 1'b1}, 13'd0}
                        : {{kept0, 1'b1}, 13'd0};
  wire equal_4 = at == TAKE12;
  wire [29:0] lane0_rest_out_unused;

  edgewalk_setup_lane0 lane0 (
    .clk           (clk),
    .read_at       ((is_sum || is_sign) ? {of_gradients && (choice_24 || choice_25), choice_25, choice_24}
: read_single_at),
    .step          (step_formed0),
    .number        (number0),
    .digits        (shifted_5[1:0]),
    .write         (write),
    .write_at      (write_at),
    .whole_in      ((at_rest == DOUBLE_COLUMNS) ? choice_26
: ((at_rest == DOUBLE_START_A) || (at_rest == DOUBLE_START_B)) ? choice_27
: 31'd0),
    .take_modulus  (take_modulus),
    .modulus_in    ((at == TAKE_B) ? (area[30] ? ~{15'd0, {dv12, 1'b0}} : ~{15'd0, {dv02, 1'b0}})
: (at == TAKE_A) ? (area[30] ? ~{15'd0, {dv01, 1'b0}} : ~{15'd0, {dv02, 1'b0}})
: equal_4 ? scaled
: (round == 2'd2) ? ~{15'd0, {dv12, 1'b0}}
: (round == 2'd1) ? ~{15'd0, {dv01, 1'b0}}
: ~{15'd0, {dv02, 1'b0}}),
    .modulus_short (!(equal_4 && area[30])),
    .give          (ends_rest),
    .nearest       (nearest),
    .upwards       (upwards),
    .negate        (negated),
    .unfit         (lane0_unfit),
    .rest_out      (lane0_rest_out_unused),
    .value         (lane0_value)
  );

  wire any_15 = |dv02[14:1];
  wire [30:0] part_37 = lane0_value;

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_DX) && (round_whole == 2'd0)) begin
      prim_major_q <= any_15 ? part_37[30:16] : 15'd0;
      prim_major_f <= any_15 ? part_37[15:0] : 16'd0;
    end
  end

  wire [30:0] inverse_2 = ~part_37;

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_COLUMNS) && (round_whole == 2'd0)) begin
      prim_major_c <= -inverse_2[30:16];
      prim_major_dist <= inverse_2[15:0];
    end
  end

  // Edge: minor1.
  wire both_6 = (|prim_n1) && (|dv01[14:1]);
  wire [30:0] part_38 = lane0_value;

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_DX) && (round_whole == 2'd1)) begin
      prim_minor1_q <= both_6 ? part_38[30:16] : 15'd0;
      prim_minor1_f <= both_6 ? part_38[15:0] : 16'd0;
    end
  end

  wire [30:0] inverse_3 = ~part_38;

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_COLUMNS) && (round_whole == 2'd1)) begin
      prim_minor1_c <= (|prim_n1) ? -inverse_3[30:16] : 15'd0;
      prim_minor1_dist <= (|prim_n1) ? inverse_3[15:0] : 16'd0;
    end
  end

  // Edge: minor2.
  wire both_7 = (|prim_n2) && (|dv12[14:1]);
  wire [30:0] part_39 = lane0_value;

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_DX) && (round_whole == 2'd2)) begin
      prim_minor2_q <= both_7 ? part_39[30:16] : 15'd0;
      prim_minor2_f <= both_7 ? part_39[15:0] : 16'd0;
    end
  end

  wire [30:0] inverse_4 = ~part_39;

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_COLUMNS) && (round_whole == 2'd2)) begin
      prim_minor2_c <= (|prim_n2) ? -inverse_4[30:16] : 15'd0;
      prim_minor2_dist <= (|prim_n2) ? inverse_4[15:0] : 16'd0;
    end
  end

  // Channel: z.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X) && (round_whole == 2'd0)) prim_z_g <= lane0_value[29:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_A) && (round_whole == 2'd0)) begin
      prim_z_d_a <= (|prim_n1) ? lane0_value[29:0] : 30'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_START_A) && (round_whole == 2'd0)) begin
      prim_z_start_a <= (|prim_n1) ? lane0_value[29:0] : 30'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_B) && (round_whole == 2'd0)) begin
      prim_z_d_b <= (|prim_n2) ? lane0_value[29:0] : 30'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_START_B) && (round_whole == 2'd0)) begin
      prim_z_start_b <= (|prim_n2) ? lane0_value[29:0] : 30'd0;
    end
  end

  // Channel: r.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X) && (round_whole == 2'd1)) prim_r_g <= lane0_value[21:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_A) && (round_whole == 2'd1)) begin
      prim_r_d_a <= (|prim_n1) ? lane0_value[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_START_A) && (round_whole == 2'd1)) begin
      prim_r_start_a <= (|prim_n1) ? lane0_value[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_B) && (round_whole == 2'd1)) begin
      prim_r_d_b <= (|prim_n2) ? lane0_value[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_START_B) && (round_whole == 2'd1)) begin
      prim_r_start_b <= (|prim_n2) ? lane0_value[21:0] : 22'd0;
    end
  end

  // Channel: g.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X) && (round_whole == 2'd2)) prim_g_g <= lane0_value[21:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_A) && (round_whole == 2'd2)) begin
      prim_g_d_a <= (|prim_n1) ? lane0_value[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_START_A) && (round_whole == 2'd2)) begin
      prim_g_start_a <= (|prim_n1) ? lane0_value[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_B) && (round_whole == 2'd2)) begin
      prim_g_d_b <= (|prim_n2) ? lane0_value[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_START_B) && (round_whole == 2'd2)) begin
      prim_g_start_b <= (|prim_n2) ? lane0_value[21:0] : 22'd0;
    end
  end

  // Channel: b.
  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_X) && (round_whole == 2'd3)) prim_b_g <= lane0_value[21:0];
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_A) && (round_whole == 2'd3)) begin
      prim_b_d_a <= (|prim_n1) ? lane0_value[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_START_A) && (round_whole == 2'd3)) begin
      prim_b_start_a <= (|prim_n1) ? lane0_value[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_B) && (round_whole == 2'd3)) begin
      prim_b_d_b <= (|prim_n2) ? lane0_value[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (ends_whole && (at_whole == DOUBLE_START_B) && (round_whole == 2'd3)) begin
      prim_b_start_b <= (|prim_n2) ? lane0_value[21:0] : 22'd0;
    end
  end

  assign prim_jm = jm[8:0];
  assign prim_major_right = area[30];

  // Not needed, on purpose.
  wire unused = &{
    1'b0, ROUND_A, less_m[0], STEP_SIGN, part_3[0], part_6[0], part_10[0], part_13[0], shifted[14:1],
    shifted_2[14:1], part_14[29:0], choice_6[14:10], choice_7[14:10], joined[15:14], joined_2[15:14],
    part_26[0], part_29[0], part_33[0], part_36[0], shifted_3[16:1], shifted_4[16:1], shifted_5[16:2]
  };

endmodule

`default_nettype wire
