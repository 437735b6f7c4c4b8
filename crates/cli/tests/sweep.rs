//! `edgewalk sweep` as a user runs it.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod refusals;
mod machines;
mod require;
mod search;
mod resume;
mod again;
mod parts;
mod oracle;
mod figures;
pub mod shadings;
mod browser;
mod chart;
mod hostile;
mod still;
#[path = "sweep/synth.rs"]
mod synth;

use crate::support::{HALF, PASSES, edgewalk, report, run};
use rand::SeedableRng;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;
use serde_json::Value;
use std::path::Path;

/// Rows of a sweep, by their order in the file.
fn rows(folder: &Path) -> Vec<Value> {
    let text = std::fs::read_to_string(folder.join("runs.jsonl")).unwrap();
    assert!(text.ends_with('\n'));
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Keys of the rows, sorted.
fn keys(folder: &Path) -> Vec<String> {
    let mut keys: Vec<String> =
        rows(folder).iter().map(|row| row["key"].as_str().unwrap().to_owned()).collect();
    keys.sort();
    keys
}

/// What `render` says of a row's machine, input and memory.
fn rendered(folder: &Path, row: &Value) -> Value {
    let mut arguments: Vec<String> =
        ["render", row["input"].as_str().unwrap(), "--json"].map(str::to_owned).into();
    for (key, value) in row["keys"].as_object().unwrap() {
        let value = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        arguments.extend(["--set".to_owned(), format!("{key}={value}")]);
    }
    if let Some(shading) = row["shading"].as_str() {
        arguments.extend(["--shading".to_owned(), shading.to_owned()]);
    }
    arguments.extend(["--stalls".to_owned(), row["stalls"].as_str().unwrap().to_owned()]);
    let output =
        edgewalk(folder, &arguments.iter().map(String::as_str).collect::<Vec<_>>()).output().unwrap();
    report(&output)
}

/// Sweeps over keys that change pixels and keys that do not, machines that have to be ticked among them.
const SWEEPS: [&[&str]; 9] = [
    &[
        "sphere",
        "--vary",
        "interpolator.adders=1..4",
        "--vary",
        "formats.z_fraction=5,9,14",
        "--vary",
        "fifo.inflight=1,2,4",
        "--vary",
        "memory.latency=1..6",
        "--vary",
        "setup.lanes=1,2,4",
        "--sample",
        "60",
    ],
    &[
        "torus",
        "--vary",
        "memory.hazard=drain,interlock,forward",
        "--vary",
        "memory.latency=1,4,8",
        "--vary",
        "fifo.span=1,2,8",
        "--vary",
        "interpolator.segments=1,2",
        "--vary",
        "edge.kind=exact,slope",
        "--vary",
        "formats.color_fraction=4,8",
        "--vary",
        "screen.guard_bits=10..13",
        "--sample",
        "60",
    ],
    &[
        "sphere",
        "torus",
        "--machine",
        "textbook",
        "--vary",
        "interpolator.adders=1,4",
        "--vary",
        "formats.z_bits=12,16",
        "--vary",
        "memory.hazard=drain,forward",
    ],
    &[
        "sphere",
        "--set",
        "screen.width=160",
        "--set",
        "screen.height=120",
        "--vary",
        "blend.kind=none,constant,interpolated",
        "--vary",
        "setup.lanes=1,4",
    ],
    &[
        "own.tri",
        "--set",
        "channels.extra=2",
        "--vary",
        "channels.e0_kind=unorm,signed,floor",
        "--vary",
        "setup.lanes=1,4",
    ],
    &[
        "sphere",
        "--set",
        "screen.width=160",
        "--set",
        "screen.height=120",
        "--vary",
        "memory.latency=1,3",
        "--vary",
        "interpolator.adders=1,4",
        "--stalls",
        "none",
        "--stalls",
        "fixed:rd=3",
        "--stalls",
        "random:seed=5",
        "--stalls",
        "dram:miss=9",
    ],
    // Frames that no two machines share.
    &[
        "passes.tri",
        "--set",
        "blend.kind=constant",
        "--vary",
        "setup.lanes=1,4",
        "--vary",
        "blend.multipliers=0,3",
        "--stalls",
        "none",
        "--stalls",
        "fixed:rd=3",
    ],
    &[
        "light.tri",
        "--set",
        "shadow.light=parallel",
        "--set",
        "shadow.size=4",
        "--set",
        "shadow.gate=scale",
        "--vary",
        "setup.lanes=1,4",
        "--vary",
        "memory.latency=1,4",
        "--vary",
        "formats.z_fraction=8,14",
    ],
    &[
        "normals.tri",
        "--set",
        "shade.kind=fast-phong",
        "--vary",
        "shade.table_bits=8..10",
        "--vary",
        "term.walk=register,memory",
    ],
];

const NORMALS: &str = "size 32 32
mode fast-phong
view 0 0 1
sun 0.3 0.3 1 0.7
material 0.1 0.7 0.5 40
T 1 1 0.5 0 0.2 1 0  31 1 0.5 0 0.2 1 0  1 31 0.5 0 0.2 1 0
N -0.3 -0.3 0.9055  0.5 -0.3 0.8124  -0.3 0.5 0.8124
";

#[test]
fn rows_drawn_by_seed_equal_render_in_every_figure() {
    let folder = tempfile::tempdir().unwrap();
    let own =
        "size 64 48\nextra 2\nT 0 0 0 1 0 0 0  60 0 0.5 0 1 0 0  0 40 1 0 0 1 0\nX 0 1  0.25 0.5  1 0.75\n";
    let files = [("own.tri", own), ("passes.tri", PASSES), ("light.tri", HALF), ("normals.tri", NORMALS)];
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let mut random = Pcg64Mcg::seed_from_u64(12);
    let (mut checked, mut ticked, mut lossy) = (0, 0, 0);
    for (place, sweep) in SWEEPS.iter().enumerate() {
        let out = format!("s{place}");
        let (code, error) = run(folder.path(), &[&["sweep", "--quiet", "--out", &out], *sweep].concat());
        assert_eq!((code, error.as_str()), (Some(0), ""), "{sweep:?}");
        let rows = rows(&folder.path().join(&out));
        let ok: Vec<&Value> = rows.iter().filter(|row| row["status"] == "ok").collect();
        for row in ok.choose_multiple(&mut random, 8) {
            let report = rendered(folder.path(), row);
            assert_eq!(row["report"], report, "{} differs from render", row["key"]);
            assert_eq!(row["machine"], report["machine"]);
            let path = report["cycles"]["path"].as_str().unwrap();
            ticked += u32::from(path.starts_with("ticked"));
            lossy += u32::from(row["verdict"] == "mismatch");
            checked += 1;
        }
    }
    println!("checked {checked} rows, {ticked} of them ticked, {lossy} of machines that draw wrongly");
    assert!(checked >= 55 && ticked >= 20 && lossy >= 2, "{checked} {ticked} {lossy}");
}

#[test]
fn size_and_compare_take_them_too() {
    let folder = tempfile::tempdir().unwrap();
    let mut checked = 0;
    for (name, text, settings, other) in [
        ("passes.tri", PASSES, "blend.kind=constant", "interpolator.adders=1"),
        ("light.tri", HALF, "shadow.light=parallel,shadow.size=4,shadow.gate=scale", "setup.lanes=1"),
        ("normals.tri", NORMALS, "shade.kind=fast-phong", "shade.table_bits=10"),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
        let set: Vec<&str> = settings.split(',').flat_map(|setting| ["--set", setting]).collect();
        let output =
            edgewalk(folder.path(), &[&["size", name, "--json"], &set[..]].concat()).output().unwrap();
        let size: Value = serde_json::from_slice(&output.stdout).unwrap();
        let channels: Vec<&str> = size["channels"]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(|channel| channel["name"].as_str())
            .collect();
        assert_eq!(channels, ["z", "color"], "{name}: the words that size can answer for");
        assert!(size["channels"][0]["these"]["fraction_bits"].as_u64() > Some(3), "{name}");
        let [a, b] = [format!("default,{settings}"), format!("default,{settings},{other}")];
        let output =
            edgewalk(folder.path(), &["compare", &a, &b, name, "--json", "--out", "c"]).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let key = other.split('=').next().unwrap();
        assert!(String::from_utf8_lossy(&output.stdout).contains(key), "{name}: {key} differs");
        checked += 1;
    }
    assert_eq!(checked, 3);
}

#[test]
fn every_point_has_one_row_and_the_best_can_be_rendered() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = [
        "sweep",
        "sphere",
        "--vary",
        "interpolator.adders=1,2,4",
        "--vary",
        "formats.z_fraction=3..6",
        "--vary",
        "setup.lanes=1,2",
        "--out",
        "s",
        "--json",
    ];
    let output = edgewalk(folder.path(), &sweep).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0));
    // z_fraction = 3 is less than the vertex's 4 bits.
    assert_eq!((&told["points"], &told["made"]), (&24.into(), &24.into()));
    assert_eq!(
        told["status"],
        serde_json::json!({"ok": 18, "pruned": 0, "invalid": 6, "failed": 0, "timeout": 0})
    );
    let rows = rows(&folder.path().join("s"));
    let invalid = rows.iter().find(|row| row["status"] == "invalid").unwrap();
    let (_, error) = run(folder.path(), &["config", "check", "--set", "formats.z_fraction=3"]);
    let why = invalid["reason"].as_str().unwrap();
    assert!(error.contains(why) && why.contains("formats.z_vertex = 4 cannot be built"), "{why}: {error}");
    let mut keys = keys(&folder.path().join("s"));
    keys.dedup();
    assert_eq!(keys.len(), 24);
    for (name, of) in told["best"].as_object().unwrap() {
        let file = format!("s/best_{name}.toml");
        assert_eq!(of["file"], file.as_str());
        let output =
            edgewalk(folder.path(), &["config", "check", "--json", "--machine", &file]).output().unwrap();
        let check: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(check["hash"], of["machine"], "{name}");
    }
    assert_eq!(told["best"].as_object().unwrap().len(), 4);
    let least = rows.iter().filter_map(|row| row.pointer("/report/cycles/total")?.as_u64()).min();
    assert_eq!(told["best"]["cycles"]["values"]["cycles"].as_f64(), least.map(|cycles| cycles as f64));
    // The table has a line a row and no field more or less.
    let csv = std::fs::read_to_string(folder.path().join("s/runs.csv")).unwrap();
    assert_eq!(csv.lines().count(), 25);
    let header: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    assert!(
        ["key", "setup.lanes", "cycles", "cycles_memory", "z_slack", "front"]
            .iter()
            .all(|name| header.contains(name))
    );
}

/// A bit more of the fraction costs a bit of every word and makes the bound less: all machines are on the front.
#[test]
fn a_long_front_is_cut_and_says_where_the_rest_is() {
    let folder = tempfile::tempdir().unwrap();
    for (values, more) in [("4..23", None), ("4..24", Some("    and 1 more, in OUT/runs.csv"))] {
        let vary = format!("formats.z_fraction={values}");
        let objectives = ["--objective", "z_bound", "--objective", "word_bits", "--out", values];
        let screen = ["--set", "screen.width=64", "--set", "screen.height=48"];
        let sweep = [&["sweep", "sphere", "--vary", &vary][..], &objectives, &screen].concat();
        let told = String::from_utf8(edgewalk(folder.path(), &sweep).output().unwrap().stdout).unwrap();
        let (_, front) = told.split_once("front of z_bound, word_bits: ").unwrap();
        let shown = front.lines().filter(|line| line.contains("  formats.z_fraction=")).count();
        let cut = front.lines().find(|line| line.contains(" more"));
        assert_eq!((shown, cut), (20, more.map(|more| more.replace("OUT", values)).as_deref()), "{told}");
    }
}

#[test]
fn points_without_the_bound_are_not_simulated() {
    let folder = tempfile::tempdir().unwrap();
    let sweep =
        ["sweep", "sphere", "--vary", "formats.z_fraction=4..14", "--bound", "1", "--out", "s", "--quiet"];
    assert_eq!(run(folder.path(), &sweep), (Some(0), String::new()));
    let (mut kept, mut pruned) = (0, 0);
    let size = edgewalk(folder.path(), &["size", "sphere", "--json"]).output().unwrap();
    let size: Value = serde_json::from_slice(&size.stdout).unwrap();
    let least = size["channels"][0]["these"]["fraction_bits"].as_u64().unwrap();
    for row in rows(&folder.path().join("s")) {
        let bits = row["keys"]["formats.z_fraction"].as_u64().unwrap();
        if bits >= least {
            assert_eq!(row["status"], "ok");
            assert!(row["slack"]["z"].as_f64().unwrap() <= 1.0);
            kept += 1;
        } else {
            let why = row["reason"].as_str().unwrap();
            assert!(
                row["status"] == "pruned" && why.contains("79 additions") && row["report"].is_null(),
                "{row}"
            );
            pruned += 1;
        }
    }
    assert!(kept >= 5 && pruned >= 2 && kept + pruned == 11, "{kept} {pruned}");
}

/// The bound is that of a row: with the step of DITHER, and missing where passes or shading leave none.
#[test]
fn points_are_skipped_by_the_bounds_that_their_rows_would_have() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("passes.tri", PASSES), ("normals.tri", NORMALS)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let screen = ["--set", "screen.width=64", "--set", "screen.height=48"];
    let (mut kept, mut pruned) = (0, 0);
    for (out, words, limit) in [
        ("a", [&["sphere", "--vary", "dither.bits=0,5,7"], &screen[..]].concat(), "5"),
        ("b", vec!["passes.tri", "--set", "blend.kind=constant", "--vary", "setup.lanes=1,4"], "5"),
        ("c", vec!["normals.tri", "--vary", "shade.kind=fast-phong"], "5"),
    ] {
        let sweep = |out: &str, more: &[&str]| {
            let words = [&["sweep", "--quiet", "--out", out][..], &words, more].concat();
            assert_eq!(run(folder.path(), &words), (Some(0), String::new()));
            rows(&folder.path().join(out))
        };
        let (all, some) = (sweep(out, &[]), sweep(&format!("{out}{out}"), &["--bound", limit]));
        assert_eq!(all.len(), some.len());
        for row in &all {
            let bounds = ["z", "color"]
                .map(|channel| row["report"]["comparison"][format!("{channel}_bound_for_input")].as_f64());
            let wanted = bounds.iter().all(|bound| bound.is_some_and(|bound| bound <= 5.0));
            let other = some.iter().find(|other| other["machine"] == row["machine"]).unwrap();
            assert_eq!(other["status"], if wanted { "ok" } else { "pruned" }, "{bounds:?}: {other}");
            (kept, pruned) = (kept + u32::from(wanted), pruned + u32::from(!wanted));
        }
    }
    assert_eq!((kept, pruned), (2, 4));
}

#[test]
fn a_sample_is_the_same_by_the_same_seed_and_of_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let vary = ["--vary", "fifo.span=1..64", "--vary", "fifo.inflight=3..16", "--vary", "memory.latency=1,2"];
    let sampled = |out: &str, seed: &str| {
        let sample = ["sweep", "sphere", "--sample", "40", "--seed", seed, "--quiet", "--out", out];
        assert_eq!(run(folder.path(), &[&sample[..], &vary].concat()), (Some(0), String::new()));
        keys(&folder.path().join(out))
    };
    let [a, again, other] = [sampled("a", "1"), sampled("b", "1"), sampled("c", "2")];
    assert_eq!((a.len(), &a), (40, &again));
    assert!(a.iter().filter(|key| other.contains(key)).count() < 10);
}
