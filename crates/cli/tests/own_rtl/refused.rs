//! Descriptions and designs that do not fit: refused before a simulator starts.

use super::{edgewalk, edit, folder, told};
use std::process::Command;

/// A folder of programs in which there is Yosys, and no simulator.
fn yosys_alone() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let path = std::env::var_os("PATH").expect("a path");
    let yosys = std::env::split_paths(&path).map(|folder| folder.join("yosys")).find(|file| file.is_file());
    std::os::unix::fs::symlink(yosys.expect("yosys is installed"), folder.path().join("yosys"))
        .expect("a link");
    folder
}

/// Changes of `pixel.toml` and what is said of them: each is refused before a simulator starts.
const REFUSED: [(&str, &str, &str); 37] = [
    (
        "[in.span]",
        "[ports]\nactive = \"nosuch\"\n\n[in.span]",
        "ports.active: my_pixel has no port nosuch for active; permitted: ",
    ),
    ("[in.span]", "[in.span", "line 13: unclosed table"),
    ("unit = \"pixel\"", "unit = 7", "unit: 7; permitted: a text in quotes"),
    ("unit = \"pixel\"\n", "", "unit: missing; permitted: a value"),
    ("unit = \"pixel\"", "unit = \"pixle\"", "unit: \"pixle\"; permitted: machine, setup, "),
    (
        "unit = \"pixel\"",
        "unit = \"blend\"",
        "unit: blend, which the machine has not; permitted: machine, setup, ",
    ),
    ("unit = \"pixel\"", "untt = \"pixel\"", "unit: missing"),
    (
        "top = \"my_pixel\"",
        "top = \"my_pixl\"",
        "top: no module my_pixl in the files; permitted: my_pixel; nearest: my_pixel",
    ),
    ("top = \"my_pixel\"", "top = \"my pixel\"", "top: \"my pixel\"; permitted: a name of Verilog"),
    ("top = \"my_pixel\"", "top = \"\"", "top: \"\"; permitted: a name of Verilog"),
    ("[\"my_pixel.v\"]", "[\"none.v\"]", "files: \"none.v\": no such file; permitted: files that are there"),
    ("[\"my_pixel.v\"]", "[]", "files: []; permitted: one file or more"),
    ("[\"my_pixel.v\"]", "\"my_pixel.v\"", "files: \"my_pixel.v\"; permitted: a list of texts"),
    ("[\"my_pixel.v\"]", "[\"my_pixel.v\", 3]", "files: [\"my_pixel.v\", 3]; permitted: a list of texts"),
    ("[\"my_pixel.v\"]", "[\"pixel.toml\"]", "permitted: *.v, *.sv"),
    ("[\"my_pixel.v\"]", "[\"my_pixel.v\"]\ninclude = [\"inc\"]", "include: \"inc\": no such folder"),
    (
        "clock = \"aclk\"",
        "clok = \"aclk\"",
        "clok: unknown key, clok = \"aclk\"; permitted: unit, top, files, ",
    ),
    ("clock = \"aclk\"", "clock = \"aclck\"", "nearest: aclk"),
    ("active = \"low\"", "active = \"lo\"", "reset.active: \"lo\"; permitted: high, low; nearest: low"),
    (
        "kind = \"asynchronous\"",
        "knid = \"asynchronous\"",
        "reset.knid: unknown key, knid = \"asynchronous\"; permitted: port, active, kind, cycles; nearest: kind",
    ),
    ("kind = \"asynchronous\"", "cycles = 0", "reset.cycles: 0; permitted: a whole number, 1 to 1000"),
    (
        "reset = { port = \"aresetn\", active = \"low\", kind = \"asynchronous\" }",
        "reset = \"aresetn\"",
        "reset: \"aresetn\"; permitted: a table, [reset]",
    ),
    (
        "compare = \"order\"",
        "compare = \"cycel\"",
        "compare: \"cycel\"; permitted: order, cycle; nearest: cycle",
    ),
    ("compare = \"order\"", "compare = \"cycle\"", "ports.active: my_pixel has no port active for active"),
    (
        "compare = \"order\"",
        "compare = \"order\"\nwidths = \"cut\"",
        "widths: \"cut\"; permitted: equal, extend, unchecked",
    ),
    (
        "compare = \"order\"",
        "compare = \"order\"\npatience = -1",
        "patience: -1; permitted: a whole number, 1 to 16777216",
    ),
    ("ZW = 38", "ZW = 36", "in.span.fields.z: port s_z has 36 bits; permitted: 38 bits for span_z"),
    (
        "ZW = 38",
        "ZW = 40",
        "in.span.fields.z: port s_z has 40 bits; permitted: 38 bits for span_z; or set widths = \"extend\"",
    ),
    ("ZW = 38", "ZM = 38", "parameters.ZM: my_pixel has no parameter ZM; permitted: CW, ZW; nearest: ZW"),
    ("ZW = 38", "ZW = 38.5", "parameters.ZW: 38.5; permitted: a whole number of 32 bits"),
    ("[in.span]", "[in.spam]", "in.spam: pixel has no channel in spam; permitted: span; nearest: span"),
    (
        "prefix = \"s_\"",
        "prefix = \"t_\"",
        "in.span.valid: my_pixel has no port t_valid for span_valid; permitted: ",
    ),
    (
        "y = \"s_line\"",
        "y = \"s_lnie\"",
        "in.span.fields.y: my_pixel has no port s_lnie for span_y; permitted: ",
    ),
    (
        "y = \"s_line\"",
        "y = \"s_column\"",
        "in.span.fields.y: port s_column, which stands for in.span.fields.x; permitted: a port of its own",
    ),
    (
        "count = \"s_pixels\"",
        "cuont = \"s_pixels\"",
        "in.span.fields.cuont: the channel has no field cuont; permitted: x, y, count, ",
    ),
    (
        "\"fence\", \"b\", ",
        "\"b\", ",
        "out.frag.order: [\"b\", \"g\", \"r\", \"z\", \"addr\"]; permitted: each of addr, z, r, g, b, fence once",
    ),
    (
        "packed = \"m_data\"",
        "packed = \"m_valid\"",
        "out.frag.packed: port m_valid, which stands for out.frag.valid",
    ),
];

#[test]
fn a_wrong_description_is_refused_before_simulation() {
    let programs = yosys_alone();
    let mut wrong = Vec::new();
    for (from, to, said) in REFUSED {
        let folder = folder();
        edit(folder.path(), "pixel.toml", from, to);
        let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
        command.args(["verify", "--dut", "pixel.toml"]).current_dir(&folder).env("PATH", programs.path());
        let (code, text) = told(&command.output().expect("the program runs"));
        let one_line = text.trim_end().lines().count() == 1;
        if code != Some(2) || !one_line || !text.starts_with("error: pixel.toml: ") || !text.contains(said) {
            wrong.push(format!("{to}: wanted {said}\n    {code:?} {text}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // A right one comes as far as the simulator, which is not there.
    let folder = folder();
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.args(["verify", "--dut", "pixel.toml"]).current_dir(&folder).env("PATH", programs.path());
    assert_eq!(command.output().expect("the program runs").status.code(), Some(3));
}

/// Ports without a meaning, of the wrong direction, and fields that the bench cannot do without.
#[test]
fn a_design_that_does_not_fit_is_refused() {
    for (file, from, to, said) in [
        (
            "my_pixel.v",
            "input  wire          m_ready",
            "input  wire          m_ready, enable",
            "pixel.toml: tie: input enable of my_pixel stands for nothing; permitted: every input has a value; name what it stands for, or hold it: [tie] enable = 0",
        ),
        (
            "my_pixel.v",
            "output wire          s_ready",
            "input wire          s_ready",
            "in.span.ready: port s_ready is an input; permitted: an output for span_ready",
        ),
        ("my_pixel.v", "endmodule", "endmodul", "pixel.toml: files: "),
        (
            "depth.toml",
            "[out.wr]\n",
            "[out.wr]\nabsent = [\"ready\", \"z\"]\n",
            "depth.toml: out.wr.absent: z, which `fields` gives a port",
        ),
        (
            "depth.toml",
            "z_en = \"w_z_en\"\n",
            "\n[out.rd]\nabsent = [\"addr\"]\n",
            "out.rd.absent: rd_addr, by which the bench keeps the memory depth",
        ),
        (
            "depth.toml",
            "depth_func = ",
            "depth_fnc = ",
            "ports.depth_fnc: depth has no port depth_fnc outside its channels; permitted: depth_func, depth_write, ",
        ),
        (
            "depth.toml",
            "[ports]",
            "[tie]\nfunc = 9\n[ports]",
            "tie.func: port func, which stands for ports.depth_func",
        ),
        (
            "depth.toml",
            "depth_func = \"func\"\ndepth_write = \"z_write\"",
            "depth_write = \"z_write\"\nabsent = [\"depth_func\"]\n[tie]\nfunc = 9",
            "tie.func: 9; permitted: 0 to 7, as the port has 3 bits",
        ),
    ] {
        let folder = folder();
        edit(folder.path(), file, from, to);
        let dut = if file == "my_pixel.v" { "pixel.toml" } else { "depth.toml" };
        let (code, text) = told(&edgewalk(folder.path(), &["verify", "--dut", dut]));
        assert_eq!(code, Some(2), "{to}: {text}");
        assert!(text.contains(said), "{to}: {text}");
    }
}

/// What only a simulator finds in a design is the design's fault too, and --no-simulators is no way around it.
#[test]
fn a_design_that_a_simulator_refuses_is_no_missing_tool() {
    let unchecked = ("depth.toml", "widths = \"extend\"", "widths = \"unchecked\"");
    let unbound = ("my_depth.v", "endmodule", "reg q; initial q = undefined_thing;\nendmodule");
    let typed = ("my_depth.v", "input  wire [23:0] f_rgb", "input  pk::rgb_t f_rgb");
    for (simulator, edits, said) in [
        ("icarus", vec![unchecked], "port f_z of my_depth: found 32 bits, needed 24"),
        ("icarus", vec![unbound], "undefined_thing"),
        (
            "icarus",
            vec![unchecked, typed],
            "icarus does not run the design; correct its files or its description:",
        ),
        ("verilator", vec![unchecked, typed], "verilator does not run the design"),
    ] {
        let folder = folder();
        for (file, from, to) in edits {
            edit(folder.path(), file, from, to);
        }
        let arguments = ["verify", "--dut", "depth.toml", "--simulator", simulator, "--only", "flat_top"];
        let (code, text) = told(&edgewalk(folder.path(), &arguments));
        assert_eq!(code, Some(2), "{said}: {text}");
        assert!(text.contains(said) && !text.contains("no-simulators"), "{said}: {text}");
    }
}

/// A parameter may be negative: the ports that Yosys tells are those of the simulator.
#[test]
fn a_parameter_may_be_negative() {
    let folder = folder();
    edit(folder.path(), "my_depth.v", "parameter QUEUE", "parameter LESS = 0, parameter QUEUE");
    edit(folder.path(), "my_depth.v", "input  wire [31:0] f_z", "input  wire [32+LESS:0] f_z");
    edit(folder.path(), "depth.toml", "QUEUE = 6", "QUEUE = 6\nLESS = -1");
    let arguments = ["verify", "--dut", "depth.toml", "--simulator", "icarus", "--only", "flat_top"];
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert_eq!(code, Some(0), "{text}");
}
