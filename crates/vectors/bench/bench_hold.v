// Counts what a channel out must not do before its token is taken: let valid fall, or change the token. It counts too where
// a port holds more than its value.
`timescale 1ns / 1ps
`default_nettype none
module bench_hold #(
    parameter WIDTH = 1,
    parameter NAME = ""
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             told,   // say what is found
    input  wire [31:0]      cycle,
    input  wire             valid,
    input  wire             ready,
    input  wire [WIDTH-1:0] data,
    input  wire             beyond, // a port holds more than its value
    output reg  [31:0]      wrong
);
    reg             held;
    reg [WIDTH-1:0] last;

    wire fell    = held && valid !== 1'b1;
    wire changed = held && !fell && data !== last;
    wire more    = valid === 1'b1 && beyond;

    always @(posedge clk)
        if (rst) begin
            held  <= 1'b0;
            last  <= 0;
            wrong <= 0;
        end else begin
            held <= valid === 1'b1 && !ready;
            last <= data;
            if (fell || changed || more) wrong <= wrong + 1;
            if (told && wrong < 5) begin
                if (fell) $display("%0s: cycle %0d: valid fell before the token was taken", NAME, cycle);
                if (changed) $display("%0s: cycle %0d: the token changed before it was taken", NAME, cycle);
                if (more) $display("%0s: cycle %0d: a wider port holds more than its value extended", NAME, cycle);
            end
        end
endmodule
`default_nettype wire
