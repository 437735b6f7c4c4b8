// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 7efc7d48fe81

// edgewalk_edge: EDGE walks the major and the minor edge of a triangle, a line a step.
//
//   prim ─┬> [major C R-f] ──────── cmaj ─────┐
//         ├> [minor C R-f q f M] ── cmin ─────┼─> line
//         ├> [a value a channel] ─ by carry ──┘
//         └─ g of each channel ─────────────────> inc, not held here
//
// Timing: the first line is valid in the cycle after an idle EDGE sees prim_valid, then one line a clock while line_ready.
// The triangle is taken behind its last line, when PIXEL has its increments. Until then prim stays, and EDGE reads it.
// Rules: a step takes f from R; where R is too small M is added back and the column goes one further (carry).
// R - f is what is kept, so that its sign says whether the step carries, and no step waits for a subtraction to know it.
// The columns are not cut to the screen here: SPAN does that.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_edge (
  input  wire        clk,
  input  wire        rst,

  input  wire        prim_valid,
  input  wire  [8:0] prim_jm,           // first line
  input  wire  [9:0] prim_n1,           // lines of the upper part
  input  wire  [9:0] prim_n2,           // lines of the lower part
  input  wire        prim_major_right,  // the major edge is the right one
  input  wire [14:0] prim_major_c,      // signed, first column on or right of the edge
  input  wire [21:0] prim_major_dist,   // distance from the edge to that column, 1/M column
  input  wire [14:0] prim_major_q,      // signed, whole columns a line, step of c
  input  wire [21:0] prim_major_f,      // 1/M column a line
  input  wire [21:0] prim_major_m,      // modulus of dist and f: the edge's height; a line has 2^8 units
  input  wire [14:0] prim_minor1_c,     // signed, first column on or right of the edge
  input  wire [21:0] prim_minor1_dist,  // distance from the edge to that column, 1/M column
  input  wire [14:0] prim_minor1_q,     // signed, whole columns a line, step of c
  input  wire [21:0] prim_minor1_f,     // 1/M column a line
  input  wire [21:0] prim_minor1_m,     // modulus of dist and f: the edge's height; a line has 2^8 units
  input  wire [14:0] prim_minor2_c,     // signed, first column on or right of the edge
  input  wire [21:0] prim_minor2_dist,  // distance from the edge to that column, 1/M column
  input  wire [14:0] prim_minor2_q,     // signed, whole columns a line, step of c
  input  wire [21:0] prim_minor2_f,     // 1/M column a line
  input  wire [21:0] prim_minor2_m,     // modulus of dist and f: the edge's height; a line has 2^8 units
  input  wire [37:0] prim_z_start,      // UQ24.14 LSB, modular, value at the first pixel of the first line
  input  wire [37:0] prim_z_d0,         // UQ24.14 LSB, modular, step to the next line, edge without carry
  input  wire [37:0] prim_z_d1,         // UQ24.14 LSB, modular, step to the next line, edge with carry
  input  wire [37:0] prim_z_g,          // UQ24.14 LSB, modular, step to the next pixel of the span
  input  wire [21:0] prim_r_start,      // UQ8.14 LSB, modular, value at the first pixel of the first line
  input  wire [21:0] prim_r_d0,         // UQ8.14 LSB, modular, step to the next line, edge without carry
  input  wire [21:0] prim_r_d1,         // UQ8.14 LSB, modular, step to the next line, edge with carry
  input  wire [21:0] prim_r_g,          // UQ8.14 LSB, modular, step to the next pixel of the span
  input  wire [21:0] prim_g_start,      // UQ8.14 LSB, modular, value at the first pixel of the first line
  input  wire [21:0] prim_g_d0,         // UQ8.14 LSB, modular, step to the next line, edge without carry
  input  wire [21:0] prim_g_d1,         // UQ8.14 LSB, modular, step to the next line, edge with carry
  input  wire [21:0] prim_g_g,          // UQ8.14 LSB, modular, step to the next pixel of the span
  input  wire [21:0] prim_b_start,      // UQ8.14 LSB, modular, value at the first pixel of the first line
  input  wire [21:0] prim_b_d0,         // UQ8.14 LSB, modular, step to the next line, edge without carry
  input  wire [21:0] prim_b_d1,         // UQ8.14 LSB, modular, step to the next line, edge with carry
  input  wire [21:0] prim_b_g,          // UQ8.14 LSB, modular, step to the next pixel of the span
  input  wire        line_ready,
  input  wire        fresh_queued,      // the triangle that is walked has not reached PIXEL yet

  output wire        prim_ready,
  output wire        line_valid,
  output reg   [8:0] line_y,            // line
  output wire [14:0] line_cmaj,         // signed, first column on or right of the major edge
  output wire [14:0] line_cmin,         // signed, first column on or right of the minor edge
  output reg         line_major_right,  // the major edge is the right one
  output reg  [37:0] line_z,            // UQ24.14 LSB, modular, depth at the first pixel of the line
  output reg  [21:0] line_r,            // UQ8.14 LSB, modular, red at the first pixel of the line
  output reg  [21:0] line_g,            // UQ8.14 LSB, modular, green at the first pixel of the line
  output reg  [21:0] line_b,            // UQ8.14 LSB, modular, blue at the first pixel of the line
  output reg         line_fresh,        // first line of the triangle
  output wire        line_fence,        // older fragments of the same pixel may be in flight
  output wire [37:0] inc_z,             // UQ24.14 LSB, modular, increment of depth a pixel along the span; stays until the next prim fires
  output wire [21:0] inc_r,             // UQ8.14 LSB, modular, increment of red a pixel along the span; stays until the next prim fires
  output wire [21:0] inc_g,             // UQ8.14 LSB, modular, increment of green a pixel along the span; stays until the next prim fires
  output wire [21:0] inc_b              // UQ8.14 LSB, modular, increment of blue a pixel along the span; stays until the next prim fires
);

  // A triangle begins while it is offered, and is taken when it is walked and PIXEL has its increments.
  reg running;
  reg last;    // last line of all
  wire step = running && line_ready;
  wire at_end = step && last;
  reg walked;  // the triangle is walked, and not taken yet
  reg idle;    // neither running nor walked
  assign prim_ready = walked && !fresh_queued;
  wire load = idle && prim_valid;
  wire moves = idle ? prim_valid : step;

  always @(posedge clk) begin
    if (rst) begin
      running <= 1'b0;
    end else begin
      if (at_end) running <= 1'b0;
      if (load) running <= 1'b1;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      walked <= 1'b0;
    end else begin
      if (at_end) walked <= 1'b1;
      if (prim_ready) walked <= 1'b0;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      idle <= 1'b1;
    end else begin
      if (load) idle <= 1'b0;
      if (prim_ready) idle <= 1'b1;
    end
  end

  // Where in the triangle: the upper part, then the lower.
  reg [9:0] n1;   // lines left of the upper part
  reg [9:0] n2;   // lines left of the lower part
  reg exchanges;  // idle, or at the knee: the minor edge is loaded, not stepped
  reg upper;      // in the upper part
  wire some_lower = |n2;
  wire two_upper = n1 == 10'd2;
  wire one_upper = n1 == 10'd1;
  wire next_last = upper ? (two_upper && !some_lower) || (one_upper && (n2 == 10'd1)) : n2 == 10'd2;
  wire lower_follows = |prim_n2;
  wire one_upper_only = prim_n1 == 10'd1;
  wire first_last = (|prim_n1) ? one_upper_only && !lower_follows : prim_n2 == 10'd1;
  wire first_knee = one_upper_only && lower_follows;
  wire next_knee = two_upper && some_lower;

  always @(posedge clk) begin
    if (moves) begin
      upper <= idle ? |prim_n1 : upper && !one_upper;
      last <= idle ? first_last : next_last;
      line_y <= idle ? prim_jm : line_y + 9'd1;
      line_fresh <= idle;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      exchanges <= 1'b1;
    end else if (moves) begin
      exchanges <= idle ? !load || first_knee : last || next_knee;
    end
  end

  always @(posedge clk) begin
    if (load) n1 <= prim_n1;
    if (step && upper) n1 <= n1 - 10'd1;
  end

  always @(posedge clk) begin
    if (load) n2 <= prim_n2;
    if (step && !upper) n2 <= n2 - 10'd1;
  end

  always @(posedge clk) begin
    if (load) line_major_right <= prim_major_right;
  end

  // The major edge.
  wire [14:0] major_q = prim_major_q;
  wire [21:0] major_f = prim_major_f;
  wire [21:0] major_m = prim_major_m;
  reg [14:0] major_c;     // signed, first column on or right of the edge
  reg [22:0] major_rest;  // R - f, signed: below 0 the step carries
  wire [22:0] major_less = major_rest - {1'b0, major_f};
  wire [22:0] major_back = major_rest[22] ? {1'b0, major_m} : 23'd0;
  wire [22:0] major_next = idle ? {1'b0, prim_major_dist} - {1'b0, prim_major_f}
                         : major_less + major_back;
  reg carry;              // the major edge carries in its next step

  always @(posedge clk) begin
    if (moves) begin
      major_rest <= major_next;
      major_c <= idle ? prim_major_c : major_c + major_q + {14'd0, major_rest[22]};
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      carry <= 1'b0;
    end else if (moves) begin
      carry <= major_next[22];
    end
  end

  // The minor edge, and the one that takes its place at the knee.
  wire [22:0] minor2_rest = {1'b0, prim_minor2_dist} - {1'b0, prim_minor2_f};
  reg [14:0] minor_c;                     // signed, first column on or right of the edge
  reg [14:0] minor_q;                     // signed, whole columns a line, step of c
  reg [21:0] minor_f;                     // 1/M column a line
  reg [21:0] minor_m;                     // modulus of dist and f: the edge's height; a line has 2^8 units
  reg [22:0] minor_rest;                  // R - f, signed: below 0 the step carries
  wire [22:0] minor_less = minor_rest - {1'b0, minor_f};
  wire [22:0] minor_back = minor_rest[22] ? {1'b0, minor_m} : 23'd0;
  wire has_upper = |prim_n1;
  wire [22:0] minor1_rest = {1'b0, prim_minor1_dist} - {1'b0, prim_minor1_f};
  wire upper_enters = idle && has_upper;  // else the second one does
  wire exchanged = exchanges && moves;

  always @(posedge clk) begin
    if (moves) begin
      minor_rest <= exchanges ? (upper_enters ? minor1_rest : minor2_rest) : minor_less + minor_back;
      minor_c <= exchanges ? (upper_enters ? prim_minor1_c : prim_minor2_c)
               : minor_c + minor_q + {14'd0, minor_rest[22]};
    end
  end

  always @(posedge clk) begin
    if (exchanged) begin
      minor_q <= upper_enters ? prim_minor1_q : prim_minor2_q;
      minor_f <= upper_enters ? prim_minor1_f : prim_minor2_f;
      minor_m <= upper_enters ? prim_minor1_m : prim_minor2_m;
    end
  end

  // The channels at the start of the span. Between triangles a value is 0, and the addend is the start value.
  wire [37:0] z_d0 = prim_z_d0;
  wire [37:0] z_d1 = prim_z_d1;
  wire [37:0] z_added = idle ? prim_z_start : carry ? z_d1 : z_d0;
  wire [21:0] r_d0 = prim_r_d0;
  wire [21:0] r_d1 = prim_r_d1;
  wire [21:0] r_added = idle ? prim_r_start : carry ? r_d1 : r_d0;
  wire [21:0] g_d0 = prim_g_d0;
  wire [21:0] g_d1 = prim_g_d1;
  wire [21:0] g_added = idle ? prim_g_start : carry ? g_d1 : g_d0;
  wire [21:0] b_d0 = prim_b_d0;
  wire [21:0] b_d1 = prim_b_d1;
  wire [21:0] b_added = idle ? prim_b_start : carry ? b_d1 : b_d0;

  always @(posedge clk) begin
    if (rst) begin
      line_z <= 38'd0;
      line_r <= 22'd0;
      line_g <= 22'd0;
      line_b <= 22'd0;
    end else begin
      if (moves) begin
        line_z <= line_z + z_added;
        line_r <= line_r + r_added;
        line_g <= line_g + g_added;
        line_b <= line_b + b_added;
      end
      if (walked) begin
        line_z <= 38'd0;
        line_r <= 22'd0;
        line_g <= 22'd0;
        line_b <= 22'd0;
      end
    end
  end

  assign line_valid = running;
  assign line_cmaj = major_c;
  assign line_cmin = minor_c;
  assign line_fence = line_fresh;
  assign inc_z = prim_z_g;
  assign inc_r = prim_r_g;
  assign inc_g = prim_g_g;
  assign inc_b = prim_b_g;

endmodule

`default_nettype wire
