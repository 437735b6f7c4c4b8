// Compares the tokens that move on a channel with those of a file, in order, and the cycles in which they do.
`default_nettype none
module bench_sink #(
    parameter NAME = "",
    parameter WIDTH = 1,
    parameter COUNT = 1,
    parameter CHECK_CYCLES = 1,
    parameter TOKENS = "",
    parameter CYCLES = ""
) (
    input  wire             clk,
    input  wire             rst,
    input  wire [31:0]      cycle,
    input  wire             fire,
    input  wire [WIDTH-1:0] data,
    output reg  [31:0]      checked, // expected tokens that came
    output reg  [31:0]      wrong    // of these and of others
);
    localparam SHOWN = 5; // differences told in full

    reg [WIDTH-1:0] tokens [0:(COUNT == 0 ? 0 : COUNT - 1)];
    reg [31:0]      cycles [0:(COUNT == 0 ? 0 : COUNT - 1)];

    initial if (COUNT > 0) begin
        $readmemh(TOKENS, tokens);
        $readmemh(CYCLES, cycles);
    end

    always @(posedge clk)
        if (rst) begin
            checked <= 0;
            wrong   <= 0;
        end else if (fire !== 1'b0) begin
            if (checked == COUNT) begin
                wrong <= wrong + 1;
                if (wrong < SHOWN)
                    $display("%0s: cycle %0d: %h is one more than the %0d expected", NAME, cycle, data, COUNT);
            end else begin
                checked <= checked + 1;
                if (fire === 1'bx || ^data === 1'bx) begin
                    wrong <= wrong + 1;
                    if (wrong < SHOWN)
                        $display("%0s: token %0d, cycle %0d: unknown bits: %h", NAME, checked, cycle, data);
                end else if (data !== tokens[checked]) begin
                    wrong <= wrong + 1;
                    if (wrong < SHOWN)
                        $display("%0s: token %0d, cycle %0d: expected %h, found %h", NAME, checked, cycle,
                                 tokens[checked], data);
                end else if (CHECK_CYCLES != 0 && cycle !== cycles[checked]) begin
                    wrong <= wrong + 1;
                    if (wrong < SHOWN)
                        $display("%0s: token %0d: expected in cycle %0d, found in cycle %0d", NAME, checked,
                                 cycles[checked], cycle);
                end
            end
        end
endmodule
`default_nettype wire
