//! The gallery in `docs/` is what the program draws today. `EDGEWALK_BLESS=1` draws it anew.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Of a picture its pixels, of another file its bytes.
fn pixels(path: &Path) -> Vec<u8> {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    if path.extension().is_none_or(|end| end != "png") {
        return bytes;
    }
    let mut decoder = zune_png::PngDecoder::new(&bytes);
    let pixels = decoder.decode_raw().expect("a picture");
    assert_eq!(decoder.get_dimensions().map(|(width, height)| 3 * width * height), Some(pixels.len()));
    pixels
}

#[test]
fn the_gallery_is_what_is_drawn_today() {
    let committed = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/gallery");
    let folder = tempfile::tempdir().expect("a folder");
    let bless = std::env::var_os("EDGEWALK_BLESS").is_some();
    let out = if bless { committed.clone() } else { folder.path().join("gallery") };
    let program = env!("CARGO_BIN_EXE_edgewalk");
    let status =
        Command::new(program).args(["gallery", "--quiet", "--out"]).arg(&out).status().expect("it runs");
    assert!(status.success());
    let [drawn, kept] =
        [&out, &committed].map(|at| std::fs::read_to_string(at.join("README.md")).expect("a page"));
    assert!(drawn == kept, "figures changed; look at them, then EDGEWALK_BLESS=1 cargo test gallery::");
    let mut checked = 0;
    for entry in std::fs::read_dir(&out).expect("the gallery") {
        let name = entry.expect("an entry").file_name();
        let [new, old] = [&out, &committed].map(|at| pixels(&at.join(&name)));
        assert!(new == old, "{name:?} of docs/gallery is not what is drawn today");
        checked += 1;
    }
    println!("checked {checked} files");
    assert!(checked > 20);
}

#[test]
fn the_gallery_is_written_to_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = env!("CARGO_BIN_EXE_edgewalk");
    let mut gallery = Command::new(program);
    gallery.args(["gallery", "worked-example", "--quiet"]).current_dir(folder.path());
    assert!(gallery.status().expect("it runs").success());
    assert!(folder.path().join("out/gallery/README.md").exists() && !folder.path().join("docs").exists());
}
