// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 332c0ada4a3a

// edgewalk_span_fifo: First in, first out: 2 places in registers. When the first token leaves, the others move up.
//
//   in ─> [place 1] ─> … ─> [place 0] ─> out
//
// Timing: a token taken in one clock is at the output in the next, if it is the first.
// Rules: in_ready does not depend on out_ready. A full queue takes no token, even while its first token leaves.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_span_fifo (
  input  wire        clk,
  input  wire        rst,

  input  wire        in_valid,
  input  wire [14:0] in_x,          // signed, first column
  input  wire  [8:0] in_y,          // line
  input  wire [14:0] in_count,      // pixels of the span, at least 1
  input  wire        in_leftward,   // 1: the span runs towards smaller columns
  input  wire [37:0] in_z,          // UQ24.14 LSB, modular, depth at the first pixel of the span
  input  wire [21:0] in_r,          // UQ8.14 LSB, modular, red at the first pixel of the span
  input  wire [21:0] in_g,          // UQ8.14 LSB, modular, green at the first pixel of the span
  input  wire [21:0] in_b,          // UQ8.14 LSB, modular, blue at the first pixel of the span
  input  wire        in_fresh,      // first span of the triangle; increments are new
  input  wire        in_fence,      // older fragments of the same pixel may be in flight
  input  wire        out_ready,

  output wire        any_fresh,     // a queued token has this flag
  output wire        in_ready,
  output wire        out_valid,
  output wire [14:0] out_x,         // signed, first column
  output wire  [8:0] out_y,         // line
  output wire [14:0] out_count,     // pixels of the span, at least 1
  output wire        out_leftward,  // 1: the span runs towards smaller columns
  output wire [37:0] out_z,         // UQ24.14 LSB, modular, depth at the first pixel of the span
  output wire [21:0] out_r,         // UQ8.14 LSB, modular, red at the first pixel of the span
  output wire [21:0] out_g,         // UQ8.14 LSB, modular, green at the first pixel of the span
  output wire [21:0] out_b,         // UQ8.14 LSB, modular, blue at the first pixel of the span
  output wire        out_fresh,     // first span of the triangle; increments are new
  output wire        out_fence      // older fragments of the same pixel may be in flight
);

  // Count of the places in use; place 0 is the first.
  reg [1:0] count;  // tokens
  assign in_ready = count < 2'd2;
  assign out_valid = |count;
  wire push = in_valid && in_ready;
  wire pop = out_valid && out_ready;

  always @(posedge clk) begin
    if (rst) begin
      count <= 2'd0;
    end else begin
      if (push && !pop) count <= count + 2'd1;
      if (pop && !push) count <= count - 2'd1;
    end
  end

  // Each free place loads the input in every cycle; so does the last used place when its token moves up. A push makes the loaded token count.
  reg [14:0] place0_x;      // signed, first column
  reg [8:0] place0_y;       // line
  reg [14:0] place0_count;  // pixels of the span, at least 1
  reg place0_leftward;      // 1: the span runs towards smaller columns
  reg [37:0] place0_z;      // UQ24.14 LSB, modular, depth at the first pixel of the span
  reg [21:0] place0_r;      // UQ8.14 LSB, modular, red at the first pixel of the span
  reg [21:0] place0_g;      // UQ8.14 LSB, modular, green at the first pixel of the span
  reg [21:0] place0_b;      // UQ8.14 LSB, modular, blue at the first pixel of the span
  reg place0_fresh;         // first span of the triangle; increments are new
  reg place0_fence;         // older fragments of the same pixel may be in flight
  reg [14:0] place1_x;      // signed, first column
  reg [8:0] place1_y;       // line
  reg [14:0] place1_count;  // pixels of the span, at least 1
  reg place1_leftward;      // 1: the span runs towards smaller columns
  reg [37:0] place1_z;      // UQ24.14 LSB, modular, depth at the first pixel of the span
  reg [21:0] place1_r;      // UQ8.14 LSB, modular, red at the first pixel of the span
  reg [21:0] place1_g;      // UQ8.14 LSB, modular, green at the first pixel of the span
  reg [21:0] place1_b;      // UQ8.14 LSB, modular, blue at the first pixel of the span
  reg place1_fresh;         // first span of the triangle; increments are new
  reg place1_fence;         // older fragments of the same pixel may be in flight
  wire place0_moves = pop || (count <= 2'd0);
  wire place0_has_next = count > 2'd1;
  wire place1_moves = pop || (count <= 2'd1);
  reg any_fresh_queued;     // a queued token has this flag

  always @(posedge clk) begin
    if (place0_moves) begin
      place0_x <= place0_has_next ? place1_x : in_x;
      place0_y <= place0_has_next ? place1_y : in_y;
      place0_count <= place0_has_next ? place1_count : in_count;
      place0_leftward <= place0_has_next ? place1_leftward : in_leftward;
      place0_z <= place0_has_next ? place1_z : in_z;
      place0_r <= place0_has_next ? place1_r : in_r;
      place0_g <= place0_has_next ? place1_g : in_g;
      place0_b <= place0_has_next ? place1_b : in_b;
      place0_fresh <= place0_has_next ? place1_fresh : in_fresh;
      place0_fence <= place0_has_next ? place1_fence : in_fence;
    end
  end

  always @(posedge clk) begin
    if (place1_moves) begin
      place1_x <= in_x;
      place1_y <= in_y;
      place1_count <= in_count;
      place1_leftward <= in_leftward;
      place1_z <= in_z;
      place1_r <= in_r;
      place1_g <= in_g;
      place1_b <= in_b;
      place1_fresh <= in_fresh;
      place1_fence <= in_fence;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      any_fresh_queued <= 1'b0;
    end else begin
      any_fresh_queued <= (pop ? (count > 2'd1) && place1_fresh : any_fresh_queued)
                       || (push && in_fresh);
    end
  end

  assign any_fresh = any_fresh_queued;
  assign out_x = place0_x;
  assign out_y = place0_y;
  assign out_count = place0_count;
  assign out_leftward = place0_leftward;
  assign out_z = place0_z;
  assign out_r = place0_r;
  assign out_g = place0_g;
  assign out_b = place0_b;
  assign out_fresh = place0_fresh;
  assign out_fence = place0_fence;

endmodule

`default_nettype wire
