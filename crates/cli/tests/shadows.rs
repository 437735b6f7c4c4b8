//! Shadows through the program: lit.npy of the page of the format, and who has none.

use std::path::Path;
use std::process::{Command, Output};

fn edgewalk(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program runs")
}

#[test]
fn the_example_of_the_format_gives_lit_npy() {
    let page = include_str!("../../../docs/triangle_file.md");
    let example = page.rsplit("```").nth(1).expect("an example at the end");
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.tri"), example).expect("written");
    let output = edgewalk(folder.path(), &["raster", "a.tri", "--engine", "golden", "--out", "OUT"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let lit = std::fs::read(folder.path().join("OUT/lit.npy")).expect("lit.npy");
    assert!(lit.starts_with(b"\x93NUMPY") && String::from_utf8_lossy(&lit[..128]).contains("u1"));
    assert_eq!(lit[lit.len() - 16..], [1, 1, 2, 2].repeat(4));
    let z = std::fs::read(folder.path().join("OUT/z.npy")).expect("z.npy");
    assert_eq!(z[z.len() - 16 * 8..], 0.5f64.to_le_bytes().repeat(16));
}

#[test]
fn only_the_golden_picture_has_shadows() {
    let folder = tempfile::tempdir().expect("a folder");
    for (arguments, word) in [
        (["render", "sphere", "--shadows", "map"], "--engine golden"),
        (["render", "sphere", "--shadows", "rays"], "ray"),
    ] {
        let output = edgewalk(folder.path(), &arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(word), "{error}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 0);
}
