//! What the tests of `edgewalk judge` share.

use super::{edgewalk, ended};
use serde_json::Value;
use std::path::Path;

/// Two triangles over most of the screen.
pub const TWO: &str = "size 32 32
T 1 1 .3 1 0 0 0  31 2 .5 0 1 0 0  2 30 .7 0 0 1 0
T 31 31 .4 1 1 0 0  31 2 .5 0 1 1 0  2 30 .6 1 0 1 0
";

/// A light whose map hides the left half of the screen, over a surface of running colours.
pub const SHADE: &str = "size 64 64
shadow 4 0.001 0.3   0.0625 0 0 0   0 0.0625 0 0   0 0 1 0   0 0 0 1
L  0 0 0.25   2 0 0.25   0 4 0.25
L  2 0 0.25   2 4 0.25   0 4 0.25
T 0 0 .5 1 0.9 0.1 0  64 0 .5 0 0.5 1 0  0 64 .5 0.3 1 0.7 0
T 64 64 .5 0.2 0.4 0.6 0  64 0 .5 0 0.5 1 0  0 64 .5 0.3 1 0.7 0
";

/// A folder with this file.
pub fn folder(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.tri"), text).unwrap();
    folder
}

/// Draws into the folder `out`.
pub fn raster(folder: &Path, options: &[&str], out: &str) {
    let words = [&["raster", "in.tri", "--out", out], options].concat();
    let (code, error) = ended(&edgewalk(folder, &words).output().unwrap());
    assert_eq!(code, Some(0), "{words:?}: {error}");
}

/// Judges: exit code, report, message.
pub fn judged(folder: &Path, options: &[&str]) -> (Option<i32>, Value, String) {
    let words = [&["judge", "in.tri", "--json"], options].concat();
    let output = edgewalk(folder, &words).output().unwrap();
    let (code, error) = ended(&output);
    (code, serde_json::from_slice(&output.stdout).unwrap_or_default(), error)
}
