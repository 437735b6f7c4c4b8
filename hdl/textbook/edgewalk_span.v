// edgewalk_span: SPAN cuts a line to the screen and queues what is left of it.
//
//   line ─> [end cut to the screen] ─> empty? ─no─> [FIFO] ─> span
//                                         └─yes─> dropped; its flags wait for the next span
//
// Timing: a line that is not empty is a span in the next cycle at the earliest; an empty one costs its cycle only.
// Rules: the span is cut on the side where it ends. What lies off the screen on the side where it starts is stepped over
// by PIXEL, as the channels must be stepped there too.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_span (
  input  wire        clk,
  input  wire        rst,

  input  wire        line_valid,
  input  wire  [8:0] line_y,            // line
  input  wire [14:0] line_cmaj,         // signed, first column right of the major edge
  input  wire [14:0] line_cmin,         // signed, first column right of the minor edge
  input  wire        line_major_right,  // the major edge is the right one
  input  wire [29:0] line_z,            // UQ16.14 LSB, modular
  input  wire [21:0] line_r,            // UQ8.14 LSB, modular
  input  wire [21:0] line_g,            // UQ8.14 LSB, modular
  input  wire [21:0] line_b,            // UQ8.14 LSB, modular
  input  wire        line_fresh,        // first line of the triangle
  input  wire        line_fence,        // what is in flight may be of the same pixels
  input  wire        span_ready,

  output wire        line_ready,
  output wire        span_valid,
  output wire [14:0] span_x,            // signed, first column
  output wire  [8:0] span_y,            // line
  output wire [14:0] span_count,        // pixels, at least 1
  output wire        span_leftward,     // towards smaller columns
  output wire [29:0] span_z,            // UQ16.14 LSB, modular
  output wire [21:0] span_r,            // UQ8.14 LSB, modular
  output wire [21:0] span_g,            // UQ8.14 LSB, modular
  output wire [21:0] span_b,            // UQ8.14 LSB, modular
  output wire        span_fresh,        // first span of the triangle: its increments are new
  output wire        span_fence,        // what is in flight may be of the same pixels
  output reg         fresh_queued       // the first span of a triangle is queued
);

  // From Trunc(X) of the left edge to Trunc(X) of the right edge, both drawn; a column register is Trunc(X) + 1.
  wire [14:0] x = (line_major_right ? line_cmin : line_cmaj) - 15'd1;
  wire [14:0] xe = line_major_right ? line_cmaj : line_cmin;  // signed, first column after the line
  wire [14:0] end_cut = ($signed(xe) < 15'sd640) ? xe : 15'd640;  // signed, first column after the span
  wire empty = ($signed(end_cut) <= $signed(x)) || ($signed(xe) <= 15'sd0);
  wire [14:0] count = end_cut - x;  // columns

  // Flags of dropped lines wait for the next span.
  reg pend_fresh;  // fresh of dropped lines
  reg pend_fence;  // fence of dropped lines
  wire fresh = line_fresh || pend_fresh;
  wire fence = line_fence || pend_fence;

  // The queue.
  wire queue_in_ready;
  assign line_ready = empty || queue_in_ready;
  wire taken = line_valid && line_ready;
  wire push = taken && !empty;
  wire [14:0] queue_out_x;
  wire [8:0] queue_out_y;
  wire [14:0] queue_out_count;
  wire queue_out_leftward;
  wire [29:0] queue_out_z;
  wire [21:0] queue_out_r;
  wire [21:0] queue_out_g;
  wire [21:0] queue_out_b;
  wire queue_out_fresh;
  wire queue_out_fence;
  wire queue_out_valid;

  edgewalk_span_fifo queue (
    .clk          (clk),
    .rst          (rst),
    .in_valid     (push),
    .in_x         (x),
    .in_y         (line_y),
    .in_count     (count),
    .in_leftward  (1'b0),
    .in_z         (line_z),
    .in_r         (line_r),
    .in_g         (line_g),
    .in_b         (line_b),
    .in_fresh     (fresh),
    .in_fence     (fence),
    .out_ready    (span_ready),
    .in_ready     (queue_in_ready),
    .out_valid    (queue_out_valid),
    .out_x        (queue_out_x),
    .out_y        (queue_out_y),
    .out_count    (queue_out_count),
    .out_leftward (queue_out_leftward),
    .out_z        (queue_out_z),
    .out_r        (queue_out_r),
    .out_g        (queue_out_g),
    .out_b        (queue_out_b),
    .out_fresh    (queue_out_fresh),
    .out_fence    (queue_out_fence)
  );

  always @(posedge clk) begin
    if (rst) begin
      pend_fresh <= 1'b0;
      pend_fence <= 1'b0;
    end else if (taken) begin
      pend_fresh <= empty && fresh;
      pend_fence <= empty && fence;
    end
  end

  // While a triangle's first span is queued, EDGE must keep the increments of the triangle.
  always @(posedge clk) begin
    if (rst) begin
      fresh_queued <= 1'b0;
    end else begin
      if (queue_out_valid && span_ready && queue_out_fresh) fresh_queued <= 1'b0;
      if (push && fresh) fresh_queued <= 1'b1;
    end
  end

  assign span_valid = queue_out_valid;
  assign span_x = queue_out_x;
  assign span_y = queue_out_y;
  assign span_count = queue_out_count;
  assign span_leftward = queue_out_leftward;
  assign span_z = queue_out_z;
  assign span_r = queue_out_r;
  assign span_g = queue_out_g;
  assign span_b = queue_out_b;
  assign span_fresh = queue_out_fresh;
  assign span_fence = queue_out_fence;

endmodule

`default_nettype wire
