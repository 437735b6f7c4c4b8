//! `--stalls` in `render` and `bench`, and how full queues and lanes are.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{SCREEN, TRIANGLE, edgewalk, run};
use serde_json::Value;
use std::path::Path;

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let output = edgewalk(folder, &[arguments, &["--json"]].concat()).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn a_stalling_memory_costs_cycles_of_its_own_cause_and_no_pixel() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let render = |stalls: &str, engine: &str| {
        let arguments = ["render", "a.tri", "--stalls", stalls, "--engine", engine, "--out", "out"];
        let report = json(folder.path(), &[&arguments[..], &SCREEN].concat());
        (report, std::fs::read(folder.path().join("out/image.png")).unwrap())
    };
    let (free, picture) = render("none", "fast");
    assert!(free["cycles"]["by_cause"]["memory"] == 0 && free["cycles"]["stalls"].is_null());
    for stalls in ["fixed:rd=3", "random:rd=100", "dram"] {
        let (report, same) = render(stalls, "fast");
        assert!(report["cycles"]["by_cause"]["memory"].as_u64() > Some(100), "{stalls} {}", report["cycles"]);
        assert!(report["cycles"]["total"].as_u64() > free["cycles"]["total"].as_u64());
        assert_eq!(report["cycles"]["path"], "ticked: the memory makes the machine wait");
        assert!(report["cycles"]["stalls"].as_str().unwrap().starts_with(stalls.split(':').next().unwrap()));
        assert!(same == picture, "{stalls}: another picture");
        let (model, _) = render(stalls, "model");
        assert_eq!(model["cycles"]["by_cause"], report["cycles"]["by_cause"]);
        let bench = ["bench", "a.tri", "--stalls", stalls, "--repeat", "1"];
        let rows = json(folder.path(), &bench)["engines"].as_array().unwrap().clone();
        let of = |name: &str| rows.iter().find(|row| row["engine"] == name).unwrap();
        assert_eq!(of("tick")["cycles"], report["cycles"]["total"]);
        assert_eq!(of("fast")["absent"], "its memory never makes the machine wait");
    }
    // One read after the other, each three clocks apart: 3 clocks more a fragment but for the last.
    let fragments = free["fragments"].as_u64().unwrap();
    let (paced, _) = render("fixed:rd=3,data=0,wr=0", "fast");
    let waits = paced["cycles"]["by_cause"]["memory"].as_u64().unwrap();
    assert!((3 * fragments - 8..3 * fragments).contains(&waits), "{waits} of {fragments}");
    for engine in ["golden", "rtl"] {
        let arguments = ["render", "a.tri", "--stalls", "dram", "--engine", engine];
        let (code, error) = run(folder.path(), &[&arguments[..], &SCREEN].concat());
        assert!(code == Some(2) && error.contains("draw with --engine fast"), "{error}");
    }
    for (stalls, says) in [("drm", "nearest: dram"), ("dram:refresh=13", "refresh = 13 is not permitted")] {
        let (code, error) = run(folder.path(), &["render", "a.tri", "--stalls", stalls]);
        assert!(code == Some(2) && error.contains(says), "{error}");
    }
    // The least time between refreshes leaves clocks for the picture.
    let (_, same) = render("dram:refresh=14", "fast");
    assert!(same == picture);
}

#[test]
fn occupancy_is_the_same_ticked_or_not_and_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    for settings in [
        &[][..],
        &["--set", "interpolator.adders=1"],
        &["--set", "memory.latency=8", "--set", "fifo.inflight=16"],
    ] {
        let of = |engine| {
            let arguments = [&["render", "a.tri", "--engine", engine], &SCREEN[..], settings].concat();
            json(folder.path(), &arguments)
        };
        let [fast, model] = ["fast", "model"].map(of);
        assert_eq!(fast["occupancy"], model["occupancy"], "{settings:?}");
        // Each fragment is in flight for as many clocks as the memory takes.
        let latency = if settings.len() > 2 { 8.0 } else { 2.0 };
        let number = |value: &Value| value.as_f64().unwrap();
        let mean = number(&fast["fragments"]) * latency / number(&fast["cycles"]["total"]);
        assert!((number(&fast["occupancy"]["inflight"]["mean"]) - mean).abs() < 1e-9);
        // One triangle: three edges and four channels at once on four lanes.
        let clocks = number(&fast["setup"]["clocks"]["most"]);
        let lanes = number(&fast["occupancy"]["lanes"]["mean"]) * number(&fast["cycles"]["total"]);
        let edges = 4.0 * clocks - lanes;
        assert!(
            (edges - edges.round()).abs() < 1e-6 && (16.0..24.0).contains(&edges),
            "S1 = {edges} of {clocks}"
        );
        assert!(
            number(&fast["occupancy"]["span_fifo"]["mean"]) <= number(&fast["occupancy"]["span_fifo"]["of"])
        );
    }
}
