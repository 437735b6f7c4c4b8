//! Which machines a sweep has: all keys that are asked for reach them, and each counts once.

use super::{NORMALS, keys, rows};
use crate::support::{HALF, TRIANGLE, edgewalk, run};
use serde_json::Value;
use std::path::Path;

/// A folder with inputs.
fn inputs() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("a.tri", TRIANGLE), ("light.tri", HALF), ("normals.tri", NORMALS)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// What `sweep` prints as JSON.
fn told(at: &Path, words: &[&str]) -> Value {
    let output = edgewalk(at, &[&["sweep", "--json"], words].concat()).output().unwrap();
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn keys_of_units_that_are_varied_reach_their_machines() {
    let folder = inputs();
    let at = folder.path();
    std::fs::write(at.join("m.toml"), "[shade]\ntable_bits = 10\n").unwrap();
    let shaded = ["normals.tri", "--vary", "shade.kind=fast-phong"];
    let shadow = ["--set", "shadow.size=4", "--set", "shadow.gate=scale", "--vary", "setup.lanes=1,4"];
    let sweeps: [(&str, Vec<&str>, &str, u32); 4] = [
        ("set", [&shaded[..], &["--set", "shade.table_bits=10"]].concat(), "shade.table_bits", 10),
        ("file", [&shaded[..], &["--machine", "m.toml"]].concat(), "shade.table_bits", 10),
        (
            "blend",
            vec!["a.tri", "--vary", "blend.kind=interpolated", "--set", "blend.kt_bits=4"],
            "blend.kt_bits",
            4,
        ),
        (
            "shadow",
            [&["light.tri", "--vary", "shadow.light=parallel"], &shadow[..]].concat(),
            "shadow.size",
            4,
        ),
    ];
    for (out, words, key, value) in sweeps {
        assert_eq!(
            run(at, &[&["sweep", "--quiet", "--out", out][..], &words].concat()),
            (Some(0), String::new())
        );
        for row in rows(&at.join(out)) {
            assert_eq!((&row["status"], &row["keys"][key]), (&"ok".into(), &value.into()), "{out}: {row}");
        }
    }
    // The page's command asks for the key too, and so does what parts read.
    let page = std::fs::read_to_string(at.join("set/report.html")).unwrap();
    assert!(page.contains("--set shade.table_bits=10"), "the page's command has no shade.table_bits");
    let plan = [&["sweep", "plan", "--quiet", "--chunks", "1", "--out", "parts"][..], &shaded].concat();
    assert_eq!(run(at, &[&plan[..], &["--set", "shade.table_bits=10"]].concat()), (Some(0), String::new()));
    for part in [&["sweep", "run", "--chunk", "0"][..], &["sweep", "merge"]] {
        assert_eq!(run(at, &[part, &["--quiet", "--out", "parts"]].concat()), (Some(0), String::new()));
    }
    assert_eq!(keys(&at.join("parts")), keys(&at.join("set")));
}

/// A triangle file brings its screen to any machine; scenes are drawn on that of the sweep, and so is the best.
#[test]
fn best_machine_has_the_screen_of_scenes() {
    let folder = inputs();
    let at = folder.path();
    let screen = ["--set", "screen.width=96", "--set", "screen.height=72"];
    for (inputs, out) in [(["a.tri", "sphere"], "file-first"), (["sphere", "a.tri"], "scene-first")] {
        let words = [&inputs[..], &["--vary", "fifo.span=1,2", "--out", out], &screen].concat();
        let best = &told(at, &words)["best"]["cycles"];
        let file = best["file"].as_str().unwrap();
        let cycles = inputs.map(|input| {
            let output = edgewalk(at, &["render", input, "--machine", file, "--json"]).output().unwrap();
            let report: Value = serde_json::from_slice(&output.stdout).unwrap();
            (input == "a.tri" || report["machine"] == best["machine"])
                .then(|| report["cycles"]["total"].as_f64())
        });
        let sum = cycles[0].unwrap().unwrap() + cycles[1].unwrap().unwrap();
        assert_eq!(best["values"]["cycles"].as_f64(), Some(sum), "{file}");
    }
}

/// A slope edge also draws pixels outside the triangle: a bound is called proved of those inside, and only of these.
#[test]
fn bounds_of_slope_edges_are_of_pixels_inside() {
    let folder = inputs();
    let at = folder.path();
    let slope = ["--vary", "edge.kind=slope", "--vary", "edge.fraction_bits=2,16", "--bound", "0.9"];
    let words = [&["sphere"], &slope[..], &["--objective", "z_bound", "--out", "s"]].concat();
    assert_eq!(told(at, &[&words[..], &crate::support::SCREEN].concat())["faults"], 0);
    let verdicts: Vec<Value> = rows(&at.join("s")).iter().map(|row| row["verdict"].clone()).collect();
    assert!(verdicts.contains(&"mismatch".into()), "{verdicts:?}");
    for (name, times) in [("best_z_bound.toml", 1), ("report.html", 2)] {
        let text = std::fs::read_to_string(at.join("s").join(name)).unwrap();
        assert!(
            text.matches("bound of it at pixels inside these triangles, LSB, proved").count() >= times,
            "{name}"
        );
    }
}

#[test]
fn machine_that_cannot_be_built_is_varied_into_those_that_can() {
    let folder = inputs();
    let at = folder.path();
    std::fs::write(at.join("m.toml"), "[edge]\nfill = \"textbook\"\n").unwrap();
    for (out, asked) in [("set", ["--set", "edge.fill=textbook"]), ("file", ["--machine", "m.toml"])] {
        let words = ["a.tri", "--vary", "screen.subpixel_bits=0,8", "--out", out];
        let report = told(at, &[&words[..], &asked].concat());
        assert_eq!((&report["status"]["ok"], &report["status"]["invalid"]), (&1.into(), &1.into()));
    }
    // The unit that is built need not be one of the machine that is varied, but of one of the sweep.
    let plan = |vary: &str| {
        let words =
            ["sweep", "plan", "normals.tri", "--quiet", "--chunks", "1", "--vary", vary, "--out", "p"];
        run(at, &[&words[..], &["--synth", "ice40-hx8k", "--synth-unit", "shade"]].concat())
    };
    assert_eq!(plan("shade.kind=none,fast-phong"), (Some(0), String::new()));
    let (code, error) = plan("setup.lanes=1,4");
    assert!(
        code == Some(2) && error.contains("--synth-unit shade: this machine has no unit shade"),
        "{error}"
    );
    let (code, error) =
        run(at, &["sweep", "a.tri", "--set", "setup.lane=1", "--vary", "fifo.span=1", "--out", "n"]);
    assert!(code == Some(2) && error.contains("unknown key setup.lane"), "{error}");
    assert!(!at.join("n").exists());
}

/// Keys of a shadow and of a shading that only some of the machines have.
const VARY: [&str; 8] = [
    "--vary",
    "shadow.size=1..100",
    "--vary",
    "blend.kind=none,interpolated",
    "--vary",
    "blend.kt_bits=4..8",
    "--vary",
    "interpolator.adders=1,2",
];

#[test]
fn machines_alike_in_all_that_means_something_count_once() {
    let folder = inputs();
    let at = folder.path();
    // Two without BLEND, and ten with it.
    let whole = told(at, &[&["a.tri", "--out", "whole"], &VARY[..]].concat());
    assert_eq!((&whole["points"], &whole["machines"]), (&12.into(), &12.into()));
    let text = edgewalk(at, &[&["sweep", "a.tri", "--out", "whole"], &VARY[..]].concat()).output().unwrap();
    assert!(!String::from_utf8(text.stdout).unwrap().contains("null"));
    assert_eq!(whole["extent"]["machines_of_space"], 12);
    let mut once = keys(&at.join("whole"));
    once.dedup();
    assert_eq!(once.len(), 12);
    for (count, made) in [("6", 6), ("11", 11), ("12", 12), ("100", 12)] {
        let sample = told(at, &[&["a.tri", "--sample", count, "--out", count], &VARY[..]].concat());
        let mut own = keys(&at.join(count));
        own.dedup();
        assert_eq!((own.len(), &sample["machines"], &sample["made"]), (made, &made.into(), &made.into()));
        assert!(own.iter().all(|key| once.contains(key)));
        assert_eq!(told(at, &[&["a.tri", "--sample", count, "--out", count], &VARY[..]].concat())["made"], 0);
    }
    let (code, error) = run(at, &[&["sweep", "a.tri", "--search", "32", "--out", "few"], &VARY[..]].concat());
    assert!(code == Some(2) && error.contains("there are 12 machines; leave --search out"), "{error}");
}

/// More combinations than are listed, of 12 machines.
#[test]
fn search_ends_where_no_other_machine_is_found() {
    let folder = inputs();
    let at = folder.path();
    let wide = ["--vary", "shadow.depth_bits=4..24", "--vary", "shadow.light_bits=4..28"];
    let words = [&["a.tri", "--search", "32", "--out", "s"], &VARY[..], &wide].concat();
    let report = told(at, &words);
    assert_eq!((&report["machines"], &report["made"]), (&12.into(), &12.into()));
    assert_eq!(told(at, &words)["made"], 0);
    let sample = told(at, &[&["a.tri", "--sample", "32", "--out", "t"], &VARY[..], &wide].concat());
    assert_eq!((&sample["machines"], keys(&at.join("t"))), (&12.into(), keys(&at.join("s"))));
}

#[test]
fn a_reason_names_no_option_of_other_commands() {
    let folder = inputs();
    let output = edgewalk(folder.path(), &["sweep", "a.tri", "--vary", "shade.kind=phong", "--out", "s"])
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let reason = text.lines().find(|line| line.starts_with("first failed: ")).unwrap();
    assert!(reason.ends_with("; give --set shade.kind=none"), "{reason}");
}
