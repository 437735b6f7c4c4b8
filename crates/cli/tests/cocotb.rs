//! The cocotb package in `python`: every unit's vectors and both designs of `docs/own_rtl` under cocotb, and their faults; the
//! scoreboard beside the live model. No part of the test run, as it needs cocotb: see "The campaign" in `docs/own_rtl.md`.

use crate::support::{edgewalk, root};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A Python that has cocotb. Verilator's own library is compiled once, and nothing is optimised: each run is short.
fn python() -> Command {
    let mut command = Command::new(std::env::var("EDGEWALK_PYTHON").unwrap_or_else(|_| "python3".to_owned()));
    command.env("PYTHONPATH", root().join("python")).env("MAKEFLAGS", "e");
    if std::env::var_os("EDGEWALK_OBJECTS").is_some() {
        command.env("OBJCACHE", root().join("tests/objcache"));
    }
    command.envs(["OPT_FAST", "OPT_SLOW", "OPT_GLOBAL"].map(|level| (level, "-O0")));
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

/// The simulators to try: EDGEWALK_SIMULATORS, else Icarus.
fn simulators() -> Vec<String> {
    let named = std::env::var("EDGEWALK_SIMULATORS").unwrap_or_else(|_| "icarus".to_owned());
    named.split_whitespace().map(str::to_owned).collect()
}

/// Machines that have every unit between them, and the units that each is for.
const MACHINES: [(&[&str], &str); 5] = [
    (&[], "machine setup edge span pixel depth"),
    (
        &["shade.kind=phong", "texture.kind=nearest", "texture.bump=yes", "shade.colour=multiply"],
        "machine term texel bump normal shade",
    ),
    (&["shade.kind=phong", "shade.light=positional", "shade.colour=multiply"], "machine lamp"),
    (
        &["shadow.light=perspective", "shadow.project=pipelined", "blend.kind=constant"],
        "machine project shadow blend",
    ),
    (&["polygon.edges=16", "dither.bits=5"], "machine poly dither"),
];

/// The two lines of the page, as a test of cocotb's for each unit: run by cocotb's own runner on the design of the directory.
#[test]
#[ignore = "needs cocotb"]
fn test_of_two_lines_passes_for_every_unit() {
    let (mut units, mut all) = (std::collections::BTreeSet::new(), 0);
    for (keys, of) in &MACHINES {
        let folder = tempfile::tempdir().expect("a folder");
        let small = ["screen.width=24", "screen.height=20"];
        let set = small.iter().chain(keys.iter()).flat_map(|key| ["--set", key]);
        let common = ["--suite", "hazards"].into_iter().chain(set);
        vectors(folder.path(), &common.collect::<Vec<_>>());
        for unit in of.split(' ') {
            let directory = format!("v/hazards_{unit}");
            let lines = format!("from edgewalk_vectors import replay\ntest = replay(\"{directory}\")\n");
            // The test runs in the folder of the simulation.
            let lines = lines.replace(&directory, &folder.path().join(&directory).display().to_string());
            fs::write(folder.path().join("test_mine.py"), lines).expect("written");
            let text =
                fs::read_to_string(folder.path().join(&directory).join("manifest.json")).expect("written");
            let manifest: serde_json::Value = serde_json::from_str(&text).expect("JSON");
            for simulator in simulators() {
                let started = std::time::Instant::now();
                let (passed, text) = tested(folder.path(), &directory, &simulator);
                assert!(passed, "{unit}: {text}");
                let (checked, expected) = checked(&text);
                assert!(
                    checked == expected && manifest["expected"] == expected && expected > 100,
                    "{unit}: {checked}"
                );
                println!(
                    "{simulator} {unit}: {checked} / {expected}, {:.1} s",
                    started.elapsed().as_secs_f64()
                );
                all += checked;
            }
            units.insert(unit);
        }
    }
    println!("{} units, {all} values", units.len());
    assert_eq!(units.len(), 17, "{units:?}");
}

/// Runs `test_mine.py` on the design of a directory: whether it passed, and all that is printed.
fn tested(folder: &Path, directory: &str, simulator: &str) -> (bool, String) {
    let script = "import os, sys; sys.path.insert(0, os.getcwd())\n\
        from edgewalk_vectors import run\n\
        sys.exit(0 if run(sys.argv[1], sys.argv[2], module='test_mine') else 1)\n";
    let mut command = python();
    command.args(["-c", script, directory, simulator]).current_dir(folder);
    let output = command.output().expect("python runs");
    let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    (output.status.success(), text)
}

/// The example of the page compares my_pixel.v with the live model; each fault fails.
#[test]
#[ignore = "needs cocotb and the module edgewalk"]
fn scoreboard_passes_and_finds_faults() {
    let folder = tempfile::tempdir().expect("a folder");
    own(folder.path());
    vectors(folder.path(), &["--dut", "pixel.toml", "--suite", "hazards"]);
    let example = root().join("docs/own_rtl/test_pixel.py");
    fs::copy(example, folder.path().join("test_mine.py")).expect("copied");
    for simulator in simulators() {
        for (from, to) in [
            ("", ""),
            ("z[ZW-1-:24]", "z[ZW-2-:24]"),
            ("stage_valid <= 1'b1;", "stage_valid <= pixels != 1;"),
            ("if (!m_valid || m_ready) begin", "begin"),
            ("fence <= 1'b0;", "fence <= fence;"),
        ] {
            own(folder.path());
            let file = folder.path().join("my_pixel.v");
            let design = fs::read_to_string(&file).expect("a file");
            assert!(design.contains(from), "{from}");
            fs::write(&file, design.replacen(from, to, 1)).expect("written");
            let (passed, text) = tested(folder.path(), "v/hazards_pixel", &simulator);
            assert_eq!(passed, from.is_empty(), "{simulator} {to}: {text}");
            if passed {
                let line = text
                    .lines()
                    .find(|line| line.contains("scoreboard: "))
                    .unwrap_or_else(|| panic!("{text}"));
                assert!(line.ends_with(" tokens compared"), "{line}");
                println!("{simulator}: {line}");
            } else {
                assert!(text.contains("Fault: frag: "), "{to}: {text}");
            }
        }
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

/// The first run, in which no ready comes before its valid, and the reset behind it: a valid that waits for its ready
/// fails, and a design whose registers have their first values from `initial` alone.
#[test]
#[ignore = "needs cocotb"]
fn valids_that_wait_and_missing_resets_fail() {
    let waits: &[(&str, &str)] = &[
        ("m_valid", "m_hold"),
        ("output reg           m_hold,", "output wire          m_valid,"),
        (
            "  reg          busy,",
            "  reg          m_hold;\n  assign m_valid = m_hold && m_ready;\n  reg          busy,",
        ),
    ];
    let keeps: &[(&str, &str)] = &[
        ("if (!aresetn) begin", "if (1'b0) begin"),
        (" or negedge aresetn", ""),
        ("  assign s_ready", "  initial {busy, stage_valid, m_valid} = 0;\n  assign s_ready"),
    ];
    let folder = tempfile::tempdir().expect("a folder");
    own(folder.path());
    // The order alone counts, as pixel.toml says: a valid that waits changes cycles alone.
    vectors(folder.path(), &["--dut", "pixel.toml", "--suite", "hazards"]);
    for (edits, said) in [
        (
            waits,
            "frag: frag_valid waits for frag_ready, which it must not: no token was offered in the first run",
        ),
        (keeps, "frag_z: expected "),
    ] {
        own(folder.path());
        let file = folder.path().join("my_pixel.v");
        let mut design = fs::read_to_string(&file).expect("a file");
        for (from, to) in edits {
            assert!(design.contains(from), "{from}");
            design = design.replace(from, to);
        }
        fs::write(&file, design).expect("written");
        for simulator in simulators() {
            let (code, text) = replayed(folder.path(), "v/hazards_pixel", &simulator);
            assert!(code == Some(1) && text.contains(said), "{simulator}: {text}");
        }
    }
}

/// A text of a parameter is the design's as it stands; a design that does not compile is refused in words.
#[test]
#[ignore = "needs cocotb"]
fn texts_of_parameters_and_broken_designs_under_cocotb() {
    for simulator in simulators() {
        let folder = tempfile::tempdir().expect("a folder");
        own(folder.path());
        let edit = |name: &str, from: &str, to: &str| {
            let file = folder.path().join(name);
            let text = fs::read_to_string(&file).expect("a file");
            assert!(text.contains(from), "{name} has no `{from}`");
            fs::write(file, text.replacen(from, to, 1)).expect("written");
        };
        edit("my_pixel.v", "parameter ZW", "parameter MODE = \"slow\",\n  parameter ZW");
        edit("my_pixel.v", "dr <= step_r", "dr <= MODE == \"fast\" ? step_r : step_g");
        edit("pixel.toml", "[parameters]", "[parameters]\nMODE = \"fast\"");
        vectors(folder.path(), &["--dut", "pixel.toml", "--suite", "hazards"]);
        let (code, text) = replayed(folder.path(), "v/hazards_pixel", &simulator);
        assert_eq!(code, Some(0), "{simulator}: {text}");
        edit("my_pixel.v", "endmodule", "endmodul");
        let (code, text) = replayed(folder.path(), "v/hazards_pixel", &simulator);
        let said = format!("error: {simulator} does not build the design");
        assert!(
            code == Some(2) && text.contains(&said) && !text.contains("Traceback"),
            "{simulator}: {text}"
        );
    }
}

/// What the page shows is what the campaign runs.
#[test]
fn page_shows_the_test_of_two_lines() {
    let page = include_str!("../../../docs/own_rtl.md");
    assert!(page.contains("from edgewalk_vectors import replay\ntest = replay(\"out/own/hazards_pixel\")\n"));
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
