// Offers the tokens of a file on a valid/ready channel, in order.
// A token is offered first in a cycle in which PATTERN is willing, and then held until it is taken.
`default_nettype none
module bench_source #(
    parameter WIDTH = 1,
    parameter COUNT = 1,
    parameter PERIOD = 1,
    parameter [PERIOD-1:0] PATTERN = 1,
    parameter TOKENS = ""
) (
    input  wire             clk,
    input  wire             rst,
    input  wire [31:0]      cycle,
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

    assign valid = !rst && more && (held || PATTERN[cycle % PERIOD]);
    assign data  = valid ? tokens[sent] : {WIDTH{1'b0}};
    assign fire  = valid && ready;
    assign more  = sent < COUNT;

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
