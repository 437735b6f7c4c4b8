// When the bench takes a token: in the cycles in which it is willing, and never during a reset. In the first run, which is
// compared in part, it waits until it has seen valid: a design whose valid waits for ready then gives nothing.
`timescale 1ns / 1ps
`default_nettype none
module bench_taker #(
    parameter COUNT = 2    // tokens of a run
) (
    input  wire clk,
    input  wire rst,
    input  wire shy,       // take only what was offered in the clock before
    input  wire keep,      // take nothing: tokens wait for the second reset
    input  wire willing,
    input  wire valid,
    output wire ready,
    output reg  offered,   // a token was offered in this run
    output reg  ahead      // and a second one, or the only one
);
    reg seen;
    reg taken; // a token was taken in this run

    assign ready = willing && !rst && !keep && (!shy || seen);

    always @(posedge clk) begin
        seen    <= !rst && valid !== 1'b0 && !ready; // an unknown valid is taken for one
        offered <= !rst && (offered || valid !== 1'b0);
        taken   <= !rst && (taken || (valid === 1'b1 && ready));
        ahead   <= !rst && (ahead || (valid !== 1'b0 && (taken || COUNT == 1)));
    end
endmodule
`default_nettype wire
