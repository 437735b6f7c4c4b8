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
