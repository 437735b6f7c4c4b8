// The calls of edgewalk.h for SystemVerilog. The head of edgewalk.h says what each takes and gives; codes are numbers
// here, and 0 is EDGEWALK_CODE_OK. Compile this file before your test bench, and link libedgewalk_c.
package edgewalk_dpi;
    // Columns, lines, z, r, g, b and k_t of each vertex in turn.
    typedef real triangle_t [21];

    import "DPI-C" function string edgewalk_message();
    import "DPI-C" function string edgewalk_version();

    import "DPI-C" function int edgewalk_machine_preset(input string name, output chandle machine);
    import "DPI-C" function int edgewalk_machine_toml(input string toml, output chandle machine);
    import "DPI-C" function int unsigned edgewalk_machine_width(input chandle machine);
    import "DPI-C" function int unsigned edgewalk_machine_height(input chandle machine);
    import "DPI-C" function void edgewalk_machine_free(input chandle machine);

    import "DPI-C" function int edgewalk_frame_new(input chandle machine, output chandle frame);
    import "DPI-C" function int edgewalk_frame_lines(input chandle frame, input string lines);
    import "DPI-C" function int edgewalk_frame_triangle(input chandle frame, input real vertices [21]);
    import "DPI-C" function void edgewalk_frame_free(input chandle frame);

    import "DPI-C" function int edgewalk_run_new(input chandle frame, output chandle run);
    import "DPI-C" function int edgewalk_run_tick(input chandle run);
    import "DPI-C" function byte edgewalk_run_is_done(input chandle run);
    import "DPI-C" function longint unsigned edgewalk_run_clocks(input chandle run);
    import "DPI-C" function int edgewalk_run_port(
        input chandle run, input string port, input int unsigned word, output longint unsigned value
    );
    import "DPI-C" function void edgewalk_run_free(input chandle run);
endpackage
