// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 6db543e8dccb

// edgewalk_setup_lane0: A lane of a sequenced SETUP: the number W + A / M, -M <= A < M, and rows of such numbers.
//
//   rows ─> row of A ─> + or - ─> [A]          one addition a clock for each: base + row or base - row,
//   rows ─> row of W ─> + or - ─> [W]          base being 0, the same, twice the same, or A without its low bits
//
// Timing: a row is addressed in the first clock, added in the second, and A and W can be written in the third.
// Rules: a modulus is added or subtracted by the sign that A has before the step, so no choice waits for the sum.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_setup_lane0 (
  input  wire        clk,

  input  wire  [7:0] read_row,       // row that is added in the next clock
  input  wire  [7:0] write_row,      // row that A, W or a word of a triangle is written to
  input  wire        write_a,        // A is written
  input  wire        write_w,        // W is written
  input  wire        takes,          // a word of a triangle is written instead of A
  input  wire [25:0] taken,          // the word
  input  wire        steps,          // a step is done
  input  wire        only_negative,  // unless A >= 0
  input  wire        only_positive,  // unless A < 0
  input  wire  [1:0] base,           // 0: nothing; 1: A, W; 2: twice these; 3: A without its low t bits, W
  input  wire        minus,          // the row is subtracted
  input  wire        by_a,           // the row is a modulus, subtracted if A >= 0
  input  wire        of_whole,       // the low bits of W stand for the row of A
  input  wire        raise_13,       // the row of A is added to W too, so far up

  output wire        is_negative,    // A < 0
  output wire        stays,          // the step before left the sign of A
  output wire [25:0] rest,           // A
  output wire [28:0] whole,          // W
  output wire [13:0] factor          // low bits of the row of A
);

  // Rows.
  reg [25:0] a;               // A
  reg [28:0] w;               // W
  reg [25:0] rows_a [0:255];  // A of each row

  initial begin : rows_a_init
    integer rows_a_index;
    for (rows_a_index = 0; rows_a_index < 256; rows_a_index = rows_a_index + 1) rows_a[rows_a_index] = 26'd0;
    rows_a[1] = 26'd1;     // one
    rows_a[2] = 26'd4;     // half
    rows_a[3] = 26'd3;     // up
    rows_a[4] = 26'd960;   // height
    rows_a[6] = 26'd1280;  // width
    rows_a[8] = 26'd8;     // pixel
  end

  reg [28:0] rows_w [0:255];  // W of each row

  initial begin : rows_w_init
    integer rows_w_index;
    for (rows_w_index = 0; rows_w_index < 256; rows_w_index = rows_w_index + 1) rows_w[rows_w_index] = 29'd0;
    rows_w[178] = 29'd4100;  // k.z
    rows_w[179] = 29'd4100;  // k.r
    rows_w[180] = 29'd4100;  // k.g
    rows_w[181] = 29'd4100;  // k.b
  end

  always @(posedge clk) begin
    if (write_a || takes) rows_a[write_row] <= takes ? taken : a;
  end

  always @(posedge clk) begin
    if (write_w && !takes) rows_w[write_row] <= w;
  end

  reg [25:0] rows_a_q;

  always @(posedge clk) begin
    if (1'b1) rows_a_q <= rows_a[read_row];
  end

  reg [28:0] rows_w_q;

  always @(posedge clk) begin
    if (1'b1) rows_w_q <= rows_w[read_row];
  end

  // The step.
  wire negative = a[25];
  wire subtracts = by_a ? !negative : minus;
  wire lowers = by_a ? negative : minus;         // W gets less
  wire nothing = base == 2'd0;
  wire twice = base == 2'd2;
  wire masked = base == 2'd3;
  wire [2:0] low_bits = a[2:0] & {3{!masked}};
  wire [25:0] from_a = (twice ? a << 1 : {a[25:3], low_bits}) & {26{!nothing}};
  wire [28:0] from_w = (twice ? w << 1 : w) & {29{!nothing}};
  wire [13:0] part = w[13:0];
  wire [26:0] joined = {(of_whole ? {{12{part[13]}}, part} : rows_a_q) ^ {26{subtracts}}, subtracts};
  wire [26:0] next_a = {from_a, 1'b1} + joined;  // and a carry out of the lowest bit
  wire [28:0] either = rows_w_q | (({{3{rows_a_q[25]}}, rows_a_q} << 13) & {29{raise_13}});
  wire [29:0] next_w = {from_w, 1'b1} + {either ^ {29{lowers}}, subtracts};  // and a carry out of the lowest bit
  wire done = steps && !((only_negative && !negative) || (only_positive && negative));
  reg was_negative;                              // A was below 0 before this clock

  always @(posedge clk) begin
    if (done) begin
      a <= next_a[26:1];
      w <= next_w[29:1];
    end
  end

  always @(posedge clk) begin
    was_negative <= negative;
  end

  assign is_negative = negative;
  assign stays = was_negative == negative;
  assign rest = a;
  assign whole = w;
  assign factor = rows_a_q[13:0];

  // Not needed, on purpose.
  wire unused = &{1'b0, next_a[0], next_w[0]};

endmodule

`default_nettype wire
