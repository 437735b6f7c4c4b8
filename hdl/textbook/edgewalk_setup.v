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
  input  wire [13:0] tri_x0,            // Q14.0 px
  input  wire [13:0] tri_y0,            // Q14.0 px
  input  wire [15:0] tri_z0,            // UQ16.0 LSB
  input  wire  [7:0] tri_r0,            // UQ8.0 LSB
  input  wire  [7:0] tri_g0,            // UQ8.0 LSB
  input  wire  [7:0] tri_b0,            // UQ8.0 LSB
  input  wire [13:0] tri_x1,            // Q14.0 px
  input  wire [13:0] tri_y1,            // Q14.0 px
  input  wire [15:0] tri_z1,            // UQ16.0 LSB
  input  wire  [7:0] tri_r1,            // UQ8.0 LSB
  input  wire  [7:0] tri_g1,            // UQ8.0 LSB
  input  wire  [7:0] tri_b1,            // UQ8.0 LSB
  input  wire [13:0] tri_x2,            // Q14.0 px
  input  wire [13:0] tri_y2,            // Q14.0 px
  input  wire [15:0] tri_z2,            // UQ16.0 LSB
  input  wire  [7:0] tri_r2,            // UQ8.0 LSB
  input  wire  [7:0] tri_g2,            // UQ8.0 LSB
  input  wire  [7:0] tri_b2,            // UQ8.0 LSB
  input  wire        prim_ready,

  output wire        tri_ready,
  output wire        prim_valid,
  output wire  [8:0] prim_jm,           // first line
  output reg   [9:0] prim_n1,           // lines of the upper part
  output reg   [9:0] prim_n2,           // lines of the lower part
  output reg         prim_major_right,  // the major edge is the right one
  output reg  [14:0] prim_major_c,      // signed, first column right of the edge
  output reg  [15:0] prim_major_r,      // distance from the edge to that column, 2^-F column
  output reg  [14:0] prim_major_q,      // signed, whole columns a line
  output reg  [15:0] prim_major_f,      // 2^-F column a line
  output reg  [14:0] prim_minor1_c,     // signed, first column right of the edge
  output reg  [15:0] prim_minor1_r,     // distance from the edge to that column, 2^-F column
  output reg  [14:0] prim_minor1_q,     // signed, whole columns a line
  output reg  [15:0] prim_minor1_f,     // 2^-F column a line
  output reg  [14:0] prim_minor2_c,     // signed, first column right of the edge
  output reg  [15:0] prim_minor2_r,     // distance from the edge to that column, 2^-F column
  output reg  [14:0] prim_minor2_q,     // signed, whole columns a line
  output reg  [15:0] prim_minor2_f,     // 2^-F column a line
  output reg  [29:0] prim_z_start_a,    // UQ16.14 LSB, modular, on the left edge, first line of part 1
  output reg  [29:0] prim_z_d_a,        // UQ16.14 LSB, modular, to the next line, part 1
  output reg  [29:0] prim_z_start_b,    // UQ16.14 LSB, modular, on the left edge, first line of part 2
  output reg  [29:0] prim_z_d_b,        // UQ16.14 LSB, modular, to the next line, part 2
  output reg  [29:0] prim_z_g,          // UQ16.14 LSB, modular, to the next pixel of the span
  output reg  [21:0] prim_r_start_a,    // UQ8.14 LSB, modular, on the left edge, first line of part 1
  output reg  [21:0] prim_r_d_a,        // UQ8.14 LSB, modular, to the next line, part 1
  output reg  [21:0] prim_r_start_b,    // UQ8.14 LSB, modular, on the left edge, first line of part 2
  output reg  [21:0] prim_r_d_b,        // UQ8.14 LSB, modular, to the next line, part 2
  output reg  [21:0] prim_r_g,          // UQ8.14 LSB, modular, to the next pixel of the span
  output reg  [21:0] prim_g_start_a,    // UQ8.14 LSB, modular, on the left edge, first line of part 1
  output reg  [21:0] prim_g_d_a,        // UQ8.14 LSB, modular, to the next line, part 1
  output reg  [21:0] prim_g_start_b,    // UQ8.14 LSB, modular, on the left edge, first line of part 2
  output reg  [21:0] prim_g_d_b,        // UQ8.14 LSB, modular, to the next line, part 2
  output reg  [21:0] prim_g_g,          // UQ8.14 LSB, modular, to the next pixel of the span
  output reg  [21:0] prim_b_start_a,    // UQ8.14 LSB, modular, on the left edge, first line of part 1
  output reg  [21:0] prim_b_d_a,        // UQ8.14 LSB, modular, to the next line, part 1
  output reg  [21:0] prim_b_start_b,    // UQ8.14 LSB, modular, on the left edge, first line of part 2
  output reg  [21:0] prim_b_d_b,        // UQ8.14 LSB, modular, to the next line, part 2
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
  localparam [3:0] PRODUCT_A = 4'd5;
  localparam [3:0] START_A = 4'd6;
  localparam [3:0] LINE_A = 4'd7;
  localparam [3:0] PRODUCT_B = 4'd8;
  localparam [3:0] START_B = 4'd9;
  localparam [3:0] LINE_B = 4'd10;
  wire cull;                            // no area, or no line on the screen
  reg [2:0] state;
  assign tri_ready = state == IDLE;
  wire take = tri_valid && tri_ready;
  wire sorting = state == SORT;
  wire in_edges = state == EDGES;
  wire working = in_edges || (state == CHANNELS);
  assign prim_valid = state == DONE;
  reg [5:0] step;                       // clock of the operation; 0 loads
  reg [3:0] op;                         // operation of the lanes
  reg [1:0] round;                      // of the jobs the lanes do in turn
  wire load = working && (step == 6'd0);
  wire stepping = working && (|step);
  wire is_edge_step = op == EDGE_STEP;
  wire is_edge_product = op == EDGE_PRODUCT;
  wire is_edge_start = op == EDGE_START;
  wire is_nx = op == NX;
  wire is_gx = op == GX;
  wire is_product_a = op == PRODUCT_A;
  wire is_start_a = op == START_A;
  wire is_line_a = op == LINE_A;
  wire is_product_b = op == PRODUCT_B;
  wire is_start_b = op == START_B;
  wire is_line_b = op == LINE_B;
  wire [5:0] steps = is_line_b ? 6'd47  // clocks of the operation after the one that loads
                   : is_start_b ? 6'd47
                   : is_line_a ? 6'd47
                   : is_start_a ? 6'd47
                   : is_gx ? 6'd47
                   : is_edge_start ? 6'd47
                   : is_edge_step ? 6'd31
                   : 6'd16;
  wire last_step = working && (step == steps);
  wire edges_end = last_step && (op == EDGE_START);
  wire channels_end = last_step && (op == LINE_B);
  wire sorted = sorting && (step == 6'd2);
  wire equal = round == 2'd3;

  always @(posedge clk) begin
    if (rst) begin
      state <= IDLE;
    end else begin
      if (take) state <= SORT;
      if (sorted) state <= EDGES;
      if (edges_end && equal) state <= cull ? IDLE : CHANNELS;
      if (channels_end && equal) state <= STORE;
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
    if (edges_end) op <= equal ? NX : EDGE_STEP;
    if (channels_end) op <= NX;
    if (take) op <= EDGE_STEP;
  end

  always @(posedge clk) begin
    if (edges_end || channels_end) round <= round + 2'd1;
    if (take) round <= 2'd0;
  end

  // Quotients are taken in the clock after the last step.
  reg finished;              // an operation ended
  reg [3:0] finished_op;     // which
  reg [1:0] finished_round;  // of the jobs the lanes do in turn
  wire edge_step_done = finished && (finished_op == EDGE_STEP);
  wire edge_start_done = finished && (finished_op == EDGE_START);
  wire gx_done = finished && (finished_op == GX);
  wire start_a_done = finished && (finished_op == START_A);
  wire line_a_done = finished && (finished_op == LINE_A);
  wire start_b_done = finished && (finished_op == START_B);
  wire line_b_done = finished && (finished_op == LINE_B);

  always @(posedge clk) begin
    if (rst) begin
      finished <= 1'b0;
    end else begin
      finished <= last_step;
    end
  end

  always @(posedge clk) begin
    finished_op <= op;
    finished_round <= round;
  end

  // The vertices, in centre coordinates: pixel centres lie on the multiples of P.
  reg [14:0] p0_u;  // Q14.1, signed
  reg [14:0] p0_v;  // Q14.1, signed
  reg [15:0] p0_z;  // UQ16.0 LSB
  reg [7:0] p0_r;   // UQ8.0 LSB
  reg [7:0] p0_g;   // UQ8.0 LSB
  reg [7:0] p0_b;   // UQ8.0 LSB
  reg [14:0] p1_u;  // Q14.1, signed
  reg [14:0] p1_v;  // Q14.1, signed
  reg [15:0] p1_z;  // UQ16.0 LSB
  reg [7:0] p1_r;   // UQ8.0 LSB
  reg [7:0] p1_g;   // UQ8.0 LSB
  reg [7:0] p1_b;   // UQ8.0 LSB
  reg [14:0] p2_u;  // Q14.1, signed
  reg [14:0] p2_v;  // Q14.1, signed
  reg [15:0] p2_z;  // UQ16.0 LSB
  reg [7:0] p2_r;   // UQ8.0 LSB
  reg [7:0] p2_g;   // UQ8.0 LSB
  reg [7:0] p2_b;   // UQ8.0 LSB
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
      p0_u <= {tri_x0, 1'b0};
      p0_v <= {tri_y0, 1'b0};
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
      p1_u <= {tri_x1, 1'b0};
      p1_v <= {tri_y1, 1'b0};
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
      p2_u <= {tri_x2, 1'b0};
      p2_v <= {tri_y2, 1'b0};
      p2_z <= tri_z2;
      p2_r <= tri_r2;
      p2_g <= tri_g2;
      p2_b <= tri_b2;
    end
  end

  // Differences of the sorted vertices.
  wire [15:0] difference = {p2_v[14], p2_v} - {p0_v[14], p0_v};
  wire [14:0] dv02 = difference[14:0];    // 1/P line
  wire [15:0] difference_2 = {p1_v[14], p1_v} - {p0_v[14], p0_v};
  wire [14:0] dv01 = difference_2[14:0];  // 1/P line
  wire [15:0] difference_3 = {p2_v[14], p2_v} - {p1_v[14], p1_v};
  wire [14:0] dv12 = difference_3[14:0];  // 1/P line
  wire [15:0] du01 = {p1_u[14], p1_u} - {p0_u[14], p0_u};  // 1/P column, signed
  wire [15:0] du02 = {p2_u[14], p2_u} - {p0_u[14], p0_u};  // 1/P column, signed

  // Lines of each part: from Y of the upper to Y of the lower end, both drawn, on the screen.
  wire [13:0] part = p0_v[14:1];
  wire [14:0] extended = {part[13], part};
  wire [14:0] j0_next = ($signed(extended) < 15'sd0) ? 15'd0 : extended;
  wire [13:0] part_2 = p1_v[14:1];
  wire [14:0] extended_2 = {part_2[13], part_2};
  wire [14:0] j1_next = ($signed(extended_2) < 15'sd0) ? 15'd0 : extended_2;
  wire [13:0] part_3 = p1_v[14:1];
  wire [14:0] extended_3 = {part_3[13], part_3};
  wire [14:0] last0 = ($signed(extended_3) < 15'sd479) ? extended_3 : 15'd479;
  wire [13:0] part_4 = p0_v[14:1];
  wire [13:0] part_5 = p1_v[14:1];
  wire some0 = ($signed({part_4[13], part_4}) < $signed({part_5[13], part_5}))
            && ($signed(j0_next) <= $signed(last0));
  wire [13:0] part_6 = p2_v[14:1];
  wire [14:0] extended_4 = {part_6[13], part_6};
  wire [14:0] last1 = ($signed(extended_4) < 15'sd479) ? extended_4 : 15'd479;
  wire [13:0] part_7 = p1_v[14:1];
  wire [13:0] part_8 = p2_v[14:1];
  wire some1 = ($signed({part_7[13], part_7}) < $signed({part_8[13], part_8}))
            && ($signed(j1_next) <= $signed(last1));
  wire take_lines = load && is_edge_step;
  reg [14:0] j0;                     // line, signed
  reg [14:0] j1;                     // line, signed
  wire upper = |prim_n1;
  wire [14:0] jm = upper ? j0 : j1;  // first line of the triangle
  wire [14:0] choice = some0 ? last0 - j0_next + 15'd1 : 15'd0;
  wire [14:0] choice_2 = some1 ? last1 - j1_next + 15'd1 : 15'd0;

  always @(posedge clk) begin
    if (take_lines) begin
      prim_n1 <= choice[9:0];
      prim_n2 <= choice_2[9:0];
      j0 <= j0_next;
      j1 <= j1_next;
    end
  end

  // What all lanes do.
  wire is_product = is_edge_product || is_nx || is_product_a || is_product_b;
  wire is_quotient = is_edge_start || is_gx || is_start_a || is_start_b;
  wire is_quotient_of_y = is_edge_step || is_line_a || is_line_b;
  wire load_terms = load && (is_edge_product || is_nx || is_product_a || is_product_b);
  wire load_product = load && is_product;
  wire step_product = stepping && is_product;
  wire first_step = step == 6'd1;
  wire load_quotient = load && is_quotient;
  wire load_quotient_of_y = load && is_quotient_of_y;
  wire step_quotient = stepping && (is_quotient || is_quotient_of_y);

  // Twice the area of the triangle, and the side on which it lies.
  wire [32:0] lane0_product;
  wire take_area = load && is_edge_start && (round == 2'd0);
  reg [30:0] area;  // |du1 dv2 - du2 dv1|
  assign cull = !(|area) || (!upper && !(|prim_n2));
  wire [31:0] part_9 = lane0_product[31:0];
  wire [31:0] choice_3 = part_9[31] ? -part_9 : part_9;

  always @(posedge clk) begin
    if (take_area) begin
      area <= choice_3[30:0];
      prim_major_right <= part_9[31];
    end
  end

  // Factors and divisor of the operations on channels, the same for all lanes.
  wire in_b = is_product_b || is_start_b || is_line_b;  // part 2
  wire [15:0] channel_a = is_nx ? {1'b0, dv02} : 16'd0;  // signed
  wire [14:0] choice_4 = (in_b && prim_major_right) ? p1_v : p0_v;
  wire [15:0] channel_b = is_nx ? {1'b0, dv01} : {in_b ? j1 : j0, 1'b0} - {choice_4[14], choice_4};  // signed
  wire flip = prim_major_right;  // differences of channels the other way round

  // Lane 0.
  wire [16:0] lane0_x_edge = (round == 2'd3) ? {{2{p2_v[14]}}, p2_v} - {{2{p1_v[14]}}, p1_v}
                           : (round == 2'd2) ? {{2{p1_v[14]}}, p1_v} - {{2{p0_v[14]}}, p0_v}
                           : (round == 2'd1) ? {{2{p2_v[14]}}, p2_v} - {{2{p0_v[14]}}, p0_v}
                           : {{2{p1_u[14]}}, p1_u} - {{2{p0_u[14]}}, p0_u};
  wire [16:0] lane0_y_edge = (round == 2'd3) ? {{2{p2_u[14]}}, p2_u} - {{2{p1_u[14]}}, p1_u}
                           : (round == 2'd2) ? {{2{p1_u[14]}}, p1_u} - {{2{p0_u[14]}}, p0_u}
                           : (round == 2'd1) ? {{2{p2_u[14]}}, p2_u} - {{2{p0_u[14]}}, p0_u}
                           : {{2{p0_u[14]}}, p0_u} - {{2{p2_u[14]}}, p2_u};
  wire [16:0] difference_4 = (flip ? {9'd0, p0_b} : {9'd0, p1_b})
                           - (flip ? {9'd0, p1_b} : {9'd0, p0_b});
  wire [16:0] difference_5 = (flip ? {9'd0, p0_g} : {9'd0, p1_g})
                           - (flip ? {9'd0, p1_g} : {9'd0, p0_g});
  wire [16:0] difference_6 = (flip ? {9'd0, p0_r} : {9'd0, p1_r})
                           - (flip ? {9'd0, p1_r} : {9'd0, p0_r});
  wire [16:0] difference_7 = (flip ? {1'b0, p0_z} : {1'b0, p1_z})
                           - (flip ? {1'b0, p1_z} : {1'b0, p0_z});
  wire [16:0] lane0_x_channel = (round == 2'd3) ? difference_4
                              : (round == 2'd2) ? difference_5
                              : (round == 2'd1) ? difference_6
                              : difference_7;
  wire either = is_product_b || is_line_b;
  wire [16:0] choice_5 = is_nx ? (flip ? {9'd0, p2_b} : {9'd0, p0_b})
                       : (prim_major_right && !either) ? {9'd0, p1_b}
                       : {9'd0, p2_b};
  wire [16:0] choice_6 = is_nx ? (flip ? {9'd0, p0_b} : {9'd0, p2_b})
                       : (prim_major_right && either) ? {9'd0, p1_b}
                       : {9'd0, p0_b};
  wire either_2 = is_product_b || is_line_b;
  wire [16:0] choice_7 = is_nx ? (flip ? {9'd0, p2_g} : {9'd0, p0_g})
                       : (prim_major_right && !either_2) ? {9'd0, p1_g}
                       : {9'd0, p2_g};
  wire [16:0] choice_8 = is_nx ? (flip ? {9'd0, p0_g} : {9'd0, p2_g})
                       : (prim_major_right && either_2) ? {9'd0, p1_g}
                       : {9'd0, p0_g};
  wire either_3 = is_product_b || is_line_b;
  wire [16:0] choice_9 = is_nx ? (flip ? {9'd0, p2_r} : {9'd0, p0_r})
                       : (prim_major_right && !either_3) ? {9'd0, p1_r}
                       : {9'd0, p2_r};
  wire [16:0] choice_10 = is_nx ? (flip ? {9'd0, p0_r} : {9'd0, p2_r})
                        : (prim_major_right && either_3) ? {9'd0, p1_r}
                        : {9'd0, p0_r};
  wire either_4 = is_product_b || is_line_b;
  wire [16:0] choice_11 = is_nx ? (flip ? {1'b0, p2_z} : {1'b0, p0_z})
                        : (prim_major_right && !either_4) ? {1'b0, p1_z}
                        : {1'b0, p2_z};
  wire [16:0] choice_12 = is_nx ? (flip ? {1'b0, p0_z} : {1'b0, p2_z})
                        : (prim_major_right && either_4) ? {1'b0, p1_z}
                        : {1'b0, p0_z};
  wire [16:0] lane0_y_channel = (round == 2'd3) ? choice_5 - choice_6
                              : (round == 2'd2) ? choice_7 - choice_8
                              : (round == 2'd1) ? choice_9 - choice_10
                              : choice_11 - choice_12;
  wire [30:0] lane0_rounded;
  wire choice_13 = (round == 2'd3) ? step > 6'd8
                 : (round == 2'd2) ? step > 6'd8
                 : (round == 2'd1) ? step > 6'd8
                 : step > 6'd0;
  wire [14:0] joined = {p1_u[14:1], 1'b1};
  wire [14:0] joined_2 = {p0_u[14:1], 1'b1};
  wire [14:0] joined_3 = {p0_u[14:1], 1'b1};
  wire [15:0] choice_14 = (round == 2'd3) ? {joined[14], joined}
                        : (round == 2'd2) ? {joined_2[14], joined_2}
                        : (round == 2'd1) ? {joined_3[14], joined_3}
                        : {1'b0, dv02};
  wire [15:0] choice_15 = (round == 2'd3) ? {j1, 1'b0} - {p1_v[14], p1_v}
                        : (round == 2'd2) ? {j0, 1'b0} - {p0_v[14], p0_v}
                        : (round == 2'd1) ? {jm, 1'b0} - {p0_v[14], p0_v}
                        : {1'b0, dv01};
  wire [30:0] choice_16 = (round == 2'd3) ? (is_edge_start ? {16'd0, dv12} << 1 : {16'd0, dv12})
                        : (round == 2'd2) ? (is_edge_start ? {16'd0, dv01} << 1 : {16'd0, dv01})
                        : (round == 2'd1) ? (is_edge_start ? {16'd0, dv02} << 1 : {16'd0, dv02})
                        : is_edge_start ? {16'd0, dv02} << 1
                        : {16'd0, dv02};
  wire [30:0] part_10 = is_gx ? area : {16'd0, prim_major_right ? (in_b ? dv12 : dv01) : dv02};
  wire [2:0] choice_17 = (round == 2'd3) ? 3'd1
                       : (round == 2'd2) ? 3'd1
                       : (round == 2'd1) ? 3'd1
                       : 3'd4;
  wire [2:0] choice_18 = (round == 2'd3) ? 3'd2
                       : (round == 2'd2) ? 3'd2
                       : (round == 2'd1) ? 3'd2
                       : 3'd5;
  wire [2:0] choice_19 = (round == 2'd3) ? 3'd1
                       : (round == 2'd2) ? 3'd1
                       : (round == 2'd1) ? 3'd1
                       : 3'd4;
  wire [2:0] choice_20 = (round == 2'd3) ? 3'd2
                       : (round == 2'd2) ? 3'd2
                       : (round == 2'd1) ? 3'd2
                       : 3'd5;
  wire [2:0] choice_21 = (round == 2'd3) ? 3'd1
                       : (round == 2'd2) ? 3'd1
                       : (round == 2'd1) ? 3'd1
                       : 3'd4;
  wire [2:0] choice_22 = (round == 2'd3) ? 3'd3
                       : (round == 2'd2) ? 3'd3
                       : (round == 2'd1) ? 3'd3
                       : 3'd3;
  wire [30:0] lane0_quotient_unused;
  wire [30:0] lane0_remainder_unused;

  edgewalk_setup_lane0 lane0 (
    .clk           (clk),
    .load_divisor  (load_quotient),
    .from_y        (load_quotient_of_y),
    .y_in          (in_edges ? lane0_y_edge : lane0_y_channel),
    .step_quotient (step_quotient && (in_edges || choice_13)),
    .a_in          (in_edges ? choice_14 : channel_a),
    .b_in          (in_edges ? choice_15 : channel_b),
    .x_in          (in_edges ? lane0_x_edge : lane0_x_channel),
    .load_terms    (load_terms),
    .load_factors  (load_product),
    .step_product  (step_product),
    .first_step    (first_step),
    .divisor_in    (in_edges ? choice_16 : part_10),
    .digit_at      (is_line_b ? choice_17
: is_start_b ? choice_18
: is_line_a ? choice_19
: is_start_a ? choice_20
: is_gx ? choice_21
: is_edge_start ? choice_22
: 3'd0),
    .product       (lane0_product),
    .quotient      (lane0_quotient_unused),
    .remainder     (lane0_remainder_unused),
    .rounded       (lane0_rounded)
  );

  // Edge: major.
  wire major_steps = |dv02[14:1];  // DY >= P
  wire major_is_there = |dv02;     // DY > 0
  wire [30:0] part_11 = lane0_rounded;

  always @(posedge clk) begin
    if (edge_step_done && (finished_round == 2'd1)) begin
      prim_major_q <= major_steps ? part_11[30:16] : 15'd0;
      prim_major_f <= major_steps ? part_11[15:0] : 16'd0;
    end
  end

  wire [30:0] inverse = ~part_11;

  always @(posedge clk) begin
    if (edge_start_done && (finished_round == 2'd1)) begin
      prim_major_c <= major_is_there ? -inverse[30:16] : 15'd0;
      prim_major_r <= major_is_there ? inverse[15:0] : 16'd0;
    end
  end

  // Edge: minor1.
  wire minor1_steps = |dv01[14:1];  // DY >= P
  wire minor1_is_there = |dv01;     // DY > 0
  wire [30:0] part_12 = lane0_rounded;

  always @(posedge clk) begin
    if (edge_step_done && (finished_round == 2'd2)) begin
      prim_minor1_q <= minor1_steps ? part_12[30:16] : 15'd0;
      prim_minor1_f <= minor1_steps ? part_12[15:0] : 16'd0;
    end
  end

  wire [30:0] inverse_2 = ~part_12;

  always @(posedge clk) begin
    if (edge_start_done && (finished_round == 2'd2)) begin
      prim_minor1_c <= minor1_is_there ? -inverse_2[30:16] : 15'd0;
      prim_minor1_r <= minor1_is_there ? inverse_2[15:0] : 16'd0;
    end
  end

  // Edge: minor2.
  wire minor2_steps = |dv12[14:1];  // DY >= P
  wire minor2_is_there = |dv12;     // DY > 0
  wire [30:0] part_13 = lane0_rounded;

  always @(posedge clk) begin
    if (edge_step_done && (finished_round == 2'd3)) begin
      prim_minor2_q <= minor2_steps ? part_13[30:16] : 15'd0;
      prim_minor2_f <= minor2_steps ? part_13[15:0] : 16'd0;
    end
  end

  wire [30:0] inverse_3 = ~part_13;

  always @(posedge clk) begin
    if (edge_start_done && (finished_round == 2'd3)) begin
      prim_minor2_c <= minor2_is_there ? -inverse_3[30:16] : 15'd0;
      prim_minor2_r <= minor2_is_there ? inverse_3[15:0] : 16'd0;
    end
  end

  // Channel: z.
  always @(posedge clk) begin
    if (gx_done && (finished_round == 2'd0)) prim_z_g <= lane0_rounded[29:0];
  end

  always @(posedge clk) begin
    if (start_a_done && (finished_round == 2'd0)) begin
      prim_z_start_a <= (|prim_n1) ? lane0_rounded[29:0] + {{p0_z, 1'b1}, 13'd0} : 30'd0;
    end
  end

  wire [29:0] sum = lane0_rounded[29:0]
                  + (prim_major_right ? {{p1_z, 1'b1}, 13'd0} : {{p0_z, 1'b1}, 13'd0});

  always @(posedge clk) begin
    if (start_b_done && (finished_round == 2'd0)) prim_z_start_b <= (|prim_n2) ? sum : 30'd0;
  end

  always @(posedge clk) begin
    if (line_a_done && (finished_round == 2'd0)) begin
      prim_z_d_a <= (|prim_n1) ? lane0_rounded[29:0] : 30'd0;
    end
  end

  always @(posedge clk) begin
    if (line_b_done && (finished_round == 2'd0)) begin
      prim_z_d_b <= (|prim_n2) ? lane0_rounded[29:0] : 30'd0;
    end
  end

  // Channel: r.
  always @(posedge clk) begin
    if (gx_done && (finished_round == 2'd1)) prim_r_g <= lane0_rounded[21:0];
  end

  always @(posedge clk) begin
    if (start_a_done && (finished_round == 2'd1)) begin
      prim_r_start_a <= (|prim_n1) ? lane0_rounded[21:0] + {{p0_r, 1'b1}, 13'd0} : 22'd0;
    end
  end

  wire [21:0] sum_2 = lane0_rounded[21:0]
                    + (prim_major_right ? {{p1_r, 1'b1}, 13'd0} : {{p0_r, 1'b1}, 13'd0});

  always @(posedge clk) begin
    if (start_b_done && (finished_round == 2'd1)) prim_r_start_b <= (|prim_n2) ? sum_2 : 22'd0;
  end

  always @(posedge clk) begin
    if (line_a_done && (finished_round == 2'd1)) begin
      prim_r_d_a <= (|prim_n1) ? lane0_rounded[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (line_b_done && (finished_round == 2'd1)) begin
      prim_r_d_b <= (|prim_n2) ? lane0_rounded[21:0] : 22'd0;
    end
  end

  // Channel: g.
  always @(posedge clk) begin
    if (gx_done && (finished_round == 2'd2)) prim_g_g <= lane0_rounded[21:0];
  end

  always @(posedge clk) begin
    if (start_a_done && (finished_round == 2'd2)) begin
      prim_g_start_a <= (|prim_n1) ? lane0_rounded[21:0] + {{p0_g, 1'b1}, 13'd0} : 22'd0;
    end
  end

  wire [21:0] sum_3 = lane0_rounded[21:0]
                    + (prim_major_right ? {{p1_g, 1'b1}, 13'd0} : {{p0_g, 1'b1}, 13'd0});

  always @(posedge clk) begin
    if (start_b_done && (finished_round == 2'd2)) prim_g_start_b <= (|prim_n2) ? sum_3 : 22'd0;
  end

  always @(posedge clk) begin
    if (line_a_done && (finished_round == 2'd2)) begin
      prim_g_d_a <= (|prim_n1) ? lane0_rounded[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (line_b_done && (finished_round == 2'd2)) begin
      prim_g_d_b <= (|prim_n2) ? lane0_rounded[21:0] : 22'd0;
    end
  end

  // Channel: b.
  always @(posedge clk) begin
    if (gx_done && (finished_round == 2'd3)) prim_b_g <= lane0_rounded[21:0];
  end

  always @(posedge clk) begin
    if (start_a_done && (finished_round == 2'd3)) begin
      prim_b_start_a <= (|prim_n1) ? lane0_rounded[21:0] + {{p0_b, 1'b1}, 13'd0} : 22'd0;
    end
  end

  wire [21:0] sum_4 = lane0_rounded[21:0]
                    + (prim_major_right ? {{p1_b, 1'b1}, 13'd0} : {{p0_b, 1'b1}, 13'd0});

  always @(posedge clk) begin
    if (start_b_done && (finished_round == 2'd3)) prim_b_start_b <= (|prim_n2) ? sum_4 : 22'd0;
  end

  always @(posedge clk) begin
    if (line_a_done && (finished_round == 2'd3)) begin
      prim_b_d_a <= (|prim_n1) ? lane0_rounded[21:0] : 22'd0;
    end
  end

  always @(posedge clk) begin
    if (line_b_done && (finished_round == 2'd3)) begin
      prim_b_d_b <= (|prim_n2) ? lane0_rounded[21:0] : 22'd0;
    end
  end

  assign prim_jm = jm[8:0];

  // Not needed, on purpose.
  wire unused = &{
    1'b0, du01, du02, lane0_product[32], difference[15], difference_2[15], difference_3[15],
    choice[14:10], choice_2[14:10], choice_3[31]
  };

endmodule

`default_nettype wire
