// dda: A value that steps by a slope.
//
// value Q8.14 LSB, slope Q8.14 LSB/px; the integer part is shown.
// Timing: load and step take effect at the end of the cycle.

`timescale 1ns / 1ps
`default_nettype none

module dda (
  input  wire        clk,
  input  wire        rst,

  input  wire        load,
  input  wire        step,
  input  wire [21:0] init,          // Q8.14 LSB
  input  wire [21:0] slope_in,      // Q8.14 LSB/px, two's complement

  output wire  [7:0] integer_part,  // LSB
  output reg         falling        // the slope is negative
);

  // The slope, held until the next load
  reg [21:0] slope;  // Q8.14 LSB/px

  always @(posedge clk) begin
    if (load) slope <= slope_in;
  end

  // The value
  reg [21:0] value;  // Q8.14 LSB
  wire [21:0] next = value + slope;

  always @(posedge clk) begin
    if (rst) begin
      value <= 22'd0;
    end else if (load || step) begin
      value <= load ? init : next;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      falling <= 1'b0;
    end else if (load) begin
      falling <= $signed(slope_in) < 22'sd0;
    end
  end

  assign integer_part = value[21:14];

endmodule

`default_nettype wire
