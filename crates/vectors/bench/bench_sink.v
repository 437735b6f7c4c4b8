// Compares the tokens that move on a channel with those of a file, in order, and the cycles in which they do.
// The words for a fault are the test bench's: it knows the fields.
`timescale 1ns / 1ps
`default_nettype none
module bench_sink #(
    parameter WIDTH = 1,
    parameter COUNT = 1,
    parameter CHECK_CYCLES = 1,
    parameter TOKENS = "",
    parameter CYCLES = ""   // in steps: cycles from each token to the next
) (
    input  wire             clk,
    input  wire             rst,
    input  wire [31:0]      cycle,
    input  wire             fire,
    input  wire [WIDTH-1:0] data,
    output reg  [31:0]      checked, // expected tokens that came
    output reg  [31:0]      wrong,   // of these and of others
    output wire [2:0]       fault,   // in this cycle: 1 one too many, 2 unknown bits, 3 another token, 4 another cycle
    output wire [WIDTH-1:0] want,    // the token expected next
    output wire [31:0]      due      // and its cycle
);
    reg [WIDTH-1:0] tokens [0:(COUNT == 0 ? 0 : COUNT - 1)];
    reg [31:0]      cycles [0:(COUNT == 0 ? 0 : COUNT - 1)];

    integer    i;

    initial if (COUNT > 0) begin
        $readmemh(TOKENS, tokens);
        $readmemh(CYCLES, cycles);
        for (i = 1; i < COUNT; i = i + 1) cycles[i] = cycles[i - 1] + cycles[i];
    end

    wire moved = !rst && fire !== 1'b0; // an unknown fire is taken for one
    wire extra = checked == COUNT;

    assign want  = tokens[extra ? 0 : checked];
    assign due   = cycles[extra ? 0 : checked];
    assign fault = !moved                                ? 3'd0
                 : extra                                 ? 3'd1
                 : (fire === 1'bx || ^data === 1'bx)     ? 3'd2
                 : data !== want                         ? 3'd3
                 : (CHECK_CYCLES != 0 && cycle !== due)  ? 3'd4
                 : 3'd0;

    always @(posedge clk)
        if (rst) begin
            checked <= 0;
            wrong   <= 0;
        end else if (moved) begin
            if (!extra) checked <= checked + 1;
            if (fault != 0) wrong <= wrong + 1;
        end
endmodule
`default_nettype wire
