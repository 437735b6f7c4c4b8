// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 332c0ada4a3a

// edgewalk_setup_lane1: A lane of setup holds a pair: the number whole + rest / M, with 0 <= rest < M.
//
//   slots ─> a ─> [n0 n1 n2 = a, a - M, a - 2M] ─┐
//                                  x = rest * 1 2 4 ─> + ─> the last sum not below 0 ─> [rest]
//                                                           how often M was taken off ─> [whole], a clock later
//
// Timing: a step takes three clocks. Its addend is read, then n0 n1 n2 are formed, then it is done.
// Rules: in a doubling step n0 n1 n2 are -M, -2M and -3M, so that up to 3 M can be taken off. To a number below 0 that is taken in
// M is added, and -1 is its whole part. So it is with a pair that is subtracted: M - a is added, and the complement of its whole part.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_setup_lane1 (
  input  wire        clk,

  input  wire  [2:0] read_at,        // slot of the addend, two clocks before its step
  input  wire  [4:0] step,           // valid a clock before the step
  input  wire [22:0] number,         // to take in, signed; with its step
  input  wire  [1:0] digits,         // digits of a number outside ±M, or its sign twice; valid with their step
  input  wire        write,          // the result of the step goes to a slot
  input  wire  [2:0] write_at,
  input  wire [30:0] whole_in,       // whole number to add to a result, a clock before value
  input  wire        take_modulus,   // two clocks before the first step with it
  input  wire [44:0] modulus_in,     // -M, or -M - 1 if modulus_short; signed
  input  wire        modulus_short,
  input  wire        give,           // an operation has ended; a clock later value is its result
  input  wire        nearest,        // value is rounded to nearest, halves up; a clock before it, with rest_out
  input  wire        upwards,        // 1: round up; 0: cut
  input  wire        negate,         // value is negated, once it is rounded

  output wire        unfit,          // the number that was taken in is not between -M and M
  output wire [43:0] rest_out,       // 1/M, from the clock after a step
  output wire [30:0] value           // modular, two clocks after a step
);

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

  // The modulus: -M, or its complement -M - 1, with the 1 that is then missing.
  reg [44:0] modulus;  // -M or -M - 1, signed
  reg short;           // 1 is missing in modulus

  always @(posedge clk) begin
    if (take_modulus) begin
      modulus <= modulus_in;
      short <= modulus_short;
    end
  end

  // Rests of the slots. Slot 0 is never written and holds 0.
  reg [43:0] rest;         // 1/M
  wire [43:0] rest_next;
  reg [43:0] rests [0:7];  // 1/M

  initial begin : rests_init
    integer rests_index;
    for (rests_index = 0; rests_index < 8; rests_index = rests_index + 1) rests[rests_index] = 44'd0;
  end

  always @(posedge clk) begin
    if (write) rests[write_at] <= rest_next;
  end

  reg [43:0] rests_q;

  always @(posedge clk) begin
    if (!(write && (write_at == read_at))) rests_q <= rests[read_at];
  end

  // The addend of the step that follows.
  reg [44:0] n0;                           // a, or M - a
  reg [45:0] n1;                           // a - M, signed
  reg [44:0] n2;                           // a - 2 M, modular
  wire of_slot = step[4];
  wire take_modulus_off = step[3];
  wire subtracts = step[1] && step[0];
  wire [44:0] a = take_modulus_off ? modulus : of_slot ? {1'b0, rests_q} : 45'd0;  // addend, 1/M, or -M
  wire [46:0] a_less_m = {{a[44], a}, 1'b1} + {{modulus[44], modulus}, short};  // and a carry out of the lowest bit
  wire [45:0] less_2m = {modulus, short};  // -2 M, or -2 M - 1
  wire [45:0] a_less_2m = {a, 1'b1} + {less_2m[44:0], short};  // and a carry out of the lowest bit
  reg carry0;                              // 1 to add to the sum of n0
  reg carry;                               // 1 to add to the other sums
  wire [45:0] part = a_less_m[46:1];

  always @(posedge clk) begin
    n0 <= subtracts ? ~part[44:0] : a;
    n1 <= part;
    n2 <= a_less_2m[45:1];
    carry0 <= (subtracts && !(step == STEP_BEGIN)) || (take_modulus_off && short);
    carry <= take_modulus_off && short;
  end

  // The step: x plus the addend, less M as often as M fits.
  reg [4:0] now;                                   // the step done
  reg fourfold;
  reg twofold;
  reg keeps;
  reg takes;
  reg [22:0] added;                                // number or digits taken in; 0 if there are none
  reg below;                                       // the number taken in is below 0
  wire [45:0] choice = fourfold ? {2'd0, rest} << 2 : twofold ? {2'd0, rest} << 1 : 46'd0;
  wire [45:0] x = choice | ({2'd0, rest} & {46{keeps}}) | {{23{added[22]}}, added};
  wire [45:0] x_and_n0 = {x[44:0], 1'b1} + {n0, carry0};  // and a carry out of the lowest bit
  wire [44:0] s0 = x_and_n0[45:1];
  wire [46:0] x_and_n1 = {x, 1'b1} + {n1, carry};  // and a carry out of the lowest bit
  wire [45:0] s1 = x_and_n1[46:1];
  wire [45:0] x_and_n2 = {x[44:0], 1'b1} + {n2, carry};  // and a carry out of the lowest bit
  wire [44:0] s2 = x_and_n2[45:1];
  wire fits0 = !s0[44];
  wire fits1 = !s1[45];
  wire fits2 = fits1 && !s2[44];
  wire stays = (fourfold && !fits0) || (takes && !below);
  wire lower = fits1 ? fits2 : stays;
  wire [43:0] chosen = fits1 ? {44{lower}} : lower ? x[43:0] : s0[43:0];
  assign rest_next = fits1 ? (chosen & s2[43:0]) | (~chosen & s1[43:0]) : chosen;

  always @(posedge clk) begin
    now <= step;
    fourfold <= (step == STEP_DOUBLE2) || (step == STEP_DIGITS);
    twofold <= (step == STEP_DOUBLE1) || (step == STEP_NEXT);
    keeps <= (step == STEP_REST) || (step == STEP_ADD);
    takes <= (step == STEP_TAKE) || (step == STEP_BEGIN);
    added <= (step == STEP_TAKE) ? number : (step == STEP_DIGITS) ? {21'd0, digits} : 23'd0;
    below <= ((step == STEP_TAKE) && number[22]) || ((step == STEP_BEGIN) && digits[1]);
    rest <= rest_next;
  end

  // The whole part, a clock behind.
  reg [2:0] read_whole_at;
  reg [30:0] whole;         // modular
  wire [30:0] whole_next;
  reg write_then;           // 0 at the start: slot 0 is not written
  initial write_then = 1'b0;
  reg [2:0] write_then_at;
  reg [30:0] wholes [0:7];  // modular

  initial begin : wholes_init
    integer wholes_index;
    for (wholes_index = 0; wholes_index < 8; wholes_index = wholes_index + 1) wholes[wholes_index] = 31'd0;
  end

  always @(posedge clk) begin
    if (write_then) wholes[write_then_at] <= whole_next;
  end

  reg [30:0] wholes_q;

  always @(posedge clk) begin
    if (!(write_then && (write_then_at == read_whole_at))) wholes_q <= wholes[read_whole_at];
  end

  reg subtracted;
  reg slot_now;
  reg [30:0] b;                                      // addend
  wire twice_or_more = fourfold ? fits1 : fits2;
  wire once_or_thrice = fourfold ? (fits0 && !fits1) || fits2 : fits1 && !fits2;
  reg [1:0] taken;                                   // how often M was taken off
  reg was_fourfold;
  reg was_twofold;
  reg was_kept;
  wire [30:0] whole_x = was_fourfold ? {whole[28:0], taken}
                      : was_twofold ? {whole[29:0], taken[1]}
                      : was_kept ? whole
                      : 31'd0;
  wire one = !was_fourfold && (|taken);
  wire [31:0] x_and_b = {whole_x, 1'b1} + {b, one};  // and a carry out of the lowest bit
  assign whole_next = x_and_b[31:1];
  wire [30:0] extended = {31{subtracted || below}};

  always @(posedge clk) begin
    read_whole_at <= read_at;
    write_then <= write;
    write_then_at <= write_at;
    subtracted <= step == STEP_SIGN;
    slot_now <= of_slot;
    b <= slot_now ? wholes_q ^ extended : extended;
    taken <= {twice_or_more, once_or_thrice};
    was_fourfold <= fourfold;
    was_twofold <= twofold;
    was_kept <= keeps;
    whole <= whole_next;
  end

  // A result is rounded, has a whole number added, or is negated: -w - 1 is the complement of w.
  wire [45:0] past_half = {{rest, 1'b0}, 1'b1} + {modulus, short};  // and a carry out of the lowest bit
  reg value_carry;         // 1 to add, rounded up or negated
  reg value_negated;
  reg [30:0] value_added;  // whole number, modular
  wire [31:0] value_sum = {whole ^ {31{value_negated}}, 1'b1} + {value_added, value_carry};  // and a carry out of the lowest bit
  wire [44:0] part_2 = past_half[45:1];

  always @(posedge clk) begin
    if (give) begin
      value_carry <= (nearest ? !part_2[44] : upwards && (|rest)) ^ negate;
      value_negated <= negate;
      value_added <= whole_in;
    end
  end

  assign unfit = (now == STEP_TAKE) && (below ? !fits0 : fits1);
  assign rest_out = rest;
  assign value = value_sum[31:1];

  // Not needed, on purpose.
  wire unused = &{
    1'b0, STEP_FIRST, a_less_m[0], less_2m[45], a_less_2m[0], x_and_n0[0], x_and_n1[0], s1[44],
    x_and_n2[0], x_and_b[0], past_half[0], value_sum[0], part_2[43:0]
  };

endmodule

`default_nettype wire
