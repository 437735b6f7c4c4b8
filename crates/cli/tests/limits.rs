//! Large pictures and endless words: memory stays small, and a refusal comes at once.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::ended;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

/// Runs the program with so many megabytes of address space.
fn within(megabytes: u64, folder: &Path, arguments: &[&str]) -> Output {
    let script = format!("ulimit -v {} && exec \"$@\"", megabytes * 1000);
    let mut shell = Command::new("sh");
    shell.args(["-c", &script, "sh", env!("CARGO_BIN_EXE_edgewalk")]).args(arguments);
    shell.current_dir(folder).output().unwrap()
}

/// Side of the picture, and what the process may take for it: 22 bytes a pixel, as 1.5 GB for 8192 x 8192 are, and what
/// any run takes (code, stacks, address space that the allocator sets apart).
const SIDE: u64 = 3072;
const LIMIT: u64 = SIDE * SIDE * 22 / 1_000_000 + 150;

#[test]
fn a_large_picture_takes_22_bytes_a_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let all = 2 * SIDE;
    // Every pixel is touched, and a steep triangle lies over lines of every band of the picture.
    let text = format!(
        "size {SIDE} {SIDE}\nT 0 0 0.5 1 0 0 0  {all} 0 0.5 0 1 0 0  0 {all} 1 0 0 1 0\n\
         T 7.5 0 0.25 1 1 1 0  {SIDE} {SIDE} 0.25 1 1 1 0  11 {SIDE} 0.25 1 1 1 0\n"
    );
    std::fs::write(folder.path().join("large.tri"), text).unwrap();
    let mut fragments = Vec::new();
    for engine in ["fast", "golden"] {
        let arguments = ["raster", "large.tri", "--engine", engine, "--json", "--out", engine];
        let output = within(LIMIT, folder.path(), &arguments);
        assert_eq!(ended(&output), (Some(0), String::new()), "{engine} in {LIMIT} MB");
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        fragments.push(report["fragments"].as_u64().unwrap());
        let header_and = |bytes: u64| SIDE * SIDE * bytes + 128;
        for (file, bytes) in [("z", 8), ("rgb", 24)] {
            let length = std::fs::metadata(folder.path().join(format!("{engine}/{file}.npy"))).unwrap().len();
            assert_eq!(length, header_and(bytes), "{engine} {file}");
        }
    }
    assert!(fragments[0] > SIDE * SIDE * 5 / 4 && fragments[0] == fragments[1], "{fragments:?}");
    for file in ["coverage.npy", "writes.npy", "id.npy"] {
        let [fast, golden] =
            ["fast", "golden"].map(|engine| std::fs::read(folder.path().join(engine).join(file)).unwrap());
        assert!(fast == golden, "{file}: bands in another order or place");
    }
    println!("checked {} fragments of 2 / 2 engines in {LIMIT} MB", fragments[0]);
}

#[test]
fn an_endless_word_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    // 300 MB without a blank or a line end; a hole in the disk.
    for name in ["long.tri", "long.obj", "long.mtl", "long.toml", "machine.toml"] {
        File::create(at(name)).unwrap().set_len(300_000_000).unwrap();
    }
    std::fs::write(at("mesh.obj"), "mtllib long.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    // As long as permitted, and one key.
    std::fs::write(at("key.toml"), "x".repeat((16 << 20) - 5) + " = 1\n").unwrap();
    std::fs::write(at("machine_key.toml"), "[screen]\n".to_owned() + &"x".repeat(1 << 19) + " = 1\n")
        .unwrap();
    std::fs::write(at("word.tri"), "size 8 8\n".to_owned() + &"x".repeat(10 << 20) + " 1\n").unwrap();
    std::fs::write(at("number.tri"), "size 8 8\nT ".to_owned() + &"1 ".repeat(10 << 20) + "\n").unwrap();
    let runs: [(&[&str], &str); 11] = [
        (&["raster", "long.tri", "--out", "o"], "long.tri:1: line: "),
        (&["raster", "long.tri", "--engine", "golden", "--out", "o"], "long.tri:1: line: "),
        (&["render", "long.tri"], "long.tri:1: line: "),
        (&["render", "long.obj"], "long.obj:1: line: "),
        (&["render", "mesh.obj"], "long.mtl:1: line: "),
        (&["render", "long.toml"], "long.toml: length: "),
        (&["render", "key.toml"], "key.toml:1: key: "),
        (&["emit", "--machine", "machine.toml"], "--machine machine.toml: permitted: at most"),
        (&["emit", "--machine", "machine_key.toml"], "machine_key.toml: line 2: unknown key screen.xxx"),
        (&["raster", "word.tri", "--out", "o"], "word.tri:2: line starts with: "),
        (&["raster", "number.tri", "--out", "o"], "number.tri:2: T: "),
    ];
    for (arguments, says) in runs {
        let start = Instant::now();
        let output = within(300, folder.path(), arguments);
        let (code, error) = ended(&output);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        assert!(error.starts_with(&format!("error: {says}")), "{arguments:?}: {error}");
        assert!(error.len() < 1000, "{arguments:?}: {} bytes of message", error.len());
        assert!(start.elapsed() < Duration::from_secs(10), "{arguments:?} took {:?}", start.elapsed());
    }
    println!("checked {0} / {0} inputs", runs.len());
}
