// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 4f0c71f00838

// edgewalk_pixel: PIXEL steps along a span, a pixel every ceil(N/A) clocks, with A adders shared by the N channels.
//
//   span ─> [x count]───────────────────────────────────────┐
//       └─> [a value a channel] <─ + <─ [increments] <─ inc ├─> [out] ─> frag
//                  └────────────────────────────────────────┘
//
// Formats: values and increments are modular words; a fragment takes the bits above the fraction.
// Timing: a pixel leaves in its last phase. In that phase the additions for the next pixel begin. Each adder serves one
// channel a clock; an adder without a channel rests.
// Rules: the unit stalls while a fragment waits at the output. A column off the screen costs its phases and makes no
// fragment.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_pixel (
  input  wire        clk,
  input  wire        rst,

  input  wire        span_valid,
  input  wire [14:0] span_x,         // signed, first column
  input  wire  [8:0] span_y,         // line
  input  wire [14:0] span_count,     // pixels of the span, at least 1
  input  wire        span_leftward,  // 1: the span runs towards smaller columns
  input  wire [37:0] span_z,         // UQ24.14 LSB, modular, depth at the first pixel of the span
  input  wire [21:0] span_r,         // UQ8.14 LSB, modular, red at the first pixel of the span
  input  wire [21:0] span_g,         // UQ8.14 LSB, modular, green at the first pixel of the span
  input  wire [21:0] span_b,         // UQ8.14 LSB, modular, blue at the first pixel of the span
  input  wire        span_fresh,     // first span of the triangle; increments are new
  input  wire        span_fence,     // older fragments of the same pixel may be in flight
  input  wire [37:0] inc_z,          // UQ24.14 LSB, modular, increment of depth a pixel along the span; counts with span_fresh
  input  wire [21:0] inc_r,          // UQ8.14 LSB, modular, increment of red a pixel along the span; counts with span_fresh
  input  wire [21:0] inc_g,          // UQ8.14 LSB, modular, increment of green a pixel along the span; counts with span_fresh
  input  wire [21:0] inc_b,          // UQ8.14 LSB, modular, increment of blue a pixel along the span; counts with span_fresh
  input  wire        frag_ready,

  output wire        span_ready,
  output reg         frag_valid,
  output reg  [18:0] frag_addr,      // line * 2^10 + column
  output reg  [23:0] frag_z,         // unorm24, depth of the pixel
  output reg   [7:0] frag_r,         // unorm8, red of the pixel
  output reg   [7:0] frag_g,         // unorm8, green of the pixel
  output reg   [7:0] frag_b,         // unorm8, blue of the pixel
  output reg         frag_fence,     // older fragments of the same pixel may be in flight
  output reg         active,         // a span is in progress
  output wire        visible,        // the current pixel is on the screen, while active is 1
  output wire        advance,        // the output is free or taken: the unit advances
  output wire        occupied        // an output stage holds a fragment
);

  // The span in progress.
  assign advance = !frag_valid || frag_ready;
  reg [14:0] x;      // current column, signed
  reg [8:0] y;       // line
  reg leftward;      // towards smaller columns
  reg [14:0] count;  // pixels left in the span, current one included
  reg fence;         // fence of the next fragment
  reg last;          // count = 1: last pixel of the span

  // Registers alone decide whether the span continues. Otherwise PIXEL loads the offered span. Values loaded without a valid span are don't care.
  wire finish = active && last;      // last clock of the span
  wire goes_on = active && !finish;  // the span continues in the next clock
  assign span_ready = advance && !goes_on;
  wire load = span_valid && span_ready;
  assign visible = x < 15'd640;
  wire emit = active && visible;     // PIXEL makes a fragment

  always @(posedge clk) begin
    if (rst) begin
      active <= 1'b0;
    end else if (advance) begin
      active <= goes_on || span_valid;
    end
  end

  always @(posedge clk) begin
    if (advance) begin
      x <= goes_on ? (leftward ? x - 15'd1 : x + 15'd1) : span_x;
      count <= goes_on ? count - 15'd1 : span_count;
      last <= goes_on ? count == 15'd2 : span_count == 15'd1;
      fence <= goes_on ? fence && !emit : span_fence;
    end
  end

  always @(posedge clk) begin
    if (span_ready) begin
      y <= span_y;
      leftward <= span_leftward;
    end
  end

  // One adder serves one channel, or several in turn.
  wire new_increments = span_valid && span_fresh;

  // Value and increment of channel z.
  reg [37:0] z_value;  // UQ24.14 LSB, modular
  reg [37:0] z_inc;    // UQ24.14 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) z_inc <= inc_z;
  end

  // Adder of this channel.
  wire [37:0] z_sum = z_value + z_inc;

  always @(posedge clk) begin
    if (advance) z_value <= goes_on ? z_sum : span_z;
  end

  // Value and increment of channel r.
  reg [21:0] r_value;  // UQ8.14 LSB, modular
  reg [21:0] r_inc;    // UQ8.14 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) r_inc <= inc_r;
  end

  // Adder of this channel.
  wire [21:0] r_sum = r_value + r_inc;

  always @(posedge clk) begin
    if (advance) r_value <= goes_on ? r_sum : span_r;
  end

  // Value and increment of channel g.
  reg [21:0] g_value;  // UQ8.14 LSB, modular
  reg [21:0] g_inc;    // UQ8.14 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) g_inc <= inc_g;
  end

  // Adder of this channel.
  wire [21:0] g_sum = g_value + g_inc;

  always @(posedge clk) begin
    if (advance) g_value <= goes_on ? g_sum : span_g;
  end

  // Value and increment of channel b.
  reg [21:0] b_value;  // UQ8.14 LSB, modular
  reg [21:0] b_inc;    // UQ8.14 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) b_inc <= inc_b;
  end

  // Adder of this channel.
  wire [21:0] b_sum = b_value + b_inc;

  always @(posedge clk) begin
    if (advance) b_value <= goes_on ? b_sum : span_b;
  end

  // Output register: loads a fragment while PIXEL advances.
  always @(posedge clk) begin
    if (advance) begin
      frag_addr <= {y, x[9:0]};
      frag_z <= z_value[37:14];
      frag_r <= r_value[21:14];
      frag_g <= g_value[21:14];
      frag_b <= b_value[21:14];
      frag_fence <= fence;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      frag_valid <= 1'b0;
    end else if (advance) begin
      frag_valid <= emit;
    end
  end

  assign occupied = frag_valid;

  // Not needed, on purpose.
  wire unused = &{1'b0, load};

endmodule

`default_nettype wire
