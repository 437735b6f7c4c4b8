// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 0ee73237105a

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
// Segments: words are cut into segments; the carry moves one segment a clock.
//   clock   0  1  2  3        Each segment loads, adds and leaves one clock behind the segment below it.
//   seg 0   a  b  c  d        A segment needs only the carry of the clock before.
//   seg 1      a  b  c        The output stages bring the bits of a fragment together.
//   seg 2         a  b

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
  input  wire [29:0] span_z,         // UQ16.14 LSB, modular, depth at the first pixel of the span
  input  wire [21:0] span_r,         // UQ8.14 LSB, modular, red at the first pixel of the span
  input  wire [21:0] span_g,         // UQ8.14 LSB, modular, green at the first pixel of the span
  input  wire [21:0] span_b,         // UQ8.14 LSB, modular, blue at the first pixel of the span
  input  wire        span_fresh,     // first span of the triangle; increments are new
  input  wire        span_fence,     // older fragments of the same pixel may be in flight
  input  wire [29:0] inc_z,          // UQ16.14 LSB, modular, increment of depth a pixel along the span; counts with span_fresh
  input  wire [21:0] inc_r,          // UQ8.14 LSB, modular, increment of red a pixel along the span; counts with span_fresh
  input  wire [21:0] inc_g,          // UQ8.14 LSB, modular, increment of green a pixel along the span; counts with span_fresh
  input  wire [21:0] inc_b,          // UQ8.14 LSB, modular, increment of blue a pixel along the span; counts with span_fresh
  input  wire        frag_ready,

  output wire        span_ready,
  output reg         frag_valid,
  output reg  [18:0] frag_addr,      // line * 2^10 + column
  output reg  [15:0] frag_z,         // unorm16, depth of the pixel
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
  reg [1:0] phase;   // clock within the pixel
  wire last_phase = &phase;
  reg last;          // count = 1: last pixel of the span

  // Registers alone decide whether the span continues. Otherwise PIXEL loads the offered span. Values loaded without a valid span are don't care.
  wire finish = active && last_phase && last;       // last clock of the span
  wire goes_on = active && !finish;                 // the span continues in the next clock
  assign span_ready = advance && !goes_on;
  wire load = span_valid && span_ready;
  assign visible = x < 15'd640;
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
      phase <= goes_on ? phase + 2'd1 : 2'd0;
      fence <= goes_on ? fence && !emit : span_fence;
    end
  end

  always @(posedge clk) begin
    if (moves) begin
      x <= goes_on ? (leftward ? x - 15'd1 : x + 15'd1) : span_x;
      count <= goes_on ? count - 15'd1 : span_count;
      last <= goes_on ? count == 15'd2 : span_count == 15'd1;
    end
  end

  always @(posedge clk) begin
    if (span_ready) begin
      y <= span_y;
      leftward <= span_leftward;
    end
  end

  // One adder serves one channel, or several in turn.
  reg adding;                      // the current pixel is not the first of its span
  wire add = goes_on && (last_phase || adding);
  wire [1:0] slot = phase + 2'd1;  // channel that each adder serves in this clock
  wire new_increments = span_valid && span_fresh;

  always @(posedge clk) begin
    if (moves) adding <= goes_on;
  end

  // Each segment repeats what the segment below did at the last advance.
  reg stays1;
  reg fresh1;
  reg add1;
  reg [1:0] slot1;
  reg stays2;
  reg fresh2;
  reg add2;
  reg [1:0] slot2;
  reg stays3;
  reg fresh3;
  reg add3;
  reg [1:0] slot3;

  always @(posedge clk) begin
    if (rst) begin
      stays1 <= 1'b0;
      fresh1 <= 1'b0;
      add1 <= 1'b0;
      slot1 <= 2'd0;
      stays2 <= 1'b0;
      fresh2 <= 1'b0;
      add2 <= 1'b0;
      slot2 <= 2'd0;
      stays3 <= 1'b0;
      fresh3 <= 1'b0;
      add3 <= 1'b0;
      slot3 <= 2'd0;
    end else if (advance) begin
      stays1 <= goes_on;
      fresh1 <= new_increments;
      add1 <= add;
      slot1 <= slot;
      stays2 <= stays1;
      fresh2 <= fresh1;
      add2 <= add1;
      slot2 <= slot1;
      stays3 <= stays2;
      fresh3 <= fresh2;
      add3 <= add2;
      slot3 <= slot2;
    end
  end

  // Value and increment of channel z.
  reg [6:0] z_value0;        // bits 6 to 0 of UQ16.14 LSB, modular
  reg [6:0] z_inc0;          // bits 6 to 0 of UQ16.14 LSB, modular
  reg [22:0] z_value_late1;  // upper bits of the next span
  reg [22:0] z_inc_late1;    // upper bits of the next span
  reg [7:0] z_value1;        // bits 14 to 7 of UQ16.14 LSB, modular
  reg [7:0] z_inc1;          // bits 14 to 7 of UQ16.14 LSB, modular
  reg [14:0] z_value_late2;  // upper bits of the next span
  reg [14:0] z_inc_late2;    // upper bits of the next span
  reg [6:0] z_value2;        // bits 21 to 15 of UQ16.14 LSB, modular
  reg [6:0] z_inc2;          // bits 21 to 15 of UQ16.14 LSB, modular
  reg [7:0] z_value_late3;   // upper bits of the next span
  reg [7:0] z_inc_late3;     // upper bits of the next span
  reg [7:0] z_value3;        // bits 29 to 22 of UQ16.14 LSB, modular
  reg [7:0] z_inc3;          // bits 29 to 22 of UQ16.14 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) z_inc0 <= inc_z[6:0];
  end

  always @(posedge clk) begin
    if (advance) begin
      z_value_late1 <= span_z[29:7];
      z_inc_late1 <= inc_z[29:7];
      z_value_late2 <= z_value_late1[22:8];
      z_inc_late2 <= z_inc_late1[22:8];
      z_value_late3 <= z_value_late2[14:7];
      z_inc_late3 <= z_inc_late2[14:7];
    end
  end

  always @(posedge clk) begin
    if (advance && !stays1 && fresh1) z_inc1 <= z_inc_late1[7:0];
  end

  always @(posedge clk) begin
    if (advance && !stays2 && fresh2) z_inc2 <= z_inc_late2[6:0];
  end

  always @(posedge clk) begin
    if (advance && !stays3 && fresh3) z_inc3 <= z_inc_late3;
  end

  // Value and increment of channel r.
  reg [6:0] r_value0;        // bits 6 to 0 of UQ8.14 LSB, modular
  reg [6:0] r_inc0;          // bits 6 to 0 of UQ8.14 LSB, modular
  reg [14:0] r_value_late1;  // upper bits of the next span
  reg [14:0] r_inc_late1;    // upper bits of the next span
  reg [7:0] r_value1;        // bits 14 to 7 of UQ8.14 LSB, modular
  reg [7:0] r_inc1;          // bits 14 to 7 of UQ8.14 LSB, modular
  reg [6:0] r_value_late2;   // upper bits of the next span
  reg [6:0] r_inc_late2;     // upper bits of the next span
  reg [6:0] r_value2;        // bits 21 to 15 of UQ8.14 LSB, modular
  reg [6:0] r_inc2;          // bits 21 to 15 of UQ8.14 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) r_inc0 <= inc_r[6:0];
  end

  always @(posedge clk) begin
    if (advance) begin
      r_value_late1 <= span_r[21:7];
      r_inc_late1 <= inc_r[21:7];
      r_value_late2 <= r_value_late1[14:8];
      r_inc_late2 <= r_inc_late1[14:8];
    end
  end

  always @(posedge clk) begin
    if (advance && !stays1 && fresh1) r_inc1 <= r_inc_late1[7:0];
  end

  always @(posedge clk) begin
    if (advance && !stays2 && fresh2) r_inc2 <= r_inc_late2;
  end

  // Value and increment of channel g.
  reg [6:0] g_value0;        // bits 6 to 0 of UQ8.14 LSB, modular
  reg [6:0] g_inc0;          // bits 6 to 0 of UQ8.14 LSB, modular
  reg [14:0] g_value_late1;  // upper bits of the next span
  reg [14:0] g_inc_late1;    // upper bits of the next span
  reg [7:0] g_value1;        // bits 14 to 7 of UQ8.14 LSB, modular
  reg [7:0] g_inc1;          // bits 14 to 7 of UQ8.14 LSB, modular
  reg [6:0] g_value_late2;   // upper bits of the next span
  reg [6:0] g_inc_late2;     // upper bits of the next span
  reg [6:0] g_value2;        // bits 21 to 15 of UQ8.14 LSB, modular
  reg [6:0] g_inc2;          // bits 21 to 15 of UQ8.14 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) g_inc0 <= inc_g[6:0];
  end

  always @(posedge clk) begin
    if (advance) begin
      g_value_late1 <= span_g[21:7];
      g_inc_late1 <= inc_g[21:7];
      g_value_late2 <= g_value_late1[14:8];
      g_inc_late2 <= g_inc_late1[14:8];
    end
  end

  always @(posedge clk) begin
    if (advance && !stays1 && fresh1) g_inc1 <= g_inc_late1[7:0];
  end

  always @(posedge clk) begin
    if (advance && !stays2 && fresh2) g_inc2 <= g_inc_late2;
  end

  // Value and increment of channel b.
  reg [6:0] b_value0;        // bits 6 to 0 of UQ8.14 LSB, modular
  reg [6:0] b_inc0;          // bits 6 to 0 of UQ8.14 LSB, modular
  reg [14:0] b_value_late1;  // upper bits of the next span
  reg [14:0] b_inc_late1;    // upper bits of the next span
  reg [7:0] b_value1;        // bits 14 to 7 of UQ8.14 LSB, modular
  reg [7:0] b_inc1;          // bits 14 to 7 of UQ8.14 LSB, modular
  reg [6:0] b_value_late2;   // upper bits of the next span
  reg [6:0] b_inc_late2;     // upper bits of the next span
  reg [6:0] b_value2;        // bits 21 to 15 of UQ8.14 LSB, modular
  reg [6:0] b_inc2;          // bits 21 to 15 of UQ8.14 LSB, modular

  always @(posedge clk) begin
    if (advance && !goes_on && new_increments) b_inc0 <= inc_b[6:0];
  end

  always @(posedge clk) begin
    if (advance) begin
      b_value_late1 <= span_b[21:7];
      b_inc_late1 <= inc_b[21:7];
      b_value_late2 <= b_value_late1[14:8];
      b_inc_late2 <= b_inc_late1[14:8];
    end
  end

  always @(posedge clk) begin
    if (advance && !stays1 && fresh1) b_inc1 <= b_inc_late1[7:0];
  end

  always @(posedge clk) begin
    if (advance && !stays2 && fresh2) b_inc2 <= b_inc_late2;
  end

  // Adder of z, r, g, b.
  wire [7:0] choice = (slot == 2'd3) ? {1'b0, b_value0}
                    : (slot == 2'd2) ? {1'b0, g_value0}
                    : (slot == 2'd1) ? {1'b0, r_value0}
                    : {1'b0, z_value0};
  wire [7:0] choice_2 = (slot == 2'd3) ? {1'b0, b_inc0}
                      : (slot == 2'd2) ? {1'b0, g_inc0}
                      : (slot == 2'd1) ? {1'b0, r_inc0}
                      : {1'b0, z_inc0};
  wire [7:0] adder0_sum0 = choice + choice_2;
  reg adder0_carry1;
  wire [8:0] choice_3 = (slot1 == 2'd3) ? {1'b0, b_value1}
                      : (slot1 == 2'd2) ? {1'b0, g_value1}
                      : (slot1 == 2'd1) ? {1'b0, r_value1}
                      : {1'b0, z_value1};
  wire [8:0] choice_4 = (slot1 == 2'd3) ? {1'b0, b_inc1}
                      : (slot1 == 2'd2) ? {1'b0, g_inc1}
                      : (slot1 == 2'd1) ? {1'b0, r_inc1}
                      : {1'b0, z_inc1};
  wire [8:0] adder0_sum1 = choice_3 + choice_4 + {8'd0, adder0_carry1};
  reg adder0_carry2;
  wire [7:0] choice_5 = (slot2 == 2'd3) ? {1'b0, b_value2}
                      : (slot2 == 2'd2) ? {1'b0, g_value2}
                      : (slot2 == 2'd1) ? {1'b0, r_value2}
                      : {1'b0, z_value2};
  wire [7:0] choice_6 = (slot2 == 2'd3) ? {1'b0, b_inc2}
                      : (slot2 == 2'd2) ? {1'b0, g_inc2}
                      : (slot2 == 2'd1) ? {1'b0, r_inc2}
                      : {1'b0, z_inc2};
  wire [7:0] adder0_sum2 = choice_5 + choice_6 + {7'd0, adder0_carry2};
  reg adder0_carry3;
  wire [7:0] adder0_sum3 = z_value3 + z_inc3 + {7'd0, adder0_carry3};

  always @(posedge clk) begin
    if (advance && !goes_on) z_value0 <= span_z[6:0];
    if (advance && add && (slot == 2'd0)) z_value0 <= adder0_sum0[6:0];
  end

  always @(posedge clk) begin
    if (advance && !goes_on) r_value0 <= span_r[6:0];
    if (advance && add && (slot == 2'd1)) r_value0 <= adder0_sum0[6:0];
  end

  always @(posedge clk) begin
    if (advance && !goes_on) g_value0 <= span_g[6:0];
    if (advance && add && (slot == 2'd2)) g_value0 <= adder0_sum0[6:0];
  end

  always @(posedge clk) begin
    if (advance && !goes_on) b_value0 <= span_b[6:0];
    if (advance && add && (slot == 2'd3)) b_value0 <= adder0_sum0[6:0];
  end

  always @(posedge clk) begin
    if (advance) begin
      adder0_carry1 <= adder0_sum0[7];
      adder0_carry2 <= adder0_sum1[8];
      adder0_carry3 <= adder0_sum2[7];
    end
  end

  always @(posedge clk) begin
    if (advance && !stays1) z_value1 <= z_value_late1[7:0];
    if (advance && add1 && (slot1 == 2'd0)) z_value1 <= adder0_sum1[7:0];
  end

  always @(posedge clk) begin
    if (advance && !stays1) r_value1 <= r_value_late1[7:0];
    if (advance && add1 && (slot1 == 2'd1)) r_value1 <= adder0_sum1[7:0];
  end

  always @(posedge clk) begin
    if (advance && !stays1) g_value1 <= g_value_late1[7:0];
    if (advance && add1 && (slot1 == 2'd2)) g_value1 <= adder0_sum1[7:0];
  end

  always @(posedge clk) begin
    if (advance && !stays1) b_value1 <= b_value_late1[7:0];
    if (advance && add1 && (slot1 == 2'd3)) b_value1 <= adder0_sum1[7:0];
  end

  always @(posedge clk) begin
    if (advance && !stays2) z_value2 <= z_value_late2[6:0];
    if (advance && add2 && (slot2 == 2'd0)) z_value2 <= adder0_sum2[6:0];
  end

  always @(posedge clk) begin
    if (advance && !stays2) r_value2 <= r_value_late2;
    if (advance && add2 && (slot2 == 2'd1)) r_value2 <= adder0_sum2[6:0];
  end

  always @(posedge clk) begin
    if (advance && !stays2) g_value2 <= g_value_late2;
    if (advance && add2 && (slot2 == 2'd2)) g_value2 <= adder0_sum2[6:0];
  end

  always @(posedge clk) begin
    if (advance && !stays2) b_value2 <= b_value_late2;
    if (advance && add2 && (slot2 == 2'd3)) b_value2 <= adder0_sum2[6:0];
  end

  always @(posedge clk) begin
    if (advance && !stays3) z_value3 <= z_value_late3;
    if (advance && add3 && (slot3 == 2'd0)) z_value3 <= adder0_sum3;
  end

  // Output: each stage completes the bits of one more segment.
  reg [18:0] out0_addr;  // line * 2^10 + column
  reg out0_fence;        // older fragments of the same pixel may be in flight
  reg out0_valid;
  reg [18:0] out1_addr;  // line * 2^10 + column
  reg out1_z;            // unorm16, depth of the pixel
  reg out1_r;            // unorm8, red of the pixel
  reg out1_g;            // unorm8, green of the pixel
  reg out1_b;            // unorm8, blue of the pixel
  reg out1_fence;        // older fragments of the same pixel may be in flight
  reg out1_valid;
  reg [18:0] out2_addr;  // line * 2^10 + column
  reg [7:0] out2_z;      // unorm16, depth of the pixel
  reg [7:0] out2_r;      // unorm8, red of the pixel
  reg [7:0] out2_g;      // unorm8, green of the pixel
  reg [7:0] out2_b;      // unorm8, blue of the pixel
  reg out2_fence;        // older fragments of the same pixel may be in flight
  reg out2_valid;

  always @(posedge clk) begin
    if (advance) begin
      out0_addr <= {y, x[9:0]};
      out0_fence <= fence;
      out1_addr <= out0_addr;
      out1_z <= z_value1[7];
      out1_r <= r_value1[7];
      out1_g <= g_value1[7];
      out1_b <= b_value1[7];
      out1_fence <= out0_fence;
      out2_addr <= out1_addr;
      out2_z <= {z_value2, out1_z};
      out2_r <= {r_value2, out1_r};
      out2_g <= {g_value2, out1_g};
      out2_b <= {b_value2, out1_b};
      out2_fence <= out1_fence;
      frag_addr <= out2_addr;
      frag_z <= {z_value3, out2_z};
      frag_r <= out2_r;
      frag_g <= out2_g;
      frag_b <= out2_b;
      frag_fence <= out2_fence;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      out0_valid <= 1'b0;
      out1_valid <= 1'b0;
      out2_valid <= 1'b0;
      frag_valid <= 1'b0;
    end else if (advance) begin
      out0_valid <= emit;
      out1_valid <= out0_valid;
      out2_valid <= out1_valid;
      frag_valid <= out2_valid;
    end
  end

  assign occupied = frag_valid || out0_valid || out1_valid || out2_valid;

  // Not needed, on purpose.
  wire unused = &{1'b0, load};

endmodule

`default_nettype wire
