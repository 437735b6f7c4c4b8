//! `edgewalk judge`: what it compares with what, and by how much a picture may be off.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, ended};
use serde_json::Value;
use std::path::Path;

/// Two triangles over most of the screen.
const TWO: &str = "size 32 32
T 1 1 .3 1 0 0 0  31 2 .5 0 1 0 0  2 30 .7 0 0 1 0
T 31 31 .4 1 1 0 0  31 2 .5 0 1 1 0  2 30 .6 1 0 1 0
";

/// A folder with this file.
fn folder(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.tri"), text).unwrap();
    folder
}

/// Draws into the folder `out`.
fn raster(folder: &Path, options: &[&str], out: &str) {
    let words = [&["raster", "in.tri", "--out", out], options].concat();
    let (code, error) = ended(&edgewalk(folder, &words).output().unwrap());
    assert_eq!(code, Some(0), "{words:?}: {error}");
}

/// Judges: exit code, report, message.
fn judged(folder: &Path, options: &[&str]) -> (Option<i32>, Value, String) {
    let words = [&["judge", "in.tri", "--json"], options].concat();
    let output = edgewalk(folder, &words).output().unwrap();
    let (code, error) = ended(&output);
    (code, serde_json::from_slice(&output.stdout).unwrap_or_default(), error)
}

/// A picture of `lit` alone has nothing in common with that of a machine without SHADOW.
#[test]
fn judge_that_compares_nothing_ends_with_2() {
    let folder = folder(TWO);
    raster(folder.path(), &["--engine", "golden"], "g");
    let (code, _, error) = judged(folder.path(), &["g/lit.npy", "--against", "machine"]);
    assert_eq!(code, Some(2), "{error}");
    for part in
        ["a machine without SHADOW has none", "permitted: one or more of coverage, id, z and rgb", "add"]
    {
        assert!(error.contains(part), "{error}");
    }
    let (code, report, error) = judged(folder.path(), &["g/lit.npy"]);
    assert_eq!((code, &report["compared"]), (Some(0), &serde_json::json!(["lit"])), "{error}");
}

/// Six layers of glass over half of the screen.
fn glass() -> String {
    let layer = |n: u32| {
        let (z, c) = (f64::from(6 - n) / 10.0, f64::from(n % 4) / 3.0);
        format!("T 0 0 {z} 1 {c} 0.3 .5  32 0 {z} {c} 1 0.1 .5  0 32 {z} 0.2 {c} 1 .5\n")
    };
    "size 32 32\nblend 1\n".to_owned() + &(0..6).map(layer).collect::<String>()
}

/// Bits that are the machine's own are no other format: the bound of the layers holds. Other bits have 1 LSB.
#[test]
fn bits_of_the_machine_leave_its_bounds() {
    let glass = glass();
    for (text, set) in [(TWO, "blend.kind=none"), (&glass[..], "blend.kind=constant")] {
        let (folder, set) = (folder(text), ["--set", set]);
        raster(folder.path(), &set, "m");
        let judged = |options: &[&str]| judged(folder.path(), &[&["m"], &set[..], options].concat());
        let (code, report, error) = judged(&[]);
        let (own, other) = (["--color-bits", "8", "--depth-bits", "24"], ["--color-bits", "7"]);
        assert_eq!(code, Some(0), "{error}{report}");
        let (code, with_bits, error) = judged(&own);
        assert_eq!((code, &with_bits), (Some(0), &report), "{error}");
        assert_eq!(judged(&other).1["tolerance"]["color"], 1.0);
        let is_glass = text != TWO;
        let layers = &report["tolerance"]["layers"];
        assert_eq!(layers.as_f64().is_some_and(|most| most > 1.0), is_glass, "{layers}");
        assert!(judged(&other).1["tolerance"]["layers"].is_null());
        let text =
            edgewalk(folder.path(), &["judge", "in.tri", "m", set[0], set[1]]).output().unwrap().stdout;
        assert_eq!(String::from_utf8(text).unwrap().contains("behind the layers of a pixel"), is_glass);
    }
}
