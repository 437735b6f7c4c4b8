// A rasterizer of another architecture: half-planes over tiles of 8 x 8 pixels, from the last tile to the first. A tile is
// kept in registers until all triangles went over it; then its pixels are written, the last first. A clock tries one pixel.
`timescale 1ns / 1ps
module tiles #(
  parameter WIDTH = 64,
  parameter HEIGHT = 48,
  parameter COUNT = 1,
  parameter DEPTH_BITS = 24, // of 24 bits those that are right
  parameter FILL = 0,        // 1: right and bottom edges are inside
  parameter FARTHEST = 0     // 1: the farthest fragment wins
) (
  input  wire        clk,
  input  wire        rst,
  output reg         wr_valid,
  output reg  [15:0] wr_addr, // line * WIDTH + column
  output reg  [23:0] wr_z,
  output reg  [23:0] wr_rgb,
  output reg  [31:0] wr_count,
  output reg         done
);
  localparam ACROSS = WIDTH / 8, TILES = ACROSS * (HEIGHT / 8);

  // For each triangle three times x, y (1/256 px), z (2^-32), r, g, b (2^-16).
  reg signed [63:0] words [0:18*COUNT-1];

  reg [23:0]  z [0:63];
  reg [23:0]  rgb [0:63];
  reg [31:0]  count [0:63];
  reg         drawn [0:63];
  integer     tile, triangle, pixel, k, m;
  reg         writes;

  reg signed [63:0]  px [0:2], py [0:2], cx, cy, area, w [0:2], ax, ay, bx, by;
  reg                inside, edge_in;
  reg signed [127:0] sum;
  reg [23:0]         new_z, new_rgb;

  function signed [63:0] cross;
    input signed [63:0] ax, ay, bx, by, cx, cy;
    cross = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  endfunction

  // The weighted value of a field, as so many bits of full scale, rounded to the nearest.
  function [31:0] value;
    input integer field, fraction, bits;
    reg signed [127:0] total, whole, one;
    begin
      total = 0;
      for (k = 0; k < 3; k = k + 1) total = total + w[k] * words[18 * triangle + 6 * k + field];
      one = (128'sd1 <<< bits) - 1;
      whole = w[0] + w[1] + w[2];
      value = (2 * total * one + (whole <<< fraction)) / (2 * (whole <<< fraction));
    end
  endfunction

  task try_pixel; begin
    cx = ((tile % ACROSS) * 8 + pixel % 8) * 256 + 128;
    cy = ((tile / ACROSS) * 8 + pixel / 8) * 256 + 128;
    for (k = 0; k < 3; k = k + 1) begin
      px[k] = words[18 * triangle + 6 * k];
      py[k] = words[18 * triangle + 6 * k + 1];
    end
    area = cross(px[0], py[0], px[1], py[1], px[2], py[2]);
    inside = area != 0;
    for (m = 0; m < 3; m = m + 1) begin
      ax = area < 0 ? px[(m + 2) % 3] : px[(m + 1) % 3];
      ay = area < 0 ? py[(m + 2) % 3] : py[(m + 1) % 3];
      bx = area < 0 ? px[(m + 1) % 3] : px[(m + 2) % 3];
      by = area < 0 ? py[(m + 1) % 3] : py[(m + 2) % 3];
      w[m] = cross(ax, ay, bx, by, cx, cy);
      edge_in = (by < ay || (by == ay && bx > ax)) ^ FILL;
      if (w[m] < 0 || (w[m] == 0 && !edge_in)) inside = 1'b0;
    end
    if (inside) begin
      count[pixel] = count[pixel] + 1;
      new_z = value(2, 32, DEPTH_BITS) << (24 - DEPTH_BITS);
      new_rgb = {value(3, 16, 8) & 8'hff, 16'h0} | (value(4, 16, 8) & 8'hff) << 8 | value(5, 16, 8) & 8'hff;
      if (!drawn[pixel] || (FARTHEST != 0 ? new_z > z[pixel] : new_z < z[pixel])) begin
        drawn[pixel] = 1'b1;
        z[pixel] = new_z;
        rgb[pixel] = new_rgb;
      end
    end
  end endtask

  task clear; for (k = 0; k < 64; k = k + 1) begin
    drawn[k] = 1'b0;
    count[k] = 0;
    z[k] = 24'hffffff;
    rgb[k] = 0;
  end endtask

  always @(posedge clk)
    if (rst) begin
      tile = TILES - 1;
      triangle = 0;
      pixel = 0;
      writes = 1'b0;
      wr_valid <= 1'b0;
      done <= 1'b0;
      clear;
    end else if (!done) begin
      wr_valid <= 1'b0;
      if (!writes) begin
        try_pixel;
        pixel = pixel + 1;
        if (pixel == 64) begin
          pixel = 0;
          triangle = triangle + 1;
          if (triangle == COUNT) begin
            triangle = 0;
            pixel = 63;
            writes = 1'b1;
          end
        end
      end else begin
        wr_valid <= drawn[pixel];
        wr_addr <= ((tile / ACROSS) * 8 + pixel / 8) * WIDTH + (tile % ACROSS) * 8 + pixel % 8;
        wr_z <= z[pixel];
        wr_rgb <= rgb[pixel];
        wr_count <= count[pixel];
        pixel = pixel - 1;
        if (pixel < 0) begin
          pixel = 0;
          writes = 1'b0;
          clear;
          if (tile == 0) done <= 1'b1;
          tile = tile - 1;
        end
      end
    end
endmodule

// The bench: a frame store, printed at the end, a line a pixel.
module tb;
  parameter COUNT = 1, DEPTH_BITS = 24, FILL = 0, FARTHEST = 0, DROP = 0;
  reg clk = 1'b0, rst = 1'b1;
  wire wr_valid, done;
  wire [15:0] wr_addr;
  wire [23:0] wr_z, wr_rgb;
  wire [31:0] wr_count;
  tiles #(.COUNT(COUNT), .DEPTH_BITS(DEPTH_BITS), .FILL(FILL), .FARTHEST(FARTHEST)) dut (
    .clk(clk), .rst(rst), .wr_valid(wr_valid), .wr_addr(wr_addr), .wr_z(wr_z), .wr_rgb(wr_rgb), .wr_count(wr_count),
    .done(done)
  );
  reg [23:0] z [0:64*48-1], rgb [0:64*48-1];
  reg [31:0] count [0:64*48-1];
  integer i, written;
  initial begin
    $readmemh("triangles.mem", dut.words);
    for (i = 0; i < 64 * 48; i = i + 1) begin
      z[i] = 24'hffffff;
      rgb[i] = 0;
      count[i] = 0;
    end
    written = 0;
    #12 rst = 1'b0;
    wait (done);
    for (i = 0; i < 64 * 48; i = i + 1)
      $display("%0d %0d %0d %0d %0d", z[i], rgb[i][23:16], rgb[i][15:8], rgb[i][7:0], count[i]);
    $finish;
  end
  always #5 clk = !clk;
  always @(posedge clk) if (wr_valid) begin
    written = written + 1;
    if (DROP == 0 || written != DROP) begin
      z[wr_addr] <= wr_z;
      rgb[wr_addr] <= wr_rgb;
      count[wr_addr] <= wr_count;
    end
  end
endmodule
