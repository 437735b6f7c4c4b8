// Offers the tokens of a file on a valid/ready channel, in order.
// A token is offered first in a cycle in which the bench is willing, and then held until it is taken.
`timescale 1ns / 1ps
`default_nettype none
module bench_source #(
    parameter WIDTH = 1,
    parameter COUNT = 1,
    parameter TOKENS = ""
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             willing,
    output wire             valid,
    input  wire             ready,
    output wire [WIDTH-1:0] data,
    output wire             fire,
    output wire             more   // there are tokens to come
);
    reg [WIDTH-1:0] tokens [0:(COUNT == 0 ? 0 : COUNT - 1)];
    reg [31:0]      sent;
    reg             held;

    initial if (COUNT > 0) $readmemh(TOKENS, tokens);

    assign valid = !rst && more && (held || willing);
    assign data  = valid ? tokens[sent] : {WIDTH{1'b0}};
    assign fire  = valid && ready;
    assign more  = sent != COUNT;

    always @(posedge clk)
        if (rst) begin
            sent <= 0;
            held <= 1'b0;
        end else begin
            if (fire) sent <= sent + 1;
            held <= valid && !ready;
        end
endmodule
`default_nettype wire
