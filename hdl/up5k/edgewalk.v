// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 6db543e8dccb

// edgewalk: EDGEWALK draws triangles, scan line by scan line.
//
//  in ─> SETUP ─prim─> EDGE ─line─> SPAN ─span─> PIXEL ─frag─> DEPTH ─wr─> frame memory
//                        └────────── inc ──────────┘             └─rd / data─ depth memory
//
// A link ─> has valid and ready: a token moves in a cycle where both are high. valid never waits for ready.
// A value drawn without valid is held until its reader has loaded it. One clock; rst is synchronous, active high.
// activity is the single cause of the cycle: 0 idle 1 draw 2 offscreen 3 hazard 4 queue 5 memory 6 edge 7 setup 8 flush.
// PIXEL steps in draw and offscreen, and stalls in hazard, queue and memory. In every other cause PIXEL has no pixel.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk (
  input  wire        clk,
  input  wire        rst,

  input  wire        in_valid,
  input  wire [15:0] in_data,      // 18 words a triangle, each in the low bits. Of vertex 0, 1, 2 in turn: x y (Q9.3 px), z (UQ16.0 LSB), r g b (UQ5.0 LSB)
  input  wire  [2:0] depth_func,   // new ? old: 0 never 1 less 2 equal 3 lequal 4 greater 5 notequal 6 gequal 7 always
  input  wire        depth_write,  // write depths of fragments that pass
  input  wire        rd_ready,
  input  wire        data_valid,
  input  wire [15:0] data_z,       // unorm16, old depth of the address read
  input  wire        wr_ready,

  output wire        in_ready,
  output wire        rd_valid,
  output wire [14:0] rd_addr,      // line * 2^8 + column
  output wire        data_ready,
  output wire        wr_valid,
  output wire [14:0] wr_addr,      // line * 2^8 + column
  output wire [15:0] wr_z,         // unorm16, depth of the pixel
  output wire        wr_z_en,      // 1: write the depth as well
  output wire  [4:0] wr_r,         // unorm5, red of the pixel
  output wire  [4:0] wr_g,         // unorm5, green of the pixel
  output wire  [4:0] wr_b,         // unorm5, blue of the pixel
  output wire  [3:0] activity,     // cause of the cycle
  output wire        idle          // no triangle, fragment or write is inside
);

  wire u_setup_prim_valid;
  wire u_edge_prim_ready;
  wire [6:0] u_setup_prim_jm;
  wire [7:0] u_setup_prim_n1;
  wire [7:0] u_setup_prim_n2;
  wire u_setup_prim_major_right;
  wire [9:0] u_setup_prim_major_c;
  wire [11:0] u_setup_prim_major_dist;
  wire [9:0] u_setup_prim_major_q;
  wire [11:0] u_setup_prim_major_f;
  wire [11:0] u_setup_prim_major_m;
  wire [9:0] u_setup_prim_minor1_c;
  wire [11:0] u_setup_prim_minor1_dist;
  wire [9:0] u_setup_prim_minor1_q;
  wire [11:0] u_setup_prim_minor1_f;
  wire [11:0] u_setup_prim_minor1_m;
  wire [9:0] u_setup_prim_minor2_c;
  wire [11:0] u_setup_prim_minor2_dist;
  wire [9:0] u_setup_prim_minor2_q;
  wire [11:0] u_setup_prim_minor2_f;
  wire [11:0] u_setup_prim_minor2_m;
  wire [25:0] u_setup_prim_z_start;
  wire [25:0] u_setup_prim_z_d0;
  wire [25:0] u_setup_prim_z_d1;
  wire [25:0] u_setup_prim_z_g;
  wire [14:0] u_setup_prim_r_start;
  wire [14:0] u_setup_prim_r_d0;
  wire [14:0] u_setup_prim_r_d1;
  wire [14:0] u_setup_prim_r_g;
  wire [14:0] u_setup_prim_g_start;
  wire [14:0] u_setup_prim_g_d0;
  wire [14:0] u_setup_prim_g_d1;
  wire [14:0] u_setup_prim_g_g;
  wire [14:0] u_setup_prim_b_start;
  wire [14:0] u_setup_prim_b_d0;
  wire [14:0] u_setup_prim_b_d1;
  wire [14:0] u_setup_prim_b_g;
  wire u_edge_line_valid;
  wire u_span_line_ready;
  wire [6:0] u_edge_line_y;
  wire [9:0] u_edge_line_cmaj;
  wire [9:0] u_edge_line_cmin;
  wire u_edge_line_major_right;
  wire [25:0] u_edge_line_z;
  wire [14:0] u_edge_line_r;
  wire [14:0] u_edge_line_g;
  wire [14:0] u_edge_line_b;
  wire u_edge_line_fresh;
  wire u_edge_line_fence;
  wire u_span_fresh_queued;
  wire u_span_span_valid;
  wire u_pixel_span_ready;
  wire [9:0] u_span_span_x;
  wire [6:0] u_span_span_y;
  wire [9:0] u_span_span_count;
  wire u_span_span_leftward;
  wire [25:0] u_span_span_z;
  wire [14:0] u_span_span_r;
  wire [14:0] u_span_span_g;
  wire [14:0] u_span_span_b;
  wire u_span_span_fresh;
  wire u_span_span_fence;
  wire [25:0] u_edge_inc_z;
  wire [14:0] u_edge_inc_r;
  wire [14:0] u_edge_inc_g;
  wire [14:0] u_edge_inc_b;

  edgewalk_edge u_edge (
    .clk              (clk),
    .rst              (rst),
    .prim_valid       (u_setup_prim_valid),
    .prim_jm          (u_setup_prim_jm),
    .prim_n1          (u_setup_prim_n1),
    .prim_n2          (u_setup_prim_n2),
    .prim_major_right (u_setup_prim_major_right),
    .prim_major_c     (u_setup_prim_major_c),
    .prim_major_dist  (u_setup_prim_major_dist),
    .prim_major_q     (u_setup_prim_major_q),
    .prim_major_f     (u_setup_prim_major_f),
    .prim_major_m     (u_setup_prim_major_m),
    .prim_minor1_c    (u_setup_prim_minor1_c),
    .prim_minor1_dist (u_setup_prim_minor1_dist),
    .prim_minor1_q    (u_setup_prim_minor1_q),
    .prim_minor1_f    (u_setup_prim_minor1_f),
    .prim_minor1_m    (u_setup_prim_minor1_m),
    .prim_minor2_c    (u_setup_prim_minor2_c),
    .prim_minor2_dist (u_setup_prim_minor2_dist),
    .prim_minor2_q    (u_setup_prim_minor2_q),
    .prim_minor2_f    (u_setup_prim_minor2_f),
    .prim_minor2_m    (u_setup_prim_minor2_m),
    .prim_z_start     (u_setup_prim_z_start),
    .prim_z_d0        (u_setup_prim_z_d0),
    .prim_z_d1        (u_setup_prim_z_d1),
    .prim_z_g         (u_setup_prim_z_g),
    .prim_r_start     (u_setup_prim_r_start),
    .prim_r_d0        (u_setup_prim_r_d0),
    .prim_r_d1        (u_setup_prim_r_d1),
    .prim_r_g         (u_setup_prim_r_g),
    .prim_g_start     (u_setup_prim_g_start),
    .prim_g_d0        (u_setup_prim_g_d0),
    .prim_g_d1        (u_setup_prim_g_d1),
    .prim_g_g         (u_setup_prim_g_g),
    .prim_b_start     (u_setup_prim_b_start),
    .prim_b_d0        (u_setup_prim_b_d0),
    .prim_b_d1        (u_setup_prim_b_d1),
    .prim_b_g         (u_setup_prim_b_g),
    .line_ready       (u_span_line_ready),
    .fresh_queued     (u_span_fresh_queued),
    .prim_ready       (u_edge_prim_ready),
    .line_valid       (u_edge_line_valid),
    .line_y           (u_edge_line_y),
    .line_cmaj        (u_edge_line_cmaj),
    .line_cmin        (u_edge_line_cmin),
    .line_major_right (u_edge_line_major_right),
    .line_z           (u_edge_line_z),
    .line_r           (u_edge_line_r),
    .line_g           (u_edge_line_g),
    .line_b           (u_edge_line_b),
    .line_fresh       (u_edge_line_fresh),
    .line_fence       (u_edge_line_fence),
    .inc_z            (u_edge_inc_z),
    .inc_r            (u_edge_inc_r),
    .inc_g            (u_edge_inc_g),
    .inc_b            (u_edge_inc_b)
  );

  wire u_pixel_frag_valid;
  wire u_depth_frag_ready;
  wire [14:0] u_pixel_frag_addr;
  wire [15:0] u_pixel_frag_z;
  wire [4:0] u_pixel_frag_r;
  wire [4:0] u_pixel_frag_g;
  wire [4:0] u_pixel_frag_b;
  wire u_pixel_frag_fence;

  // Cause of the cycle.
  localparam [3:0] DRAW = 4'd1;
  localparam [3:0] OFFSCREEN = 4'd2;
  localparam [3:0] HAZARD = 4'd3;
  localparam [3:0] QUEUE = 4'd4;
  localparam [3:0] MEMORY = 4'd5;
  localparam [3:0] EDGE = 4'd6;
  localparam [3:0] SETUP = 4'd7;
  localparam [3:0] FLUSH = 4'd8;
  localparam [3:0] IDLE = 4'd0;
  wire u_pixel_advance;
  wire u_pixel_occupied;
  wire u_depth_occupied;
  wire u_depth_hazard;
  wire u_depth_full;
  wire u_setup_in_ready;

  edgewalk_setup u_setup (
    .clk              (clk),
    .rst              (rst),
    .in_valid         (in_valid),
    .in_data          (in_data),
    .prim_ready       (u_edge_prim_ready),
    .in_ready         (u_setup_in_ready),
    .prim_valid       (u_setup_prim_valid),
    .prim_jm          (u_setup_prim_jm),
    .prim_n1          (u_setup_prim_n1),
    .prim_n2          (u_setup_prim_n2),
    .prim_major_right (u_setup_prim_major_right),
    .prim_major_c     (u_setup_prim_major_c),
    .prim_major_dist  (u_setup_prim_major_dist),
    .prim_major_q     (u_setup_prim_major_q),
    .prim_major_f     (u_setup_prim_major_f),
    .prim_major_m     (u_setup_prim_major_m),
    .prim_minor1_c    (u_setup_prim_minor1_c),
    .prim_minor1_dist (u_setup_prim_minor1_dist),
    .prim_minor1_q    (u_setup_prim_minor1_q),
    .prim_minor1_f    (u_setup_prim_minor1_f),
    .prim_minor1_m    (u_setup_prim_minor1_m),
    .prim_minor2_c    (u_setup_prim_minor2_c),
    .prim_minor2_dist (u_setup_prim_minor2_dist),
    .prim_minor2_q    (u_setup_prim_minor2_q),
    .prim_minor2_f    (u_setup_prim_minor2_f),
    .prim_minor2_m    (u_setup_prim_minor2_m),
    .prim_z_start     (u_setup_prim_z_start),
    .prim_z_d0        (u_setup_prim_z_d0),
    .prim_z_d1        (u_setup_prim_z_d1),
    .prim_z_g         (u_setup_prim_z_g),
    .prim_r_start     (u_setup_prim_r_start),
    .prim_r_d0        (u_setup_prim_r_d0),
    .prim_r_d1        (u_setup_prim_r_d1),
    .prim_r_g         (u_setup_prim_r_g),
    .prim_g_start     (u_setup_prim_g_start),
    .prim_g_d0        (u_setup_prim_g_d0),
    .prim_g_d1        (u_setup_prim_g_d1),
    .prim_g_g         (u_setup_prim_g_g),
    .prim_b_start     (u_setup_prim_b_start),
    .prim_b_d0        (u_setup_prim_b_d0),
    .prim_b_d1        (u_setup_prim_b_d1),
    .prim_b_g         (u_setup_prim_b_g)
  );

  wire u_span_line_held;

  edgewalk_span u_span (
    .clk              (clk),
    .rst              (rst),
    .line_valid       (u_edge_line_valid),
    .line_y           (u_edge_line_y),
    .line_cmaj        (u_edge_line_cmaj),
    .line_cmin        (u_edge_line_cmin),
    .line_major_right (u_edge_line_major_right),
    .line_z           (u_edge_line_z),
    .line_r           (u_edge_line_r),
    .line_g           (u_edge_line_g),
    .line_b           (u_edge_line_b),
    .line_fresh       (u_edge_line_fresh),
    .line_fence       (u_edge_line_fence),
    .span_ready       (u_pixel_span_ready),
    .line_ready       (u_span_line_ready),
    .span_valid       (u_span_span_valid),
    .span_x           (u_span_span_x),
    .span_y           (u_span_span_y),
    .span_count       (u_span_span_count),
    .span_leftward    (u_span_span_leftward),
    .span_z           (u_span_span_z),
    .span_r           (u_span_span_r),
    .span_g           (u_span_span_g),
    .span_b           (u_span_span_b),
    .span_fresh       (u_span_span_fresh),
    .span_fence       (u_span_span_fence),
    .fresh_queued     (u_span_fresh_queued),
    .line_held        (u_span_line_held)
  );

  wire u_pixel_visible;
  wire u_pixel_active;

  edgewalk_pixel u_pixel (
    .clk           (clk),
    .rst           (rst),
    .span_valid    (u_span_span_valid),
    .span_x        (u_span_span_x),
    .span_y        (u_span_span_y),
    .span_count    (u_span_span_count),
    .span_leftward (u_span_span_leftward),
    .span_z        (u_span_span_z),
    .span_r        (u_span_span_r),
    .span_g        (u_span_span_g),
    .span_b        (u_span_span_b),
    .span_fresh    (u_span_span_fresh),
    .span_fence    (u_span_span_fence),
    .inc_z         (u_edge_inc_z),
    .inc_r         (u_edge_inc_r),
    .inc_g         (u_edge_inc_g),
    .inc_b         (u_edge_inc_b),
    .frag_ready    (u_depth_frag_ready),
    .span_ready    (u_pixel_span_ready),
    .frag_valid    (u_pixel_frag_valid),
    .frag_addr     (u_pixel_frag_addr),
    .frag_z        (u_pixel_frag_z),
    .frag_r        (u_pixel_frag_r),
    .frag_g        (u_pixel_frag_g),
    .frag_b        (u_pixel_frag_b),
    .frag_fence    (u_pixel_frag_fence),
    .active        (u_pixel_active),
    .visible       (u_pixel_visible),
    .advance       (u_pixel_advance),
    .occupied      (u_pixel_occupied)
  );

  wire [3:0] choice = u_pixel_active ? (u_pixel_visible ? DRAW : OFFSCREEN)
                    : (u_span_span_valid || u_span_line_held || u_edge_line_valid) ? EDGE
                    : !u_setup_in_ready ? SETUP
                    : (u_pixel_occupied || u_depth_occupied) ? FLUSH
                    : IDLE;
  assign activity = u_pixel_advance ? choice
                  : u_depth_hazard ? HAZARD
                  : u_depth_full ? QUEUE
                  : MEMORY;
  wire u_depth_rd_valid;
  wire [14:0] u_depth_rd_addr;
  wire u_depth_data_ready;
  wire u_depth_wr_valid;
  wire [14:0] u_depth_wr_addr;
  wire [15:0] u_depth_wr_z;
  wire u_depth_wr_z_en;
  wire [4:0] u_depth_wr_r;
  wire [4:0] u_depth_wr_g;
  wire [4:0] u_depth_wr_b;

  edgewalk_depth u_depth (
    .clk         (clk),
    .rst         (rst),
    .depth_func  (depth_func),
    .depth_write (depth_write),
    .frag_valid  (u_pixel_frag_valid),
    .frag_addr   (u_pixel_frag_addr),
    .frag_z      (u_pixel_frag_z),
    .frag_r      (u_pixel_frag_r),
    .frag_g      (u_pixel_frag_g),
    .frag_b      (u_pixel_frag_b),
    .frag_fence  (u_pixel_frag_fence),
    .rd_ready    (rd_ready),
    .data_valid  (data_valid),
    .data_z      (data_z),
    .wr_ready    (wr_ready),
    .frag_ready  (u_depth_frag_ready),
    .rd_valid    (u_depth_rd_valid),
    .rd_addr     (u_depth_rd_addr),
    .data_ready  (u_depth_data_ready),
    .wr_valid    (u_depth_wr_valid),
    .wr_addr     (u_depth_wr_addr),
    .wr_z        (u_depth_wr_z),
    .wr_z_en     (u_depth_wr_z_en),
    .wr_r        (u_depth_wr_r),
    .wr_g        (u_depth_wr_g),
    .wr_b        (u_depth_wr_b),
    .hazard      (u_depth_hazard),
    .full        (u_depth_full),
    .occupied    (u_depth_occupied)
  );

  assign in_ready = u_setup_in_ready;
  assign rd_valid = u_depth_rd_valid;
  assign rd_addr = u_depth_rd_addr;
  assign data_ready = u_depth_data_ready;
  assign wr_valid = u_depth_wr_valid;
  assign wr_addr = u_depth_wr_addr;
  assign wr_z = u_depth_wr_z;
  assign wr_z_en = u_depth_wr_z_en;
  assign wr_r = u_depth_wr_r;
  assign wr_g = u_depth_wr_g;
  assign wr_b = u_depth_wr_b;
  assign idle = activity == 4'd0;

endmodule

`default_nettype wire
