// A memory: a read sees the word before a write of its own cycle; its data is offered, in order, LATENCY cycles
// later, or in the next cycle in which the bench is willing, and then held until it is taken.
`timescale 1ns / 1ps
`default_nettype none
module bench_memory #(
    parameter ADDRESS = 1,
    parameter WIDTH = 1,
    parameter LATENCY = 1,
    parameter [WIDTH-1:0] CLEAR = 0,
    parameter STARTS = 0,  // words of its own, from address 0 on
    parameter START = ""   // their file
) (
    input  wire               clk,
    input  wire               rst,
    input  wire [31:0]        cycle,
    input  wire               willing,
    input  wire               read,
    input  wire [ADDRESS-1:0] read_address,
    input  wire               write,
    input  wire [ADDRESS-1:0] write_address,
    input  wire [WIDTH-1:0]   write_data,
    output wire               valid,
    input  wire               ready,
    output wire [WIDTH-1:0]   data,
    output wire               fire
);
    // More than the 2048 reads that can be in flight: tables are asked for faster than they are taken.
    reg [WIDTH-1:0] waiting [0:4095];
    reg [31:0]      due [0:4095];
    reg [11:0]      first;
    reg [11:0]      free;
    reg             held;
    reg [WIDTH-1:0] words [0:(1 << ADDRESS) - 1];
    reg             used = 1'b1;  // not filled after the last clock without reset
    integer         i;

    task fill; begin
        for (i = 0; i < (1 << ADDRESS); i = i + 1) words[i] = CLEAR;
        if (STARTS > 0) $readmemh(START, words, 0, STARTS - 1);
    end endtask

    assign valid = !rst && first != free && due[first] <= cycle && (held || willing);
    assign data  = valid ? waiting[first] : {WIDTH{1'b0}};
    assign fire  = valid && ready;

    always @(posedge clk)
        if (rst) begin
            first <= 0;
            free  <= 0;
            held  <= 1'b0;
            used  <= 1'b0;
            if (used) fill;
        end else begin
            used <= 1'b1;
            if (fire) first <= first + 1;
            held <= valid && !ready;
            if (read) begin
                waiting[free] <= words[read_address];
                due[free]     <= cycle + LATENCY;
                free          <= free + 1;
            end
            if (write) words[write_address] = write_data;
        end
endmodule
`default_nettype wire
