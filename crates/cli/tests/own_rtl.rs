//! A design of another hand in place of ours, through the program: `docs/own_rtl/*.toml` and what may be wrong with them.

mod faults;
mod memory_inside;
mod refused;
mod rules;

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const PIXEL: &str = include_str!("../../../docs/own_rtl/pixel.toml");
const DEPTH: &str = include_str!("../../../docs/own_rtl/depth.toml");
const MY_PIXEL: &str = include_str!("../../../docs/own_rtl/my_pixel.v");
const MY_DEPTH: &str = include_str!("../../../docs/own_rtl/my_depth.v");

/// Cases of the suites that a test asks for by name.
const LONG: &str = "guard_band_to_guard_band_on_a_line";
const FUNCTIONS: &str = "nearer_equal_and_farther_than_the_cleared_depth";

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
        text.contains("pass  directed        pixel    model = verilator  checked 15787 / 15787"),
        "{text}"
    );
}

/// Lists of the report behind these words, without counts and reasons.
fn listed<'a>(text: &'a str, head: &str) -> Vec<&'a str> {
    let line = text.lines().find_map(|line| line.strip_prefix(head)).unwrap_or_default();
    line.split(", ").map(|word| word.split(' ').next().unwrap_or(word)).collect()
}

/// Of the events of the unit the report says which the design met, and which no port of it shows.
#[test]
fn events_of_the_designs_own_run_are_told() {
    let folder = folder();
    let arguments = ["verify", "--dut", "depth.toml", "--simulator", "icarus", "--only", "flat_top"];
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert_eq!(code, Some(0), "{text}");
    assert_eq!(listed(&text, "events met: "), ["depth_fail", "memory_stall", "write_stall"], "{text}");
    assert!(text.contains("queue_full (no port for full)\n"), "{text}");
    let hidden = ["forward_compare", "forward_used", "forward_write", "queue_full"];
    assert_eq!(listed(&text, "not to be seen: "), hidden, "{text}");
    let arguments = ["verify", "--dut", "pixel.toml", "--simulator", "icarus", "--only", "flat_top"];
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert_eq!(code, Some(0), "{text}");
    assert_eq!(
        (listed(&text, "events met: "), listed(&text, "not met: ")),
        (vec!["fence"], vec!["off_screen"])
    );
    edit(folder.path(), "pixel.toml", "\"fence\", ", "");
    edit(folder.path(), "pixel.toml", "prefix = \"m_\"", "prefix = \"m_\"\nabsent = [\"fence\"]");
    edit(folder.path(), "my_pixel.v", "output reg  [67:0]   m_data", "output reg  [66:0]   m_data");
    edit(folder.path(), "my_pixel.v", "m_data  <= stage;", "m_data  <= stage[66:0];");
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert!(code == Some(0) && text.contains("not to be seen: fence (no port for frag_fence)"), "{text}");
}

/// What the bench counts at the ports of our own DEPTH is what the model counts.
#[test]
fn events_at_the_ports_are_those_of_the_model() {
    let folder = folder();
    let own = "unit = \"depth\"\ntop = \"edgewalk_depth\"\nfiles = [\"v/hazards_depth/hdl/*.v\"]\ncompare = \"cycle\"\n";
    fs::write(folder.path().join("own.toml"), own).expect("written");
    let mut counted = 0;
    for hazard in ["forward", "interlock", "drain"] {
        let key = format!("memory.hazard={hazard}");
        let set = ["--set", &key, "--only", "one_pixel_again_and_again_nearer"];
        let vectors = ["vectors", "--unit", "depth", "--suite", "hazards", "--no-csv", "--out", "v"];
        assert_eq!(told(&edgewalk(folder.path(), &[&vectors[..], &set].concat())).0, Some(0));
        let verify = ["verify", "--dut", "own.toml", "--simulator", "icarus", "--json"];
        let output = edgewalk(folder.path(), &[&verify[..], &set].concat());
        assert_eq!(output.status.code(), Some(0), "{}", told(&output).1);
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let manifest = fs::read(folder.path().join("v/hazards_depth/manifest.json")).expect("written");
        let manifest: Value = serde_json::from_slice(&manifest).expect("JSON");
        let met = report["dut"]["events"]["met"].as_object().expect("a table");
        for (event, count) in met {
            assert_eq!(count, &manifest["coverage"][event], "{hazard}: {event}: {report}");
            counted += 1;
        }
        let [hidden, not_met] = ["not_seen", "not_met"].map(|key| report["dut"]["events"][key].clone());
        let sizes =
            (hidden.as_object().map_or(0, serde_json::Map::len), not_met.as_array().map_or(0, Vec::len));
        let all = manifest["coverage"].as_object().expect("a table").len();
        assert_eq!(sizes.0 + sizes.1 + met.len(), all, "{report}");
        assert_eq!(sizes.0, if hazard == "forward" { 3 } else { 0 }, "{report}");
    }
    println!("checked {counted} events");
    assert!(counted >= 9, "{counted}");
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
    assert!(
        code == Some(2) && text.contains("--only: unknown case flat_tpo; nearest: flat_top; permitted: ")
    );
    let (code, text) =
        run(&["--suite", "depth_less", "--unit", "depth", "--out", "none", "--only", "flat_tpo"]);
    let list: Vec<&str> =
        text.trim().rsplit_once("permitted: ").map_or(vec![], |(_, list)| list.split(", ").collect());
    let different: std::collections::BTreeSet<_> = list.iter().collect();
    assert!(code == Some(2) && list.len() > 10 && different.len() == list.len(), "{text}");
}

/// A run in which no suite has anything for the design's unit, or in which the simulator has no suite, does not pass.
#[test]
fn a_run_without_a_suite_is_refused() {
    let folder = folder();
    for cases in [["icarus", FUNCTIONS], ["verilator", "torus-knot"]] {
        let arguments = ["verify", "--dut", "pixel.toml", "--simulator", cases[0], "--only", cases[1]];
        let (code, text) = told(&edgewalk(folder.path(), &arguments));
        assert!(code == Some(2) && text.contains("error: no suite was run, as none of those"), "{text}");
    }
}

/// A text of a parameter reaches bench and lint as it is, and no shell.
#[test]
fn texts_of_parameters_are_taken_as_they_are() {
    let folder = folder();
    edit(folder.path(), "my_pixel.v", "parameter ZW", "parameter TEXT = \"none\",\n  parameter ZW");
    edit(folder.path(), "my_pixel.v", "endmodule", "  initial $display(\"%0s\", TEXT);\nendmodule");
    let text = "x';touch planted;'$HOME`";
    edit(folder.path(), "pixel.toml", "[parameters]", &format!("[parameters]\nTEXT = \"{text}\""));
    let case = "one_pixel_again_and_again_nearer";
    let arguments = ["vectors", "--dut", "pixel.toml", "--suite", "hazards", "--only", case, "--out", "v"];
    let (code, said) = told(&edgewalk(folder.path(), &arguments));
    assert_eq!(code, Some(0), "{said}");
    let (passed, said) = made(folder.path(), "v/hazards_pixel", &["lint", "icarus"]);
    assert!(passed && said.contains(&format!("\n| {text}\n")), "{said}");
    assert!(!folder.path().join("v/hazards_pixel/planted").exists(), "the shell ran the text");
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
    assert_eq!(list.split(", ").count(), 15, "{said}");
    for key in list.trim().split(", ").filter(|key| !["reset", "in", "out"].contains(key)) {
        assert!(page.contains(&format!("`{key}`")) || page.contains(&format!("`[{key}]`")), "{key}");
    }
}
