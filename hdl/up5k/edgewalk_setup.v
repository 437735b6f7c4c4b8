// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 6db543e8dccb

// edgewalk_setup: SETUP turns three vertices, which come word by word, into edges and increments. It is a program.
//
//   words ─> rows of the lanes ─> [A, W] ─> rows, prim
//   ROM ─> word: which row, which step, which result, which word comes next
//   [f, g] ─> digits: which row of a table is added
//
// Formats: see the ports; in centre coordinates pixel centres lie on whole numbers.
// Timing: a word names a row in its first clock, does its step in the second; in the third A and W are written, and leave.
// Rules: docs/machine.md, section 2, prints the program and says what each clause of a word does. A name of a code is the
// part of the word and the clause: ACT_SIDE is `side`, JUMP_NEGATIVE is `negative l`, GIVE_QF is `give qf`.

`timescale 1ns / 1ps
`default_nettype none

module edgewalk_setup (
  input  wire        clk,
  input  wire        rst,

  input  wire        in_valid,
  input  wire [15:0] in_data,           // 18 words a triangle, each in the low bits. Of vertex 0, 1, 2 in turn: x y (Q9.3 px), z (UQ16.0 LSB), r g b (UQ5.0 LSB)
  input  wire        prim_ready,

  output wire        in_ready,
  output wire        prim_valid,
  output reg   [6:0] prim_jm,           // first line
  output reg   [7:0] prim_n1,           // lines of the upper part
  output reg   [7:0] prim_n2,           // lines of the lower part
  output reg         prim_major_right,  // the major edge is the right one
  output reg   [9:0] prim_major_c,      // signed, first column on or right of the edge
  output reg  [11:0] prim_major_dist,   // distance from the edge to that column, 1/M column
  output reg   [9:0] prim_major_q,      // signed, whole columns a line, step of c
  output reg  [11:0] prim_major_f,      // 1/M column a line
  output reg  [11:0] prim_major_m,      // modulus of dist and f: the edge's height; a line has 2^3 units
  output reg   [9:0] prim_minor1_c,     // signed, first column on or right of the edge
  output reg  [11:0] prim_minor1_dist,  // distance from the edge to that column, 1/M column
  output reg   [9:0] prim_minor1_q,     // signed, whole columns a line, step of c
  output reg  [11:0] prim_minor1_f,     // 1/M column a line
  output reg  [11:0] prim_minor1_m,     // modulus of dist and f: the edge's height; a line has 2^3 units
  output reg   [9:0] prim_minor2_c,     // signed, first column on or right of the edge
  output reg  [11:0] prim_minor2_dist,  // distance from the edge to that column, 1/M column
  output reg   [9:0] prim_minor2_q,     // signed, whole columns a line, step of c
  output reg  [11:0] prim_minor2_f,     // 1/M column a line
  output reg  [11:0] prim_minor2_m,     // modulus of dist and f: the edge's height; a line has 2^3 units
  output reg  [25:0] prim_z_start,      // UQ16.10 LSB, modular, value at the first pixel of the first line
  output reg  [25:0] prim_z_d0,         // UQ16.10 LSB, modular, step to the next line, edge without carry
  output reg  [25:0] prim_z_d1,         // UQ16.10 LSB, modular, step to the next line, edge with carry
  output reg  [25:0] prim_z_g,          // UQ16.10 LSB, modular, step to the next pixel of the span
  output reg  [14:0] prim_r_start,      // UQ5.10 LSB, modular, value at the first pixel of the first line
  output reg  [14:0] prim_r_d0,         // UQ5.10 LSB, modular, step to the next line, edge without carry
  output reg  [14:0] prim_r_d1,         // UQ5.10 LSB, modular, step to the next line, edge with carry
  output reg  [14:0] prim_r_g,          // UQ5.10 LSB, modular, step to the next pixel of the span
  output reg  [14:0] prim_g_start,      // UQ5.10 LSB, modular, value at the first pixel of the first line
  output reg  [14:0] prim_g_d0,         // UQ5.10 LSB, modular, step to the next line, edge without carry
  output reg  [14:0] prim_g_d1,         // UQ5.10 LSB, modular, step to the next line, edge with carry
  output reg  [14:0] prim_g_g,          // UQ5.10 LSB, modular, step to the next pixel of the span
  output reg  [14:0] prim_b_start,      // UQ5.10 LSB, modular, value at the first pixel of the first line
  output reg  [14:0] prim_b_d0,         // UQ5.10 LSB, modular, step to the next line, edge without carry
  output reg  [14:0] prim_b_d1,         // UQ5.10 LSB, modular, step to the next line, edge with carry
  output reg  [14:0] prim_b_g           // UQ5.10 LSB, modular, step to the next pixel of the span
);

  // The program.
  wire [7:0] next_place;
  reg [54:0] listing [0:253];  // the program

  initial begin : listing_init
    listing[0] = 55'h4000400000000;     // rest ; words ; unsorted
    listing[1] = 55'h200591;            // load v1.y
    listing[2] = 55'h202d81;            // sub v0.y
    listing[3] = 55'd0;                 // rest
    listing[4] = 55'h8000000000000;     // rest ; swap01
    listing[5] = 55'h2005a1;            // load v2.y
    listing[6] = 55'h202d91;            // sub v1.y
    listing[7] = 55'd0;                 // rest
    listing[8] = 55'hc000000000000;     // rest ; swap12
    listing[9] = 55'h200591;            // load v1.y
    listing[10] = 55'h202d81;           // sub v0.y
    listing[11] = 55'd0;                // rest
    listing[12] = 55'h8000000000000;    // rest ; swap01
    listing[13] = 55'h200581;           // load v0.y
    listing[14] = 55'h200803;           // add up
    listing[15] = 55'h201800;           // mask
    listing[16] = 55'h240000;           // load zero ; if negative
    listing[17] = 55'h202c04;           // sub height[pass]
    listing[18] = 55'h280000;           // load zero ; if positive
    listing[19] = 55'hc6600c04;         // add height[pass] -> j.1
    listing[20] = 55'h200591;           // load v1.y
    listing[21] = 55'h200803;           // add up
    listing[22] = 55'h201800;           // mask
    listing[23] = 55'h240000;           // load zero ; if negative
    listing[24] = 55'h202c04;           // sub height[pass]
    listing[25] = 55'h280000;           // load zero ; if positive
    listing[26] = 55'hc6a00c04;         // add height[pass] -> j.2
    listing[27] = 55'h2005a1;           // load v2.y
    listing[28] = 55'h200803;           // add up
    listing[29] = 55'h201800;           // mask
    listing[30] = 55'h240000;           // load zero ; if negative
    listing[31] = 55'h202c04;           // sub height[pass]
    listing[32] = 55'h280000;           // load zero ; if positive
    listing[33] = 55'hc6e00c04;         // add height[pass] -> j.3
    listing[34] = 55'h202819;           // sub j.1
    listing[35] = 55'h202801;           // sub one
    listing[36] = 55'h200580;           // load v0.x
    listing[37] = 55'h322000000000;     // rest ; negative nolines
    listing[38] = 55'h200803;           // add up
    listing[39] = 55'h201800;           // mask
    listing[40] = 55'h240000;           // load zero ; if negative
    listing[41] = 55'h202c06;           // sub width[pass]
    listing[42] = 55'h280000;           // load zero ; if positive
    listing[43] = 55'hd7e00c06;         // add width[pass] -> i0
    listing[44] = 55'h200590;           // load v1.x
    listing[45] = 55'h200803;           // add up
    listing[46] = 55'h201800;           // mask
    listing[47] = 55'h240000;           // load zero ; if negative
    listing[48] = 55'h202c06;           // sub width[pass]
    listing[49] = 55'h280000;           // load zero ; if positive
    listing[50] = 55'hd8200c06;         // add width[pass] -> i1
    listing[51] = 55'h2005a0;           // load v2.x
    listing[52] = 55'h200803;           // add up
    listing[53] = 55'h201800;           // mask
    listing[54] = 55'h240000;           // load zero ; if negative
    listing[55] = 55'h202c06;           // sub width[pass]
    listing[56] = 55'h280000;           // load zero ; if positive
    listing[57] = 55'h200c06;           // add width[pass]
    listing[58] = 55'hd860285f;         // sub i0 -> tmp
    listing[59] = 55'h200060;           // load i1
    listing[60] = 55'h11200020285f;     // sub i0 ; negative area
    listing[61] = 55'h202061;           // negate tmp
    listing[62] = 55'h112000000000;     // rest ; negative area
    listing[63] = 55'h11200020005f;     // load i0 ; negative area
    listing[64] = 55'h202860;           // sub i1
    listing[65] = 55'd0;                // rest
    listing[66] = 55'h112000000000;     // rest ; negative area
    listing[67] = 55'h50003400000000;   // rest ; drop columns ; goto take
    listing[68] = 55'h2005a1;           // load v2.y
    listing[69] = 55'hd4e02d81;         // sub v0.y -> dv2
    listing[70] = 55'h200591;           // load v1.y
    listing[71] = 55'hd4a02d81;         // sub v0.y -> dv1
    listing[72] = 55'h200590;           // load v1.x
    listing[73] = 55'hc3a02d80;         // sub v0.x -> t1.2
    listing[74] = 55'h100000053;        // factor f dv2
    listing[75] = 55'h200000052;        // factor g dv1
    listing[76] = 55'h200590;           // load v1.x
    listing[77] = 55'hc3e02da0;         // sub v2.x -> t1.3
    listing[78] = 55'h200580;           // load v0.x
    listing[79] = 55'hc3602da0;         // sub v2.x -> t1.1
    listing[80] = 55'hc00000000;        // rest ; settle
    listing[81] = 55'h1c00000020210c;   // negate t1[digits] ; shift
    listing[82] = 55'h105520110c;       // double t1[digits] -> ma.a ; digits
    listing[83] = 55'd0;                // rest
    listing[84] = 55'h10000000000000;   // rest ; side
    listing[85] = 55'h55242054;         // negate ma -> ma.a ; if negative
    listing[86] = 55'h202801;           // sub one
    listing[87] = 55'd0;                // rest
    listing[88] = 55'h326000000000;     // rest ; negative noarea
    listing[89] = 55'h20001a;           // load j.2
    listing[90] = 55'hd4202819;         // sub j.1 -> n1
    listing[91] = 55'h202801;           // sub one
    listing[92] = 55'h20001b;           // load j.3
    listing[93] = 55'h140000d460281a;   // sub j.2 -> n2 ; upper
    listing[94] = 55'h202801;           // sub one
    listing[95] = 55'h200019;           // load j.1
    listing[96] = 55'h180000c62c001a;   // load j.2 -> j.0 ; if no upper ; lower
    listing[97] = 55'h3c000000000000;   // rest ; edge1
    listing[98] = 55'h192800000000;     // rest ; no upper minor2
    listing[99] = 55'h32b800000000;     // rest ; call edge
    listing[100] = 55'h40000000000000;  // rest ; edge2
    listing[101] = 55'h19ec00000000;    // rest ; no lower major
    listing[102] = 55'h32b800000000;    // rest ; call edge
    listing[103] = 55'h3832b800000000;  // rest ; edge0 ; call edge
    listing[104] = 55'h4800010000005b;  // factor f q ; alone
    listing[105] = 55'h200000000;       // factor g zero
    listing[106] = 55'hc5a00053;        // load dv2 -> t3.2
    listing[107] = 55'd0;               // rest
    listing[108] = 55'hc00000000;       // rest ; settle
    listing[109] = 55'h1c000000202114;  // negate t3[digits] ; shift
    listing[110] = 55'h1000201114;      // double t3[digits] ; digits
    listing[111] = 55'h10000005b;       // factor f q
    listing[112] = 55'h200000000;       // factor g zero
    listing[113] = 55'h202da0;          // sub v2.x
    listing[114] = 55'hd7600d80;        // add v0.x -> s2
    listing[115] = 55'hc5a00052;        // load dv1 -> t3.2
    listing[116] = 55'hc00000000;       // rest ; settle
    listing[117] = 55'd0;               // rest
    listing[118] = 55'h1c000000202114;  // negate t3[digits] ; shift
    listing[119] = 55'h1000201114;      // double t3[digits] ; digits
    listing[120] = 55'h10000005b;       // factor f q
    listing[121] = 55'h200000000;       // factor g zero
    listing[122] = 55'h202d90;          // sub v1.x
    listing[123] = 55'hd7200d80;        // add v0.x -> s1
    listing[124] = 55'hc5a0005a;        // load h -> t3.2
    listing[125] = 55'hc00000000;       // rest ; settle
    listing[126] = 55'd0;               // rest
    listing[127] = 55'h1c000000202114;  // negate t3[digits] ; shift
    listing[128] = 55'h1000201114;      // double t3[digits] ; digits
    listing[129] = 55'h200d80;          // add v0.x
    listing[130] = 55'hd8602802;        // sub half -> tmp
    listing[131] = 55'h34000000200328;  // load ec[number] ; last round
    listing[132] = 55'h302808;          // sub pixel ; if right
    listing[133] = 55'hd7a02861;        // sub tmp -> ss
    listing[134] = 55'h20000100000053;  // factor f dv2 ; judge
    listing[135] = 55'h200000052;       // factor g dv1
    listing[136] = 55'h20459f;          // load v1.c ; by side
    listing[137] = 55'hc3a06d8f;        // sub v0.c -> t1.2 ; by side
    listing[138] = 55'h24000000208854;  // R ma ; check
    listing[139] = 55'h20458f;          // load v0.c ; by side
    listing[140] = 55'hc3606daf;        // sub v2.c -> t1.1 ; by side
    listing[141] = 55'h24000000208854;  // R ma ; check
    listing[142] = 55'h20459f;          // load v1.c ; by side
    listing[143] = 55'hc3e06daf;        // sub v2.c -> t1.3 ; by side
    listing[144] = 55'h24000000208854;  // R ma ; check
    listing[145] = 55'd0;               // rest
    listing[146] = 55'hc00000000;       // rest ; settle
    listing[147] = 55'h1c31240020210c;  // negate t1[digits] ; shift ; unfit scale
    listing[148] = 55'h2c25d800209054;  // D ma ; zeros gx1 ; times k
    listing[149] = 55'h20090c;          // add t1[digits]
    listing[150] = 55'h251c00208854;    // R ma ; more gx
    listing[151] = 55'h10000005d;       // factor f s2
    listing[152] = 55'h20000005c;       // factor g s1
    listing[153] = 55'h14c4a09054;      // D ma -> t2.2 ; again
    listing[154] = 55'h209054;          // D ma
    listing[155] = 55'hd8608854;        // R ma -> tmp
    listing[156] = 55'hc00000000;       // rest ; settle
    listing[157] = 55'h1c00000020210c;  // negate t1[digits] ; shift
    listing[158] = 55'h208854;          // R ma
    listing[159] = 55'h2c289800209054;  // D ma ; zeros d01 ; times k
    listing[160] = 55'h20090c;          // add t1[digits]
    listing[161] = 55'h27dc00208854;    // R ma ; more d0
    listing[162] = 55'h10000005e;       // factor f ss
    listing[163] = 55'h20000005a;       // factor g h
    listing[164] = 55'h14c4609054;      // D ma -> t2.1 ; again
    listing[165] = 55'h209054;          // D ma
    listing[166] = 55'hee208854;        // R ma -> c0[number]
    listing[167] = 55'hec204061;        // load tmp -> cg[number] ; by side
    listing[168] = 55'h200012;          // load t2.2
    listing[169] = 55'h200811;          // add t2.1
    listing[170] = 55'hc4e08854;        // R ma -> t2.3
    listing[171] = 55'h209054;          // D ma
    listing[172] = 55'hf0208854;        // R ma -> c1[number]
    listing[173] = 55'hc00000000;       // rest ; settle
    listing[174] = 55'h1c000000202110;  // negate t2[digits] ; shift
    listing[175] = 55'h208854;          // R ma
    listing[176] = 55'h2cd800209054;    // D ma ; zeros st1
    listing[177] = 55'h200910;          // add t2[digits]
    listing[178] = 55'h2c1c00208854;    // R ma ; more st
    listing[179] = 55'h248854;          // R ma ; if negative
    listing[180] = 55'h200dbf;          // add k.c
    listing[181] = 55'h21b0f2220d8f;    // add v0.c -> cs[number] ; raised ; rounds round
    listing[182] = 55'h40000800000000;  // rest ; room ; edge2
    listing[183] = 55'h100000020031c;   // load em[number] ; give m
    listing[184] = 55'h1800000200324;   // load er[number] ; give r
    listing[185] = 55'h1c00000200328;   // load ec[number] ; give c
    listing[186] = 55'h16df000200320;   // load eq[number] ; give qf ; rounds edges
    listing[187] = 55'h400000200018;    // load j.0 ; give jm
    listing[188] = 55'h800000200050;    // load n1 ; give n1
    listing[189] = 55'h34c00000200051;  // load n2 ; give n2 ; last round
    listing[190] = 55'h2c00000200330;   // load cg[number] ; give g
    listing[191] = 55'h2400000200338;   // load c0[number] ; give d0
    listing[192] = 55'h2800000200340;   // load c1[number] ; give d1
    listing[193] = 55'h22fb000200348;   // load cs[number] ; give start ; rounds given
    listing[194] = 55'd0;               // rest
    listing[195] = 55'h58003400000000;  // rest ; done ; goto take
    listing[196] = 55'h200054;          // load ma
    listing[197] = 55'h201000;          // double
    listing[198] = 55'h201000;          // double
    listing[199] = 55'h3021b455201000;  // double -> ma.a ; scale ; goto round
    listing[200] = 55'h4c003400000000;  // rest ; drop lines ; goto take
    listing[201] = 55'h54003400000000;  // rest ; drop area ; goto take
    listing[202] = 55'h28000000200781;  // load b.y ; times t
    listing[203] = 55'h200000e7202e81;  // sub a.y -> em[number] ; judge
    listing[204] = 55'h1455601000;      // double -> me.a ; again
    listing[205] = 55'h200780;          // load b.x
    listing[206] = 55'hd5a02e80;        // sub a.x -> dx
    listing[207] = 55'h24000000208855;  // R me ; check
    listing[208] = 55'h200680;          // load a.x
    listing[209] = 55'hd5e02802;        // sub half -> ua
    listing[210] = 55'h3c64d6201800;    // mask -> um ; unfit slow
    listing[211] = 55'h200218;          // load j[edge]
    listing[212] = 55'h202e81;          // sub a.y
    listing[213] = 55'hd6a00802;        // add half -> h
    listing[214] = 55'h200057;          // load ua
    listing[215] = 55'hd6602858;        // sub um -> ul
    listing[216] = 55'hc3a0231c;        // negate em[number] -> t1.2
    listing[217] = 55'hc3602056;        // negate dx -> t1.1
    listing[218] = 55'h100000059;       // factor f ul
    listing[219] = 55'h20080e;          // add t1.2
    listing[220] = 55'hc3e08855;        // R me -> t1.3
    listing[221] = 55'h20000005a;       // factor g h
    listing[222] = 55'h28000000200056;  // load dx ; times t
    listing[223] = 55'h1400209055;      // D me ; again
    listing[224] = 55'he8248855;        // R me -> eq[number] ; if negative
    listing[225] = 55'h20031c;          // load em[number]
    listing[226] = 55'h202808;          // sub pixel
    listing[227] = 55'h280320;          // load eq[number] ; if positive
    listing[228] = 55'he8240000;        // load zero -> eq[number] ; if negative
    listing[229] = 55'h56e10000;        // load whole -> q.a
    listing[230] = 55'hc00000000;       // rest ; settle
    listing[231] = 55'h1c00000020210c;  // negate t1[digits] ; shift
    listing[232] = 55'h283ad800209055;  // D me ; zeros ed1 ; times t
    listing[233] = 55'h20090c;          // add t1[digits]
    listing[234] = 55'h3a1c00208855;    // R me ; more ed
    listing[235] = 55'h248855;          // R me ; if negative
    listing[236] = 55'he9201800;        // mask -> er[number]
    listing[237] = 55'h212000;          // negate whole
    listing[238] = 55'h1400201000;      // double ; again
    listing[239] = 55'hea200858;        // add um -> ec[number]
    listing[240] = 55'h3c00000000;      // rest ; return
    listing[241] = 55'h100000056;       // factor f dx
    listing[242] = 55'h200000000;       // factor g zero
    listing[243] = 55'hc5a00001;        // load one -> t3.2
    listing[244] = 55'd0;               // rest
    listing[245] = 55'hc00000000;       // rest ; settle
    listing[246] = 55'h1c000000202114;  // negate t3[digits] ; shift
    listing[247] = 55'h208855;          // R me
    listing[248] = 55'h3ed800209055;    // D me ; zeros sl1
    listing[249] = 55'h200914;          // add t3[digits]
    listing[250] = 55'h3e1c00208855;    // R me ; more sl
    listing[251] = 55'hd5a00800;        // add zero -> dx
    listing[252] = 55'd0;               // rest
    listing[253] = 55'h34f400000000;    // rest ; goto fits
  end

  reg [54:0] listing_q;

  always @(posedge clk) begin
    if (1'b1) listing_q <= listing[next_place];
  end

  wire [4:0] act = listing_q[54:50];
  wire [3:0] give = listing_q[49:46];
  wire [7:0] target = listing_q[45:38];
  wire [3:0] jump = listing_q[37:34];
  wire load_g = listing_q[33];
  wire load_f = listing_q[32];
  wire write_w = listing_q[31];
  wire write_a = listing_q[30];
  wire write_numbered = listing_q[29];
  wire [6:0] write_row = listing_q[28:22];
  wire steps = listing_q[21];
  wire [2:0] only = listing_q[20:18];
  wire raised = listing_q[17];
  wire whole = listing_q[16];
  wire by_a = listing_q[15];
  wire by_side = listing_q[14];
  wire minus = listing_q[13];
  wire [1:0] base = listing_q[12:11];
  wire [2:0] mode = listing_q[10:8];
  wire [7:0] row = listing_q[7:0];

  // Codes of the clauses.
  localparam [4:0] ACT_UNSORTED = 5'd1;
  localparam [4:0] ACT_SWAP01 = 5'd2;
  localparam [4:0] ACT_SWAP12 = 5'd3;
  localparam [4:0] ACT_SIDE = 5'd4;
  localparam [4:0] ACT_UPPER = 5'd5;
  localparam [4:0] ACT_LOWER = 5'd6;
  localparam [4:0] ACT_SHIFT = 5'd7;
  localparam [4:0] ACT_JUDGE = 5'd8;
  localparam [4:0] ACT_CHECK = 5'd9;
  localparam [4:0] ACT_TIMES_T = 5'd10;
  localparam [4:0] ACT_TIMES_K = 5'd11;
  localparam [4:0] ACT_SCALE = 5'd12;
  localparam [4:0] ACT_LAST_ROUND = 5'd13;
  localparam [4:0] ACT_EDGE0 = 5'd14;
  localparam [4:0] ACT_EDGE1 = 5'd15;
  localparam [4:0] ACT_EDGE2 = 5'd16;
  localparam [4:0] ACT_ALONE = 5'd18;
  localparam [4:0] ACT_DROP_LINES = 5'd19;
  localparam [4:0] ACT_DROP_COLUMNS = 5'd20;
  localparam [4:0] ACT_DROP_AREA = 5'd21;
  localparam [4:0] ACT_DONE = 5'd22;
  localparam [3:0] JUMP_WORDS = 4'd1;
  localparam [3:0] JUMP_ROOM = 4'd2;
  localparam [3:0] JUMP_SETTLE = 4'd3;
  localparam [3:0] JUMP_DIGITS = 4'd4;
  localparam [3:0] JUMP_AGAIN = 4'd5;
  localparam [3:0] JUMP_ZEROS = 4'd6;
  localparam [3:0] JUMP_MORE = 4'd7;
  localparam [3:0] JUMP_NEGATIVE = 4'd8;
  localparam [3:0] JUMP_UNFIT = 4'd9;
  localparam [3:0] JUMP_NO_UPPER = 4'd10;
  localparam [3:0] JUMP_NO_LOWER = 4'd11;
  localparam [3:0] JUMP_ROUNDS = 4'd12;
  localparam [3:0] JUMP_GOTO = 4'd13;
  localparam [3:0] JUMP_CALL = 4'd14;
  localparam [3:0] JUMP_RETURN = 4'd15;
  localparam [3:0] GIVE_JM = 4'd1;
  localparam [3:0] GIVE_N1 = 4'd2;
  localparam [3:0] GIVE_N2 = 4'd3;
  localparam [3:0] GIVE_M = 4'd4;
  localparam [3:0] GIVE_QF = 4'd5;
  localparam [3:0] GIVE_R = 4'd6;
  localparam [3:0] GIVE_C = 4'd7;
  localparam [3:0] GIVE_START = 4'd8;
  localparam [3:0] GIVE_D0 = 4'd9;
  localparam [3:0] GIVE_D1 = 4'd10;
  localparam [3:0] GIVE_G = 4'd11;
  localparam [2:0] MODE_DIGITS = 3'd1;
  localparam [2:0] MODE_EDGE = 3'd2;
  localparam [2:0] MODE_NUMBER = 3'd3;
  localparam [2:0] MODE_PASS = 3'd4;
  localparam [2:0] MODE_VERTEX = 3'd5;
  localparam [2:0] MODE_UPPER = 3'd6;
  localparam [2:0] MODE_LOWER = 3'd7;
  reg runs;  // the first word is there
  initial runs = 1'b0;

  always @(posedge clk) begin
    if (rst) begin
      runs <= 1'b0;
    end else begin
      runs <= 1'b1;
    end
  end

  // The factors of a sum: the highest bit of each is the digit that has come up.
  reg [13:0] f0;   // factor, signed, left-aligned
  reg [13:0] g0;   // factor, signed, left-aligned
  reg [3:0] left;  // digits that are left, the one that has come up among them
  reg skips;       // leading digits may be left to skip
  reg loads_f;
  reg loads_g;
  wire is_last = left == 4'd1;

  always @(posedge clk) begin
    loads_f <= load_f;
    loads_g <= load_g;
  end

  // Counters and flags.
  reg full;                         // a triangle is there, and worked on
  reg prim_there;                   // a prim is offered
  wire done = (act == ACT_DONE) && runs;
  reg leaves;                       // the prim is offered for the first time
  wire idle = !full && !leaves;
  wire lane0_is_negative;
  reg right;                        // the major edge lies right
  reg upper;                        // the upper part has lines
  reg lower;                        // the lower part has lines
  reg [1:0] place0;                 // number of the vertex there
  reg [1:0] place1;                 // number of the vertex there
  reg [1:0] place2;                 // number of the vertex there
  reg [2:0] number;                 // of the round of channels, or of the edge
  localparam [4:0] ACT_BESIDE = 5'd17;
  wire zero = !(f0[13] || g0[13]);  // both digits are 0
  wire top = ((|f0[13:12]) && !(&f0[13:12])) || ((|g0[13:12]) && !(&g0[13:12]));  // the next digit differs from a sign
  wire top4 = ((|f0[13:9]) && !(&f0[13:9])) || ((|g0[13:9]) && !(&g0[13:9]));  // one of the next four differs from a sign
  wire ends = top || is_last;
  wire by_four = skips && !top4 && (left > 4'd4);
  wire by_one = skips && !ends && !by_four;
  wire consumes = (jump == JUMP_DIGITS) || (jump == JUMP_MORE) || ((jump == JUMP_ZEROS) && zero);  // the digits are done
  wire shifts = consumes || (act == ACT_SHIFT);
  wire [13:0] lane0_factor;
  reg checks;
  reg checked;
  wire lane0_stays;
  reg unfit;                        // a checked number does not fit
  reg [6:0] scale;                  // i: the modulus of channels is the area times 2^i
  reg [6:0] count;                  // doublings that are left
  reg of_channels;                  // they are a channel's

  always @(posedge clk) begin
    if (rst) begin
      prim_there <= 1'b0;
    end else begin
      if (prim_ready) prim_there <= 1'b0;
      if (done) prim_there <= 1'b1;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      leaves <= 1'b0;
    end else begin
      leaves <= done;
    end
  end

  always @(posedge clk) begin
    if ((act == ACT_SIDE) && runs) right <= lane0_is_negative;
  end

  always @(posedge clk) begin
    if ((act == ACT_UPPER) && runs) upper <= !lane0_is_negative;
  end

  always @(posedge clk) begin
    if ((act == ACT_LOWER) && runs) lower <= !lane0_is_negative;
  end

  wire both = (act == ACT_SWAP01) && lane0_is_negative;

  always @(posedge clk) begin
    if (act == ACT_UNSORTED) place0 <= 2'd0;
    if (both) place0 <= place1;
  end

  wire both_2 = (act == ACT_SWAP12) && lane0_is_negative;

  always @(posedge clk) begin
    if (act == ACT_UNSORTED) place1 <= 2'd1;
    if (both) place1 <= place0;
    if (both_2) place1 <= place2;
  end

  always @(posedge clk) begin
    if (act == ACT_UNSORTED) place2 <= 2'd2;
    if (both_2) place2 <= place1;
  end

  always @(posedge clk) begin
    if ((act == ACT_LAST_ROUND) && runs) number <= 3'd3;
    if ((act == ACT_EDGE0) && runs) number <= 3'd0;
    if ((act == ACT_EDGE1) && runs) number <= 3'd1;
    if ((act == ACT_EDGE2) && runs) number <= 3'd2;
    if ((act == ACT_BESIDE) && runs) number <= 3'd0;
    if ((jump == JUMP_ROUNDS) && (|number)) number <= number - 3'd1;
  end

  always @(posedge clk) begin
    if (shifts || by_one) f0 <= f0 << 1;
    if (by_four) f0 <= f0 << 4;
    if (loads_f) f0 <= lane0_factor;
  end

  always @(posedge clk) begin
    if (shifts || by_one) g0 <= g0 << 1;
    if (by_four) g0 <= g0 << 4;
    if (loads_g) g0 <= lane0_factor;
  end

  always @(posedge clk) begin
    if (consumes || by_one) left <= left - 4'd1;
    if (by_four) left <= left - 4'd4;
    if (loads_f || loads_g) left <= 4'd13;
  end

  always @(posedge clk) begin
    if (rst) begin
      skips <= 1'b0;
    end else begin
      if (ends) skips <= 1'b0;
      if (loads_g) skips <= 1'b1;
    end
  end

  always @(posedge clk) begin
    checks <= act == ACT_CHECK;
    checked <= checks;
  end

  always @(posedge clk) begin
    if (checked && lane0_stays) unfit <= 1'b1;
    if (act == ACT_JUDGE) unfit <= 1'b0;
  end

  always @(posedge clk) begin
    if ((act == ACT_LAST_ROUND) && runs) scale <= 7'd0;
    if ((act == ACT_SCALE) && runs) scale <= scale + 7'd3;
  end

  always @(posedge clk) begin
    if (jump == JUMP_AGAIN) count <= count - 7'd1;
    if (act == ACT_TIMES_T) count <= 7'd3;
    if (act == ACT_TIMES_K) count <= 7'd13 + scale;
  end

  always @(posedge clk) begin
    if (act == ACT_TIMES_T) of_channels <= 1'b0;
    if (act == ACT_TIMES_K) of_channels <= 1'b1;
  end

  // The next word.
  reg [7:0] place;  // of the word that is executed
  wire [7:0] behind = place + 8'd1;
  reg [7:0] link;   // of the word behind the call
  wire repeats = ((jump == JUMP_WORDS) && !full)
              || ((jump == JUMP_ROOM) && prim_there)
              || ((jump == JUMP_SETTLE) && (skips || loads_g))
              || ((jump == JUMP_DIGITS) && !is_last)
              || ((jump == JUMP_AGAIN) && !(count == 7'd1))
              || ((jump == JUMP_ZEROS) && zero && !is_last);
  wire jumps = (jump == JUMP_GOTO)
            || (jump == JUMP_CALL)
            || ((jump == JUMP_ZEROS) && zero && is_last)
            || ((jump == JUMP_MORE) && !is_last)
            || ((jump == JUMP_NEGATIVE) && lane0_is_negative)
            || ((jump == JUMP_UNFIT) && unfit)
            || ((jump == JUMP_NO_UPPER) && !upper)
            || ((jump == JUMP_NO_LOWER) && !lower)
            || ((jump == JUMP_ROUNDS) && (|number));
  wire [7:0] choice = repeats ? place : (jump == JUMP_RETURN) ? link : jumps ? target : behind;
  assign next_place = choice & {8{runs}};

  always @(posedge clk) begin
    if (jump == JUMP_CALL) link <= behind;
  end

  always @(posedge clk) begin
    place <= next_place;
  end

  // The words of a triangle.
  reg [1:0] vertex;                                 // of the word that comes; 3: behind the vertices
  reg [3:0] part;                                   // of the vertex: x, y, the channels
  wire fires = in_valid && idle;
  wire closes = part == 4'd5;                       // the last word of a vertex
  wire last = fires && (vertex == 2'd2) && closes;  // the last word of a triangle
  wire coordinate = part < 4'd2;
  wire [3:0] channel = part - 4'd2;

  always @(posedge clk) begin
    if (rst) begin
      part <= 4'd0;
    end else begin
      if (fires) part <= closes ? 4'd0 : part + 4'd1;
      if (last) part <= 4'd0;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      vertex <= 2'd0;
    end else begin
      if (fires && closes) vertex <= vertex + 2'd1;
      if (last) vertex <= 2'd0;
    end
  end

  always @(posedge clk) begin
    if (rst) begin
      full <= 1'b0;
    end else begin
      if (done
       || ((act == ACT_DROP_LINES) && runs)
       || ((act == ACT_DROP_COLUMNS) && runs)
       || ((act == ACT_DROP_AREA) && runs)) begin
        full <= 1'b0;
      end
      if (last) full <= 1'b1;
    end
  end

  // The step, a clock behind its word, and what is written, two clocks behind.
  wire starts_step = steps && runs && !((only == 3'd3) && upper) && !((only == 3'd4) && !right);
  reg [1:0] step_base;
  reg step_minus;
  reg step_by_a;
  reg step_of_whole;
  reg step_only_negative;
  reg step_only_positive;
  reg [6:0] write_row_next;
  reg [6:0] write_row_now;
  reg write_a_next;
  initial write_a_next = 1'b0;
  reg write_a_now;
  initial write_a_now = 1'b0;
  reg write_w_next;
  initial write_w_next = 1'b0;
  reg write_w_now;
  initial write_w_now = 1'b0;
  reg step_raised;
  reg [2:0] step_number;
  reg does_step;
  wire [3:0] value0 = {1'b0, number} + 4'd2;
  wire either = (mode == MODE_VERTEX) || (mode == MODE_UPPER) || (mode == MODE_LOWER);
  wire [1:0] choice_2 = (mode == MODE_UPPER) ? {1'b0, number[1:0] == 2'd2}
                      : (mode == MODE_LOWER) ? ((number[1:0] == 2'd1) ? 2'd1 : 2'd2)
                      : row[5:4];
  wire [1:0] choice_3 = (choice_2 == 2'd0) ? place0
                      : (choice_2 == 2'd1) ? place1
                      : (choice_2 == 2'd2) ? place2
                      : 2'd3;
  wire [7:0] row0 = either ? {2'd2, choice_3, (&row[3:0]) ? value0 : row[3:0]}
                  : (mode == MODE_NUMBER) ? {row[7:3], row[2:0] | number}
                  : (mode == MODE_DIGITS) ? {row[7:2], {f0[13], g0[13]}}
                  : (mode == MODE_EDGE) ? {row[7:2], number[1:0]}
                  : (mode == MODE_PASS) ? {row[7:2], row[1], 1'b0}
                  : row;

  always @(posedge clk) begin
    step_base <= base;
    step_minus <= minus ^ (by_side && right);
    step_by_a <= by_a;
    step_of_whole <= whole;
    step_only_negative <= only == 3'd1;
    step_only_positive <= only == 3'd2;
    write_row_next <= {write_row[6:3], write_row[2:0] | (number & {3{write_numbered}})};
    write_row_now <= write_row_next;
    write_a_next <= write_a && runs;
    write_a_now <= write_a_next;
    write_w_next <= write_w && runs;
    write_w_now <= write_w_next;
    step_raised <= raised;
    step_number <= number;
    does_step <= starts_step;
  end

  // The prim.
  reg [3:0] result_giving;
  reg [3:0] result_given;
  reg [2:0] number_giving;
  reg [2:0] number_given;
  wire [25:0] lane0_rest;
  wire [28:0] lane0_whole;
  wire [11:0] part_2 = in_data[11:0];

  edgewalk_setup_lane0 lane0 (
    .clk           (clk),
    .read_row      (row0),
    .write_row     (fires ? {2'd2, vertex, coordinate ? part : channel + 4'd2} : {1'b0, write_row_now}),
    .write_a       (write_a_now),
    .write_w       (write_w_now),
    .takes         (fires),
    .taken         (coordinate ? {{14{part_2[11]}}, part_2}
: (channel == 4'd3) ? {21'd0, in_data[4:0]}
: (channel == 4'd2) ? {21'd0, in_data[4:0]}
: (channel == 4'd1) ? {21'd0, in_data[4:0]}
: {10'd0, in_data}),
    .steps         (does_step),
    .only_negative (step_only_negative),
    .only_positive (step_only_positive),
    .base          (step_base),
    .minus         (step_minus),
    .by_a          (step_by_a),
    .of_whole      (step_of_whole),
    .raise_13      (step_raised),
    .is_negative   (lane0_is_negative),
    .stays         (lane0_stays),
    .rest          (lane0_rest),
    .whole         (lane0_whole),
    .factor        (lane0_factor)
  );

  always @(posedge clk) begin
    if (done) prim_major_right <= right;
  end

  always @(posedge clk) begin
    result_giving <= give;
    result_given <= result_giving;
    number_giving <= number;
    number_given <= number_giving;
  end

  always @(posedge clk) begin
    if (result_given == GIVE_JM) prim_jm <= lane0_rest[9:3];
  end

  always @(posedge clk) begin
    if (result_given == GIVE_N1) prim_n1 <= lane0_rest[10:3];
  end

  always @(posedge clk) begin
    if (result_given == GIVE_N2) prim_n2 <= lane0_rest[10:3];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_M) && (number_given == 3'd0)) prim_major_m <= lane0_rest[11:0];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_QF) && (number_given == 3'd0)) begin
      prim_major_q <= lane0_whole[9:0];
      prim_major_f <= lane0_rest[14:3];
    end
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_R) && (number_given == 3'd0)) prim_major_dist <= lane0_rest[14:3];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_C) && (number_given == 3'd0)) prim_major_c <= lane0_rest[12:3];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_M) && (number_given == 3'd1)) prim_minor1_m <= lane0_rest[11:0];
    if ((result_given == GIVE_M) && (number_given == 3'd1) && !upper) prim_minor1_m <= 12'd0;
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_QF) && (number_given == 3'd1)) begin
      prim_minor1_q <= lane0_whole[9:0];
      prim_minor1_f <= lane0_rest[14:3];
    end
    if ((result_given == GIVE_QF) && (number_given == 3'd1) && !upper) begin
      prim_minor1_q <= 10'd0;
      prim_minor1_f <= 12'd0;
    end
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_R) && (number_given == 3'd1)) prim_minor1_dist <= lane0_rest[14:3];
    if ((result_given == GIVE_R) && (number_given == 3'd1) && !upper) prim_minor1_dist <= 12'd0;
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_C) && (number_given == 3'd1)) prim_minor1_c <= lane0_rest[12:3];
    if ((result_given == GIVE_C) && (number_given == 3'd1) && !upper) prim_minor1_c <= 10'd0;
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_M) && (number_given == 3'd2)) prim_minor2_m <= lane0_rest[11:0];
    if ((result_given == GIVE_M) && (number_given == 3'd2) && !lower) prim_minor2_m <= 12'd0;
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_QF) && (number_given == 3'd2)) begin
      prim_minor2_q <= lane0_whole[9:0];
      prim_minor2_f <= lane0_rest[14:3];
    end
    if ((result_given == GIVE_QF) && (number_given == 3'd2) && !lower) begin
      prim_minor2_q <= 10'd0;
      prim_minor2_f <= 12'd0;
    end
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_R) && (number_given == 3'd2)) prim_minor2_dist <= lane0_rest[14:3];
    if ((result_given == GIVE_R) && (number_given == 3'd2) && !lower) prim_minor2_dist <= 12'd0;
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_C) && (number_given == 3'd2)) prim_minor2_c <= lane0_rest[12:3];
    if ((result_given == GIVE_C) && (number_given == 3'd2) && !lower) prim_minor2_c <= 10'd0;
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_START) && (number_given == 3'd0)) prim_z_start <= lane0_whole[28:3];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_D0) && (number_given == 3'd0)) prim_z_d0 <= lane0_whole[26:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_D1) && (number_given == 3'd0)) prim_z_d1 <= lane0_whole[26:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_G) && (number_given == 3'd0)) prim_z_g <= lane0_whole[26:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_START) && (number_given == 3'd1)) prim_r_start <= lane0_whole[17:3];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_D0) && (number_given == 3'd1)) prim_r_d0 <= lane0_whole[15:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_D1) && (number_given == 3'd1)) prim_r_d1 <= lane0_whole[15:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_G) && (number_given == 3'd1)) prim_r_g <= lane0_whole[15:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_START) && (number_given == 3'd2)) prim_g_start <= lane0_whole[17:3];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_D0) && (number_given == 3'd2)) prim_g_d0 <= lane0_whole[15:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_D1) && (number_given == 3'd2)) prim_g_d1 <= lane0_whole[15:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_G) && (number_given == 3'd2)) prim_g_g <= lane0_whole[15:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_START) && (number_given == 3'd3)) prim_b_start <= lane0_whole[17:3];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_D0) && (number_given == 3'd3)) prim_b_d0 <= lane0_whole[15:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_D1) && (number_given == 3'd3)) prim_b_d1 <= lane0_whole[15:1];
  end

  always @(posedge clk) begin
    if ((result_given == GIVE_G) && (number_given == 3'd3)) prim_b_g <= lane0_whole[15:1];
  end

  assign in_ready = idle;
  assign prim_valid = prim_there;

  // Not needed, on purpose.
  wire unused = &{1'b0, ACT_ALONE, of_channels, step_number, lane0_rest[25:15]};

endmodule

`default_nettype wire
