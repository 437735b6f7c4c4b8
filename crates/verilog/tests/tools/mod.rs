//! The outside tools: Icarus, Verilator, Yosys. An absent tool fails the test.
#![allow(dead_code)] // every test file uses a part

pub mod bench;

use std::path::Path;
use std::process::Command;

/// Runs a tool in a directory and returns what it printed.
pub fn run(directory: &Path, tool: &str, arguments: &[&str]) -> String {
    let output = Command::new(tool).args(arguments).current_dir(directory).output();
    let output = output.unwrap_or_else(|error| {
        panic!("{tool} can not be run ({error}); this test needs: apt-get install -y --no-install-recommends iverilog verilator yosys")
    });
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{tool} {}:\n{text}", arguments.join(" "));
    text.into_owned()
}

/// Writes the files into a directory.
pub fn write(directory: &Path, files: &[(String, String)]) {
    for (name, text) in files {
        std::fs::write(directory.join(name), text).unwrap();
    }
}

/// `verilator -Wall` must be silent, with only the waivers given; every module is looked at through `top`.
pub fn lint(directory: &Path, files: &[(String, String)], top: &str, waivers: &[&str]) {
    let names: Vec<&str> =
        files.iter().map(|(name, _)| name.as_str()).chain(waivers.iter().copied()).collect();
    let text =
        run(directory, "verilator", &[&["--lint-only", "-Wall", "--top-module", top], &names[..]].concat());
    assert_eq!(text, "", "lint of {top}");
}
