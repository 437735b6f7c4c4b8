// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 332c0ada4a3a

// edgewalk_poly: POLY walks all edges of a polygon from line to line, a pair of them a span.
//
//   prim ─> LOAD ─> [edge table] ──────> PASS ─pair─> MOVER ─> line
//             └──> [order list] ───────> │ ^            └────> inc, held for PIXEL
//                  [active list of y] ─> B C D E ─> [active list of y + 1]
//
// LOAD writes the edges of a polygon to one half of the table, and their numbers to the order list, by their first lines.
// PASS goes through the active list of a line: each pair of columns is a span, each edge steps to the next line and goes
// into its list, by its column. MOVER takes the values along, by d0 from line to line, by g from column to column.
//
// Timing: a line of n edges takes n + 2 clocks, an edge that enters 1 more, one that goes before m others m + 2 more.
// MOVER takes a clock a line down, one for each bit of the number of columns, and one more.
// Rules: a step takes f from R; where R is too small M is added back and the column goes one further (carry).
// R - f is what is kept, so that its sign says whether the step carries.
// A polygon of more edges than the table has places is refused: nothing of it is drawn.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_poly (
  input  wire        clk,
  input  wire        rst,

  input  wire        prim_valid,
  input  wire  [8:0] prim_jm,           // first line
  input  wire  [9:0] prim_n1,           // lines of the upper part
  input  wire  [9:0] prim_n2,           // lines of the lower part
  input  wire        prim_major_right,  // the major edge is the right one
  input  wire  [2:0] prim_sides,        // major, first and second minor edge count, a bit each
  input  wire        prim_ends,         // 1: a whole triangle or line, or the last edges of a polygon with its plane
  input  wire        prim_void,         // the plane has no area: nothing is drawn
  input  wire  [9:0] prim_start_x,      // column of the pixel at which values start
  input  wire  [8:0] prim_start_y,      // its line, the first that is drawn
  input  wire [14:0] prim_major_c,      // signed, first column on or right of the edge
  input  wire [15:0] prim_major_dist,   // distance from the edge to that column, 2^-F column
  input  wire [14:0] prim_major_q,      // signed, whole columns a line, step of c
  input  wire [15:0] prim_major_f,      // 2^-F column a line
  input  wire [14:0] prim_minor1_c,     // signed, first column on or right of the edge
  input  wire [15:0] prim_minor1_dist,  // distance from the edge to that column, 2^-F column
  input  wire [14:0] prim_minor1_q,     // signed, whole columns a line, step of c
  input  wire [15:0] prim_minor1_f,     // 2^-F column a line
  input  wire [14:0] prim_minor2_c,     // signed, first column on or right of the edge
  input  wire [15:0] prim_minor2_dist,  // distance from the edge to that column, 2^-F column
  input  wire [14:0] prim_minor2_q,     // signed, whole columns a line, step of c
  input  wire [15:0] prim_minor2_f,     // 2^-F column a line
  input  wire [37:0] prim_z_start,      // UQ24.14 LSB, modular, value at pixel (start_x, start_y)
  input  wire [37:0] prim_z_d0,         // UQ24.14 LSB, modular, step to the next line
  input  wire [37:0] prim_z_g,          // UQ24.14 LSB, modular, step to the next pixel to the right
  input  wire [21:0] prim_height02,     // 2^-8 line, from vertex 0 down to 2 of those sorted by line
  input  wire [21:0] prim_height01,     // 2^-8 line, from vertex 0 down to 1 of those sorted by line
  input  wire [21:0] prim_height12,     // 2^-8 line, from vertex 1 down to 2 of those sorted by line
  input  wire [21:0] prim_down0,        // 2^-8 line, from vertex 0 down to the first line
  input  wire [21:0] prim_down1,        // 2^-8 line, from vertex 1 down to the first line of the lower part
  input  wire [11:0] prim_r_at0,        // UQ8.4 LSB, red at vertex 0 of those sorted by line
  input  wire [11:0] prim_r_at1,        // UQ8.4 LSB, red at vertex 1 of those sorted by line
  input  wire [11:0] prim_r_at2,        // UQ8.4 LSB, red at vertex 2 of those sorted by line
  input  wire [11:0] prim_g_at0,        // UQ8.4 LSB, green at vertex 0 of those sorted by line
  input  wire [11:0] prim_g_at1,        // UQ8.4 LSB, green at vertex 1 of those sorted by line
  input  wire [11:0] prim_g_at2,        // UQ8.4 LSB, green at vertex 2 of those sorted by line
  input  wire [11:0] prim_b_at0,        // UQ8.4 LSB, blue at vertex 0 of those sorted by line
  input  wire [11:0] prim_b_at1,        // UQ8.4 LSB, blue at vertex 1 of those sorted by line
  input  wire [11:0] prim_b_at2,        // UQ8.4 LSB, blue at vertex 2 of those sorted by line
  input  wire        line_ready,
  input  wire        fresh_queued,      // the polygon before has not reached PIXEL yet

  output wire        prim_ready,
  output wire        line_valid,
  output reg   [8:0] line_y,            // line
  output reg  [14:0] line_cmaj,         // signed, first column of the span
  output reg  [14:0] line_cmin,         // signed, column behind the span
  output wire        line_major_right,  // the major edge is the right one
  output reg  [37:0] line_z,            // UQ24.14 LSB, modular, depth at the first pixel of the line
  output reg  [21:0] line_r,            // UQ8.14 LSB, modular, red at the first pixel of the line
  output reg  [21:0] line_g,            // UQ8.14 LSB, modular, green at the first pixel of the line
  output reg  [21:0] line_b,            // UQ8.14 LSB, modular, blue at the first pixel of the line
  output wire        line_fresh,        // first span of the polygon
  output wire        line_fence,        // older fragments of the same pixel may be in flight
  output reg  [37:0] inc_z,             // UQ24.14 LSB, modular, increment of depth a pixel along the span; counts with line_valid
  output reg  [21:0] inc_r,             // UQ8.14 LSB, modular, increment of red a pixel along the span; counts with line_valid
  output reg  [21:0] inc_g,             // UQ8.14 LSB, modular, increment of green a pixel along the span; counts with line_valid
  output reg  [21:0] inc_b,             // UQ8.14 LSB, modular, increment of blue a pixel along the span; counts with line_valid
  output wire        walking,           // a polygon is walked, or its last span waits
  output wire        refused            // a polygon ends here that has more edges than the table: nothing of it is drawn
);

  wire pass_writes;  // PASS writes a record

  // The table of edges and the lists. A half of each is read while the other is written.
  reg [61:0] steps [0:127];     // of each edge c, dist, q, f, as in the prim
  reg [26:0] rests [0:127];     // of each edge R - f, signed, and the lines left
  reg [14:0] order [0:127];     // first line and number of each edge, by the line
  reg [36:0] lists [0:127];     // column, 2^F - 1 - R and number of each active edge, by the column, 2^F - 1 - R
  reg [21:0] r_values [0:127];  // of each edge the colour on its line
  reg [21:0] r_slopes [0:127];  // of each edge the colour's step to the next line
  reg [21:0] g_values [0:127];  // of each edge the colour on its line
  reg [21:0] g_slopes [0:127];  // of each edge the colour's step to the next line
  reg [21:0] b_values [0:127];  // of each edge the colour on its line
  reg [21:0] b_slopes [0:127];  // of each edge the colour's step to the next line

  // LOAD: the sides of a prim that count and have lines, one after the other.
  reg bank;                                  // half of the table that is loaded
  reg [6:0] edges;                           // in that half
  reg over;                                  // there are more
  reg putting;                               // an edge goes before others of the order list
  reg [2:0] did;                             // sides of the prim that are chosen
  wire [9:0] all_lines = prim_n1 + prim_n2;
  wire [8:0] knee = prim_jm + prim_n1[8:0];  // first line of the lower part
  wire major_left = prim_sides[0] && ((|prim_n1) || (|prim_n2)) && !did[0];
  wire minor1_left = prim_sides[1] && (|prim_n1) && !did[1];
  wire minor2_left = prim_sides[2] && (|prim_n2) && !did[2];
  wire any_left = major_left || minor1_left || minor2_left;
  reg edge_waits;                            // an edge is chosen, and not in the table
  wire edge_stays = edge_waits && (pass_writes || putting);
  reg found;                                 // the colours of the edge are found
  wire seeks = prim_valid && any_left && !edge_stays && !found;  // colours of an edge are not found yet
  wire [2:0] turn = {minor2_left && !major_left && !minor1_left,
                     minor1_left && !major_left,
                     major_left};
  wire takes = prim_valid && any_left && !putting && !(edge_waits && pass_writes) && found;  // a side is chosen
  wire of_major = prim_sides[0] && !did[0];
  reg [8:0] first_line;
  reg [9:0] lines;
  reg [14:0] loaded_c;
  reg [15:0] loaded_dist;
  reg [14:0] loaded_q;
  reg [15:0] loaded_f;
  wire [21:0] edge_height = of_major ? prim_height02 : minor1_left ? prim_height01 : prim_height12;
  wire [21:0] edge_down = of_major ? prim_down0 : minor1_left ? prim_down0 : prim_down1;

  always @(posedge clk) begin
    if (rst) begin
      edge_waits <= 1'b0;
    end else begin
      edge_waits <= takes || edge_stays;
    end
  end

  always @(posedge clk) begin
    if (!edge_stays) begin
      first_line <= of_major ? prim_jm : minor1_left ? prim_jm : knee;
      lines <= of_major ? all_lines : minor1_left ? prim_n1 : prim_n2;
      loaded_c <= of_major ? prim_major_c : minor1_left ? prim_minor1_c : prim_minor2_c;
      loaded_dist <= of_major ? prim_major_dist : minor1_left ? prim_minor1_dist : prim_minor2_dist;
      loaded_q <= of_major ? prim_major_q : minor1_left ? prim_minor1_q : prim_minor2_q;
      loaded_f <= of_major ? prim_major_f : minor1_left ? prim_minor1_f : prim_minor2_f;
    end
  end

  // Colours along an edge: pairs, whole and rest, of the modulus M, its height. First the difference of its ends over M, a digit a clock.
  reg [6:0] seek_at;                 // clocks of the search so far
  wire seek_reads = seek_at == 7'd0;
  wire seek_begins = seek_at == 7'd1;
  wire pair_stored = seek_at == 7'd14;
  wire value_found = seek_at == 7'd47;
  wire whole_begins = seek_at == 7'd2;
  wire whole_stored = seek_at == 7'd15;
  wire whole_of_value = seek_at == 7'd48;
  wire step_found = seek_at == 7'd67;
  wire reads_edge = seeks && seek_reads;
  reg [21:0] height;                 // of the edge
  wire sums_down = (seek_at >= 7'd14) && (seek_at < 7'd36);
  reg [21:0] down_way;               // from the upper end to the first line
  reg [21:0] down_digits;            // digits of the lines down that are left, the highest first
  wire adds_pair = sums_down && (pair_stored ? down_way[21] : down_digits[20]);
  reg adds_rest;                     // the pair's rest is added
  reg adds_whole;                    // its whole part is added
  wire takes_digits = seek_at < 7'd13;
  wire [11:0] r_upper = of_major ? prim_r_at0 : minor1_left ? prim_r_at0 : prim_r_at1;
  wire [11:0] r_lower = of_major ? prim_r_at2 : minor1_left ? prim_r_at1 : prim_r_at2;
  reg [11:0] r_from;                 // at the upper end
  reg [11:0] r_to;                   // at the lower end
  wire [12:0] r_rise = {1'b0, r_to} - {1'b0, r_from};
  reg [11:0] r_digits;               // digits of the difference that are left
  reg [21:0] r_whole;                // whole part of the pair, 2^-r LSB at last
  reg [21:0] r_rest;                 // what is left over, in 1/M
  reg [21:0] r_pair_whole;           // the difference over M: whole part
  reg [21:0] r_pair_rest;            // what is left over
  reg [21:0] r_added;                // a digit, or the pair's rest
  wire [24:0] shifted = {3'd0, r_rest} << 1;
  wire [24:0] r_doubled = shifted + {3'd0, r_added};
  wire [24:0] inverse = ~{3'd0, height};
  wire [24:0] r_less_one_digits = shifted ^ {3'd0, r_added} ^ inverse;
  wire [24:0] r_less_one_carries = (shifted & {3'd0, r_added})
                                 | (shifted & inverse)
                                 | ({3'd0, r_added} & inverse);
  wire [24:0] r_less_one = r_less_one_digits + {r_less_one_carries[23:0], 1'b1};
  wire [24:0] inverse_2 = ~({3'd0, height} << 1);
  wire [24:0] r_less_two_digits = shifted ^ {3'd0, r_added} ^ inverse_2;
  wire [24:0] r_less_two_carries = (shifted & {3'd0, r_added})
                                 | (shifted & inverse_2)
                                 | ({3'd0, r_added} & inverse_2);
  wire [24:0] r_less_two = r_less_two_digits + {r_less_two_carries[23:0], 1'b1};
  reg r_one;                         // M was in the rest
  reg r_two;                         // 2 M were in it
  wire [21:0] r_base = ({10'd0, r_from} << 10) + 22'd8192;
  wire [22:0] r_first = {r_whole, 1'b1} + {r_base, r_one};  // and a carry out of the lowest bit
  reg [21:0] r_edge_value;           // on the edge's first line, 2^-r LSB
  wire [21:0] r_rounded = r_whole + {21'd0, r_one};
  reg [21:0] r_edge_step;            // to the next line
  wire [11:0] g_upper = of_major ? prim_g_at0 : minor1_left ? prim_g_at0 : prim_g_at1;
  wire [11:0] g_lower = of_major ? prim_g_at2 : minor1_left ? prim_g_at1 : prim_g_at2;
  reg [11:0] g_from;                 // at the upper end
  reg [11:0] g_to;                   // at the lower end
  wire [12:0] g_rise = {1'b0, g_to} - {1'b0, g_from};
  reg [11:0] g_digits;               // digits of the difference that are left
  reg [21:0] g_whole;                // whole part of the pair, 2^-r LSB at last
  reg [21:0] g_rest;                 // what is left over, in 1/M
  reg [21:0] g_pair_whole;           // the difference over M: whole part
  reg [21:0] g_pair_rest;            // what is left over
  reg [21:0] g_added;                // a digit, or the pair's rest
  wire [24:0] shifted_2 = {3'd0, g_rest} << 1;
  wire [24:0] g_doubled = shifted_2 + {3'd0, g_added};
  wire [24:0] inverse_3 = ~{3'd0, height};
  wire [24:0] g_less_one_digits = shifted_2 ^ {3'd0, g_added} ^ inverse_3;
  wire [24:0] g_less_one_carries = (shifted_2 & {3'd0, g_added})
                                 | (shifted_2 & inverse_3)
                                 | ({3'd0, g_added} & inverse_3);
  wire [24:0] g_less_one = g_less_one_digits + {g_less_one_carries[23:0], 1'b1};
  wire [24:0] inverse_4 = ~({3'd0, height} << 1);
  wire [24:0] g_less_two_digits = shifted_2 ^ {3'd0, g_added} ^ inverse_4;
  wire [24:0] g_less_two_carries = (shifted_2 & {3'd0, g_added})
                                 | (shifted_2 & inverse_4)
                                 | ({3'd0, g_added} & inverse_4);
  wire [24:0] g_less_two = g_less_two_digits + {g_less_two_carries[23:0], 1'b1};
  reg g_one;                         // M was in the rest
  reg g_two;                         // 2 M were in it
  wire [21:0] g_base = ({10'd0, g_from} << 10) + 22'd8192;
  wire [22:0] g_first = {g_whole, 1'b1} + {g_base, g_one};  // and a carry out of the lowest bit
  reg [21:0] g_edge_value;           // on the edge's first line, 2^-r LSB
  wire [21:0] g_rounded = g_whole + {21'd0, g_one};
  reg [21:0] g_edge_step;            // to the next line
  wire [11:0] b_upper = of_major ? prim_b_at0 : minor1_left ? prim_b_at0 : prim_b_at1;
  wire [11:0] b_lower = of_major ? prim_b_at2 : minor1_left ? prim_b_at1 : prim_b_at2;
  reg [11:0] b_from;                 // at the upper end
  reg [11:0] b_to;                   // at the lower end
  wire [12:0] b_rise = {1'b0, b_to} - {1'b0, b_from};
  reg [11:0] b_digits;               // digits of the difference that are left
  reg [21:0] b_whole;                // whole part of the pair, 2^-r LSB at last
  reg [21:0] b_rest;                 // what is left over, in 1/M
  reg [21:0] b_pair_whole;           // the difference over M: whole part
  reg [21:0] b_pair_rest;            // what is left over
  reg [21:0] b_added;                // a digit, or the pair's rest
  wire [24:0] shifted_3 = {3'd0, b_rest} << 1;
  wire [24:0] b_doubled = shifted_3 + {3'd0, b_added};
  wire [24:0] inverse_5 = ~{3'd0, height};
  wire [24:0] b_less_one_digits = shifted_3 ^ {3'd0, b_added} ^ inverse_5;
  wire [24:0] b_less_one_carries = (shifted_3 & {3'd0, b_added})
                                 | (shifted_3 & inverse_5)
                                 | ({3'd0, b_added} & inverse_5);
  wire [24:0] b_less_one = b_less_one_digits + {b_less_one_carries[23:0], 1'b1};
  wire [24:0] inverse_6 = ~({3'd0, height} << 1);
  wire [24:0] b_less_two_digits = shifted_3 ^ {3'd0, b_added} ^ inverse_6;
  wire [24:0] b_less_two_carries = (shifted_3 & {3'd0, b_added})
                                 | (shifted_3 & inverse_6)
                                 | ({3'd0, b_added} & inverse_6);
  wire [24:0] b_less_two = b_less_two_digits + {b_less_two_carries[23:0], 1'b1};
  reg b_one;                         // M was in the rest
  reg b_two;                         // 2 M were in it
  wire [21:0] b_base = ({10'd0, b_from} << 10) + 22'd8192;
  wire [22:0] b_first = {b_whole, 1'b1} + {b_base, b_one};  // and a carry out of the lowest bit
  reg [21:0] b_edge_value;           // on the edge's first line, 2^-r LSB
  wire [21:0] b_rounded = b_whole + {21'd0, b_one};
  reg [21:0] b_edge_step;            // to the next line
  reg through;                       // no side of the prim is left, and none waits
  assign prim_ready = through && !putting && !(prim_ends && (walking || fresh_queued));
  wire fires = prim_valid && prim_ready;
  wire closes = fires && prim_ends;  // the polygon has all its edges
  wire begins = closes && (|edges) && !over && !prim_void;
  assign refused = closes && over;
  wire loads = edge_waits && !edge_stays;
  wire stores = loads && !edges[6];
  wire [6:0] load_place = {bank, edges[5:0]};

  always @(posedge clk) begin
    if (stores) steps[load_place] <= {loaded_c, loaded_dist, loaded_q, loaded_f};
  end

  always @(posedge clk) begin
    if (stores) r_slopes[load_place] <= r_edge_step;
  end

  always @(posedge clk) begin
    if (stores) g_slopes[load_place] <= g_edge_step;
  end

  always @(posedge clk) begin
    if (stores) b_slopes[load_place] <= b_edge_step;
  end

  wire [16:0] first_rest = {1'b0, loaded_dist} - {1'b0, loaded_f};  // R - f, signed

  always @(posedge clk) begin
    if (rst) begin
      seek_at <= 7'd0;
    end else if (seeks) begin
      seek_at <= step_found ? 7'd0 : seek_at + 7'd1;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      found <= 1'b0;
    end else begin
      if (takes) found <= 1'b0;
      if (seeks && step_found) found <= 1'b1;
    end
  end

  always @(posedge clk) begin
    if (reads_edge) begin
      height <= edge_height;
      down_way <= edge_down;
      r_from <= r_upper;
      r_to <= r_lower;
      g_from <= g_upper;
      g_to <= g_lower;
      b_from <= b_upper;
      b_to <= b_lower;
    end
  end

  wire [11:0] choice = seek_begins ? r_rise[11:0] : r_digits << 1;
  wire inverse_7 = !r_less_one[24];
  wire inverse_8 = !r_less_two[24];
  wire [21:0] sum = (r_whole << 1)
                  + (r_pair_whole & {22{adds_whole}})
                  + {20'd0, {r_two, r_one && !r_two}};
  wire [24:0] choice_2 = inverse_8 ? r_less_two : inverse_7 ? r_less_one : r_doubled;
  wire [11:0] choice_3 = seek_begins ? g_rise[11:0] : g_digits << 1;
  wire inverse_9 = !g_less_one[24];
  wire inverse_10 = !g_less_two[24];
  wire [21:0] sum_2 = (g_whole << 1)
                    + (g_pair_whole & {22{adds_whole}})
                    + {20'd0, {g_two, g_one && !g_two}};
  wire [24:0] choice_4 = inverse_10 ? g_less_two : inverse_9 ? g_less_one : g_doubled;
  wire [11:0] choice_5 = seek_begins ? b_rise[11:0] : b_digits << 1;
  wire inverse_11 = !b_less_one[24];
  wire inverse_12 = !b_less_two[24];
  wire [21:0] sum_3 = (b_whole << 1)
                    + (b_pair_whole & {22{adds_whole}})
                    + {20'd0, {b_two, b_one && !b_two}};
  wire [24:0] choice_6 = inverse_12 ? b_less_two : inverse_11 ? b_less_one : b_doubled;

  always @(posedge clk) begin
    if (seeks) begin
      down_digits <= pair_stored ? down_way : down_digits << 1;
      adds_rest <= adds_pair;
      adds_whole <= adds_rest;
      r_digits <= choice;
      r_added <= {21'd0, takes_digits && choice[11]}
               | ((pair_stored ? r_rest : r_pair_rest) & {22{adds_pair}});
      r_one <= inverse_7;
      r_two <= inverse_8;
      r_whole <= whole_begins ? {22{r_rise[12]}}
               : whole_stored ? 22'd0
               : whole_of_value ? r_pair_whole
               : sum;
      r_rest <= seek_begins ? (r_rise[12] ? height - 22'd1 : 22'd0)
              : pair_stored ? 22'd0
              : value_found ? r_pair_rest
              : choice_2[21:0];
      g_digits <= choice_3;
      g_added <= {21'd0, takes_digits && choice_3[11]}
               | ((pair_stored ? g_rest : g_pair_rest) & {22{adds_pair}});
      g_one <= inverse_9;
      g_two <= inverse_10;
      g_whole <= whole_begins ? {22{g_rise[12]}}
               : whole_stored ? 22'd0
               : whole_of_value ? g_pair_whole
               : sum_2;
      g_rest <= seek_begins ? (g_rise[12] ? height - 22'd1 : 22'd0)
              : pair_stored ? 22'd0
              : value_found ? g_pair_rest
              : choice_4[21:0];
      b_digits <= choice_5;
      b_added <= {21'd0, takes_digits && choice_5[11]}
               | ((pair_stored ? b_rest : b_pair_rest) & {22{adds_pair}});
      b_one <= inverse_11;
      b_two <= inverse_12;
      b_whole <= whole_begins ? {22{b_rise[12]}}
               : whole_stored ? 22'd0
               : whole_of_value ? b_pair_whole
               : sum_3;
      b_rest <= seek_begins ? (b_rise[12] ? height - 22'd1 : 22'd0)
              : pair_stored ? 22'd0
              : value_found ? b_pair_rest
              : choice_6[21:0];
    end
  end

  always @(posedge clk) begin
    if (seeks && whole_stored) begin
      r_pair_whole <= r_whole;
      g_pair_whole <= g_whole;
      b_pair_whole <= b_whole;
    end
  end

  always @(posedge clk) begin
    if (seeks && pair_stored) begin
      r_pair_rest <= r_rest;
      g_pair_rest <= g_rest;
      b_pair_rest <= b_rest;
    end
  end

  always @(posedge clk) begin
    if (seeks && whole_of_value) begin
      r_edge_value <= r_first[22:1];
      g_edge_value <= g_first[22:1];
      b_edge_value <= b_first[22:1];
    end
  end

  always @(posedge clk) begin
    if (seeks && step_found) begin
      r_edge_step <= r_rounded;
      g_edge_step <= g_rounded;
      b_edge_step <= b_rounded;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      through <= 1'b0;
    end else begin
      through <= prim_valid && !any_left && !edge_stays && !fires;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      bank <= 1'b0;
    end else if (closes) begin
      bank <= !bank;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      did <= 3'd0;
    end else begin
      if (takes) did <= did | turn;
      if (fires) did <= 3'd0;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      over <= 1'b0;
    end else begin
      if (loads && edges[6]) over <= 1'b1;
      if (closes) over <= 1'b0;
    end
  end

  // The order list: those that begin later move up, a clock each, the last first. The words before it are read two clocks ahead.
  reg [8:0] last_first;  // first line of the last edge of the list
  reg [5:0] last_index;  // its number
  reg [5:0] position;    // the place that is free
  reg [8:0] put_line;    // first line of the edge that is put there
  reg [5:0] put_index;   // its number
  wire later = (first_line >= last_first) || !(|edges);  // no edge of the list begins later
  wire appends = stores && later;
  wire inserts = stores && !later;
  reg [5:0] next_below;  // place of the word that is read next
  wire [5:0] read_below = putting ? next_below : edges[5:0] - 6'd2;
  reg [14:0] order_q;

  always @(posedge clk) begin
    if (prim_valid) order_q <= order[{bank, read_below}];
  end

  reg [8:0] below_line;   // first line of the edge before the free place
  reg [5:0] below_index;  // its number
  reg below_later;        // that edge begins later than the one that is put
  reg moves_last;         // the last edge moves up
  wire moves_up = moves_last || (below_later && (|position));
  wire ended = putting && !moves_up;
  wire [5:0] order_place = putting ? position : edges[5:0];
  wire [8:0] choice_7 = putting ? (moves_up ? (moves_last ? last_first : below_line) : put_line)
                      : first_line;
  wire [5:0] choice_8 = putting ? (moves_up ? (moves_last ? last_index : below_index) : put_index)
                      : edges[5:0];

  always @(posedge clk) begin
    if (appends || putting) order[{bank, order_place}] <= {choice_7, choice_8};
  end

  wire pair_leaves;  // MOVER takes the pair that waits, or drops it

  always @(posedge clk) begin
    if (!putting) begin
      put_index <= edges[5:0];
      put_line <= first_line;
    end
  end

  always @(posedge clk) begin
    if (appends) begin
      last_first <= first_line;
      last_index <= edges[5:0];
    end
  end

  always @(posedge clk) begin
    next_below <= read_below - 6'd1;
    below_line <= order_q[14:6];
    below_index <= order_q[5:0];
    below_later <= order_q[14:6] > put_line;
    moves_last <= inserts;
  end

  always @(posedge clk) begin
    position <= order_place;
    if (putting && moves_up) position <= position - 6'd1;
  end

  always @(posedge clk) begin
    if (rst) begin
      putting <= 1'b0;
    end else begin
      if (ended) putting <= 1'b0;
      if (inserts) putting <= 1'b1;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      edges <= 7'd0;
    end else begin
      if (stores) edges <= edges + 7'd1;
      if (closes) edges <= 7'd0;
    end
  end

  // PASS: the active list of line y through the stages B, a word, and C, the word with its record.
  reg run;                             // lines are passed
  reg fills;                           // the first word of the order list is stored
  reg [8:0] y;                         // the line
  reg [8:0] y_below;                   // the line below
  reg [8:0] y_after;                   // the line below that
  reg list;                            // the active list that is read: that of the line
  reg half;                            // the first column of a pair is there
  reg b_valid;
  reg c_valid;
  reg entering;                        // the edge of C begins on the next line
  reg pair_waits;                      // a pair of columns waits for MOVER
  wire passed = c_valid && !entering;  // the edge of C meets line y
  wire closes_pair = passed && half;
  wire blocked = closes_pair && pair_waits;

  // Stage E: does the edge go behind the last of its list, or before some? That is found out on its way from D.
  reg [6:0] count;       // edges in the list of the next line
  reg [30:0] d_key;      // signed, column, 2^F - 1 - R of the edge on the next line
  reg [5:0] d_index;     // its number
  reg [30:0] e_key;      // signed, column, 2^F - 1 - R of the edge that goes into the list
  reg [5:0] e_index;     // its number
  reg [30:0] head_key;   // signed, first column, 2^F - 1 - R of the list
  reg [5:0] head_index;  // its number
  reg [30:0] top_key;    // signed, last column, 2^F - 1 - R of the list
  reg [5:0] top_index;   // its number
  reg d_valid;
  reg e_valid;
  reg before_top;        // the edge of E goes before the last of the list
  reg moving;            // words move up for the edge of E
  wire begins_moving = e_valid && !moving && before_top;
  wire works = run && !fills;
  wire advance = works && !(moving || begins_moving) && !blocked;

  // The next edge of the order list in registers, and the word behind it on the memory's port; while no polygon is walked, the first of the one that is loaded.
  reg [6:0] waiting;      // edges that have not entered
  reg [5:0] order_next;   // place of the word that is read next
  wire [14:0] order_word;
  reg [8:0] order_line;   // first line of the next edge
  reg [5:0] order_index;  // its number
  reg due;                // the next edge begins on the next line
  wire enters = run && !b_valid && due;
  wire entered = advance && enters;
  wire order_loads = entered || fills;
  wire more_wait = fills || (waiting > 7'd1);
  reg [14:0] order_q2;

  always @(posedge clk) begin
    if (!run || order_loads) order_q2 <= order[{bank ^ run, order_next & {6{run}}}];
  end

  assign order_word = order_q2;
  wire some_waits = |waiting;
  wire due_after_next = some_waits && (order_line == y_after);
  wire line_ends = works && !(moving || begins_moving) && !d_valid && !b_valid && !c_valid && !enters;  // no edge is left on it, none enters
  wire some_words = (|count) || e_valid;  // of the next line
  wire next_line_starts = line_ends && some_words;

  always @(posedge clk) begin
    if (entered) waiting <= waiting - 7'd1;
    if (!run) waiting <= edges;
  end

  always @(posedge clk) begin
    if (order_loads) order_next <= order_next + 6'd1;
    if (!run) order_next <= 6'd1;
  end

  always @(posedge clk) begin
    if (order_loads) begin
      order_line <= order_word[14:6];
      order_index <= order_word[5:0];
    end
  end

  always @(posedge clk) begin
    if (order_loads) due <= more_wait && (order_word[14:6] == y_below);
    if (line_ends) due <= due_after_next;
  end

  // Stage B: the next word of the list. Its first is kept in a register, to begin with on the next line.
  reg [6:0] unread;          // words of the list not read yet
  reg [5:0] next_word;       // place of the next word
  wire some_unread = |unread;
  wire many = count > 7'd1;  // two words at least, without that in E
  wire several = many || ((|count) && e_valid);
  wire reads = advance && some_unread;
  wire [6:0] behind_second = e_valid ? count - 7'd1 : count - 7'd2;  // words behind the second
  reg [36:0] lists_q;

  always @(posedge clk) begin
    if (advance) lists_q <= lists[{some_unread ? list : !list, some_unread ? next_word : 6'd1}];
  end

  reg b_in_e;  // the word of B is that of E

  always @(posedge clk) begin
    if (rst) begin
      unread <= 7'd0;
    end else begin
      if (reads) unread <= unread - 7'd1;
      if (line_ends) unread <= several ? behind_second : 7'd0;
    end
  end

  always @(posedge clk) begin
    if (reads) next_word <= next_word + 6'd1;
    if (line_ends) next_word <= 6'd2;
  end

  always @(posedge clk) begin
    if (rst) begin
      b_valid <= 1'b0;
    end else if (advance) begin
      b_valid <= some_unread || (line_ends && several);
    end
  end

  always @(posedge clk) begin
    if (advance) b_in_e <= line_ends && !many;
  end

  // Stage C: the word with its record.
  wire [5:0] next_index = b_valid ? (b_in_e ? e_index : lists_q[5:0])
                        : enters ? order_index
                        : head_index;
  wire [6:0] read_place = {!bank, next_index};
  reg [61:0] steps_q;

  always @(posedge clk) begin
    if (advance) steps_q <= steps[read_place];
  end

  reg [26:0] rests_q;

  always @(posedge clk) begin
    if (advance) rests_q <= rests[read_place];
  end

  wire [9:0] lines_left = rests_q[9:0];
  wire [16:0] rest = rests_q[26:10];  // R - f, signed
  reg [30:0] c_key;
  reg [5:0] c_index;

  always @(posedge clk) begin
    if (advance) begin
      c_key <= b_valid ? (b_in_e ? e_key : lists_q[36:6]) : head_key;
      c_index <= next_index;
      entering <= !b_valid && enters;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      c_valid <= 1'b0;
    end else if (advance) begin
      c_valid <= b_valid || enters || next_line_starts;
    end
  end

  // Each second column closes a pair. While no pair waits its place takes what may become one.
  wire walked = advance && passed;
  reg [30:0] left;  // first column, 2^F - 1 - R of the pair

  always @(posedge clk) begin
    if (!half) left <= c_key;
  end

  // Colours of the edge in C.
  reg [21:0] r_values_q;

  always @(posedge clk) begin
    if (advance) r_values_q <= r_values[read_place];
  end

  wire [21:0] c_r = r_values_q;
  reg [21:0] r_slopes_q;

  always @(posedge clk) begin
    if (advance) r_slopes_q <= r_slopes[read_place];
  end

  wire [21:0] c_r_step = r_slopes_q;
  reg [21:0] g_values_q;

  always @(posedge clk) begin
    if (advance) g_values_q <= g_values[read_place];
  end

  wire [21:0] c_g = g_values_q;
  reg [21:0] g_slopes_q;

  always @(posedge clk) begin
    if (advance) g_slopes_q <= g_slopes[read_place];
  end

  wire [21:0] c_g_step = g_slopes_q;
  reg [21:0] b_values_q;

  always @(posedge clk) begin
    if (advance) b_values_q <= b_values[read_place];
  end

  wire [21:0] c_b = b_values_q;
  reg [21:0] b_slopes_q;

  always @(posedge clk) begin
    if (advance) b_slopes_q <= b_slopes[read_place];
  end

  wire [21:0] c_b_step = b_slopes_q;
  reg [21:0] left_r;
  reg [21:0] left_g;
  reg [21:0] left_b;
  wire pair_closed = advance && closes_pair;
  wire [14:0] part = c_key[30:16];
  wire right_cut = !part[14] && (part >= 15'd640);  // the pair ends beside the screen
  wire [14:0] part_2 = left[30:16];
  wire left_cut = part_2[14];                       // the pair begins beside the screen
  wire some_columns = ($signed(part_2) < $signed(part))  // of the screen
                   && !(!part_2[14] && (part_2 >= 15'd640))
                   && !part[14] && (|part);
  wire [14:0] first = left_cut ? 15'd0 : part_2;
  wire [14:0] behind = right_cut ? 15'd640 : part;
  reg [8:0] pair_line;
  reg pair_some;
  reg [14:0] pair_first;
  reg [14:0] pair_behind;
  reg [30:0] pair_left_key;
  reg [21:0] pair_left_r;
  reg [21:0] pair_left_g;
  reg [21:0] pair_left_b;
  reg [30:0] pair_right_key;
  reg [21:0] pair_right_r;
  reg [21:0] pair_right_g;
  reg [21:0] pair_right_b;

  always @(posedge clk) begin
    if (!half) begin
      left_r <= c_r;
      left_g <= c_g;
      left_b <= c_b;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      half <= 1'b0;
    end else begin
      if (walked) half <= !half;
      if (line_ends) half <= 1'b0;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      pair_waits <= 1'b0;
    end else begin
      if (pair_leaves) pair_waits <= 1'b0;
      if (pair_closed) pair_waits <= 1'b1;
    end
  end

  always @(posedge clk) begin
    if (!pair_waits) begin
      pair_line <= y;
      pair_some <= some_columns;
      pair_first <= first;
      pair_behind <= behind;
      pair_left_key <= left;
      pair_left_r <= left_r;
      pair_left_g <= left_g;
      pair_left_b <= left_b;
      pair_right_key <= c_key;
      pair_right_r <= c_r;
      pair_right_g <= c_g;
      pair_right_b <= c_b;
    end
  end

  // Stage D: the edge on the next line, and its record written back.
  wire leaves = !entering && (lines_left == 10'd1);  // line y is its last one
  wire [14:0] stepped = c_key[30:16] + steps_q[30:16] + {14'd0, rest[16]};
  reg [16:0] d_rest;                                 // R - f, signed
  reg [9:0] d_lines_left;
  reg writes;                                        // the record of D is written
  wire rests_written = stores || writes;
  wire [6:0] choice_9 = writes ? {!bank, d_index} : load_place;

  always @(posedge clk) begin
    if (rests_written) rests[choice_9] <= writes ? {d_rest, d_lines_left} : {first_rest, lines};
  end

  reg [21:0] d_r;

  always @(posedge clk) begin
    if (rests_written) r_values[choice_9] <= writes ? d_r : r_edge_value;
  end

  reg [21:0] d_g;

  always @(posedge clk) begin
    if (rests_written) g_values[choice_9] <= writes ? d_g : g_edge_value;
  end

  reg [21:0] d_b;

  always @(posedge clk) begin
    if (rests_written) b_values[choice_9] <= writes ? d_b : b_edge_value;
  end

  always @(posedge clk) begin
    d_rest <= {1'b0, rest[15:0]} - {1'b0, steps_q[15:0]};
    d_lines_left <= lines_left - 10'd1;
    d_r <= c_r + c_r_step;
    d_g <= c_g + c_g_step;
    d_b <= c_b + c_b_step;
  end

  always @(posedge clk) begin
    if (rst) begin
      writes <= 1'b0;
    end else begin
      writes <= advance && passed && !leaves;
    end
  end

  // The words before which the edge goes move up, the last of them first; then it takes the gap. They are read a clock ahead of that.
  reg [5:0] gap;          // the place that is free
  reg [5:0] next_before;  // place of the word that is read next
  wire [5:0] read_before = moving ? next_before : count[5:0] - 6'd2;
  reg [36:0] lists_q2;

  always @(posedge clk) begin
    if (e_valid) lists_q2 <= lists[{!list, read_before}];
  end

  reg [30:0] gap_word_key;   // the word before the gap
  reg [5:0] gap_word_index;  // its number
  reg gap_greater;           // the word before the gap goes behind the edge
  reg fetches;               // the word before the gap is read
  wire shifts = moving && !fetches && (|gap) && gap_greater;
  wire placed = e_valid && !begins_moving && !fetches && !shifts;  // the edge has its place
  wire [5:0] list_place = moving ? gap : count[5:0];
  wire moved = begins_moving || shifts;

  always @(posedge clk) begin
    if (e_valid) lists[{!list, list_place}] <= {moved ? (shifts ? gap_word_key : top_key) : e_key,
 moved ? (shifts ? gap_word_index : top_index) : e_index};
  end

  wire first_of_list = !(|count) && !e_valid;  // the list is empty, and so is E
  wire d_to_e = advance && d_valid;
  wire d_smaller = $signed(d_key) < $signed(e_valid ? e_key : top_key);

  always @(posedge clk) begin
    next_before <= read_before - 6'd1;
    gap_word_key <= lists_q2[36:6];
    gap_word_index <= lists_q2[5:0];
    gap_greater <= $signed(e_key) < $signed(lists_q2[36:6]);
    fetches <= begins_moving;
    before_top <= d_smaller && !first_of_list;
  end

  always @(posedge clk) begin
    if (rst) begin
      moving <= 1'b0;
    end else begin
      if (placed) moving <= 1'b0;
      if (begins_moving) moving <= 1'b1;
    end
  end

  always @(posedge clk) begin
    if (shifts) gap <= gap - 6'd1;
    if (begins_moving) gap <= count[5:0] - 6'd1;
  end

  always @(posedge clk) begin
    if (placed && !moving) begin
      top_key <= e_key;
      top_index <= e_index;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      count <= 7'd0;
    end else begin
      if (placed) count <= count + 7'd1;
      if (line_ends) count <= 7'd0;
    end
  end

  always @(posedge clk) begin
    if (placed && moving && !(|gap)) begin
      head_key <= e_key;
      head_index <= e_index;
    end
    if (d_to_e && first_of_list) begin
      head_key <= d_key;
      head_index <= d_index;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      e_valid <= 1'b0;
    end else begin
      if (placed) e_valid <= 1'b0;
      if (advance) e_valid <= d_valid;
    end
  end

  always @(posedge clk) begin
    if (d_to_e) begin
      e_key <= d_key;
      e_index <= d_index;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      d_valid <= 1'b0;
    end else if (advance) begin
      d_valid <= c_valid && !leaves;
    end
  end

  always @(posedge clk) begin
    if (advance) begin
      d_key <= entering ? {steps_q[61:47], ~steps_q[46:31]} : {stepped, ~rest[15:0]};
      d_index <= c_index;
    end
  end

  // The next line.
  wire polygon_ends = line_ends && !some_words && !some_waits;
  wire [8:0] second_line = prim_start_y + 9'd1;
  assign pass_writes = writes;

  always @(posedge clk) begin
    if (rst) begin
      run <= 1'b0;
    end else begin
      if (polygon_ends) run <= 1'b0;
      if (begins) run <= 1'b1;
    end
  end

  always @(posedge clk) begin
    fills <= begins;
  end

  always @(posedge clk) begin
    if (line_ends) y <= y_below;
  end

  always @(posedge clk) begin
    if (line_ends) begin
      y_below <= y_after;
      y_after <= y_after + 9'd1;
    end
    if (!run) begin
      y_below <= prim_start_y;
      y_after <= second_line;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      list <= 1'b0;
    end else if (line_ends) begin
      list <= !list;
    end
  end

  // MOVER: the pair that waits; it is dropped if it has no column of the screen.
  reg has_span;  // a span is offered, or values move to it
  wire line_fires = line_valid && line_ready;
  wire free = !has_span || line_fires;
  wire takes_pair = pair_waits && pair_some && free;

  always @(posedge clk) begin
    if (rst) begin
      has_span <= 1'b0;
    end else begin
      if (line_fires) has_span <= 1'b0;
      if (takes_pair) has_span <= 1'b1;
    end
  end

  // The way to the span: lines down, then columns to the right or to the left.
  reg [8:0] at_line;        // line of the span before
  reg [9:0] at_column;      // its first column
  wire [10:0] beside = {1'b0, pair_first[9:0]} - {1'b0, at_column};  // signed, columns
  wire [9:0] back = at_column - pair_first[9:0];
  wire [9:0] columns_away = beside[10] ? back : beside[9:0];
  reg [8:0] lines_down;     // lines left to go down
  reg [9:0] columns_along;  // columns left to go, in doubles of what is added
  reg down;                 // lines are left
  reg along;                // columns are left
  reg to_left;              // they lie to the left
  wire doubles = !down && along;
  wire adds = down || (along && columns_along[0]);

  always @(posedge clk) begin
    if (takes_pair) begin
      at_line <= pair_line;
      at_column <= pair_first[9:0];
      to_left <= beside[10];
    end
    if (!walking) begin
      at_line <= prim_start_y;
      at_column <= prim_start_x;
      to_left <= 1'b0;
    end
  end

  always @(posedge clk) begin
    if (down) lines_down <= lines_down - 9'd1;
    if (takes_pair) lines_down <= pair_line - at_line;
  end

  always @(posedge clk) begin
    if (rst) begin
      down <= 1'b0;
    end else begin
      if (down) down <= lines_down != 9'd1;
      if (takes_pair) down <= pair_line != at_line;
    end
  end

  wire [9:0] shifted_4 = columns_along >> 1;

  always @(posedge clk) begin
    if (doubles) begin
      columns_along <= shifted_4;
      along <= |shifted_4;
    end
    if (takes_pair) begin
      columns_along <= columns_away;
      along <= pair_first[9:0] != at_column;
    end
    if (!walking) begin
      columns_along <= 10'd1;
      along <= 1'b1;
    end
  end

  // Colours from edge to edge. Digits of the place of the first pixel, over the width between the edges; then those of a pixel. Each sum is the colours' difference times the digits so far.
  reg dividing;                         // digits are found
  reg [5:0] turns;                      // digits found
  reg summing;                          // the digit found last is summed
  reg [30:0] apart;                     // from edge to edge, 2^-F px
  wire [30:0] into = {pair_first, 16'hffff} - pair_left_key;  // from the left edge to the first pixel, 2^-F px
  reg [30:0] apart_rest;                // what is left over of the division
  wire [32:0] shifted_5 = {2'd0, apart_rest} << 1;
  wire [32:0] less_apart = shifted_5 - {2'd0, apart};
  wire digit = !less_apart[32];
  reg last_digit;
  wire wide = apart > 31'h10000;        // the edges are more than a pixel apart
  reg second_digits;                    // those of a pixel follow
  reg second_sum;                       // the sums of a pixel begin
  wire starts = summing && second_sum;  // the sums are those of the first pixel
  reg [22:0] r_difference;              // of the right and the left edge, signed
  reg [45:0] r_sum;                     // times the digits so far, signed
  wire [21:0] r_part = r_sum[44:23] + {21'd0, r_sum[22]};
  reg [22:0] g_difference;              // of the right and the left edge, signed
  reg [45:0] g_sum;                     // times the digits so far, signed
  wire [21:0] g_part = g_sum[44:23] + {21'd0, g_sum[22]};
  reg [22:0] b_difference;              // of the right and the left edge, signed
  reg [45:0] b_sum;                     // times the digits so far, signed
  wire [21:0] b_part = b_sum[44:23] + {21'd0, b_sum[22]};
  reg offers;                           // the span is offered
  wire grants = has_span && !down && !along && !dividing && !summing && !offers && !fresh_queued;  // its increments are shown, and it is offered
  assign line_valid = has_span && offers;
  wire [32:0] choice_10 = digit ? less_apart : shifted_5;

  always @(posedge clk) begin
    if (dividing) begin
      turns <= turns + 6'd1;
      apart_rest <= second_digits ? (wide ? 31'h10000 : 31'd0) : choice_10[30:0];
    end
    if (takes_pair) begin
      turns <= 6'd0;
      apart_rest <= into;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      dividing <= 1'b0;
    end else begin
      if (turns == 6'd45) dividing <= 1'b0;
      if (takes_pair) dividing <= 1'b1;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      summing <= 1'b0;
    end else begin
      summing <= dividing;
    end
  end

  always @(posedge clk) begin
    if (takes_pair) begin
      apart <= pair_right_key - pair_left_key;
      r_difference <= {1'b0, pair_right_r} - {1'b0, pair_left_r};
      g_difference <= {1'b0, pair_right_g} - {1'b0, pair_left_g};
      b_difference <= {1'b0, pair_right_b} - {1'b0, pair_left_b};
    end
  end

  always @(posedge clk) begin
    last_digit <= digit;
    second_digits <= dividing && (turns == 6'd21);
    second_sum <= dividing && (turns == 6'd23);
  end

  always @(posedge clk) begin
    if (summing) begin
      r_sum <= (second_sum ? 46'd0 : r_sum << 1)
             + ({{23{r_difference[22]}}, r_difference} & {46{last_digit}});
      g_sum <= (second_sum ? 46'd0 : g_sum << 1)
             + ({{23{g_difference[22]}}, g_difference} & {46{last_digit}});
      b_sum <= (second_sum ? 46'd0 : b_sum << 1)
             + ({{23{b_difference[22]}}, b_difference} & {46{last_digit}});
    end
    if (takes_pair) begin
      r_sum <= 46'd0;
      g_sum <= 46'd0;
      b_sum <= 46'd0;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      offers <= 1'b0;
    end else begin
      if (line_fires) offers <= 1'b0;
      if (grants) offers <= 1'b1;
    end
  end

  // The line that is offered. While no polygon is walked everything takes the next one, again and again.
  reg line_first;  // first span of the polygon

  always @(posedge clk) begin
    if (takes_pair) begin
      line_y <= pair_line;
      line_cmaj <= pair_first;
      line_cmin <= pair_behind;
    end
  end

  always @(posedge clk) begin
    if (line_fires) line_first <= 1'b0;
    if (!walking) line_first <= 1'b1;
  end

  // Values: d0 is added once a line. For each set bit i of the number of columns the increment, doubled i times, is added.
  reg [37:0] z_d0;     // step to the next line
  reg [37:0] z_along;  // increment, doubled as often as it was asked for
  wire [37:0] z_added = down ? z_d0 : z_along ^ {38{to_left}};
  wire [38:0] z_moved = {line_z, 1'b1} + {z_added, !down && to_left};  // and a carry out of the lowest bit
  assign pair_leaves = pair_waits && (free || !pair_some);
  assign walking = run || pair_waits || has_span;

  always @(posedge clk) begin
    if (starts) begin
      line_r <= line_r + r_part;
      line_g <= line_g + g_part;
      line_b <= line_b + b_part;
    end
    if (takes_pair) begin
      line_r <= pair_left_r;
      line_g <= pair_left_g;
      line_b <= pair_left_b;
    end
  end

  always @(posedge clk) begin
    if (grants) begin
      inc_r <= r_part;
      inc_g <= g_part;
      inc_b <= b_part;
    end
  end

  always @(posedge clk) begin
    if (begins) inc_z <= prim_z_g;
  end

  always @(posedge clk) begin
    if (!walking) z_d0 <= prim_z_d0;
  end

  always @(posedge clk) begin
    if (doubles) z_along <= z_along << 1;
    if (takes_pair) z_along <= inc_z;
    if (!walking) z_along <= prim_z_start;
  end

  always @(posedge clk) begin
    if (adds) line_z <= z_moved[38:1];
    if (!walking) line_z <= 38'd0;
  end

  assign line_major_right = 1'b0;
  assign line_fresh = 1'b1;
  assign line_fence = line_first;

  // Not needed, on purpose.
  wire unused = &{
    1'b0, prim_major_right, r_less_one_carries[24], r_less_two_carries[24], r_first[0],
    g_less_one_carries[24], g_less_two_carries[24], g_first[0], b_less_one_carries[24],
    b_less_two_carries[24], b_first[0], z_moved[0], choice_2[24:22], choice_4[24:22], choice_6[24:22],
    choice_10[32:31]
  };

endmodule

`default_nettype wire
