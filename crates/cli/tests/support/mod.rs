//! What the tests of the program's behaviour as a process share.
#![allow(clippy::unwrap_used, dead_code)] // a test that unwraps nothing reports it; no test uses all of it

use std::path::Path;
use std::process::{Command, Output, Stdio};

/// A triangle on 64 x 48 pixels.
pub const TRIANGLE: &str = "size 64 48\nT 0 0 0 1 0 0 0  60 0 0 0 1 0 0  0 40 1 0 0 1 0\n";

/// The screen of [`TRIANGLE`], for commands that do not take it from the file.
pub const SCREEN: [&str; 4] = ["--set", "screen.width=64", "--set", "screen.height=48"];

/// The program in a folder.
pub fn edgewalk(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null());
    command
}

/// Runs it to its end: exit code, standard error.
pub fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    ended(&edgewalk(folder, arguments).output().unwrap())
}

/// How it ended: exit code, standard error, which never tells of a panic or of a temporary folder.
pub fn ended(output: &Output) -> (Option<i32>, String) {
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!error.contains("panicked") && !error.contains(".edgewalk-"), "{error}");
    (output.status.code(), error)
}

/// What stands in a folder, by name, hidden files too.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// An array as numpy's format says: element type, shape, and the elements' bytes.
pub fn npy(path: &Path) -> (String, Vec<usize>, Vec<u8>) {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00", "magic and version");
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
    assert!(header.contains("'fortran_order': False"), "{header}");
    let behind = |key: &str, end: char| {
        let from = header.split_once(key).unwrap().1.trim_start().trim_start_matches(['\'', '(']);
        from.split_once(end).unwrap().0.to_owned()
    };
    let shape = behind("'shape':", ')');
    let shape =
        shape.split(',').map(str::trim).filter(|n| !n.is_empty()).map(|n| n.parse().unwrap()).collect();
    (behind("'descr':", '\''), shape, bytes[10 + length..].to_vec())
}
