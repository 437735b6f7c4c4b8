// When the bench takes a token: in the cycles in which it is willing. In the first run, which is not compared, it waits
// until it has seen valid: a design whose valid waits for ready then gives nothing.
`timescale 1ns / 1ps
`default_nettype none
module bench_taker (
    input  wire clk,
    input  wire rst,
    input  wire shy,       // take only what was offered in the clock before
    input  wire willing,
    input  wire valid,
    output wire ready,
    output reg  offered    // a token was offered in this run
);
    reg seen;

    assign ready = willing && (!shy || seen);

    always @(posedge clk) begin
        seen    <= !rst && valid !== 1'b0 && !ready; // an unknown valid is taken for one
        offered <= !rst && (offered || valid !== 1'b0);
    end
endmodule
`default_nettype wire
