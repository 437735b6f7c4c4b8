//! A sweep with synthesis: cells and clock of each machine beside its errors, made once, null with the reason where there are none.

use super::rows;
use crate::support::{TRIANGLE, edgewalk, ended, run};
use std::collections::BTreeMap;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Every file below a folder, and when it was written.
fn files(folder: &Path, found: &mut BTreeMap<PathBuf, SystemTime>) {
    for entry in std::fs::read_dir(folder).unwrap().map(Result::unwrap) {
        if entry.file_type().unwrap().is_dir() {
            files(&entry.path(), found);
        } else {
            found.insert(entry.path(), entry.metadata().unwrap().modified().unwrap());
        }
    }
}

#[test]
fn machines_are_synthesised_once_and_stand_in_fronts() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let sweep = |target: &str, unit: &str, out: &str| {
        let cells = ["--synth", target, "--synth-unit", unit, "--synth-seeds", "1", "--cache", "cache"];
        let vary =
            ["sweep", "a.tri", "--machine", "small", "--vary", "fifo.span=1,2", "--out", out, "--quiet"];
        assert_eq!(run(at, &[&vary[..], &cells].concat()), (Some(0), String::new()));
        rows(&at.join(out))
    };
    let first = sweep("ice40-hx8k", "span", "first");
    let mut written = BTreeMap::new();
    files(&at.join("cache"), &mut written);
    let second = sweep("ice40-hx8k", "span", "second");
    let mut kept = BTreeMap::new();
    files(&at.join("cache"), &mut kept);
    assert!(!written.is_empty() && written == kept, "a tool ran again");
    let mut checked = 0;
    for row in &first {
        let same = second.iter().find(|other| other["key"] == row["key"]).unwrap();
        assert_eq!(same["synth"], row["synth"]);
        let mhz = row["synth"]["mhz"]["median"].as_f64().unwrap();
        assert!(row["synth"]["cells"]["lut4"].as_u64() > Some(20) && mhz > 20.0, "{}", row["synth"]);
        // Rates at that clock, of a frame with more fragments than triangles.
        let report = |at: &str| row["report"].pointer(at).unwrap().as_f64().unwrap();
        let frames = 1e6 * mhz / report("/cycles/total");
        let luts = row["synth"]["cells"]["lut4"].as_f64().unwrap();
        let (pixels, triangles) = (frames * report("/fragments") / 1e6, frames * report("/triangles") / 1e6);
        assert!(pixels > 10.0 * triangles);
        for (name, own) in [
            ("frames_per_s", frames),
            ("mpixels_per_s", pixels),
            ("mtriangles_per_s", triangles),
            ("mpixels_per_s_per_lut", pixels / luts),
            ("mtriangles_per_s_per_lut", triangles / luts),
        ] {
            let told = row["derived"][name].as_f64().unwrap();
            assert!((told - own).abs() < 1e-9 * own, "{name} {told} {own}");
        }
        checked += 1;
    }
    assert_eq!(checked, 2);
    let table = std::fs::read_to_string(at.join("first/runs.csv")).unwrap();
    let fronts: Vec<&str> = table.lines().skip(1).map(|line| line.rsplit(',').next().unwrap()).collect();
    assert!(fronts.contains(&"1"), "{table}");
    assert!(at.join("first/best_lut4.toml").is_file());
    // The page has every unit's cells.
    let page = super::oracle::data(&std::fs::read_to_string(at.join("first/report.html")).unwrap());
    let columns = page["columns"].as_array().unwrap();
    for (line, row) in page["rows"].as_array().unwrap().iter().zip(&first) {
        let row =
            if line[0] == row["key"] { row } else { first.iter().find(|row| line[0] == row["key"]).unwrap() };
        let units = row["synth"]["units"].as_array().unwrap();
        assert_eq!(page["units"].as_array().unwrap().len(), units.len());
        for unit in units {
            let name = format!("lut4_{}", unit["unit"].as_str().unwrap());
            let place = columns.iter().position(|column| *column == name.as_str()).unwrap();
            assert_eq!(line[place], unit["lut4"], "{name}");
        }
    }
}

#[test]
fn what_could_not_be_synthesised_is_null_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let sweep = ["sweep", "a.tri", "--vary", "fifo.span=2", "--out", "s", "--quiet"];
    let cells = ["--synth", "ice40-up5k", "--synth-unit", "setup", "--limit", "1", "--cache", "cache"];
    let (code, error) = run(at, &[&sweep[..], &cells].concat());
    let why = "the tools gave figures of no machine; the first reason: yosys was ended after 1 s";
    assert!(code == Some(4) && error.contains(why), "{error}");
    let rows = rows(&at.join("s"));
    let [row] = &rows[..] else { panic!("one row") };
    assert!(row["status"] == "timeout" && row["reason"].as_str().unwrap().contains("1 s"), "{row}");
    assert!(row["synth"].is_null() && row["derived"]["frames_per_s"].is_null(), "{row}");
    let table = std::fs::read_to_string(at.join("s/runs.csv")).unwrap();
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let lut4 = lines[0].iter().position(|name| *name == "lut4").unwrap();
    assert_eq!(lines[1][lut4], "", "what is not known is empty");
}

#[test]
fn a_tool_that_fails_is_no_empty_comparison() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let sweep = |cache: &str| {
        let words =
            ["sweep", "a.tri", "--vary", "fifo.span=1,2", "--synth", "ice40-hx8k", "--synth-unit", "depth"];
        let rest = ["--synth-seeds", "1", "--out", "s", "--quiet", "--cache", cache];
        let mut command = edgewalk(at, &[&words[..], &rest].concat());
        ended(&command.env("PATH", at.join("tools")).output().unwrap())
    };
    // What has nothing to do with the rows does not name their file.
    std::fs::create_dir(at.join("tools")).unwrap();
    for (cache, code, why) in
        [("cache", 3, "yosys is not installed; try: "), ("a.tri/c", 2, "--cache a.tri/c: ")]
    {
        let (found, error) = sweep(cache);
        assert!(found == Some(code) && error.contains(why) && !error.contains("runs.jsonl"), "{error}");
    }
    for tool in ["yosys", "nextpnr-ice40"] {
        let script = "#!/bin/sh\ncase \"$1\" in -V | --version) echo 1 ;; *) echo boom; exit 1 ;; esac\n";
        std::fs::write(at.join("tools").join(tool), script).unwrap();
        std::fs::set_permissions(at.join("tools").join(tool), std::fs::Permissions::from_mode(0o755))
            .unwrap();
    }
    let why = "the tools gave figures of no machine; the first reason: yosys failed:\nboom";
    let (code, error) = sweep("cache");
    assert!(code == Some(3) && error.contains(why), "{error}");
    // The same rows, without a run of a tool.
    assert_eq!(sweep("cache"), (code, error));
}
