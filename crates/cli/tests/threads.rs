//! Jobs over all cores: what comes out is the same for any number of threads.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Runs the program with so many threads and returns what it prints.
fn edgewalk(threads: &str, arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .env("RAYON_NUM_THREADS", threads)
        .args(arguments)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Every file under a folder.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().display().to_string();
                files.insert(name, std::fs::read(path).unwrap());
            }
        }
    }
    files
}

#[test]
fn vectors_are_the_same_files_in_the_same_order() {
    let folder = tempfile::tempdir().unwrap();
    let run = |threads: &str| {
        let out = folder.path().join(threads);
        let text = edgewalk(
            threads,
            &["vectors", "--suite", "hazards", "--json", "--out", &out.display().to_string()],
        );
        (text, contents(&out))
    };
    let (text, files) = run("1");
    assert!(files.len() > 30, "{} files", files.len());
    for threads in ["2", "5"] {
        let (other, made) = run(threads);
        assert_eq!(text, other, "{threads} threads");
        assert!(files == made, "{threads} threads");
    }
}

#[test]
fn verify_says_the_same() {
    let run = "verify sphere --triangles 5 --no-simulators --json";
    // A small machine, so that it takes seconds.
    let machine = "--set screen.width=24 --set screen.height=20 --set screen.guard_bits=6";
    let arguments: Vec<&str> = run.split(' ').chain(machine.split(' ')).collect();
    let text = edgewalk("1", &arguments);
    assert!(text.matches("\"checked\"").count() > 10, "{text}");
    assert_eq!(text, edgewalk("3", &arguments));
}
