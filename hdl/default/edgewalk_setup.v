// edgewalk_setup: SETUP turns three vertices into edges and increments.
//
//   tri ─> [sort by v] ─┬─> lines j0 j1 n1 n2 ────────────────────────────┐
//                       ├─> area ─> major_right, cull?                    ├─> prim
//                       ├─> three edges: q f = DX/DY, C R = N/DY ─────────┤
//                       └─> N channels: increments and start ─────────────┘
//             the products and quotients are formed in serial lanes, side by side or in rounds
//
// Formats: see the ports; P = 2^t is a pixel in centre coordinates.
// Timing: three clocks to sort, then for each round of the lanes three operations on edges; if the triangle draws
// anything, for each round the operations on channels, and one clock to store. prim_valid is high from the next on.
// Rules: all results are those of exact division, rounded once; a word keeps its low bits.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_setup (
  input  wire        clk,
  input  wire        rst,

  input  wire        tri_valid,
  input  wire [21:0] tri_x0,            // Q14.8 px
  input  wire [21:0] tri_y0,            // Q14.8 px
  input  wire [27:0] tri_z0,            // UQ24.4 LSB
  input  wire [11:0] tri_r0,            // UQ8.4 LSB
  input  wire [11:0] tri_g0,            // UQ8.4 LSB
  input  wire [11:0] tri_b0,            // UQ8.4 LSB
  input  wire [21:0] tri_x1,            // Q14.8 px
  input  wire [21:0] tri_y1,            // Q14.8 px
  input  wire [27:0] tri_z1,            // UQ24.4 LSB
  input  wire [11:0] tri_r1,            // UQ8.4 LSB
  input  wire [11:0] tri_g1,            // UQ8.4 LSB
  input  wire [11:0] tri_b1,            // UQ8.4 LSB
  input  wire [21:0] tri_x2,            // Q14.8 px
  input  wire [21:0] tri_y2,            // Q14.8 px
  input  wire [27:0] tri_z2,            // UQ24.4 LSB
  input  wire [11:0] tri_r2,            // UQ8.4 LSB
  input  wire [11:0] tri_g2,            // UQ8.4 LSB
  input  wire [11:0] tri_b2,            // UQ8.4 LSB
  input  wire        prim_ready,

  output wire        tri_ready,
  output wire        prim_valid,
  output wire  [8:0] prim_jm,           // first line
  output reg   [9:0] prim_n1,           // lines of the upper part
  output reg   [9:0] prim_n2,           // lines of the lower part
  output reg         prim_major_right,  // the major edge is the right one
  output reg  [14:0] prim_major_c,      // signed, first column right of the edge
  output reg  [21:0] prim_major_r,      // distance from the edge to that column, 1/M column
  output reg  [14:0] prim_major_q,      // signed, whole columns a line
  output reg  [21:0] prim_major_f,      // 1/M column a line
  output wire [21:0] prim_major_m,      // modulus of r and f: the edge's height, 1/P line
  output reg  [14:0] prim_minor1_c,     // signed, first column right of the edge
  output reg  [21:0] prim_minor1_r,     // distance from the edge to that column, 1/M column
  output reg  [14:0] prim_minor1_q,     // signed, whole columns a line
  output reg  [21:0] prim_minor1_f,     // 1/M column a line
  output wire [21:0] prim_minor1_m,     // modulus of r and f: the edge's height, 1/P line
  output reg  [14:0] prim_minor2_c,     // signed, first column right of the edge
  output reg  [21:0] prim_minor2_r,     // distance from the edge to that column, 1/M column
  output reg  [14:0] prim_minor2_q,     // signed, whole columns a line
  output reg  [21:0] prim_minor2_f,     // 1/M column a line
  output wire [21:0] prim_minor2_m,     // modulus of r and f: the edge's height, 1/P line
  output reg  [37:0] prim_z_start,      // UQ24.14 LSB, modular, at the first pixel of the first line
  output reg  [37:0] prim_z_d0,         // UQ24.14 LSB, modular, to the next line, edge without carry
  output reg  [37:0] prim_z_d1,         // UQ24.14 LSB, modular, to the next line, edge with carry
  output reg  [37:0] prim_z_g,          // UQ24.14 LSB, modular, to the next pixel of the span
  output reg  [21:0] prim_r_start,      // UQ8.14 LSB, modular, at the first pixel of the first line
  output reg  [21:0] prim_r_d0,         // UQ8.14 LSB, modular, to the next line, edge without carry
  output reg  [21:0] prim_r_d1,         // UQ8.14 LSB, modular, to the next line, edge with carry
  output reg  [21:0] prim_r_g,          // UQ8.14 LSB, modular, to the next pixel of the span
  output reg  [21:0] prim_g_start,      // UQ8.14 LSB, modular, at the first pixel of the first line
  output reg  [21:0] prim_g_d0,         // UQ8.14 LSB, modular, to the next line, edge without carry
  output reg  [21:0] prim_g_d1,         // UQ8.14 LSB, modular, to the next line, edge with carry
  output reg  [21:0] prim_g_g,          // UQ8.14 LSB, modular, to the next pixel of the span
  output reg  [21:0] prim_b_start,      // UQ8.14 LSB, modular, at the first pixel of the first line
  output reg  [21:0] prim_b_d0,         // UQ8.14 LSB, modular, to the next line, edge without carry
  output reg  [21:0] prim_b_d1,         // UQ8.14 LSB, modular, to the next line, edge with carry
  output reg  [21:0] prim_b_g           // UQ8.14 LSB, modular, to the next pixel of the span
);

  // Control. Sorting takes three clocks; an operation takes one to load, then k bits a clock.
  localparam [2:0] IDLE = 3'd0;
  localparam [2:0] SORT = 3'd1;
  localparam [2:0] EDGES = 3'd2;
  localparam [2:0] CHANNELS = 3'd3;
  localparam [2:0] STORE = 3'd4;
  localparam [2:0] DONE = 3'd5;
  localparam [3:0] EDGE_STEP = 4'd0;
  localparam [3:0] EDGE_PRODUCT = 4'd1;
  localparam [3:0] EDGE_START = 4'd2;
  localparam [3:0] NX = 4'd3;
  localparam [3:0] GX = 4'd4;
  localparam [3:0] NY = 4'd5;
  localparam [3:0] LINE_PRODUCT = 4'd6;
  localparam [3:0] LINE = 4'd7;
  localparam [3:0] START_PRODUCT = 4'd8;
  localparam [3:0] START = 4'd9;
  wire cull;                           // no area, or no line on the screen
  reg [2:0] state;
  assign tri_ready = state == IDLE;
  wire take = tri_valid && tri_ready;
  wire sorting = state == SORT;
  wire in_edges = state == EDGES;
  wire working = in_edges || (state == CHANNELS);
  assign prim_valid = state == DONE;
  reg [5:0] step;                      // clock of the operation; 0 loads
  reg [3:0] op;                        // operation of the lanes
  wire load = working && (step == 6'd0);
  wire stepping = working && (|step);
  wire is_edge_step = op == EDGE_STEP;
  wire is_edge_product = op == EDGE_PRODUCT;
  wire is_edge_start = op == EDGE_START;
  wire is_nx = op == NX;
  wire is_gx = op == GX;
  wire is_ny = op == NY;
  wire is_line_product = op == LINE_PRODUCT;
  wire is_line = op == LINE;
  wire is_start_product = op == START_PRODUCT;
  wire is_start = op == START;
  wire [5:0] steps = is_start ? 6'd42  // clocks of the operation after the one that loads
                   : is_line ? 6'd42
                   : is_gx ? 6'd35
                   : is_edge_start ? 6'd19
                   : is_edge_step ? 6'd11
                   : 6'd12;
  wire last_step = working && (step == steps);
  wire edges_end = last_step && (op == EDGE_START);
  wire channels_end = last_step && (op == START);
  wire sorted = sorting && (step == 6'd2);

  always @(posedge clk) begin
    if (rst) begin
      state <= IDLE;
    end else begin
      if (take) state <= SORT;
      if (sorted) state <= EDGES;
      if (edges_end) state <= cull ? IDLE : CHANNELS;
      if (channels_end) state <= STORE;
      if (state == STORE) state <= DONE;
      if (prim_valid && prim_ready) state <= IDLE;
    end
  end

  always @(posedge clk) begin
    if (sorting || working) step <= step + 6'd1;
    if (take || sorted || last_step) step <= 6'd0;
  end

  always @(posedge clk) begin
    if (last_step) op <= op + 4'd1;
    if (edges_end) op <= NX;
    if (channels_end) op <= NX;
    if (take) op <= EDGE_STEP;
  end

  // Quotients are taken in the clock after the last step.
  reg finished;           // an operation ended
  reg [3:0] finished_op;  // which
  wire edge_step_done = finished && (finished_op == EDGE_STEP);
  wire edge_start_done = finished && (finished_op == EDGE_START);
  wire gx_done = finished && (finished_op == GX);
  wire line_done = finished && (finished_op == LINE);
  wire start_done = finished && (finished_op == START);

  always @(posedge clk) begin
    if (rst) begin
      finished <= 1'b0;
    end else begin
      finished <= last_step;
    end
  end

  always @(posedge clk) begin
    finished_op <= op;
  end

  // The vertices, in centre coordinates: pixel centres lie on the multiples of P.
  reg [21:0] p0_u;  // Q14.8, signed
  reg [21:0] p0_v;  // Q14.8, signed
  reg [27:0] p0_z;  // UQ24.4 LSB
  reg [11:0] p0_r;  // UQ8.4 LSB
  reg [11:0] p0_g;  // UQ8.4 LSB
  reg [11:0] p0_b;  // UQ8.4 LSB
  reg [21:0] p1_u;  // Q14.8, signed
  reg [21:0] p1_v;  // Q14.8, signed
  reg [27:0] p1_z;  // UQ24.4 LSB
  reg [11:0] p1_r;  // UQ8.4 LSB
  reg [11:0] p1_g;  // UQ8.4 LSB
  reg [11:0] p1_b;  // UQ8.4 LSB
  reg [21:0] p2_u;  // Q14.8, signed
  reg [21:0] p2_v;  // Q14.8, signed
  reg [27:0] p2_z;  // UQ24.4 LSB
  reg [11:0] p2_r;  // UQ8.4 LSB
  reg [11:0] p2_g;  // UQ8.4 LSB
  reg [11:0] p2_b;  // UQ8.4 LSB
  wire second_clock = step == 6'd1;
  wire swap01 = sorting && !second_clock && ($signed(p1_v) < $signed(p0_v));
  wire swap12 = sorting && second_clock && ($signed(p2_v) < $signed(p1_v));

  always @(posedge clk) begin
    if (swap01) begin
      p0_u <= p1_u;
      p0_v <= p1_v;
      p0_z <= p1_z;
      p0_r <= p1_r;
      p0_g <= p1_g;
      p0_b <= p1_b;
    end
    if (take) begin
      p0_u <= tri_x0 - 22'd128;
      p0_v <= tri_y0 - 22'd128;
      p0_z <= tri_z0;
      p0_r <= tri_r0;
      p0_g <= tri_g0;
      p0_b <= tri_b0;
    end
  end

  always @(posedge clk) begin
    if (swap01) begin
      p1_u <= p0_u;
      p1_v <= p0_v;
      p1_z <= p0_z;
      p1_r <= p0_r;
      p1_g <= p0_g;
      p1_b <= p0_b;
    end
    if (swap12) begin
      p1_u <= p2_u;
      p1_v <= p2_v;
      p1_z <= p2_z;
      p1_r <= p2_r;
      p1_g <= p2_g;
      p1_b <= p2_b;
    end
    if (take) begin
      p1_u <= tri_x1 - 22'd128;
      p1_v <= tri_y1 - 22'd128;
      p1_z <= tri_z1;
      p1_r <= tri_r1;
      p1_g <= tri_g1;
      p1_b <= tri_b1;
    end
  end

  always @(posedge clk) begin
    if (swap12) begin
      p2_u <= p1_u;
      p2_v <= p1_v;
      p2_z <= p1_z;
      p2_r <= p1_r;
      p2_g <= p1_g;
      p2_b <= p1_b;
    end
    if (take) begin
      p2_u <= tri_x2 - 22'd128;
      p2_v <= tri_y2 - 22'd128;
      p2_z <= tri_z2;
      p2_r <= tri_r2;
      p2_g <= tri_g2;
      p2_b <= tri_b2;
    end
  end

  // Differences of the sorted vertices.
  wire [22:0] difference = {p2_v[21], p2_v} - {p0_v[21], p0_v};
  wire [21:0] dv02 = difference[21:0];    // 1/P line
  wire [22:0] difference_2 = {p1_v[21], p1_v} - {p0_v[21], p0_v};
  wire [21:0] dv01 = difference_2[21:0];  // 1/P line
  wire [22:0] difference_3 = {p2_v[21], p2_v} - {p1_v[21], p1_v};
  wire [21:0] dv12 = difference_3[21:0];  // 1/P line
  wire [22:0] du01 = {p1_u[21], p1_u} - {p0_u[21], p0_u};  // 1/P column, signed
  wire [22:0] du02 = {p2_u[21], p2_u} - {p0_u[21], p0_u};  // 1/P column, signed

  // Lines: from ceil(v/P) of the upper to before ceil(v/P) of the lower end, on the screen.
  wire [13:0] part = p0_v[21:8];
  wire [14:0] line0 = {part[13], part} + {14'd0, |p0_v[7:0]};  // ceil(v/P)
  wire [14:0] j0_next = ($signed(line0) < 15'sd0) ? 15'd0 : line0;
  wire [13:0] part_2 = p2_v[21:8];
  wire [14:0] line2 = {part_2[13], part_2} + {14'd0, |p2_v[7:0]};  // ceil(v/P)
  wire [14:0] choice = ($signed(line2) < 15'sd480) ? line2 : 15'd480;
  wire [14:0] end_line = ($signed(choice) < $signed(j0_next)) ? j0_next : choice;
  wire [13:0] part_3 = p1_v[21:8];
  wire [14:0] line1 = {part_3[13], part_3} + {14'd0, |p1_v[7:0]};  // ceil(v/P)
  wire [14:0] choice_2 = ($signed(line1) < $signed(j0_next)) ? j0_next : line1;
  wire [14:0] j1_next = ($signed(choice_2) < $signed(end_line)) ? choice_2 : end_line;
  wire take_lines = load && is_edge_step;
  reg [14:0] j0;                     // line, signed
  reg [14:0] j1;                     // line, signed
  wire upper = |prim_n1;
  wire [14:0] jm = upper ? j0 : j1;  // first line of the triangle
  wire [14:0] difference_4 = j1_next - j0_next;
  wire [14:0] difference_5 = end_line - j1_next;

  always @(posedge clk) begin
    if (take_lines) begin
      prim_n1 <= difference_4[9:0];
      prim_n2 <= difference_5[9:0];
      j0 <= j0_next;
      j1 <= j1_next;
    end
  end

  // What all lanes do.
  wire is_product = is_edge_product || is_nx || is_ny || is_line_product || is_start_product;
  wire is_quotient = is_edge_start || is_gx || is_line || is_start;
  wire is_quotient_of_y = is_edge_step;
  wire load_terms = load && (is_edge_product || is_nx || is_ny);
  wire load_product = load && is_product;
  wire step_product = stepping && is_product;
  wire first_step = step == 6'd1;
  wire load_quotient = load && is_quotient;
  wire load_quotient_of_y = load && is_quotient_of_y;
  wire step_quotient = stepping && (is_quotient || is_quotient_of_y);

  // Twice the area of the triangle, and the side on which it lies.
  wire [74:0] lane0_product;
  wire take_area = load && is_edge_start;
  reg [44:0] area;  // |du1 dv2 - du2 dv1|
  assign cull = !(|area) || (!upper && !(|prim_n2));
  wire [45:0] part_4 = lane0_product[45:0];
  wire [45:0] choice_3 = part_4[45] ? -part_4 : part_4;

  always @(posedge clk) begin
    if (take_area) begin
      area <= choice_3[44:0];
      prim_major_right <= part_4[45];
    end
  end

  // Factors and divisor of the operations on channels, the same for all lanes.
  wire [14:0] px = prim_major_c - {14'd0, prim_major_right};  // column of the first pixel, signed
  wire [22:0] channel_a = is_start_product ? {px, 8'd0} - {p0_u[21], p0_u}  // signed
                        : is_line_product ? {{8{prim_major_q[14]}}, prim_major_q}
                        : is_nx ? {1'b0, dv02}
                        : du02;
  wire [22:0] channel_b = is_start_product ? {jm, 8'd0} - {p0_v[21], p0_v}  // signed
                        : is_line_product ? 23'd1
                        : is_nx ? {1'b0, dv01}
                        : du01;
  wire flip = prim_major_right ^ is_ny;  // differences of channels the other way round

  // Lane 0.
  wire [28:0] lane0_x_edge = {{7{p1_u[21]}}, p1_u} - {{7{p0_u[21]}}, p0_u};
  wire [28:0] lane0_y_edge = {{7{p0_u[21]}}, p0_u} - {{7{p2_u[21]}}, p2_u};
  wire [28:0] lane0_x_channel = (flip ? {1'b0, p0_z} : {1'b0, p1_z})
                              - (flip ? {1'b0, p1_z} : {1'b0, p0_z});
  wire [28:0] lane0_y_channel = (flip ? {1'b0, p2_z} : {1'b0, p0_z})
                              - (flip ? {1'b0, p0_z} : {1'b0, p2_z});
  wire [37:0] lane0_rounded;
  wire [37:0] lane0_d1;
  wire [37:0] lane0_quotient_unused;
  wire [44:0] lane0_remainder_unused;

  edgewalk_setup_lane0 lane0 (
    .clk            (clk),
    .load_divisor   (load_quotient),
    .from_y         (load_quotient_of_y),
    .y_in           (in_edges ? lane0_y_edge : lane0_y_channel),
    .step_quotient  (step_quotient),
    .a_in           (in_edges ? {1'b0, dv02} : channel_a),
    .b_in           (in_edges ? {1'b0, dv01} : channel_b),
    .x_in           (in_edges ? lane0_x_edge : lane0_x_channel),
    .load_terms     (load_terms),
    .load_factors   (load_product),
    .step_product   (step_product),
    .first_step     (first_step),
    .divisor_in     (in_edges ? {23'd0, dv02} : area),
    .digit_at       (is_start ? 2'd2 : is_line ? 2'd1 : 2'd0),
    .keep_nx        (load && is_gx),
    .load_gradients (load && is_line_product),
    .keep_gx        (gx_done),
    .add_line       (line_done),
    .product        (lane0_product),
    .quotient       (lane0_quotient_unused),
    .remainder      (lane0_remainder_unused),
    .rounded        (lane0_rounded),
    .d1             (lane0_d1)
  );

  // Lane 1.
  wire [22:0] lane1_x_edge = {p0_v[21], p0_v} - {p2_v[21], p2_v};
  wire [21:0] choice_4 = is_edge_step ? p2_u : p0_u;
  wire [21:0] choice_5 = is_edge_step ? p0_u : p2_u;
  wire [22:0] lane1_y_edge = {choice_4[21], choice_4} - {choice_5[21], choice_5};
  wire [22:0] lane1_x_channel = (flip ? {11'd0, p0_r} : {11'd0, p1_r})
                              - (flip ? {11'd0, p1_r} : {11'd0, p0_r});
  wire [22:0] lane1_y_channel = (flip ? {11'd0, p2_r} : {11'd0, p0_r})
                              - (flip ? {11'd0, p0_r} : {11'd0, p2_r});
  wire [21:0] lane1_quotient;
  wire [44:0] lane1_remainder;
  wire [21:0] lane1_rounded;
  wire [21:0] lane1_d1;
  wire [58:0] lane1_product_unused;

  edgewalk_setup_lane1 lane1 (
    .clk            (clk),
    .load_divisor   (load_quotient),
    .from_y         (load_quotient_of_y),
    .y_in           (in_edges ? lane1_y_edge : lane1_y_channel),
    .step_quotient  (step_quotient && (in_edges || (step > 6'd8))),
    .a_in           (in_edges ? {p0_u[21], p0_u} : channel_a),
    .b_in           (in_edges ? {jm, 8'd0} - {p0_v[21], p0_v} : channel_b),
    .x_in           (in_edges ? lane1_x_edge : lane1_x_channel),
    .load_terms     (load_terms),
    .load_factors   (load_product),
    .step_product   (step_product),
    .first_step     (first_step),
    .divisor_in     (in_edges ? {23'd0, dv02} : area),
    .digit_at       (is_start ? 3'd4 : is_line ? 3'd3 : is_gx ? 3'd1 : is_edge_start ? 3'd2 : 3'd0),
    .keep_nx        (load && is_gx),
    .load_gradients (load && is_line_product),
    .keep_gx        (gx_done),
    .add_line       (line_done),
    .product        (lane1_product_unused),
    .quotient       (lane1_quotient),
    .remainder      (lane1_remainder),
    .rounded        (lane1_rounded),
    .d1             (lane1_d1)
  );

  // Lane 2.
  wire [22:0] lane2_x_edge = {p0_v[21], p0_v} - {p1_v[21], p1_v};
  wire [21:0] choice_6 = is_edge_step ? p1_u : p0_u;
  wire [21:0] choice_7 = is_edge_step ? p0_u : p1_u;
  wire [22:0] lane2_y_edge = {choice_6[21], choice_6} - {choice_7[21], choice_7};
  wire [22:0] lane2_x_channel = (flip ? {11'd0, p0_g} : {11'd0, p1_g})
                              - (flip ? {11'd0, p1_g} : {11'd0, p0_g});
  wire [22:0] lane2_y_channel = (flip ? {11'd0, p2_g} : {11'd0, p0_g})
                              - (flip ? {11'd0, p0_g} : {11'd0, p2_g});
  wire [21:0] lane2_quotient;
  wire [44:0] lane2_remainder;
  wire [21:0] lane2_rounded;
  wire [21:0] lane2_d1;
  wire [58:0] lane2_product_unused;

  edgewalk_setup_lane1 lane2 (
    .clk            (clk),
    .load_divisor   (load_quotient),
    .from_y         (load_quotient_of_y),
    .y_in           (in_edges ? lane2_y_edge : lane2_y_channel),
    .step_quotient  (step_quotient && (in_edges || (step > 6'd8))),
    .a_in           (in_edges ? {p0_u[21], p0_u} : channel_a),
    .b_in           (in_edges ? {j0, 8'd0} - {p0_v[21], p0_v} : channel_b),
    .x_in           (in_edges ? lane2_x_edge : lane2_x_channel),
    .load_terms     (load_terms),
    .load_factors   (load_product),
    .step_product   (step_product),
    .first_step     (first_step),
    .divisor_in     (in_edges ? {23'd0, dv01} : area),
    .digit_at       (is_start ? 3'd4 : is_line ? 3'd3 : is_gx ? 3'd1 : is_edge_start ? 3'd2 : 3'd0),
    .keep_nx        (load && is_gx),
    .load_gradients (load && is_line_product),
    .keep_gx        (gx_done),
    .add_line       (line_done),
    .product        (lane2_product_unused),
    .quotient       (lane2_quotient),
    .remainder      (lane2_remainder),
    .rounded        (lane2_rounded),
    .d1             (lane2_d1)
  );

  // Lane 3.
  wire [22:0] lane3_x_edge = {p1_v[21], p1_v} - {p2_v[21], p2_v};
  wire [21:0] choice_8 = is_edge_step ? p2_u : p1_u;
  wire [21:0] choice_9 = is_edge_step ? p1_u : p2_u;
  wire [22:0] lane3_y_edge = {choice_8[21], choice_8} - {choice_9[21], choice_9};
  wire [22:0] lane3_x_channel = (flip ? {11'd0, p0_b} : {11'd0, p1_b})
                              - (flip ? {11'd0, p1_b} : {11'd0, p0_b});
  wire [22:0] lane3_y_channel = (flip ? {11'd0, p2_b} : {11'd0, p0_b})
                              - (flip ? {11'd0, p0_b} : {11'd0, p2_b});
  wire [21:0] lane3_quotient;
  wire [44:0] lane3_remainder;
  wire [21:0] lane3_rounded;
  wire [21:0] lane3_d1;
  wire [58:0] lane3_product_unused;

  edgewalk_setup_lane1 lane3 (
    .clk            (clk),
    .load_divisor   (load_quotient),
    .from_y         (load_quotient_of_y),
    .y_in           (in_edges ? lane3_y_edge : lane3_y_channel),
    .step_quotient  (step_quotient && (in_edges || (step > 6'd8))),
    .a_in           (in_edges ? {p1_u[21], p1_u} : channel_a),
    .b_in           (in_edges ? {j1, 8'd0} - {p1_v[21], p1_v} : channel_b),
    .x_in           (in_edges ? lane3_x_edge : lane3_x_channel),
    .load_terms     (load_terms),
    .load_factors   (load_product),
    .step_product   (step_product),
    .first_step     (first_step),
    .divisor_in     (in_edges ? {23'd0, dv12} : area),
    .digit_at       (is_start ? 3'd4 : is_line ? 3'd3 : is_gx ? 3'd1 : is_edge_start ? 3'd2 : 3'd0),
    .keep_nx        (load && is_gx),
    .load_gradients (load && is_line_product),
    .keep_gx        (gx_done),
    .add_line       (line_done),
    .product        (lane3_product_unused),
    .quotient       (lane3_quotient),
    .remainder      (lane3_remainder),
    .rounded        (lane3_rounded),
    .d1             (lane3_d1)
  );

  // Edge: major.
  wire major_steps = |dv02[21:8];  // DY >= P
  wire major_is_there = |dv02;     // DY > 0

  always @(posedge clk) begin
    if (edge_step_done) begin
      prim_major_q <= major_steps ? lane1_quotient[14:0] : 15'd0;
      prim_major_f <= major_steps ? lane1_remainder[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (edge_start_done) begin
      prim_major_c <= major_is_there ? -lane1_quotient[14:0] : 15'd0;
      prim_major_r <= major_is_there ? lane1_remainder[21:0] : 22'd0;
    end
  end

  // Edge: minor1.
  wire minor1_steps = |dv01[21:8];  // DY >= P
  wire minor1_is_there = |dv01;     // DY > 0

  always @(posedge clk) begin
    if (edge_step_done) begin
      prim_minor1_q <= minor1_steps ? lane2_quotient[14:0] : 15'd0;
      prim_minor1_f <= minor1_steps ? lane2_remainder[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (edge_start_done) begin
      prim_minor1_c <= minor1_is_there ? -lane2_quotient[14:0] : 15'd0;
      prim_minor1_r <= minor1_is_there ? lane2_remainder[21:0] : 22'd0;
    end
  end

  // Edge: minor2.
  wire minor2_steps = |dv12[21:8];  // DY >= P
  wire minor2_is_there = |dv12;     // DY > 0

  always @(posedge clk) begin
    if (edge_step_done) begin
      prim_minor2_q <= minor2_steps ? lane3_quotient[14:0] : 15'd0;
      prim_minor2_f <= minor2_steps ? lane3_remainder[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (edge_start_done) begin
      prim_minor2_c <= minor2_is_there ? -lane3_quotient[14:0] : 15'd0;
      prim_minor2_r <= minor2_is_there ? lane3_remainder[21:0] : 22'd0;
    end
  end

  // Channel: z.
  always @(posedge clk) begin
    if (gx_done) prim_z_g <= prim_major_right ? -lane0_rounded : lane0_rounded;
  end

  always @(posedge clk) begin
    if (line_done) prim_z_d0 <= lane0_rounded;
  end

  always @(posedge clk) begin
    if (start_done) begin
      prim_z_d1 <= lane0_d1;
      prim_z_start <= lane0_rounded + {p0_z + 28'd8, 10'd0};
    end
  end

  // Channel: r.
  always @(posedge clk) begin
    if (gx_done) prim_r_g <= prim_major_right ? -lane1_rounded : lane1_rounded;
  end

  always @(posedge clk) begin
    if (line_done) prim_r_d0 <= lane1_rounded;
  end

  always @(posedge clk) begin
    if (start_done) begin
      prim_r_d1 <= lane1_d1;
      prim_r_start <= lane1_rounded + {p0_r + 12'd8, 10'd0};
    end
  end

  // Channel: g.
  always @(posedge clk) begin
    if (gx_done) prim_g_g <= prim_major_right ? -lane2_rounded : lane2_rounded;
  end

  always @(posedge clk) begin
    if (line_done) prim_g_d0 <= lane2_rounded;
  end

  always @(posedge clk) begin
    if (start_done) begin
      prim_g_d1 <= lane2_d1;
      prim_g_start <= lane2_rounded + {p0_g + 12'd8, 10'd0};
    end
  end

  // Channel: b.
  always @(posedge clk) begin
    if (gx_done) prim_b_g <= prim_major_right ? -lane3_rounded : lane3_rounded;
  end

  always @(posedge clk) begin
    if (line_done) prim_b_d0 <= lane3_rounded;
  end

  always @(posedge clk) begin
    if (start_done) begin
      prim_b_d1 <= lane3_d1;
      prim_b_start <= lane3_rounded + {p0_b + 12'd8, 10'd0};
    end
  end

  assign prim_jm = jm[8:0];
  assign prim_major_m = dv02;
  assign prim_minor1_m = dv01;
  assign prim_minor2_m = dv12;

  // Not needed, on purpose.
  wire unused = &{
    1'b0, lane0_product[74:46], lane1_quotient[21:15], lane1_remainder[44:22], lane2_quotient[21:15],
    lane2_remainder[44:22], lane3_quotient[21:15], lane3_remainder[44:22], difference[22],
    difference_2[22], difference_3[22], difference_4[14:10], difference_5[14:10], choice_3[45]
  };

endmodule

`default_nettype wire
