// pair: Two DDAs, one of them fed from a small memory.

`timescale 1ns / 1ps
`default_nettype none

module pair (
  input  wire        clk,
  input  wire        rst,

  input  wire        load,
  input  wire [21:0] init,
  input  wire        write,
  input  wire  [2:0] addr,

  output wire        stop,      // the left one has passed the right
  output wire  [7:0] middle,    // LSB
  output wire [11:0] furthest
);

  localparam [1:0] IDLE = 2'd0;
  localparam [1:0] BUSY = 2'd1;
  reg [1:0] state;

  // Slopes
  reg [21:0] slopes [0:7];  // Q8.14 LSB/px

  initial begin : slopes_init
    integer slopes_index;
    for (slopes_index = 0; slopes_index < 8; slopes_index = slopes_index + 1) slopes[slopes_index] = 22'd0;
  end

  always @(posedge clk) begin
    if (write) slopes[addr] <= init;
  end

  reg [21:0] slopes_q;

  always @(posedge clk) begin
    if (!write) slopes_q <= slopes[addr];
  end

  // The two
  wire is_busy = state == BUSY;
  wire [7:0] u_left_integer_part;
  wire [7:0] u_right_integer_part;
  wire u_right_falling_unused;

  dda u_right (
    .clk          (clk),
    .rst          (rst),
    .load         (load),
    .step         (is_busy),
    .init         (-init),
    .slope_in     ($unsigned($signed(slopes_q) >>> 1) + 22'd3),
    .integer_part (u_right_integer_part),
    .falling      (u_right_falling_unused)
  );

  wire u_left_falling;

  dda u_left (
    .clk          (clk),
    .rst          (rst),
    .load         (load),
    .step         (is_busy && !stop),
    .init         (init),
    .slope_in     (slopes_q),
    .integer_part (u_left_integer_part),
    .falling      (u_left_falling)
  );

  assign stop = (u_left_integer_part >= u_right_integer_part) && u_left_falling;

  always @(posedge clk) begin
    if (rst) begin
      state <= IDLE;
    end else begin
      if (load) state <= BUSY;
      if (stop) state <= IDLE;
    end
  end

  // Out
  wire [8:0] sum = {1'b0, u_left_integer_part} + {1'b0, u_right_integer_part};
  assign middle = sum[8:1];
  wire [7:0] choice = (u_left_integer_part > u_right_integer_part) ? u_left_integer_part
                    : u_right_integer_part;
  assign furthest = (|choice) ? {{4{u_left_integer_part[7]}}, u_left_integer_part}
                  : {{4{u_right_integer_part[7]}}, u_right_integer_part};

  // Not needed, on purpose.
  wire unused = &{1'b0, sum[0]};

endmodule

`default_nettype wire
