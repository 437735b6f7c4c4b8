//! What a feature costs: machines that shade differently in one sweep, each judged by what it draws, all held against one equation.

use super::oracle::table;
use super::{rendered, rows};
use crate::support::{colors, edgewalk, run};
use serde_json::Value;
use std::path::Path;

/// A pyramid with the normals of something round and a grey highlight, which every kind of shading takes.
const PYRAMID: &str = "mtllib p.mtl\nusemtl m
v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.4 0
vn -0.6 0.53 -0.6\nvn 0.6 0.53 -0.6\nvn 0.6 0.53 0.6\nvn -0.6 0.53 0.6\nvn 0 1 0
f 1//1 5//5 2//2\nf 2//2 5//5 3//3\nf 3//3 5//5 4//4\nf 4//4 5//5 1//1\n";
const MATERIAL: &str = "newmtl m\nKd 0.5 0.4 0.3\nKs 0.4 0.4 0.4\nNs 20\n";

/// The mesh `p.obj` in a folder.
pub fn pyramid(at: &Path) {
    std::fs::write(at.join("p.obj"), PYRAMID).unwrap();
    std::fs::write(at.join("p.mtl"), MATERIAL).unwrap();
}

const SCREEN: [&str; 4] = ["--set", "screen.width=96", "--set", "screen.height=72"];

/// The distance of a picture from the equation, from the files that `render` writes, LSB of 8 bits: largest and mean.
fn distance(at: &Path, shading: &[&str]) -> (f64, f64) {
    let draw = |out: &str, more: &[&str]| {
        let (_, error) =
            run(at, &[&["render", "p.obj", "--quiet", "--out", out], &SCREEN[..], more].concat());
        assert_eq!(error, "");
    };
    draw("truth", &["--engine", "golden"]);
    draw("drawn", shading);
    let [truth, golden, drawn] =
        ["truth/truth.png", "truth/image.png", "drawn/image.png"].map(|name| colors(&at.join(name)));
    // Where golden shows the background the truth does as well.
    let background = golden[0];
    let shown = truth.iter().zip(&drawn).filter(|(truth, _)| **truth != background);
    let worst = |(a, b): (&[u8; 3], &[u8; 3])| f64::from((0..3).map(|i| a[i].abs_diff(b[i])).max().unwrap());
    let all: Vec<f64> = shown.map(worst).collect();
    assert!(all.len() > 300, "{} pixels", all.len());
    (all.iter().copied().fold(0.0, f64::max), all.iter().sum::<f64>() / all.len() as f64)
}

#[test]
fn machines_are_judged_by_what_they_draw() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    pyramid(at);
    let vary =
        ["sweep", "p.obj", "--vary", "shade.kind=none,fast-phong,phong", "--vary", "interpolator.adders=1,4"];
    let sweep = [&vary[..], &SCREEN, &["--out", "s", "--json"]].concat();
    let output = edgewalk(at, &sweep).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((output.status.code(), &told["status"]["ok"]), (Some(0), &6.into()), "{told}");
    let ways = [("none", "gouraud"), ("fast-phong", "fast-phong"), ("phong", "phong")];
    let rows = rows(&at.join("s"));
    let mut means = Vec::new();
    for (kind, shading) in ways {
        for row in rows.iter().filter(|row| row["keys"]["shade.kind"] == kind) {
            assert_eq!(row["shading"], shading);
            assert_eq!(row["report"], rendered(at, row), "{kind}");
            let (largest, mean) =
                distance(at, &["--shading", shading, "--set", &format!("shade.kind={kind}")]);
            // Files round the equation to 8 bits.
            let of = |name: &str| row["equation"][name].as_f64().unwrap();
            assert!(
                (of("largest") - largest).abs() <= 0.51 && (of("mean") - mean).abs() < 0.3,
                "{kind}: {} {largest} {mean}",
                row["equation"]
            );
            means.push(of("mean"));
        }
    }
    assert_eq!(means.len(), 6);
    assert!(means[0] > 2.0 * means[4], "Phong is nearer to the equation than Gouraud: {means:?}");
    // Where shadings differ the distance from the equation stands for the error of colours.
    let best = |name: &str| told["best"][name]["keys"]["shade.kind"].as_str().unwrap();
    assert_eq!(best("cycles"), "none");
    assert!(told["best"]["color_error"].is_null() && best("shading_mean") != "none", "{told}");
    let least = means.iter().copied().fold(f64::MAX, f64::min);
    assert_eq!(told["best"]["shading_mean"]["values"]["shading_mean"].as_f64(), Some(least));
    let html = std::fs::read_to_string(at.join("s/report.html")).unwrap();
    assert!(table(&html, "The first front")[0].contains(&"shading_mean".to_owned()));
    // The command of a row draws it again: the page adds the shading to it.
    assert!(html.contains("--shading ${get(row, \"shading\")}"));
}

#[test]
fn rows_without_the_distance_are_made_again() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    pyramid(at);
    let made = |objective: &[&str]| -> u64 {
        let vary = ["sweep", "p.obj", "--vary", "setup.lanes=1,2", "--out", "s", "--json"];
        let output = edgewalk(at, &[&vary[..], &SCREEN, objective].concat()).output().unwrap();
        serde_json::from_slice::<Value>(&output.stdout).unwrap()["made"].as_u64().unwrap()
    };
    let distance = ["--objective", "shading_error", "--objective", "cycles"];
    assert_eq!([made(&[]), made(&[]), made(&distance), made(&distance), made(&[])], [2, 0, 2, 0, 0]);
}

#[test]
fn a_shading_asked_for_holds_for_all() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    pyramid(at);
    let sweep =
        ["sweep", "p.obj", "--vary", "setup.lanes=1,4", "--shading", "constant", "--out", "s", "--quiet"];
    assert_eq!(run(at, &[&sweep[..], &SCREEN].concat()), (Some(0), String::new()));
    for row in rows(&at.join("s")) {
        assert_eq!((&row["shading"], &row["report"]), (&"constant".into(), &rendered(at, &row)));
    }
    // Gouraud on a machine that shades by normals is refused as before.
    let sweep =
        ["sweep", "p.obj", "--vary", "shade.kind=none,phong", "--shading", "gouraud", "--out", "t", "--json"];
    let output = edgewalk(at, &[&sweep[..], &SCREEN].concat()).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&told["status"]["ok"], &told["status"]["failed"]), (&1.into(), &1.into()));
}
