// The Verilog of preset `small` in lock-step with the model: the model's memories and triangles drive both, and every
// output is compared in every clock.
`timescale 1ns / 1ps
`define GIVE(name) name = value_of(`"name`")
`define SAME(name) compare(`"name`", 64'(name))

module lockstep;
    import edgewalk_dpi::*;

    // The ports of hdl/small/edgewalk.v.
    logic        clk = 0, rst = 1;
    logic        tri_valid, rd_ready, data_valid, wr_ready, depth_write;
    logic [11:0] tri_x0, tri_y0, tri_x1, tri_y1, tri_x2, tri_y2;
    logic [15:0] tri_z0, tri_z1, tri_z2, data_z;
    logic [4:0]  tri_r0, tri_g0, tri_b0, tri_r1, tri_g1, tri_b1, tri_r2, tri_g2, tri_b2;
    logic [2:0]  depth_func;
    logic        tri_ready, rd_valid, data_ready, wr_valid, wr_z_en, idle;
    logic [15:0] rd_addr, wr_addr, wr_z;
    logic [4:0]  wr_r, wr_g, wr_b;
    logic [3:0]  activity;
    edgewalk dut (.*);

    chandle machine, frame, run;
    int     checked = 0, wrong = 0;
    real    triangle [21];

    function automatic void check(int code);
        if (code != 0) $fatal(1, "%s", edgewalk_message());
    endfunction

    function automatic longint unsigned value_of(string name);
        longint unsigned value;
        check(edgewalk_run_port(run, name, 0, value));
        return value;
    endfunction

    function automatic void compare(string name, longint unsigned found);
        longint unsigned expected = value_of(name);
        checked++;
        if (found === expected) return;
        wrong++;
        if (wrong <= 5) $display("clock %0d: %s: expected %h, found %h", edgewalk_run_clocks(run), name, expected, found);
    endfunction

    initial begin
        check(edgewalk_machine_preset("small", machine));
        check(edgewalk_frame_new(machine, frame));
        check(edgewalk_frame_lines(frame, "depth lequal"));
        triangle = '{20.0, 10.0, 0.5, 1.0, 0.0, 0.0, 0.0,  90.0, 30.0, 0.4, 0.0, 1.0, 0.0, 0.0,
                     40.0, 75.0, 0.3, 0.0, 0.0, 1.0, 0.0};
        check(edgewalk_frame_triangle(frame, triangle));
        check(edgewalk_run_new(frame, run));
        repeat (3) #5 clk = !clk;
        #5 clk = 0; rst = 0;
        while (edgewalk_run_is_done(run) == 0) begin
            check(edgewalk_run_tick(run)); // the clock whose rising edge comes next
            `GIVE(tri_valid); `GIVE(rd_ready); `GIVE(data_valid); `GIVE(data_z); `GIVE(wr_ready);
            `GIVE(depth_func); `GIVE(depth_write);
            `GIVE(tri_x0); `GIVE(tri_y0); `GIVE(tri_z0); `GIVE(tri_r0); `GIVE(tri_g0); `GIVE(tri_b0);
            `GIVE(tri_x1); `GIVE(tri_y1); `GIVE(tri_z1); `GIVE(tri_r1); `GIVE(tri_g1); `GIVE(tri_b1);
            `GIVE(tri_x2); `GIVE(tri_y2); `GIVE(tri_z2); `GIVE(tri_r2); `GIVE(tri_g2); `GIVE(tri_b2);
            #1;
            `SAME(rd_valid); `SAME(wr_valid); `SAME(activity); `SAME(idle);
            if (tri_valid)  `SAME(tri_ready);
            if (data_valid) `SAME(data_ready);
            if (rd_valid)   `SAME(rd_addr);
            if (wr_valid) begin
                `SAME(wr_addr); `SAME(wr_z); `SAME(wr_z_en); `SAME(wr_r); `SAME(wr_g); `SAME(wr_b);
            end
            #4 clk = 1;
            #5 clk = 0;
        end
        $display("checked %0d, %0d differ", checked, wrong);
        if (checked == 0 || wrong != 0) $display("FAIL");
        else $display("PASS");
        edgewalk_run_free(run);
        edgewalk_frame_free(frame);
        edgewalk_machine_free(machine);
        $finish;
    end
endmodule
