//! A design of another hand in place of ours, through the program: `docs/own_rtl/*.toml` and what may be wrong with them.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const PIXEL: &str = include_str!("../../../docs/own_rtl/pixel.toml");
const DEPTH: &str = include_str!("../../../docs/own_rtl/depth.toml");
const MY_PIXEL: &str = include_str!("../../../docs/own_rtl/my_pixel.v");
const MY_DEPTH: &str = include_str!("../../../docs/own_rtl/my_depth.v");

/// A folder with both designs and their descriptions.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let files =
        [("pixel.toml", PIXEL), ("depth.toml", DEPTH), ("my_pixel.v", MY_PIXEL), ("my_depth.v", MY_DEPTH)];
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("written");
    }
    folder
}

/// Replaces a text of a file, which must have it once or more.
fn edit(folder: &Path, name: &str, from: &str, to: &str) {
    let text = fs::read_to_string(folder.join(name)).expect("a file");
    assert!(text.contains(from), "{name} has no `{from}`");
    fs::write(folder.join(name), text.replacen(from, to, 1)).expect("written");
}

fn edgewalk(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.args(arguments).current_dir(folder).output().expect("the program runs")
}

fn told(output: &Output) -> (Option<i32>, String) {
    let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    (output.status.code(), text)
}

/// Both designs pass every suite of their unit in Icarus; the report says what was not compared.
#[test]
fn designs_of_another_hand_pass_in_icarus() {
    for (file, least, not_compared) in [
        ("pixel.toml", 16_000, "not compared: active, visible, advance, occupied"),
        ("depth.toml", 28_000, "not compared: hazard, full, occupied"),
    ] {
        let folder = folder();
        let arguments = ["verify", "--dut", file, "--simulator", "icarus", "--junit", "out/results.xml"];
        let (code, text) = told(&edgewalk(folder.path(), &arguments));
        assert_eq!(code, Some(0), "{text}");
        assert!(text.lines().any(|line| line == not_compared), "{text}");
        let counts = text.lines().filter_map(|line| line.split_once("checked ")?.1.split_once(" / "));
        let counts: Vec<(u64, u64)> =
            counts.map(|(n, of)| (n.parse().expect("a number"), of.parse().expect("a number"))).collect();
        assert!(counts.iter().all(|(n, of)| n == of && *n > 0), "{text}");
        assert!(counts.iter().map(|(n, _)| n).sum::<u64>() > least, "{text}");
        let xml = fs::read_to_string(folder.path().join("out/results.xml")).expect("written");
        assert!(xml.contains(&format!("tests=\"{}\" failures=\"0\"", counts.len())), "{xml}");
    }
}

#[test]
fn a_design_of_another_hand_passes_in_verilator() {
    let folder = folder();
    let (code, text) =
        told(&edgewalk(folder.path(), &["verify", "--dut", "pixel.toml", "--simulator", "verilator"]));
    assert_eq!(code, Some(0), "{text}");
    assert!(
        text.contains("pass  directed        pixel    model = verilator  checked 15734 / 15734"),
        "{text}"
    );
}

/// A fault of one of the designs.
struct Fault {
    file: &'static str,
    from: &'static str,
    to: &'static str,
    /// A case that shows it.
    case: &'static str,
    /// What the report says of it.
    said: &'static str,
}

const fn fault(
    file: &'static str,
    from: &'static str,
    to: &'static str,
    case: &'static str,
    said: &'static str,
) -> Fault {
    Fault { file, from, to, case, said }
}

const LONG: &str = "guard_band_to_guard_band_on_a_line";
const FUNCTIONS: &str = "nearer_equal_and_farther_than_the_cleared_depth";

const FAULTS: [Fault; 12] = [
    fault("my_pixel.v", "column < 640", "column < 639", LONG, "case guard_band_to_guard_band_on_a_line"),
    fault("my_pixel.v", "left ? column - 1", "left ? column + 1", "flat_top", "frag_addr: expected "),
    fault("my_pixel.v", "dr <= step_r", "dr <= step_g", "flat_top", "frag_r: expected "),
    fault(
        "my_pixel.v",
        "fence <= 1'b0;",
        "fence <= fence;",
        "flat_top",
        "frag_fence: expected 0 (0), found 1 (1)",
    ),
    fault("my_pixel.v", "z[ZW-1-:24]", "z[ZW-2-:24]", "flat_top", "frag_z: expected "),
    fault(
        "my_pixel.v",
        "stage_valid <= 1'b1;",
        "stage_valid <= pixels != 1;",
        "flat_top",
        "frag_addr: expected 00407 (1031), found 00801 (2049)",
    ),
    fault("my_pixel.v", "if (!m_valid || m_ready) begin", "begin", "flat_top", "frag: cycle "),
    fault("my_depth.v", "less ? func[0]", "less ? func[1]", "flat_top", "wr: "),
    fault(
        "my_depth.v",
        "addr[(first + i) & 15] == f_addr",
        "1'b0",
        "one_pixel_again_nearer_and_farther",
        "wr: ",
    ),
    fault(
        "my_depth.v",
        "w_z_en <= z_write",
        "w_z_en <= 1'b1",
        FUNCTIONS,
        "wr_z_en: expected 0 (0), found 1 (1)",
    ),
    fault(
        "my_depth.v",
        "{8'b0, new_z}",
        "{8'b1, new_z}",
        "flat_top",
        "a wider port holds more than its value extended",
    ),
    fault("my_depth.v", "rgb[free] <= f_rgb", "rgb[free] <= f_rgb | 1", "flat_top", "wr_b: expected "),
];

/// Each fault under this simulator: exit code 1, and in Icarus the words for it.
fn faults_fail(simulator: &str, faults: impl Iterator<Item = &'static Fault>) {
    for Fault { file, from, to, case, said } in faults {
        let folder = folder();
        edit(folder.path(), file, from, to);
        let dut = file.replace("my_", "").replace(".v", ".toml");
        let arguments = ["verify", "--dut", &dut, "--simulator", simulator, "--only", case];
        let (code, text) = told(&edgewalk(folder.path(), &arguments));
        assert_eq!(code, Some(1), "{to}: {text}");
        assert!(text.contains("FAIL  "), "{to}: {text}");
        assert!(simulator != "icarus" || text.contains(said), "{to} without `{said}`: {text}");
    }
}

#[test]
fn faults_of_both_designs_fail_in_icarus() {
    faults_fail("icarus", FAULTS.iter());
}

/// Not part of the test run: a dozen builds. `cargo test --release -p edgewalk-cli own_rtl:: -- --ignored`
#[test]
#[ignore = "three minutes"]
fn faults_of_both_designs_fail_in_verilator() {
    let folder = folder();
    let arguments = ["verify", "--dut", "depth.toml", "--simulator", "verilator"];
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert_eq!(code, Some(0), "{text}");
    // Verilator runs the directed suites alone, and these are drawn with depth writes.
    faults_fail("verilator", FAULTS.iter().filter(|fault| fault.case != FUNCTIONS));
}

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
const REFUSED: [(&str, &str, &str); 36] = [
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

fn made(folder: &Path, directory: &str, targets: &[&str]) -> (bool, String) {
    let mut command = Command::new("make");
    let output = command
        .args(["-C", directory])
        .args(targets)
        .current_dir(folder)
        .output()
        .expect("make is installed");
    (output.status.success(), told(&output).1)
}

/// The directory of vectors of one's own design: its Makefile compiles the files where they are, after an edit too.
#[test]
fn vectors_are_wired_to_the_design() {
    let folder = folder();
    let arguments = ["vectors", "--dut", "pixel.toml", "--suite", "hazards", "--no-csv", "--out", "v"];
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert_eq!(code, Some(0), "{text}");
    let (passed, said) = made(folder.path(), "v/hazards_pixel", &["icarus"]);
    assert!(passed && said.lines().any(|line| line == "checked 350 / 350"), "{said}");
    let (passed, said) = made(folder.path(), "v/hazards_pixel", &["lint"]);
    assert!(passed, "{said}");
    let text = fs::read(folder.path().join("v/hazards_pixel/manifest.json")).expect("written");
    let manifest: Value = serde_json::from_slice(&text).expect("JSON");
    assert_eq!(manifest["dut"]["top"], "my_pixel");
    assert_eq!(
        manifest["dut"]["ports"]["frag_z"],
        serde_json::json!({ "port": "m_data", "lsb": 19, "width": 24 })
    );
    assert_eq!(manifest["dut"]["ports"]["span_count"]["port"], "s_pixels");
    assert_eq!(manifest["expected"], 350);
    edit(folder.path(), "my_pixel.v", "dr <= step_r", "dr <= step_g");
    let (passed, said) = made(folder.path(), "v/hazards_pixel", &["icarus"]);
    assert!(!passed && said.lines().any(|line| line == "FAIL"), "{said}");
}

/// Our own PIXEL under other names passes in every cycle; a register more does not, as its cycles differ.
#[test]
fn cycles_and_status_are_compared_where_asked() {
    let folder = folder();
    let arguments = ["vectors", "--unit", "pixel", "--suite", "hazards", "--no-csv", "--out", "v"];
    assert_eq!(told(&edgewalk(folder.path(), &arguments)).0, Some(0));
    let ours =
        fs::read_to_string(folder.path().join("v/hazards_pixel/hdl/edgewalk_pixel.v")).expect("written");
    let renamed = ours.replace("module edgewalk_pixel", "module theirs").replace("active", "busy");
    assert!(renamed.contains("output reg         busy"), "{renamed}");
    fs::write(folder.path().join("theirs.v"), renamed).expect("written");
    let dut = "unit = \"pixel\"\ntop = \"theirs\"\nfiles = [\"th*.v\"]\ncompare = \"cycle\"\n[ports]\nactive = \"busy\"\n";
    fs::write(folder.path().join("theirs.toml"), dut).expect("written");
    let verify = |file: &str| {
        let arguments =
            ["verify", "--dut", file, "--simulator", "icarus", "--only", "one_pixel_again_and_again_nearer"];
        told(&edgewalk(folder.path(), &arguments))
    };
    let (code, text) = verify("theirs.toml");
    assert!(code == Some(0) && text.contains("pass  hazards         pixel"), "{text}");
    assert!(!text.contains("not compared") && !text.contains("corners"), "{text}");
    edit(folder.path(), "theirs.v", "assign occupied = ", "assign occupied = !");
    let (code, text) = verify("theirs.toml");
    assert!(code == Some(1) && text.contains("occupied: expected "), "{text}");
}

/// Ports that the design has not: a ready that is not asked, an input held, a signed field in a wider port.
#[test]
fn absent_tied_and_wider_ports_are_wired() {
    let folder = folder();
    let path = folder.path();
    edit(path, "my_pixel.v", "input  wire          m_ready", "input  wire [1:0]     enable");
    edit(path, "my_pixel.v", "input  wire [14:0]   s_column", "input  wire [17:0]   s_column");
    edit(
        path,
        "my_pixel.v",
        "wire         on_screen   = !column[14]",
        "wire m_ready = enable == 2;\n  wire on_screen = !column[14]",
    );
    edit(
        path,
        "my_pixel.v",
        "column <= s_column",
        "column <= {s_column[17], s_column[17] ^ s_column[16] ^ s_column[13], s_column[12:0]}",
    );
    edit(path, "pixel.toml", "compare = \"order\"", "compare = \"order\"\nwidths = \"extend\"");
    edit(path, "pixel.toml", "[in.span]", "[tie]\nenable = 2\n\n[in.span]");
    edit(path, "pixel.toml", "[out.frag]", "[out.frag]\nabsent = [\"ready\"]");
    let arguments =
        ["verify", "--dut", "pixel.toml", "--simulator", "icarus", "--only", "flat_top", "--only", LONG];
    let (code, text) = told(&edgewalk(path, &arguments));
    assert_eq!(code, Some(0), "{text}");
    edit(path, "pixel.toml", "enable = 2", "enable = 1");
    let (code, text) = told(&edgewalk(path, &arguments));
    assert_eq!(code, Some(1), "{text}");
}

/// `--only` keeps the triangles of its cases as they are in the suite, and no others.
#[test]
fn cases_are_replayed_alone() {
    let folder = folder();
    let run = |arguments: &[&str]| {
        let common = ["vectors", "--unit", "setup", "--suite", "corners", "--stalls", "none", "--no-csv"];
        told(&edgewalk(folder.path(), &[&common[..], arguments].concat()))
    };
    assert_eq!(run(&["--out", "all"]).0, Some(0));
    let (code, text) = run(&["--out", "one", "--only", "flat_top"]);
    assert_eq!(code, Some(0), "{text}");
    let file = |name: &str| -> PathBuf { folder.path().join(name) };
    let tokens = |name: &str| fs::read_to_string(file(name)).expect("written");
    let manifest: Value = serde_json::from_str(&tokens("all/corners_setup/manifest.json")).expect("JSON");
    let cases = manifest["suite"]["cases"].as_array().expect("a list");
    let case = cases.iter().find(|case| case["name"] == "flat_top").expect("a case");
    let (first, count) =
        (case["first"].as_u64().expect("a number"), case["count"].as_u64().expect("a number"));
    let all = tokens("all/corners_setup/tri.in.mem");
    let wanted: Vec<&str> = all.lines().skip(first as usize).take(count as usize).collect();
    let one = tokens("one/corners_setup/tri.in.mem");
    assert_eq!(one.lines().collect::<Vec<_>>(), wanted);
    let (code, text) = run(&["--out", "none", "--only", "flat_tpo"]);
    assert!(code == Some(2) && text.contains("--only: unknown case flat_tpo; permitted: "), "{text}");
    assert!(text.contains("nearest: flat_top"), "{text}");
}

/// The example of the documents is the file that passes, and every key of a description stands there.
#[test]
fn the_page_shows_the_description_and_all_keys() {
    let page = include_str!("../../../docs/own_rtl.md");
    assert!(page.contains(&format!("```toml\n{PIXEL}```\n")));
    let permitted = |text: &str| -> Vec<String> {
        let folder = folder();
        edit(
            folder.path(),
            "pixel.toml",
            "[in.span]\nprefix",
            &format!("{text}\n[in.span]\nnosuch = 1\nprefix"),
        );
        let (_, said) = told(&edgewalk(folder.path(), &["verify", "--dut", "pixel.toml"]));
        let (_, list) = said.split_once("permitted: ").unwrap_or_else(|| panic!("{said}"));
        list.trim().split(", ").map(str::to_owned).collect()
    };
    let of_a_channel = permitted("");
    assert_eq!(of_a_channel.len(), 7, "{of_a_channel:?}");
    for key in of_a_channel {
        assert!(page.contains(&format!("`{key}`")) || page.contains(&format!("`{key}.NAME`")), "{key}");
    }
    let folder = folder();
    edit(folder.path(), "pixel.toml", "clock = ", "clok = ");
    edit(folder.path(), "pixel.toml", "top = ", "nosuch = 1\nclock = \"aclk\"\ntop = ");
    let (_, said) = told(&edgewalk(folder.path(), &["verify", "--dut", "pixel.toml"]));
    let (_, list) = said.split_once("permitted: ").unwrap_or_else(|| panic!("{said}"));
    let (list, _) = list.split_once(';').unwrap_or((list, ""));
    assert_eq!(list.split(", ").count(), 14, "{said}");
    for key in list.trim().split(", ").filter(|key| !["reset", "in", "out"].contains(key)) {
        assert!(page.contains(&format!("`{key}`")) || page.contains(&format!("`[{key}]`")), "{key}");
    }
}
