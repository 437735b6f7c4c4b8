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
    localparam MOST = 4096;  // writes whose addresses are kept

    // More than the 2048 reads that can be in flight: tables are asked for faster than they are taken.
    reg [WIDTH-1:0] waiting [0:4095];
    reg [31:0]      due [0:4095];
    reg [11:0]      first;
    reg [11:0]      free;
    reg             held;
    reg [WIDTH-1:0] words [0:(1 << ADDRESS) - 1];
    reg [ADDRESS-1:0] written [0:MOST-1];  // addresses of the writes since the last fill
    integer         writes = MOST + 1;     // how many; above MOST every word is filled
    integer         i;

    // To fill all words of a large memory takes longer than a short case.
    task fill; begin
        if (writes > MOST) for (i = 0; i < (1 << ADDRESS); i = i + 1) words[i] = CLEAR;
        else for (i = 0; i < writes; i = i + 1) words[written[i]] = CLEAR;
        if (STARTS > 0) $readmemh(START, words, 0, STARTS - 1);
        writes = 0;
    end endtask

    assign valid = !rst && first != free && due[first] <= cycle && (held || willing);
    assign data  = valid ? waiting[first] : {WIDTH{1'b0}};
    assign fire  = valid && ready;

    always @(posedge clk)
        if (rst) begin
            first <= 0;
            free  <= 0;
            held  <= 1'b0;
            if (writes > 0) fill;
        end else begin
            if (fire) first <= first + 1;
            held <= valid && !ready;
            if (read) begin
                waiting[free] <= words[read_address];
                due[free]     <= cycle + LATENCY;
                free          <= free + 1;
            end
            if (write) begin
                words[write_address] = write_data;
                if (writes < MOST) written[writes] = write_address;
                if (writes <= MOST) writes = writes + 1;
            end
        end
endmodule
`default_nettype wire
