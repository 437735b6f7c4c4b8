// Whether the bench is willing, to offer a new token or to take one: a bit for each cycle, again from the start after PERIOD.
`timescale 1ns / 1ps
`default_nettype none
module bench_pattern #(
    parameter PERIOD = 1,
    parameter BITS = ""
) (
    input  wire [31:0] cycle,
    output wire        willing
);
    reg bits [0:PERIOD-1];

    initial $readmemb(BITS, bits);

    assign willing = bits[cycle % PERIOD];
endmodule
`default_nettype wire
