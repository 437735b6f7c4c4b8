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
