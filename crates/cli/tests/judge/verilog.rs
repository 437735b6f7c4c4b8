//! A rasterizer in Verilog of another architecture, run in Icarus and judged by frame: it passes, and each of its faults
//! fails with its cause.

use super::{SIZE, Vertex, count, judged, npy, text, triangles};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Draws the triangles in Icarus and writes the arrays; `parameters` are those of the test bench.
fn drawn(folder: &Path, list: &[[Vertex; 3]], parameters: &[&str]) {
    let word = |value: f64, scale: f64| format!("{:016x}\n", (value * scale).round_ties_even() as i64);
    let scales = [256.0, 256.0, 65536.0 * 65536.0, 65536.0, 65536.0, 65536.0];
    let vertices = list.iter().flatten();
    let words =
        vertices.flat_map(|vertex| vertex.iter().zip(scales).map(|(value, scale)| word(*value, scale)));
    std::fs::write(folder.join("triangles.mem"), words.collect::<String>()).unwrap();
    let tiles = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/tiles.v");
    let mut compile = Command::new("iverilog");
    compile.args(["-g2001", "-s", "tb", "-o", "tb.vvp", &format!("-Ptb.COUNT={}", list.len())]);
    compile.args(parameters).arg(tiles).current_dir(folder);
    assert!(compile.status().expect("iverilog is installed").success());
    let output = Command::new("vvp").args(["-n", "tb.vvp"]).current_dir(folder).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    let pixels: Vec<Vec<u32>> =
        printed.lines().map(|line| line.split(' ').map(|n| n.parse().unwrap()).collect()).collect();
    assert_eq!(pixels.len(), SIZE.0 * SIZE.1, "{printed}");
    let shape = format!("({}, {})", SIZE.1, SIZE.0);
    let column =
        |place: usize| pixels.iter().flat_map(|pixel| pixel[place].to_le_bytes()).collect::<Vec<u8>>();
    npy(&folder.join("z.npy"), "<u4", &shape, &column(0));
    npy(&folder.join("coverage.npy"), "<u4", &shape, &column(4));
    let colors: Vec<u8> =
        pixels.iter().flat_map(|pixel| pixel[1..4].iter().map(|value| *value as u8)).collect();
    npy(&folder.join("rgb.npy"), "|u1", &format!("({}, {}, 3)", SIZE.1, SIZE.0), &colors);
}

fn judge_drawn(seed: u64, parameters: &[&str]) -> (Option<i32>, Value) {
    let folder = tempfile::tempdir().unwrap();
    let list = triangles(seed);
    std::fs::write(folder.path().join("in.tri"), text(&list)).unwrap();
    drawn(folder.path(), &list, parameters);
    judged(folder.path(), &["."])
}

#[test]
fn verilog_of_tiles_passes_on_three_inputs() {
    for seed in [1, 2, 3] {
        let (code, report) = judge_drawn(seed, &[]);
        assert_eq!((code, &report["wrong"]), (Some(0), &0.into()), "{report}");
        assert!(report["covered"].as_u64().unwrap() > 1000, "{report}");
    }
}

#[test]
fn each_fault_of_the_verilog_fails_with_its_cause() {
    for (parameters, cause) in [
        ("-Ptb.FILL=1", "missing"),
        ("-Ptb.FILL=1", "extra"),
        ("-Ptb.FARTHEST=1", "wrong-winner"),
        ("-Ptb.DEPTH_BITS=20", "depth"),
        ("-Ptb.DROP=500", "missing"),
    ] {
        let (code, report) = judge_drawn(1, &[parameters]);
        assert_eq!(code, Some(1), "{parameters}: {report}");
        assert!(count(&report, cause) > 0, "{parameters}: {report}");
        let examples = report["examples"].as_array().unwrap();
        assert!(examples.iter().any(|found| found["cause"] == cause), "{parameters}: {report}");
    }
}
