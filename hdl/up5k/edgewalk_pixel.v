// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 6db543e8dccb

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
  input  wire  [9:0] span_x,         // signed, first column
  input  wire  [6:0] span_y,         // line
  input  wire  [9:0] span_count,     // pixels of the span, at least 1
  input  wire        span_leftward,  // 1: the span runs towards smaller columns
  input  wire [25:0] span_z,         // UQ16.10 LSB, modular, depth at the first pixel of the span
  input  wire [14:0] span_r,         // UQ5.10 LSB, modular, red at the first pixel of the span
  input  wire [14:0] span_g,         // UQ5.10 LSB, modular, green at the first pixel of the span
  input  wire [14:0] span_b,         // UQ5.10 LSB, modular, blue at the first pixel of the span
  input  wire        span_fresh,     // first span of the triangle; increments are new
  input  wire        span_fence,     // older fragments of the same pixel may be in flight
  input  wire [25:0] inc_z,          // UQ16.10 LSB, modular, increment of depth a pixel along the span; counts with span_fresh
  input  wire [14:0] inc_r,          // UQ5.10 LSB, modular, increment of red a pixel along the span; counts with span_fresh
  input  wire [14:0] inc_g,          // UQ5.10 LSB, modular, increment of green a pixel along the span; counts with span_fresh
  input  wire [14:0] inc_b,          // UQ5.10 LSB, modular, increment of blue a pixel along the span; counts with span_fresh
  input  wire        frag_ready,

  output wire        span_ready,
  output reg         frag_valid,
  output reg  [14:0] frag_addr,      // line * 2^8 + column
  output reg  [15:0] frag_z,         // unorm16, depth of the pixel
  output reg   [4:0] frag_r,         // unorm5, red of the pixel
  output reg   [4:0] frag_g,         // unorm5, green of the pixel
  output reg   [4:0] frag_b,         // unorm5, blue of the pixel
  output reg         frag_fence,     // older fragments of the same pixel may be in flight
  output reg         active,         // a span is in progress
  output wire        visible,        // the current pixel is on the screen, while active is 1
  output wire        advance,        // the output is free or taken: the unit advances
  output wire        occupied        // an output stage holds a fragment
);

  // The span in progress.
  assign advance = !frag_valid || frag_ready;
  reg [9:0] x;      // current column, signed
  reg [6:0] y;      // line
  reg leftward;     // towards smaller columns
  reg [9:0] count;  // pixels left in the span, current one included
  reg fence;        // fence of the next fragment
  reg phase;        // clock within the pixel
  wire last_phase = phase;
  reg last;         // count = 1: last pixel of the span

  // Registers alone decide whether the span continues. Otherwise PIXEL loads the offered span. Values loaded without a valid span are don't care.
  wire finish = active && last_phase && last;       // last clock of the span
  wire goes_on = active && !finish;                 // the span continues in the next clock
  assign span_ready = advance && !goes_on;
  wire load = span_valid && span_ready;
  assign visible = x < 10'd160;
  wire emit = active && last_phase && visible;      // PIXEL makes a fragment
  wire moves = advance && (last_phase || !active);  // the pixel changes, or PIXEL is idle

  always @(posedge clk) begin
    if (rst) begin
      active <= 1'b0;
    end else if (advance) begin
      active <= goes_on || span_valid;
    end
  end

  always @(posedge clk) begin
    if (advance) begin
      phase <= goes_on ? phase + 1'b1 : 1'b0;
      fence <= goes_on ? fence && !emit : span_fence;
    end
  end

  always @(posedge clk) begin
    if (moves) begin
      x <= goes_on ? (leftward ? x - 10'd1 : x + 10'd1) : span_x;
      count <= goes_on ? count - 10'd1 : span_count;
      last <= goes_on ? count == 10'd2 : span_count == 10'd1;
    end
  end

  always @(posedge clk) begin
    if (span_ready) begin
      y <= span_y;
      leftward <= span_leftward;
    end
  end

  // One adder serves one channel, or several in turn.
  reg adding;                // the current pixel is not the first of its span
  wire add = goes_on && (last_phase || adding);
  wire slot = phase + 1'b1;  // channel that each adder serves in this clock
  wire new_increments = span_valid && span_fresh;

  always @(posedge clk) begin
    if (moves) adding <= goes_on;
  end

  // Value and increment of channel z.
  reg [25:0] z_value;  // UQ16.10 LSB, modular
  reg [25:0] z_inc;    // UQ16.10 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) z_inc <= inc_z;
  end

  // Value and increment of channel r.
  reg [14:0] r_value;  // UQ5.10 LSB, modular
  reg [14:0] r_inc;    // UQ5.10 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) r_inc <= inc_r;
  end

  // Adder of z, r.
  wire [25:0] adder0_sum = ((slot == 1'b1) ? {11'd0, r_value} : z_value)
                         + ((slot == 1'b1) ? {11'd0, r_inc} : z_inc);

  always @(posedge clk) begin
    if (advance && !goes_on) z_value <= span_z;
    if (advance && add && (slot == 1'b0)) z_value <= adder0_sum;
  end

  always @(posedge clk) begin
    if (advance && !goes_on) r_value <= span_r;
    if (advance && add && (slot == 1'b1)) r_value <= adder0_sum[14:0];
  end

  // Value and increment of channel g.
  reg [14:0] g_value;  // UQ5.10 LSB, modular
  reg [14:0] g_inc;    // UQ5.10 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) g_inc <= inc_g;
  end

  // Value and increment of channel b.
  reg [14:0] b_value;  // UQ5.10 LSB, modular
  reg [14:0] b_inc;    // UQ5.10 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) b_inc <= inc_b;
  end

  // Adder of g, b.
  wire [14:0] adder1_sum = ((slot == 1'b1) ? b_value : g_value) + ((slot == 1'b1) ? b_inc : g_inc);

  always @(posedge clk) begin
    if (advance && !goes_on) g_value <= span_g;
    if (advance && add && (slot == 1'b0)) g_value <= adder1_sum;
  end

  always @(posedge clk) begin
    if (advance && !goes_on) b_value <= span_b;
    if (advance && add && (slot == 1'b1)) b_value <= adder1_sum;
  end

  // Output register: loads a fragment while PIXEL advances.
  always @(posedge clk) begin
    if (advance) begin
      frag_addr <= {y, x[7:0]};
      frag_z <= z_value[25:10];
      frag_r <= r_value[14:10];
      frag_g <= g_value[14:10];
      frag_b <= b_value[14:10];
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
