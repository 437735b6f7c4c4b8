//! `edgewalk compare` as a user runs it.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{colors, edgewalk, names, run};
use serde_json::{Value, json};
use std::path::Path;

fn compare(folder: &Path, arguments: &[&str]) -> Value {
    let output = edgewalk(folder, &[&["compare"], arguments, &["--json"]].concat()).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn what_differs_is_told_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let adders = compare(folder.path(), &["default", "default,interpolator.adders=1", "sphere"]);
    assert_eq!(adders["keys"], json!({ "interpolator.adders": [4, 1] }));
    assert_eq!((&adders["pixels"]["color"], &adders["pixels"]["depth"]), (&0.into(), &0.into()));
    let [a, b] = ["a", "b"].map(|side| &adders[side]["report"]);
    assert_eq!(adders["figures"]["cycles"], json!([a["cycles"]["total"], b["cycles"]["total"]]));
    assert!(a["cycles"]["total"].as_u64() < b["cycles"]["total"].as_u64());
    assert!(adders["figures"]["fragments"].is_null() && adders["figures"]["z error, LSB"].is_null());
    let text = std::fs::read_to_string(folder.path().join("out/compare/compare.txt")).unwrap();
    let keys = text.split("keys").nth(1).unwrap().split("figures that differ").next().unwrap();
    assert!(keys.contains("interpolator.adders") && keys.lines().count() == 2, "{text}");
    assert!(text.contains("cycles: draw") && !text.contains("z error"), "{text}");
    // Each side is what `render` says.
    let rendered = edgewalk(folder.path(), &["render", "sphere", "--json", "--set", "interpolator.adders=1"])
        .output()
        .unwrap();
    assert_eq!(*b, serde_json::from_slice::<Value>(&rendered.stdout).unwrap());
    assert_eq!(
        names(&folder.path().join("out/compare")),
        ["a.png", "b.png", "compare.json", "compare.txt", "difference.png"]
    );
    // Word lengths change pixels, and settings of --set hold for both.
    let set = ["--set", "screen.width=160", "--set", "screen.height=120"];
    let bits = compare(
        folder.path(),
        &[&["default", "default,formats.color_fraction=4", "sphere"], &set[..]].concat(),
    );
    assert_eq!(bits["keys"], json!({ "formats.color_fraction": [14, 4] }));
    assert_eq!(bits["pixels"]["all"], 160 * 120);
    assert!(
        bits["pixels"]["color"].as_u64() > Some(10) && bits["pixels"]["depth"] == 0,
        "{}",
        bits["pixels"]
    );
    // Pictures are of 8 bits, so their files have the very difference.
    let [a, b] =
        ["a.png", "b.png"].map(|name| colors(&folder.path().join("out/compare").join(name)).concat());
    let apart = a.iter().zip(&b).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
    let largest = bits["pixels"]["largest_color_difference"].as_f64().unwrap();
    assert!(apart > 0 && (largest * 255.0 - f64::from(apart)).abs() < 1e-9, "{apart}: {largest}");
    let same = compare(folder.path(), &["default", "default", "sphere", "--stalls", "dram"]);
    assert_eq!((&same["keys"], &same["figures"]), (&json!({}), &json!({})));
    assert!(
        same["a"]["report"]["cycles"]["by_cause"]["memory"].as_u64() > Some(1000),
        "{}",
        same["a"]["report"]["cycles"]
    );
}

#[test]
fn what_cannot_be_compared_is_said() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, said) in [
        (["default", "default,screen.width=320", "sphere"], "the screens differ, 640x480 and 320x480"),
        (["default", "defalt", "sphere"], "nearest preset: default"),
        (["default", "default,adders=1", "sphere"], "nearest: interpolator.adders"),
        (["default", "textbook", "nosuch.obj"], "nosuch.obj"),
    ] {
        let (code, error) = run(folder.path(), &[&["compare"], &arguments[..]].concat());
        assert!(code == Some(2) && error.contains(said), "{error}");
    }
    assert!(names(folder.path()).is_empty());
}
