//! `edgewalk raster`: the fast engine, streaming its file, against the ticking model, array by array.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use serde_json::Value;
use std::path::Path;
use std::process::Command;

const ARRAYS: [&str; 5] = ["coverage.npy", "writes.npy", "id.npy", "z.npy", "rgb.npy"];

/// Hourglasses over each other: the lower triangle begins with a pixel that the upper one ends with.
fn triangles() -> String {
    let pair = |i: i32| {
        let z = f64::from(i * 7 % 20) / 20.0;
        format!(
            "T 4 2 {z} 1 0 0 0  {} 2 0.5 0 1 0 0  20.5 20.5 {z} 0 0 1 0\n\
             T 20.5 19 0.5 1 1 0 0  2 40 {z} 0 1 0 0  60 {} {z} 1 0 1 0\n",
            40 + i,
            40 - i
        )
    };
    "size 64 48\nclear 0.25 0.5 1\n".to_owned() + &(0..20).map(pair).collect::<String>()
}

/// Draws with an engine into `out`, and returns the report.
fn raster(file: &Path, engine: &str, settings: &[&str], out: &Path) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.arg("raster").arg(file).args(["--engine", engine, "--json", "--out"]).arg(out);
    for setting in settings {
        command.args(["--set", setting]);
    }
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn fast_equals_model_and_says_when_it_ticked() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pairs.tri");
    std::fs::write(&file, triangles()).unwrap();
    let cases: [(&[&str], &str); 4] = [
        (&[], "without ticking"),
        (&["edge.kind=slope", "interpolator.adders=2"], "without ticking"),
        (&["fifo.inflight=8", "memory.latency=8"], "ticked: the in-flight queue may fill"),
        (
            &["memory.hazard=interlock", "interpolator.adders=1", "memory.latency=8"],
            "ticked: a fragment may have met its address in flight",
        ),
    ];
    for (settings, path) in cases {
        let [fast, model] = ["fast", "model"].map(|engine| folder.path().join(engine));
        let mut report = raster(&file, "fast", settings, &fast);
        let mut expected = raster(&file, "model", settings, &model);
        assert_eq!(report["cycles"]["path"], path);
        report["cycles"].as_object_mut().unwrap().remove("path");
        if path == "without ticking" {
            expected.as_object_mut().unwrap().remove("corners");
        }
        assert_eq!(report, expected);
        assert!(report["fragments"].as_u64().unwrap() > 1000);
        for array in ARRAYS {
            assert!(
                std::fs::read(fast.join(array)).unwrap() == std::fs::read(model.join(array)).unwrap(),
                "{array}"
            );
        }
    }
}

#[test]
fn a_fault_far_down_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pairs.tri");
    std::fs::write(&file, triangles() + "T 1 2 3\n").unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .arg("raster")
        .arg(&file)
        .arg("--out")
        .arg(folder.path().join("out"))
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("pairs.tri:43: T: `3 given`"), "{message}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "only the triangles");
}

#[test]
fn polygons_go_to_the_machine_as_triangles() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("polygons.tri");
    let text = "size 64 48\ndepth lequal\n\
                P 6  2 3 .5 1 0 0 0  30 1 .5 1 0 0 0  60 20 .5 1 0 0 0  50 45 .5 1 0 0 0  30 20 .5 1 0 0 0  2 40 .5 1 0 0 0\n\
                H 4  10 8 .5 1 0 0 0  20 8 .5 1 0 0 0  20 16 .5 1 0 0 0  10 16 .5 1 0 0 0\n\
                T 0 0 .5 0 1 0 0  20 0 .5 0 1 0 0  0 20 .5 0 1 0 0\n\
                P 3  64 48 .25 0 0 1 0  20 48 .25 0 0 1 0  64 10 .25 0 0 1 0\n";
    std::fs::write(&file, text).unwrap();
    let out = |engine: &str| folder.path().join(engine);
    let golden = raster(&file, "golden", &[], &out("golden"));
    for engine in ["fast", "model", "rtl"] {
        let report = raster(&file, engine, &[], &out(engine));
        for key in ["triangles", "polygons", "fragments", "writes"] {
            assert_eq!(report[key], golden[key], "{engine} {key}");
        }
        for array in &ARRAYS[..3] {
            let [drawn, expected] =
                [engine, "golden"].map(|name| std::fs::read(out(name).join(array)).unwrap());
            assert!(drawn == expected, "{engine} {array}");
        }
    }
    assert_eq!((&golden["triangles"], &golden["polygons"]), (&1.into(), &2.into()));
    assert!(golden["fragments"].as_u64().unwrap() > 1500);
}

#[test]
fn a_polygon_that_crosses_itself_is_for_golden_alone() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bow_tie.tri");
    let bow_tie = "size 9 9\nP 4  0 0 0 1 1 1 0  8 8 0 1 1 1 0  8 0 0 1 1 1 0  0 8 0 1 1 1 0\n";
    std::fs::write(&file, bow_tie).unwrap();
    assert_eq!(raster(&file, "golden", &[], &folder.path().join("golden"))["fragments"], 32);
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .arg("raster")
        .arg(&file)
        .arg("--out")
        .arg(folder.path().join("out"))
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("bow_tie.tri: polygon at vertex 8 0: the edge from there crosses"), "{message}");
}
