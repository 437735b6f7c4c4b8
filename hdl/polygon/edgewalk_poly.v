// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine a2dbd3f4d826

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
  input  wire [21:0] prim_major_dist,   // distance from the edge to that column, 1/M column
  input  wire [14:0] prim_major_q,      // signed, whole columns a line, step of c
  input  wire [21:0] prim_major_f,      // 1/M column a line
  input  wire [21:0] prim_major_m,      // modulus of dist and f: the edge's height; a line has 2^8 units
  input  wire [14:0] prim_minor1_c,     // signed, first column on or right of the edge
  input  wire [21:0] prim_minor1_dist,  // distance from the edge to that column, 1/M column
  input  wire [14:0] prim_minor1_q,     // signed, whole columns a line, step of c
  input  wire [21:0] prim_minor1_f,     // 1/M column a line
  input  wire [21:0] prim_minor1_m,     // modulus of dist and f: the edge's height; a line has 2^8 units
  input  wire [14:0] prim_minor2_c,     // signed, first column on or right of the edge
  input  wire [21:0] prim_minor2_dist,  // distance from the edge to that column, 1/M column
  input  wire [14:0] prim_minor2_q,     // signed, whole columns a line, step of c
  input  wire [21:0] prim_minor2_f,     // 1/M column a line
  input  wire [21:0] prim_minor2_m,     // modulus of dist and f: the edge's height; a line has 2^8 units
  input  wire [37:0] prim_z_start,      // UQ24.14 LSB, modular, value at pixel (start_x, start_y)
  input  wire [37:0] prim_z_d0,         // UQ24.14 LSB, modular, step to the next line
  input  wire [37:0] prim_z_g,          // UQ24.14 LSB, modular, step to the next pixel to the right
  input  wire [21:0] prim_r_start,      // UQ8.14 LSB, modular, value at pixel (start_x, start_y)
  input  wire [21:0] prim_r_d0,         // UQ8.14 LSB, modular, step to the next line
  input  wire [21:0] prim_r_g,          // UQ8.14 LSB, modular, step to the next pixel to the right
  input  wire [21:0] prim_g_start,      // UQ8.14 LSB, modular, value at pixel (start_x, start_y)
  input  wire [21:0] prim_g_d0,         // UQ8.14 LSB, modular, step to the next line
  input  wire [21:0] prim_g_g,          // UQ8.14 LSB, modular, step to the next pixel to the right
  input  wire [21:0] prim_b_start,      // UQ8.14 LSB, modular, value at pixel (start_x, start_y)
  input  wire [21:0] prim_b_d0,         // UQ8.14 LSB, modular, step to the next line
  input  wire [21:0] prim_b_g,          // UQ8.14 LSB, modular, step to the next pixel to the right
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
  output reg         line_fresh,        // first span of the polygon
  output wire        line_fence,        // older fragments of the same pixel may be in flight
  output reg  [37:0] inc_z,             // UQ24.14 LSB, modular, increment of depth a pixel along the span; stays until the next prim with prim_ends fires
  output reg  [21:0] inc_r,             // UQ8.14 LSB, modular, increment of red a pixel along the span; stays until the next prim with prim_ends fires
  output reg  [21:0] inc_g,             // UQ8.14 LSB, modular, increment of green a pixel along the span; stays until the next prim with prim_ends fires
  output reg  [21:0] inc_b,             // UQ8.14 LSB, modular, increment of blue a pixel along the span; stays until the next prim with prim_ends fires
  output wire        walking,           // a polygon is walked, or its last span waits
  output wire        refused            // a polygon ends here that has more edges than the table: nothing of it is drawn
);

  wire pass_writes;  // PASS writes a record

  // The table of edges and the lists. A half of each is read while the other is written.
  reg [73:0] steps [0:127];  // of each edge c, q, f, m - f, as in the prim
  reg [32:0] rests [0:127];  // of each edge R - f, signed, and the lines left
  reg [14:0] order [0:127];  // first line and number of each edge, by the line
  reg [20:0] lists [0:127];  // column and number of each active edge, by the column

  // LOAD: the sides of a prim that count and have lines, one after the other.
  reg bank;                                       // half of the table that is loaded
  reg [6:0] edges;                                // in that half
  reg over;                                       // there are more
  reg putting;                                    // an edge goes before others of the order list
  reg [2:0] did;                                  // sides of the prim that are chosen
  wire [9:0] all_lines = prim_n1 + prim_n2;
  wire [8:0] knee = prim_jm + prim_n1[8:0];       // first line of the lower part
  wire major_left = prim_sides[0] && ((|prim_n1) || (|prim_n2)) && !did[0];
  wire minor1_left = prim_sides[1] && (|prim_n1) && !did[1];
  wire minor2_left = prim_sides[2] && (|prim_n2) && !did[2];
  wire any_left = major_left || minor1_left || minor2_left;
  reg edge_waits;                                 // an edge is chosen, and not in the table
  wire edge_stays = edge_waits && (pass_writes || putting);
  wire [2:0] turn = {minor2_left && !major_left && !minor1_left,
                     minor1_left && !major_left,
                     major_left};
  wire takes = prim_valid && any_left && !putting && !(edge_waits && pass_writes);  // a side is chosen
  wire of_major = prim_sides[0] && !did[0];
  reg [8:0] first_line;
  reg [9:0] lines;
  reg [14:0] loaded_c;
  reg [21:0] loaded_dist;
  reg [14:0] loaded_q;
  reg [21:0] loaded_f;
  reg [21:0] loaded_m;
  wire [21:0] loaded_back = loaded_m - loaded_f;  // M - f
  reg through;                                    // no side of the prim is left, and none waits
  assign prim_ready = through && !putting && !(prim_ends && (walking || fresh_queued));
  wire fires = prim_valid && prim_ready;
  wire closes = fires && prim_ends;               // the polygon has all its edges
  wire begins = closes && (|edges) && !over && !prim_void;
  assign refused = closes && over;
  wire loads = edge_waits && !edge_stays;
  wire stores = loads && !edges[6];
  wire [6:0] load_place = {bank, edges[5:0]};

  always @(posedge clk) begin
    if (stores) steps[load_place] <= {loaded_c, loaded_q, loaded_f, loaded_back};
  end

  wire [22:0] first_rest = {1'b0, loaded_dist} - {1'b0, loaded_f};  // R - f, signed

  always @(posedge clk) begin
    if (rst) begin
      edge_waits <= 1'b0;
      through <= 1'b0;
    end else begin
      edge_waits <= takes || edge_stays;
      through <= prim_valid && !any_left && !edge_stays && !fires;
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
      loaded_m <= of_major ? prim_major_m : minor1_left ? prim_minor1_m : prim_minor2_m;
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
  wire [8:0] choice = putting ? (moves_up ? (moves_last ? last_first : below_line) : put_line)
                    : first_line;
  wire [5:0] choice_2 = putting ? (moves_up ? (moves_last ? last_index : below_index) : put_index)
                      : edges[5:0];

  always @(posedge clk) begin
    if (appends || putting) order[{bank, order_place}] <= {choice, choice_2};
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
  reg [6:0] count;         // edges in the list of the next line
  reg [14:0] d_column;     // signed, column of the edge on the next line
  reg [5:0] d_index;       // its number
  reg [14:0] e_column;     // signed, column of the edge that goes into the list
  reg [5:0] e_index;       // its number
  reg [14:0] head_column;  // signed, first column of the list
  reg [5:0] head_index;    // its number
  reg [14:0] top_column;   // signed, last column of the list
  reg [5:0] top_index;     // its number
  reg d_valid;
  reg e_valid;
  reg before_top;          // the edge of E goes before the last of the list
  reg moving;              // words move up for the edge of E
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
  reg [20:0] lists_q;

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
  reg [73:0] steps_q;

  always @(posedge clk) begin
    if (advance) steps_q <= steps[read_place];
  end

  reg [32:0] rests_q;

  always @(posedge clk) begin
    if (advance) rests_q <= rests[read_place];
  end

  wire [9:0] lines_left = rests_q[9:0];
  wire [22:0] rest = rests_q[32:10];  // R - f, signed
  reg [14:0] c_column;
  reg [5:0] c_index;

  always @(posedge clk) begin
    if (advance) begin
      c_column <= b_valid ? (b_in_e ? e_column : lists_q[20:6]) : head_column;
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
  reg [14:0] left;           // first column of the pair
  wire pair_closed = advance && closes_pair;
  wire right_cut = !c_column[14] && (c_column >= 15'd640);  // the pair ends beside the screen
  wire left_cut = left[14];  // the pair begins beside the screen
  wire some_columns = ($signed(left) < $signed(c_column))  // of the screen
                   && !(!left[14] && (left >= 15'd640))
                   && !c_column[14] && (|c_column);
  wire [14:0] first = left_cut ? 15'd0 : left;
  wire [14:0] behind = right_cut ? 15'd640 : c_column;
  reg [8:0] pair_line;
  reg pair_some;
  reg [14:0] pair_first;
  reg [14:0] pair_behind;

  always @(posedge clk) begin
    if (!half) left <= c_column;
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
    end
  end

  // Stage D: the edge on the next line, and its record written back.
  wire leaves = !entering && (lines_left == 10'd1);  // line y is its last one
  wire [14:0] stepped = c_column + steps_q[58:44] + {14'd0, rest[22]};
  wire [23:0] joined = {rest[22] ? {1'b0, steps_q[21:0]} : ~{1'b0, steps_q[43:22]}, !rest[22]};
  wire [23:0] rest_stepped = {rest, 1'b1} + joined;  // and a carry out of the lowest bit
  reg [22:0] d_rest;                                 // R - f, signed
  reg [9:0] d_lines_left;
  reg writes;                                        // the record of D is written
  wire rests_written = stores || writes;

  always @(posedge clk) begin
    if (rests_written) rests[writes ? {!bank, d_index} : load_place] <= writes ? {d_rest, d_lines_left} : {first_rest, lines};
  end

  always @(posedge clk) begin
    d_rest <= rest_stepped[23:1];
    d_lines_left <= lines_left - 10'd1;
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
  reg [20:0] lists_q2;

  always @(posedge clk) begin
    if (e_valid) lists_q2 <= lists[{!list, read_before}];
  end

  reg [14:0] gap_word_column;  // the word before the gap
  reg [5:0] gap_word_index;    // its number
  reg gap_greater;             // the word before the gap goes behind the edge
  reg fetches;                 // the word before the gap is read
  wire shifts = moving && !fetches && (|gap) && gap_greater;
  wire placed = e_valid && !begins_moving && !fetches && !shifts;  // the edge has its place
  wire [5:0] list_place = moving ? gap : count[5:0];
  wire moved = begins_moving || shifts;

  always @(posedge clk) begin
    if (e_valid) lists[{!list, list_place}] <= {moved ? (shifts ? gap_word_column : top_column) : e_column,
 moved ? (shifts ? gap_word_index : top_index) : e_index};
  end

  wire first_of_list = !(|count) && !e_valid;  // the list is empty, and so is E
  wire d_to_e = advance && d_valid;
  wire d_smaller = $signed(d_column) < $signed(e_valid ? e_column : top_column);

  always @(posedge clk) begin
    next_before <= read_before - 6'd1;
    gap_word_column <= lists_q2[20:6];
    gap_word_index <= lists_q2[5:0];
    gap_greater <= $signed(e_column) < $signed(lists_q2[20:6]);
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
      top_column <= e_column;
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
      head_column <= e_column;
      head_index <= e_index;
    end
    if (d_to_e && first_of_list) begin
      head_column <= d_column;
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
      e_column <= d_column;
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
      d_column <= entering ? steps_q[73:59] : stepped;
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
  assign line_valid = has_span && !down && !along;

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

  wire [9:0] shifted = columns_along >> 1;

  always @(posedge clk) begin
    if (doubles) begin
      columns_along <= shifted;
      along <= |shifted;
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

  // The line that is offered. While no polygon is walked everything takes the next one, again and again.
  always @(posedge clk) begin
    if (takes_pair) begin
      line_y <= pair_line;
      line_cmaj <= pair_first;
      line_cmin <= pair_behind;
    end
  end

  always @(posedge clk) begin
    if (line_fires) line_fresh <= 1'b0;
    if (!walking) line_fresh <= 1'b1;
  end

  // Values: d0 is added once a line. For each set bit i of the number of columns the increment, doubled i times, is added.
  reg [37:0] z_d0;     // step to the next line
  reg [37:0] z_along;  // increment, doubled as often as it was asked for
  wire [37:0] z_added = down ? z_d0 : z_along ^ {38{to_left}};
  wire [38:0] z_moved = {line_z, 1'b1} + {z_added, !down && to_left};  // and a carry out of the lowest bit
  reg [21:0] r_d0;     // step to the next line
  reg [21:0] r_along;  // increment, doubled as often as it was asked for
  wire [21:0] r_added = down ? r_d0 : r_along ^ {22{to_left}};
  wire [22:0] r_moved = {line_r, 1'b1} + {r_added, !down && to_left};  // and a carry out of the lowest bit
  reg [21:0] g_d0;     // step to the next line
  reg [21:0] g_along;  // increment, doubled as often as it was asked for
  wire [21:0] g_added = down ? g_d0 : g_along ^ {22{to_left}};
  wire [22:0] g_moved = {line_g, 1'b1} + {g_added, !down && to_left};  // and a carry out of the lowest bit
  reg [21:0] b_d0;     // step to the next line
  reg [21:0] b_along;  // increment, doubled as often as it was asked for
  wire [21:0] b_added = down ? b_d0 : b_along ^ {22{to_left}};
  wire [22:0] b_moved = {line_b, 1'b1} + {b_added, !down && to_left};  // and a carry out of the lowest bit
  assign pair_leaves = pair_waits && (free || !pair_some);
  assign walking = run || pair_waits || has_span;

  always @(posedge clk) begin
    if (begins) begin
      inc_z <= prim_z_g;
      inc_r <= prim_r_g;
      inc_g <= prim_g_g;
      inc_b <= prim_b_g;
    end
  end

  always @(posedge clk) begin
    if (!walking) begin
      z_d0 <= prim_z_d0;
      r_d0 <= prim_r_d0;
      g_d0 <= prim_g_d0;
      b_d0 <= prim_b_d0;
    end
  end

  always @(posedge clk) begin
    if (doubles) begin
      z_along <= z_along << 1;
      r_along <= r_along << 1;
      g_along <= g_along << 1;
      b_along <= b_along << 1;
    end
    if (takes_pair) begin
      z_along <= inc_z;
      r_along <= inc_r;
      g_along <= inc_g;
      b_along <= inc_b;
    end
    if (!walking) begin
      z_along <= prim_z_start;
      r_along <= prim_r_start;
      g_along <= prim_g_start;
      b_along <= prim_b_start;
    end
  end

  always @(posedge clk) begin
    if (adds) begin
      line_z <= z_moved[38:1];
      line_r <= r_moved[22:1];
      line_g <= g_moved[22:1];
      line_b <= b_moved[22:1];
    end
    if (!walking) begin
      line_z <= 38'd0;
      line_r <= 22'd0;
      line_g <= 22'd0;
      line_b <= 22'd0;
    end
  end

  assign line_major_right = 1'b0;
  assign line_fence = line_fresh;

  // Not needed, on purpose.
  wire unused = &{1'b0, prim_major_right, rest_stepped[0], z_moved[0], r_moved[0], g_moved[0], b_moved[0]};

endmodule

`default_nettype wire
