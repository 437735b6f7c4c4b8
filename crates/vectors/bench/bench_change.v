// Fires in the first cycle and in every cycle in which the value is not that of the cycle before.
`timescale 1ns / 1ps
`default_nettype none
module bench_change #(
    parameter WIDTH = 1
) (
    input  wire             clk,
    input  wire             rst,
    input  wire [WIDTH-1:0] value,
    output wire             fire
);
    reg [WIDTH-1:0] last;
    reg             started;

    assign fire = !rst && (!started || value !== last);

    always @(posedge clk) begin
        started <= !rst;
        last    <= value;
    end
endmodule
`default_nettype wire
