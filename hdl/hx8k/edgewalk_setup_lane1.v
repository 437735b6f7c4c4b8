// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 7efc7d48fe81

// edgewalk_setup_lane1: A lane of a sequenced SETUP: the number W + A / M, -M <= A < M, and rows of such numbers.
//
//   rows ─> row of A ─> + or - ─> [A]          one addition a clock for each: base + row or base - row,
//   rows ─> row of W ─> + or - ─> [W]          base being 0, the same, twice the same, or A without its low bits
//
// Timing: a row is addressed in the first clock, added in the second, and A and W can be written in the third.
// Rules: a modulus is added or subtracted by the sign that A has before the step, so no choice waits for the sum.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_setup_lane1 (
  input  wire        clk,

  input  wire  [7:0] read_row,       // row that is added in the next clock
  input  wire  [7:0] write_row,      // row that A, W or a word of a triangle is written to
  input  wire        write_a,        // A is written
  input  wire        write_w,        // W is written
  input  wire        takes,          // a word of a triangle is written instead of A
  input  wire [45:0] taken,          // the word
  input  wire        steps,          // a step is done
  input  wire        only_negative,  // unless A >= 0
  input  wire        only_positive,  // unless A < 0
  input  wire  [1:0] base,           // 0: nothing; 1: A, W; 2: twice these; 3: A without its low t bits, W
  input  wire        minus,          // the row is subtracted
  input  wire        by_a,           // the row is a modulus, subtracted if A >= 0
  input  wire        of_whole,       // the low bits of W stand for the row of A
  input  wire        raise_18,       // the row of A is added to W too, so far up

  output wire        is_negative,    // A < 0
  output wire        stays,          // the step before left the sign of A
  output wire [45:0] rest,           // A
  output wire [29:0] whole,          // W
  output wire [23:0] factor          // low bits of the row of A
);

  // Rows.
  reg [45:0] a;               // A
  reg [29:0] w;               // W
  reg [45:0] rows_a [0:255];  // A of each row

  initial begin : rows_a_init
    integer rows_a_index;
    for (rows_a_index = 0; rows_a_index < 256; rows_a_index = rows_a_index + 1) rows_a[rows_a_index] = 46'd0;
    rows_a[1] = 46'd1;      // one
    rows_a[2] = 46'd128;    // half
    rows_a[3] = 46'd127;    // up
    rows_a[4] = 46'h1e000;  // height
    rows_a[6] = 46'h28000;  // width
    rows_a[8] = 46'd256;    // pixel
  end

  reg [29:0] rows_w [0:255];  // W of each row

  initial begin : rows_w_init
    integer rows_w_index;
    for (rows_w_index = 0; rows_w_index < 256; rows_w_index = rows_w_index + 1) rows_w[rows_w_index] = 30'd0;
    rows_w[178] = 30'h200080;  // k.r
  end

  always @(posedge clk) begin
    if (write_a || takes) rows_a[write_row] <= takes ? taken : a;
  end

  always @(posedge clk) begin
    if (write_w && !takes) rows_w[write_row] <= w;
  end

  reg [45:0] rows_a_q;

  always @(posedge clk) begin
    if (1'b1) rows_a_q <= rows_a[read_row];
  end

  reg [29:0] rows_w_q;

  always @(posedge clk) begin
    if (1'b1) rows_w_q <= rows_w[read_row];
  end

  // The step.
  wire negative = a[45];
  wire subtracts = by_a ? !negative : minus;
  wire lowers = by_a ? negative : minus;         // W gets less
  wire nothing = base == 2'd0;
  wire twice = base == 2'd2;
  wire masked = base == 2'd3;
  wire [7:0] low_bits = a[7:0] & {8{!masked}};
  wire [45:0] from_a = (twice ? a << 1 : {a[45:8], low_bits}) & {46{!nothing}};
  wire [29:0] from_w = (twice ? w << 1 : w) & {30{!nothing}};
  wire [23:0] part = w[23:0];
  wire [46:0] joined = {(of_whole ? {{22{part[23]}}, part} : rows_a_q) ^ {46{subtracts}}, subtracts};
  wire [46:0] next_a = {from_a, 1'b1} + joined;  // and a carry out of the lowest bit
  wire [29:0] differing = (rows_w_q | ((rows_a_q[29:0] << 18) & {30{raise_18}})) ^ {30{lowers}};
  wire [30:0] next_w = {from_w, 1'b1} + {differing, subtracts};  // and a carry out of the lowest bit
  wire done = steps && !((only_negative && !negative) || (only_positive && negative));
  reg was_negative;                              // A was below 0 before this clock

  always @(posedge clk) begin
    if (done) begin
      a <= next_a[46:1];
      w <= next_w[30:1];
    end
  end

  always @(posedge clk) begin
    was_negative <= negative;
  end

  assign is_negative = negative;
  assign stays = was_negative == negative;
  assign rest = a;
  assign whole = w;
  assign factor = rows_a_q[23:0];

  // Not needed, on purpose.
  wire unused = &{1'b0, next_a[0], next_w[0]};

endmodule

`default_nettype wire
