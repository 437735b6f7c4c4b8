//! The cocotb package in `python`: every unit's vectors and both designs of `docs/own_rtl` under cocotb, and their faults.
//! No part of the test run, as it needs cocotb:
//! `EDGEWALK_PYTHON=venv/bin/python cargo test --release -p edgewalk-cli cocotb:: -- --ignored`

use crate::support::edgewalk;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A Python that has cocotb.
fn python() -> Command {
    let mut command = Command::new(std::env::var("EDGEWALK_PYTHON").unwrap_or_else(|_| "python3".to_owned()));
    command.env("PYTHONPATH", root().join("python"));
    command
}

fn vectors(folder: &Path, arguments: &[&str]) {
    let common = ["vectors", "--no-csv", "--quiet", "--out", "v"];
    let output = edgewalk(folder, &[&common, arguments].concat()).output().expect("the program runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Exit code, and all that is printed.
fn replayed(folder: &Path, directory: &str, simulator: &str) -> (Option<i32>, String) {
    let mut command = python();
    command.args(["-m", "edgewalk_vectors", directory, "--simulator", simulator]).current_dir(folder);
    let output = command.output().expect("python runs");
    let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    (output.status.code(), text)
}

fn own(folder: &Path) {
    for name in ["pixel.toml", "my_pixel.v", "depth.toml", "my_depth.v"] {
        fs::copy(root().join("docs/own_rtl").join(name), folder.join(name)).expect("copied");
    }
}

/// Counts compared under cocotb, from its log.
fn checked(text: &str) -> (u64, u64) {
    let counts = text.lines().find_map(|line| line.split_once("checked ")?.1.split_once(" / "));
    let (checked, expected) = counts.unwrap_or_else(|| panic!("{text}"));
    (checked.trim().parse().expect("a number"), expected.trim().parse().expect("a number"))
}

#[test]
#[ignore = "needs cocotb"]
fn every_unit_passes_under_cocotb() {
    let folder = tempfile::tempdir().expect("a folder");
    vectors(folder.path(), &["--suite", "hazards"]);
    for unit in ["machine", "setup", "edge", "span", "pixel", "depth"] {
        let directory = format!("v/hazards_{unit}");
        let (code, text) = replayed(folder.path(), &directory, "icarus");
        assert_eq!(code, Some(0), "{text}");
        let (checked, expected) = checked(&text);
        let text = fs::read_to_string(folder.path().join(directory).join("manifest.json")).expect("written");
        let manifest: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert!(
            checked == expected && manifest["expected"] == expected && expected > 300,
            "{unit}: {checked}"
        );
    }
}

#[test]
#[ignore = "needs cocotb"]
fn designs_of_another_hand_and_faults_under_cocotb() {
    let folder = tempfile::tempdir().expect("a folder");
    own(folder.path());
    for (unit, from, to) in [
        ("pixel", "z[ZW-1-:24]", "z[ZW-2-:24]"),
        ("pixel", "dr <= step_r", "dr <= step_g"),
        ("pixel", "left ? column - 1", "left ? column + 1"),
        ("pixel", "stage_valid <= 1'b1;", "stage_valid <= pixels != 1;"),
        ("pixel", "if (!m_valid || m_ready) begin", "begin"),
        ("depth", "less ? func[0]", "less ? func[1]"),
        ("depth", "addr[(first + i) & 15] == f_addr", "1'b0"),
        ("depth", "{8'b0, new_z}", "{8'b1, new_z}"),
        ("depth", "rgb[free] <= f_rgb", "rgb[free] <= f_rgb | 1"),
        ("depth", "w_addr <= addr[first]", "w_addr <= addr[first] ^ 1"),
    ] {
        own(folder.path());
        vectors(folder.path(), &["--dut", &format!("{unit}.toml"), "--suite", "hazards"]);
        let directory = format!("v/hazards_{unit}");
        let (code, text) = replayed(folder.path(), &directory, "icarus");
        assert!(code == Some(0) && checked(&text).0 > 300, "{unit}: {text}");
        let file = folder.path().join(format!("my_{unit}.v"));
        let design = fs::read_to_string(&file).expect("a file");
        assert!(design.contains(from), "{from}");
        fs::write(&file, design.replacen(from, to, 1)).expect("written");
        let (code, text) = replayed(folder.path(), &directory, "icarus");
        assert!(code == Some(1) && text.lines().any(|line| line == "FAIL"), "{to}: {text}");
    }
}

/// The two lines of the page, in a file of a user's own.
#[test]
#[ignore = "needs cocotb"]
fn a_test_of_two_lines_runs() {
    let page = include_str!("../../../docs/own_rtl.md");
    let lines = "from edgewalk_vectors import replay\ntest = replay(\"out/own/hazards_pixel\")\n";
    assert!(page.contains(lines));
    let folder = tempfile::tempdir().expect("a folder");
    vectors(folder.path(), &["--suite", "hazards", "--unit", "pixel"]);
    let lines =
        lines.replace("out/own/hazards_pixel", &folder.path().join("v/hazards_pixel").display().to_string());
    fs::write(folder.path().join("test_mine.py"), lines).expect("written");
    let script = "import os, sys; sys.path.insert(0, os.getcwd())\n\
        from edgewalk_vectors.run import runner\n\
        r = runner('icarus')\n\
        r.build(sources=['v/hazards_pixel/hdl/edgewalk_pixel.v'], hdl_toplevel='edgewalk_pixel', timescale=('1ns', '1ps'))\n\
        print(r.test(hdl_toplevel='edgewalk_pixel', test_module='test_mine'))\n";
    let output = python().args(["-c", script]).current_dir(folder.path()).output().expect("python runs");
    let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    assert!(
        output.status.success() && text.contains("PASS=1") && text.contains("checked 611 / 611"),
        "{text}"
    );
}

/// A directory that was changed is refused; this needs no cocotb.
#[test]
fn a_changed_directory_is_refused_by_the_package() {
    let folder = tempfile::tempdir().expect("a folder");
    vectors(folder.path(), &["--suite", "hazards", "--unit", "pixel"]);
    let script = "import importlib.util, sys\n\
        spec = importlib.util.spec_from_file_location('directory', sys.argv[1])\n\
        module = importlib.util.module_from_spec(spec)\n\
        spec.loader.exec_module(module)\n\
        print(len(module.Directory('v/hazards_pixel').numbers('frag.exp.mem')))\n";
    let file = root().join("python/edgewalk_vectors/directory.py");
    let run = || {
        let mut command = Command::new("python3");
        command.args(["-c", script]).arg(&file).current_dir(folder.path());
        let output = command.output().expect("python3 is installed");
        (output.status.success(), [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat())
    };
    assert_eq!(run(), (true, "350\n".to_owned()));
    let changed = folder.path().join("v/hazards_pixel/frag.exp.mem");
    let text = fs::read_to_string(&changed).expect("a file");
    fs::write(&changed, text.replacen('0', "1", 1)).expect("written");
    let (passed, text) = run();
    assert!(!passed && text.contains("frag.exp.mem is not the file that the manifest describes"), "{text}");
}
