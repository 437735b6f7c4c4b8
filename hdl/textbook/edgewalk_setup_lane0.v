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

  input  wire        load_divisor,   // a division of acc begins
  input  wire        from_y,         // a division of y_in begins
  input  wire [16:0] y_in,           // signed
  input  wire        step_quotient,
  input  wire [15:0] a_in,           // factor of x, signed
  input  wire [15:0] b_in,           // factor of y, signed
  input  wire [16:0] x_in,           // signed
  input  wire        load_terms,     // x := x_in, y := y_in
  input  wire        load_factors,   // a := a_in, b := b_in, acc := 0
  input  wire        step_product,
  input  wire        first_step,     // of a product
  input  wire [30:0] divisor_in,     // unsigned
  input  wire  [2:0] digit_at,       // which bits of acc are the next digits

  output wire [32:0] product,        // signed
  output wire [30:0] quotient,       // rounded down, modular
  output wire [30:0] remainder,      // 0 to divisor - 1
  output wire [30:0] rounded         // rounded to nearest, halves up, modular
);

  // Terms and factors of a product.
  reg [16:0] x;  // term, signed
  reg [16:0] y;  // term, signed
  reg [15:0] a;  // factor, its next bits at the top
  reg [15:0] b;  // factor, its next bits at the top

  always @(posedge clk) begin
    if (load_terms) begin
      x <= x_in;
      y <= y_in;
    end
  end

  always @(posedge clk) begin
    if (step_product) begin
      a <= a << 1;
      b <= b << 1;
    end
    if (load_factors) begin
      a <= a_in;
      b <= b_in;
    end
  end

  // A step. The sign bits subtract; then acc is 0, and its doubled lowest bit is free for -t = ~t + 1.
  reg [32:0] acc;  // product, or what is left of a numerator; signed
  wire [17:0] sum = (a[15] ? {x[16], x} : 18'd0) + (b[15] ? {y[16], y} : 18'd0);
  wire [32:0] extended = {{15{sum[17]}}, sum};
  wire [32:0] sum0 = {acc[31:0], first_step} + (first_step ? ~extended : extended);

  always @(posedge clk) begin
    if (step_quotient) acc <= acc << 1;
    if (step_product) acc <= sum0;
    if (load_factors) acc <= 33'd0;
    if (from_y) acc <= {{16{y_in[16]}}, y_in};
  end

  // The numerator: acc without its sign, k digits a clock from where this operation has them.
  reg negative;  // the numerator is below 0
  wire digits = (digit_at == 3'd5) ? acc[32]
              : (digit_at == 3'd4) ? acc[31]
              : (digit_at == 3'd3) ? acc[30]
              : (digit_at == 3'd2) ? acc[24]
              : (digit_at == 3'd1) ? acc[23]
              : acc[14];

  always @(posedge clk) begin
    if (load_divisor) negative <= acc[32];
    if (from_y) negative <= y_in[16];
  end

  // A step: the divisor is taken away wherever it fits.
  wire begin_division = load_divisor || from_y;
  reg [30:0] divisor;  // unsigned
  reg [30:0] rem;      // remainder so far
  reg [30:0] quot;     // quotient so far, modular
  wire [31:0] joined = {rem, digits ^ negative};
  wire [31:0] less0 = joined - {1'b0, divisor};
  wire fits0 = !less0[31];
  wire [31:0] choice = fits0 ? less0 : joined;
  wire [30:0] rest0 = choice[30:0];

  always @(posedge clk) begin
    if (begin_division) divisor <= divisor_in;
  end

  always @(posedge clk) begin
    if (step_quotient) rem <= rest0;
    if (begin_division) rem <= 31'd0;
  end

  always @(posedge clk) begin
    if (step_quotient) quot <= {quot[29:0], fits0};
  end

  // Below 0: floor(N/D) = ~floor(~N/D), and the remainder is D - 1 - r.
  wire [30:0] floor = negative ? ~quot : quot;  // modular
  wire [30:0] floor_remainder = negative ? divisor + ~rem : rem;
  wire up = ({rem, negative} < {1'b0, divisor}) == negative;  // the next higher is nearest
  assign product = acc;
  assign quotient = floor;
  assign remainder = floor_remainder;
  assign rounded = floor + {30'd0, up};

  // Not needed, on purpose.
  wire unused = &{1'b0, choice[31]};

endmodule

`default_nettype wire
