// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 333c8cc6e2fc

// edgewalk_span_fifo: First in, first out: 1 places in registers; the others move up as the first is taken.
//
//   in ─> [place 0] ─> … ─> [place 0] ─> out
//
// Timing: a token taken in at a clock is seen at the output in the next cycle, if it is first.
// Rules: in_ready does not look at out_ready: a full queue takes nothing in, even while its first token leaves.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_span_fifo (
  input  wire        clk,
  input  wire        rst,

  input  wire        in_valid,
  input  wire  [9:0] in_x,          // signed, first column
  input  wire  [7:0] in_y,          // line
  input  wire  [9:0] in_count,      // pixels, at least 1
  input  wire        in_leftward,   // towards smaller columns
  input  wire [25:0] in_z,          // UQ16.10 LSB, modular
  input  wire [14:0] in_r,          // UQ5.10 LSB, modular
  input  wire [14:0] in_g,          // UQ5.10 LSB, modular
  input  wire [14:0] in_b,          // UQ5.10 LSB, modular
  input  wire        in_fresh,      // first span of the triangle: its increments are new
  input  wire        in_fence,      // what is in flight may be of the same pixels
  input  wire        out_ready,

  output wire        any_fresh,     // of a token in the queue
  output wire        in_ready,
  output wire        out_valid,
  output wire  [9:0] out_x,         // signed, first column
  output wire  [7:0] out_y,         // line
  output wire  [9:0] out_count,     // pixels, at least 1
  output wire        out_leftward,  // towards smaller columns
  output wire [25:0] out_z,         // UQ16.10 LSB, modular
  output wire [14:0] out_r,         // UQ5.10 LSB, modular
  output wire [14:0] out_g,         // UQ5.10 LSB, modular
  output wire [14:0] out_b,         // UQ5.10 LSB, modular
  output wire        out_fresh,     // first span of the triangle: its increments are new
  output wire        out_fence      // what is in flight may be of the same pixels
);

  // How many places are taken, counted from place 0.
  reg count;  // tokens
  assign in_ready = count < 1'b1;
  assign out_valid = count;
  wire push = in_valid && in_ready;
  wire pop = out_valid && out_ready;

  always @(posedge clk) begin
    if (rst) begin
      count <= 1'b0;
    end else begin
      if (push && !pop) count <= count + 1'b1;
      if (pop && !push) count <= count - 1'b1;
    end
  end

  // A free place takes the input in every cycle, the last taken one as its token moves up; a push makes it count.
  reg [9:0] place0_x;      // signed, first column
  reg [7:0] place0_y;      // line
  reg [9:0] place0_count;  // pixels, at least 1
  reg place0_leftward;     // towards smaller columns
  reg [25:0] place0_z;     // UQ16.10 LSB, modular
  reg [14:0] place0_r;     // UQ5.10 LSB, modular
  reg [14:0] place0_g;     // UQ5.10 LSB, modular
  reg [14:0] place0_b;     // UQ5.10 LSB, modular
  reg place0_fresh;        // first span of the triangle: its increments are new
  reg place0_fence;        // what is in flight may be of the same pixels
  wire place0_moves = pop || (count <= 1'b0);
  reg any_fresh_queued;    // of a token in the queue

  always @(posedge clk) begin
    if (place0_moves) begin
      place0_x <= in_x;
      place0_y <= in_y;
      place0_count <= in_count;
      place0_leftward <= in_leftward;
      place0_z <= in_z;
      place0_r <= in_r;
      place0_g <= in_g;
      place0_b <= in_b;
      place0_fresh <= in_fresh;
      place0_fence <= in_fence;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      any_fresh_queued <= 1'b0;
    end else begin
      any_fresh_queued <= (pop ? 1'b0 : any_fresh_queued) || (push && in_fresh);
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
