// Counts changes of values that are held beside a channel out: from the first token of a triangle that moves there on they
// stay as they are until the next triangle is taken.
`timescale 1ns / 1ps
`default_nettype none
module bench_kept #(
    parameter WIDTH = 1,
    parameter AHEAD = 0,   // 1: the design may have taken triangles whose first token has not moved yet
    parameter NAME = ""
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             told,   // say what is found
    input  wire [31:0]      cycle,
    input  wire             moved,  // the first token of a triangle moves
    input  wire             taken,  // the next triangle is taken
    input  wire [WIDTH-1:0] values,
    output reg  [31:0]      wrong
);
    reg               kept;
    reg [WIDTH-1:0]   last;
    reg signed [31:0] ahead;  // triangles taken, without those whose first token has moved

    wire signed [31:0] left = ahead + (taken ? 1 : 0) - (moved ? 1 : 0);
    wire changed = kept && values !== last;

    always @(posedge clk)
        if (rst) begin
            kept  <= 1'b0;
            last  <= 0;
            ahead <= 0;
            wrong <= 0;
        end else begin
            kept  <= (kept || moved) && !taken && (AHEAD == 0 || left <= 0);
            last  <= values;
            ahead <= left;
            if (changed) wrong <= wrong + 1;
            if (changed && told && wrong < 5)
                $display("%0s: cycle %0d: changed before the next triangle was taken: %h, then %h", NAME, cycle, last, values);
        end
endmodule
`default_nettype wire
