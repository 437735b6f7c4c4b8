// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 7efc7d48fe81

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
// Hazard: a fragment takes its depth from the youngest older fragment that writes its pixel.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_depth (
  input  wire        clk,
  input  wire        rst,

  input  wire  [2:0] depth_func,   // new ? old: 0 never 1 less 2 equal 3 lequal 4 greater 5 notequal 6 gequal 7 always
  input  wire        depth_write,  // write depths of fragments that pass
  input  wire        frag_valid,
  input  wire [18:0] frag_addr,    // line * 2^10 + column
  input  wire [23:0] frag_z,       // unorm24, depth of the pixel
  input  wire  [7:0] frag_r,       // unorm8, red of the pixel
  input  wire  [7:0] frag_g,       // unorm8, green of the pixel
  input  wire  [7:0] frag_b,       // unorm8, blue of the pixel
  input  wire        frag_fence,   // older fragments of the same pixel may be in flight
  input  wire        rd_ready,
  input  wire        data_valid,
  input  wire [23:0] data_z,       // unorm24, old depth of the address read
  input  wire        wr_ready,

  output wire        frag_ready,
  output wire        rd_valid,
  output wire [18:0] rd_addr,      // line * 2^10 + column
  output wire        data_ready,
  output reg         wr_valid,     // w holds a pixel to write
  output reg  [18:0] wr_addr,      // line * 2^10 + column
  output reg  [23:0] wr_z,         // unorm24, depth of the pixel
  output reg         wr_z_en,      // 1: write the depth as well
  output reg   [7:0] wr_r,         // unorm8, red of the pixel
  output reg   [7:0] wr_g,         // unorm8, green of the pixel
  output reg   [7:0] wr_b,         // unorm8, blue of the pixel
  output wire        hazard,       // the offered fragment waits for one in flight, while frag_valid is 1
  output wire        full,         // the in-flight queue is full
  output wire        occupied      // a fragment is in flight
);

  // State: the queue of fragments that wait for their old depths, and the write register w.
  reg [2:0] count;          // fragments in flight
  reg [18:0] place0_addr;   // line * 2^10 + column
  reg [23:0] place0_z;      // unorm24, depth of the pixel
  reg [7:0] place0_r;       // unorm8, red of the pixel
  reg [7:0] place0_g;       // unorm8, green of the pixel
  reg [7:0] place0_b;       // unorm8, blue of the pixel
  reg place0_fwd_valid;     // an older fragment wrote this pixel
  reg [23:0] place0_fwd_z;  // depth from the youngest older fragment of this pixel
  reg place0_follows;       // same pixel as the fragment that left one cycle earlier
  wire place0_after_w = place0_follows && wr_valid && wr_z_en;
  reg [18:0] place1_addr;   // line * 2^10 + column
  reg [23:0] place1_z;      // unorm24, depth of the pixel
  reg [7:0] place1_r;       // unorm8, red of the pixel
  reg [7:0] place1_g;       // unorm8, green of the pixel
  reg [7:0] place1_b;       // unorm8, blue of the pixel
  reg place1_fwd_valid;     // an older fragment wrote this pixel
  reg [23:0] place1_fwd_z;  // depth from the youngest older fragment of this pixel
  reg place1_follows;       // same pixel as the fragment that left one cycle earlier
  wire place1_after_w = place1_follows && wr_valid && wr_z_en;
  reg [18:0] place2_addr;   // line * 2^10 + column
  reg [23:0] place2_z;      // unorm24, depth of the pixel
  reg [7:0] place2_r;       // unorm8, red of the pixel
  reg [7:0] place2_g;       // unorm8, green of the pixel
  reg [7:0] place2_b;       // unorm8, blue of the pixel
  reg place2_fwd_valid;     // an older fragment wrote this pixel
  reg [23:0] place2_fwd_z;  // depth from the youngest older fragment of this pixel
  reg place2_follows;       // same pixel as the fragment that left one cycle earlier
  wire place2_after_w = place2_follows && wr_valid && wr_z_en;
  reg [18:0] place3_addr;   // line * 2^10 + column
  reg [23:0] place3_z;      // unorm24, depth of the pixel
  reg [7:0] place3_r;       // unorm8, red of the pixel
  reg [7:0] place3_g;       // unorm8, green of the pixel
  reg [7:0] place3_b;       // unorm8, blue of the pixel
  reg place3_fwd_valid;     // an older fragment wrote this pixel
  reg [23:0] place3_fwd_z;  // depth from the youngest older fragment of this pixel

  // A fragment enters while the queue has room: its depth may still be in flight, as it is forwarded.
  assign full = count[2];
  assign hazard = 1'b0;
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
  wire [23:0] old = place0_fwd_valid ? place0_fwd_z : data_z;  // old depth of the head
  wire equal = place0_z == old;

  // w and the head were compared while w was loaded; here only the outcome is selected.
  wire next_less = place1_z < place0_z;
  wire next_equal = place1_z == place0_z;
  reg passes_w;  // outcome of the head against w
  wire if_less = place0_after_w ? passes_w : depth_func[0];  // the head passes if its depth is less
  wire if_not = place0_after_w ? passes_w : equal ? depth_func[1] : depth_func[2];  // the head passes if its depth is not less

  always @(posedge clk) begin
    passes_w <= next_less ? depth_func[0] : next_equal ? depth_func[1] : depth_func[2];
  end

  // pass = less ? if_less : if_not. The top bits of the difference make it, so no logic follows the carry.
  wire [25:0] outcome = {!if_less || if_not, if_less || if_not, place0_z}
                      - {1'b0, !(if_less && if_not), old};
  wire pass = outcome[25];

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
  wire place0_moves = goes || (count <= 3'd0);
  wire place0_has_next = count > 3'd1;
  wire place1_moves = goes || (count <= 3'd1);
  wire place1_has_next = count > 3'd2;
  wire place2_moves = goes || (count <= 3'd2);
  wire place2_has_next = count > 3'd3;
  wire place3_moves = goes || (count <= 3'd3);

  always @(posedge clk) begin
    if (rst) begin
      count <= 3'd0;
    end else begin
      if (push && !compare) count <= count + 3'd1;
      if (compare && !push) count <= count - 3'd1;
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
      place1_addr <= place1_has_next ? place2_addr : frag_addr;
      place1_z <= place1_has_next ? place2_z : frag_z;
      place1_r <= place1_has_next ? place2_r : frag_r;
      place1_g <= place1_has_next ? place2_g : frag_g;
      place1_b <= place1_has_next ? place2_b : frag_b;
    end
  end

  always @(posedge clk) begin
    if (place2_moves) begin
      place2_addr <= place2_has_next ? place3_addr : frag_addr;
      place2_z <= place2_has_next ? place3_z : frag_z;
      place2_r <= place2_has_next ? place3_r : frag_r;
      place2_g <= place2_has_next ? place3_g : frag_g;
      place2_b <= place2_has_next ? place3_b : frag_b;
    end
  end

  always @(posedge clk) begin
    if (place3_moves) begin
      place3_addr <= frag_addr;
      place3_z <= frag_z;
      place3_r <= frag_r;
      place3_g <= frag_g;
      place3_b <= frag_b;
    end
  end

  // Forward: a word on its way to memory goes to every queued fragment of its pixel.
  wire enters_after_w = wr_valid && wr_z_en && (wr_addr == frag_addr);

  always @(posedge clk) begin
    if (place0_after_w) begin
      place0_fwd_valid <= 1'b1;
      place0_fwd_z <= wr_z;
    end
    if (place0_moves) begin
      place0_fwd_valid <= place0_has_next ? place1_fwd_valid || place1_after_w : enters_after_w;
      place0_fwd_z <= (place0_has_next && !place1_after_w) ? place1_fwd_z : wr_z;
    end
  end

  always @(posedge clk) begin
    if (place1_after_w) begin
      place1_fwd_valid <= 1'b1;
      place1_fwd_z <= wr_z;
    end
    if (place1_moves) begin
      place1_fwd_valid <= place1_has_next ? place2_fwd_valid || place2_after_w : enters_after_w;
      place1_fwd_z <= (place1_has_next && !place2_after_w) ? place2_fwd_z : wr_z;
    end
  end

  always @(posedge clk) begin
    if (place2_after_w) begin
      place2_fwd_valid <= 1'b1;
      place2_fwd_z <= wr_z;
    end
    if (place2_moves) begin
      place2_fwd_valid <= place2_has_next ? place3_fwd_valid : enters_after_w;
      place2_fwd_z <= place2_has_next ? place3_fwd_z : wr_z;
    end
  end

  always @(posedge clk) begin
    if (place3_moves) begin
      place3_fwd_valid <= enters_after_w;
      place3_fwd_z <= wr_z;
    end
  end

  // The head reaches w one cycle later. Meanwhile each place compares its address with the head's.
  wire enters_after_head = frag_addr == place0_addr;
  wire place1_after_head = place1_addr == place0_addr;
  wire place2_after_head = place2_addr == place0_addr;
  wire place3_after_head = place3_addr == place0_addr;

  always @(posedge clk) begin
    place0_follows <= goes && (place0_has_next ? place1_after_head : enters_after_head);
    place1_follows <= goes && (place1_has_next ? place2_after_head : enters_after_head);
    place2_follows <= goes && (place2_has_next ? place3_after_head : enters_after_head);
  end

  assign rd_addr = frag_addr;
  assign occupied = (|count) || wr_valid;

  // Not needed, on purpose.
  wire unused = &{1'b0, frag_fence, outcome[24:0]};

endmodule

`default_nettype wire
