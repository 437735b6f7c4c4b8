// edgewalk_setup_lane0: A lane of setup multiplies and divides serially, k bits a clock.
//
//   a b ─> digits ─> [acc := 2^k acc + a_i x + b_i y] ─ digits of |acc| ─> [rem := 2 rem + digit, less divisor if it fits]
//   x y ────────────────┘                                                     └─ 1 if it fit ─> [quot]
//
// Timing: a clock to load, then k bits a clock, the most significant first; results stand from the next clock on.
// Rules: products are signed; in the first step the sign bits of a and b subtract. Quotients are rounded down
// (quotient, remainder) or to nearest, halves up (rounded). Of a quotient the low bits are kept: the rest falls out.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_setup_lane0 (
  input  wire        clk,

  input  wire        load_divisor,    // a division of acc begins
  input  wire        from_y,          // a division of y_in begins
  input  wire [28:0] y_in,            // signed
  input  wire        step_quotient,
  input  wire [22:0] a_in,            // factor of x, signed
  input  wire [22:0] b_in,            // factor of y, signed
  input  wire [28:0] x_in,            // signed
  input  wire        load_terms,      // x := x_in, y := y_in
  input  wire        load_factors,    // a := a_in, b := b_in, acc := 0
  input  wire        step_product,
  input  wire        first_step,      // of a product
  input  wire [44:0] divisor_in,      // unsigned
  input  wire  [1:0] digit_at,        // which bits of acc are the next digits
  input  wire        keep_nx,         // nx := acc
  input  wire        load_gradients,  // x := nx, y := acc
  input  wire        keep_gx,         // the quotient is that of gx
  input  wire        add_line,        // the quotient is that of d0

  output wire [74:0] product,         // signed
  output wire [37:0] quotient,        // rounded down, modular
  output wire [44:0] remainder,       // 0 to divisor - 1
  output wire [37:0] rounded,         // rounded to nearest, halves up, modular
  output wire [37:0] d1               // modular
);

  // Terms and factors of a product.
  reg [51:0] x;  // term, signed
  reg [51:0] y;  // term, signed
  reg [23:0] a;  // factor, its next bits at the top
  reg [23:0] b;  // factor, its next bits at the top

  always @(posedge clk) begin
    if (step_product) begin
      a <= a << 2;
      b <= b << 2;
    end
    if (load_factors) begin
      a <= {a_in[22], a_in};
      b <= {b_in[22], b_in};
    end
  end

  // A step. The sign bits subtract; then acc is 0, and its doubled lowest bit is free for -t = ~t + 1.
  reg [74:0] acc;  // product, or what is left of a numerator; signed
  wire [52:0] sum = (a[23] ? {x[51], x} : 53'd0) + (b[23] ? {y[51], y} : 53'd0);
  wire [74:0] extended = {{22{sum[52]}}, sum};
  wire [74:0] sum0 = {acc[73:0], first_step} + (first_step ? ~extended : extended);
  wire [52:0] sum_2 = (a[22] ? {x[51], x} : 53'd0) + (b[22] ? {y[51], y} : 53'd0);
  wire [74:0] sum1 = {sum0[73:0], 1'b0} + {{22{sum_2[52]}}, sum_2};

  always @(posedge clk) begin
    if (step_quotient) acc <= acc << 2;
    if (step_product) acc <= sum1;
    if (load_factors) acc <= 75'd0;
    if (from_y) acc <= {{46{y_in[28]}}, y_in};
  end

  // The numerator: acc without its sign, k digits a clock from where this operation has them.
  reg negative;  // the numerator is below 0
  wire [1:0] digits = (digit_at == 2'd2) ? acc[73:72] : (digit_at == 2'd1) ? acc[65:64] : acc[51:50];

  always @(posedge clk) begin
    if (load_divisor) negative <= acc[74];
    if (from_y) negative <= y_in[28];
  end

  // A step: the divisor is taken away wherever it fits.
  wire begin_division = load_divisor || from_y;
  reg [44:0] divisor;  // unsigned
  reg [44:0] rem;      // remainder so far
  reg [37:0] quot;     // quotient so far, modular
  wire [45:0] joined = {rem, digits[1] ^ negative};
  wire [45:0] less0 = joined - {1'b0, divisor};
  wire fits0 = !less0[45];
  wire [45:0] choice = fits0 ? less0 : joined;
  wire [44:0] rest0 = choice[44:0];
  wire [45:0] joined_2 = {rest0, digits[0] ^ negative};
  wire [45:0] less1 = joined_2 - {1'b0, divisor};
  wire fits1 = !less1[45];
  wire [45:0] choice_2 = fits1 ? less1 : joined_2;
  wire [44:0] rest1 = choice_2[44:0];

  always @(posedge clk) begin
    if (begin_division) divisor <= divisor_in;
  end

  always @(posedge clk) begin
    if (step_quotient) rem <= rest1;
    if (begin_division) rem <= 45'd0;
  end

  wire [37:0] joined_3 = {quot[36:0], fits0};

  always @(posedge clk) begin
    if (step_quotient) quot <= {joined_3[36:0], fits1};
  end

  // Below 0: floor(N/D) = ~floor(~N/D), and the remainder is D - 1 - r.
  wire [37:0] floor = negative ? ~quot : quot;  // modular
  wire [44:0] floor_remainder = negative ? divisor + ~rem : rem;
  wire up = ({rem, negative} < {1'b0, divisor}) == negative;  // the next higher is nearest

  // Nx waits here while Ny is formed; then both are terms.
  reg [51:0] nx;  // Nx, signed

  always @(posedge clk) begin
    if (keep_nx) nx <= acc[51:0];
  end

  always @(posedge clk) begin
    if (load_terms) begin
      x <= {{23{x_in[28]}}, x_in};
      y <= {{23{y_in[28]}}, y_in};
    end
    if (load_gradients) begin
      x <= nx;
      y <= acc[51:0];
    end
  end

  // d1 = RN of the sum of the numerators of d0 and gx: from the sums of their quotients and remainders.
  reg [37:0] both;  // sum of the quotients, modular
  reg [45:0] rest;  // sum of the remainders, below 2 divisors
  wire [46:0] joined_4 = {rest, 1'b0};
  wire half = joined_4 >= {2'd0, divisor};
  wire three_halves = joined_4 >= ({2'd0, divisor} + ({2'd0, divisor} << 1));

  always @(posedge clk) begin
    if (add_line) begin
      both <= both + floor;
      rest <= rest + {1'b0, floor_remainder};
    end
    if (keep_gx) begin
      both <= floor;
      rest <= {1'b0, floor_remainder};
    end
  end

  assign product = acc;
  assign quotient = floor;
  assign remainder = floor_remainder;
  assign rounded = floor + {37'd0, up};
  assign d1 = both + {37'd0, half} + {37'd0, three_halves};

  // Not needed, on purpose.
  wire unused = &{1'b0, sum0[74], choice[45], joined_3[37], choice_2[45]};

endmodule

`default_nettype wire
