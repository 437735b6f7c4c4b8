// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 333c8cc6e2fc

// edgewalk_depth: DEPTH reads the old depth of every fragment, compares, and writes a fragment that passes.
//
//            ┌──────────────── rd (address) ──> depth memory
//   frag ────┴─> [in-flight queue] ─┬─ compare ─> [w] ── wr ──> depth and frame memory
//            depth memory ── data ──┘
//
// Formats: unsigned depths; depth_func 0 never, 1 less, 2 equal, 3 lequal, 4 greater, 5 notequal, 6 gequal, 7 always.
// Timing: the read leaves in the cycle in which a fragment enters. The compare takes place in the cycle in which the old
// depth arrives. The write follows one cycle later.
// Rules: depths arrive in the order of the reads. depth_func and depth_write are stable while the machine is busy.
// Every fragment reads, whatever the function.
// Hazard: a fragment with fence waits until no fragment is in flight.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_depth (
  input  wire        clk,
  input  wire        rst,

  input  wire  [2:0] depth_func,   // new ? old: 0 never 1 less 2 equal 3 lequal 4 greater 5 notequal 6 gequal 7 always
  input  wire        depth_write,  // write depths of fragments that pass
  input  wire        frag_valid,
  input  wire [15:0] frag_addr,    // line * 2^8 + column
  input  wire [15:0] frag_z,       // unorm16, depth of the pixel
  input  wire  [4:0] frag_r,       // unorm5, red of the pixel
  input  wire  [4:0] frag_g,       // unorm5, green of the pixel
  input  wire  [4:0] frag_b,       // unorm5, blue of the pixel
  input  wire        frag_fence,   // older fragments of the same pixel may be in flight
  input  wire        rd_ready,
  input  wire        data_valid,
  input  wire [15:0] data_z,       // unorm16, old depth of the address read
  input  wire        wr_ready,

  output wire        frag_ready,
  output wire        rd_valid,
  output wire [15:0] rd_addr,      // line * 2^8 + column
  output wire        data_ready,
  output reg         wr_valid,     // w holds a pixel to write
  output reg  [15:0] wr_addr,      // line * 2^8 + column
  output reg  [15:0] wr_z,         // unorm16, depth of the pixel
  output reg         wr_z_en,      // 1: write the depth as well
  output reg   [4:0] wr_r,         // unorm5, red of the pixel
  output reg   [4:0] wr_g,         // unorm5, green of the pixel
  output reg   [4:0] wr_b,         // unorm5, blue of the pixel
  output wire        hazard,       // the offered fragment waits for one in flight, while frag_valid is 1
  output wire        full,         // the in-flight queue is full
  output wire        occupied      // a fragment is in flight
);

  // State: the queue of fragments that wait for their old depths, and the write register w.
  reg [1:0] count;         // fragments in flight
  reg [15:0] place0_addr;  // line * 2^8 + column
  reg [15:0] place0_z;     // unorm16, depth of the pixel
  reg [4:0] place0_r;      // unorm5, red of the pixel
  reg [4:0] place0_g;      // unorm5, green of the pixel
  reg [4:0] place0_b;      // unorm5, blue of the pixel
  reg [15:0] place1_addr;  // line * 2^8 + column
  reg [15:0] place1_z;     // unorm16, depth of the pixel
  reg [4:0] place1_r;      // unorm5, red of the pixel
  reg [4:0] place1_g;      // unorm5, green of the pixel
  reg [4:0] place1_b;      // unorm5, blue of the pixel

  // A fragment enters while the queue has room and no fragment in flight may change its depth.
  assign full = count[1];
  assign hazard = frag_fence && ((|count) || wr_valid);
  wire clear_to_read = !full && !hazard;
  assign rd_valid = frag_valid && clear_to_read;
  assign frag_ready = rd_ready && clear_to_read;
  wire push = rd_valid && rd_ready;

  // Compare the head with its old depth when the depth arrives and w is free.
  wire w_free = !wr_valid || wr_ready;
  wire has_head = |count;
  wire goes = data_valid && w_free;  // the head leaves, if the queue holds one
  assign data_ready = has_head && w_free;
  wire compare = has_head && goes;
  wire [15:0] old = data_z;          // old depth of the head
  wire equal = place0_z == old;
  wire if_less = depth_func[0];      // the head passes if its depth is less
  wire if_not = equal ? depth_func[1] : depth_func[2];  // the head passes if its depth is not less

  // pass = less ? if_less : if_not. The top bits of the difference make it, so no logic follows the carry.
  wire [17:0] outcome = {!if_less || if_not, if_less || if_not, place0_z}
                      - {1'b0, !(if_less && if_not), old};
  wire pass = outcome[17];

  // Write a fragment that passes.
  always @(posedge clk) begin
    if (rst) begin
      wr_valid <= 1'b0;
    end else begin
      if (wr_ready) wr_valid <= 1'b0;
      if (compare) wr_valid <= pass;
    end
  end

  always @(posedge clk) begin
    if (w_free) begin
      wr_addr <= place0_addr;
      wr_z <= place0_z;
      wr_z_en <= depth_write;
      wr_r <= place0_r;
      wr_g <= place0_g;
      wr_b <= place0_b;
    end
  end

  // The queue moves up when its head leaves; a new fragment goes behind the last one.
  wire place0_moves = goes || (count <= 2'd0);
  wire place0_has_next = count > 2'd1;
  wire place1_moves = goes || (count <= 2'd1);

  always @(posedge clk) begin
    if (rst) begin
      count <= 2'd0;
    end else begin
      if (push && !compare) count <= count + 2'd1;
      if (compare && !push) count <= count - 2'd1;
    end
  end

  always @(posedge clk) begin
    if (place0_moves) begin
      place0_addr <= place0_has_next ? place1_addr : frag_addr;
      place0_z <= place0_has_next ? place1_z : frag_z;
      place0_r <= place0_has_next ? place1_r : frag_r;
      place0_g <= place0_has_next ? place1_g : frag_g;
      place0_b <= place0_has_next ? place1_b : frag_b;
    end
  end

  always @(posedge clk) begin
    if (place1_moves) begin
      place1_addr <= frag_addr;
      place1_z <= frag_z;
      place1_r <= frag_r;
      place1_g <= frag_g;
      place1_b <= frag_b;
    end
  end

  assign rd_addr = frag_addr;
  assign occupied = (|count) || wr_valid;

  // Not needed, on purpose.
  wire unused = &{1'b0, outcome[16:0]};

endmodule

`default_nettype wire
