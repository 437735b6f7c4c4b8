// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 7efc7d48fe81

// edgewalk_span: SPAN cuts the end of a line to the screen and queues the span.
//
//   line ─> [end cut to the screen] ─> held ─> empty? ─no─> [FIFO] ─> span
//                                                └─yes─> dropped; its flags wait for the next span
//
// Timing: SPAN takes a line if it holds none, or if the queue has room. A span appears two cycles after its line was taken, at the
// earliest. An empty line takes its turn like any other.
// Rules: the span is cut on the side where it ends. Columns off the screen on the side where it starts are
// stepped over by PIXEL, as the channels must be stepped there too.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_span (
  input  wire        clk,
  input  wire        rst,

  input  wire        line_valid,
  input  wire  [8:0] line_y,            // line
  input  wire [14:0] line_cmaj,         // signed, first column on or right of the major edge
  input  wire [14:0] line_cmin,         // signed, first column on or right of the minor edge
  input  wire        line_major_right,  // the major edge is the right one
  input  wire [37:0] line_z,            // UQ24.14 LSB, modular, depth at the first pixel of the line
  input  wire [21:0] line_r,            // UQ8.14 LSB, modular, red at the first pixel of the line
  input  wire [21:0] line_g,            // UQ8.14 LSB, modular, green at the first pixel of the line
  input  wire [21:0] line_b,            // UQ8.14 LSB, modular, blue at the first pixel of the line
  input  wire        line_fresh,        // first line of the triangle
  input  wire        line_fence,        // older fragments of the same pixel may be in flight
  input  wire        span_ready,

  output wire        line_ready,
  output wire        span_valid,
  output wire [14:0] span_x,            // signed, first column
  output wire  [8:0] span_y,            // line
  output wire [14:0] span_count,        // pixels of the span, at least 1
  output wire        span_leftward,     // 1: the span runs towards smaller columns
  output wire [37:0] span_z,            // UQ24.14 LSB, modular, depth at the first pixel of the span
  output wire [21:0] span_r,            // UQ8.14 LSB, modular, red at the first pixel of the span
  output wire [21:0] span_g,            // UQ8.14 LSB, modular, green at the first pixel of the span
  output wire [21:0] span_b,            // UQ8.14 LSB, modular, blue at the first pixel of the span
  output wire        span_fresh,        // first span of the triangle; increments are new
  output wire        span_fence,        // older fragments of the same pixel may be in flight
  output wire        fresh_queued,      // the first span of a triangle is queued, or may come of the line held
  output reg         line_held          // a line stands before the queue
);

  // To the right from cmaj to before cmin, at most to the end of the screen; to the left to cmin, at least to column 0.
  wire right_of_screen = !line_cmin[14] && (line_cmin >= 15'd640);  // no column of the screen lies right of cmin
  wire left_of_screen = line_cmin[14] || (line_cmin == 15'd0);  // no column of the screen lies left of cmin

  // The edges' own columns say whether the span is empty, so no comparison waits for the clipped end.
  wire [15:0] difference = {line_cmaj[14], line_cmaj} - {line_cmin[14], line_cmin};
  wire ordered = difference[15];
  wire outside_right = (!line_cmaj[14] && (line_cmaj >= 15'd640)) || left_of_screen;
  wire outside_left = line_cmaj[14] || (line_cmaj == 15'd0) || right_of_screen;
  wire [14:0] first = line_major_right ? (left_of_screen ? 15'd0 : line_cmin) : line_cmaj;
  wire beyond = !line_major_right && right_of_screen;
  wire crossed = line_major_right ? ordered || (line_cmaj == line_cmin) : !ordered;
  wire outside = line_major_right ? outside_left : outside_right;

  // Line register. The right end is clipped here. Don't care while line_held is 0.
  wire queue_in_ready;
  assign line_ready = !line_held || queue_in_ready;
  wire take = line_valid && line_ready;
  wire moves = line_held && queue_in_ready;   // the line held is queued or dropped
  reg [8:0] held_y;                           // line
  reg [37:0] held_z;                          // UQ24.14 LSB, modular, depth at the first pixel of the span
  reg [21:0] held_r;                          // UQ8.14 LSB, modular, red at the first pixel of the span
  reg [21:0] held_g;                          // UQ8.14 LSB, modular, green at the first pixel of the span
  reg [21:0] held_b;                          // UQ8.14 LSB, modular, blue at the first pixel of the span
  reg held_fresh;                             // first span of the triangle; increments are new
  reg held_fence;                             // older fragments of the same pixel may be in flight
  reg [14:0] held_first;                      // signed, first column
  reg [14:0] held_end;                        // signed, the column behind the last, or one beyond the screen
  reg held_beyond;                            // 1: the span ends with the screen
  wire [14:0] end_cut = held_beyond ? 15'd640 : held_end;
  reg held_crossed;                           // 1: no column lies between the line's edges
  reg held_outside;                           // 1: both ends lie beside the screen
  wire empty = held_crossed || held_outside;  // 1: the line has no column on the screen
  reg held_leftward;                          // 1: the span is drawn from its last column to its first

  always @(posedge clk) begin
    if (rst) begin
      line_held <= 1'b0;
    end else begin
      if (moves) line_held <= 1'b0;
      if (take) line_held <= 1'b1;
    end
  end

  always @(posedge clk) begin
    if (line_ready) begin
      held_y <= line_y;
      held_z <= line_z;
      held_r <= line_r;
      held_g <= line_g;
      held_b <= line_b;
      held_fresh <= line_fresh;
      held_fence <= line_fence;
      held_first <= first;
      held_end <= line_major_right ? line_cmaj : line_cmin;
      held_beyond <= beyond;
      held_crossed <= crossed;
      held_outside <= outside;
      held_leftward <= line_major_right;
    end
  end

  // Flags of dropped lines wait for the next span.
  reg pend_fresh;  // fresh of dropped lines
  reg pend_fence;  // fence of dropped lines
  wire fresh = held_fresh || pend_fresh;
  wire fence = held_fence || pend_fence;

  always @(posedge clk) begin
    if (rst) begin
      pend_fresh <= 1'b0;
      pend_fence <= 1'b0;
    end else if (moves) begin
      pend_fresh <= empty && fresh;
      pend_fence <= empty && fence;
    end
  end

  // The queue.
  wire push = moves && !empty;
  wire [14:0] queue_out_x;
  wire [8:0] queue_out_y;
  wire [14:0] queue_out_count;
  wire queue_out_leftward;
  wire [37:0] queue_out_z;
  wire [21:0] queue_out_r;
  wire [21:0] queue_out_g;
  wire [21:0] queue_out_b;
  wire queue_out_fresh;
  wire queue_out_fence;
  wire queue_out_valid;

  // While a triangle's first span is queued, or the held line may become it, EDGE must keep its increments.
  wire queue_any_fresh;

  edgewalk_span_fifo queue (
    .clk          (clk),
    .rst          (rst),
    .in_valid     (push),
    .in_x         (held_leftward ? end_cut - 15'd1 : held_first),
    .in_y         (held_y),
    .in_count     (end_cut - held_first),
    .in_leftward  (held_leftward),
    .in_z         (held_z),
    .in_r         (held_r),
    .in_g         (held_g),
    .in_b         (held_b),
    .in_fresh     (fresh),
    .in_fence     (fence),
    .out_ready    (span_ready),
    .any_fresh    (queue_any_fresh),
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

  wire fresh_in_queue = queue_any_fresh;
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
  assign fresh_queued = fresh_in_queue || (line_held && fresh);

  // Not needed, on purpose.
  wire unused = &{1'b0, difference[14:0]};

endmodule

`default_nettype wire
