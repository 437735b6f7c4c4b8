//! `tests/run` with a build and a Python part of our own: its exit code is that of the suites and of the Python part.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::root;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

/// Writes a shell script that can be run.
fn script(path: &Path, body: &str) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, format!("#!/bin/sh\n{body}\n")).unwrap();
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
}

/// The exit code of `tests/run` and what it prints, where the build, the suites and the Python part end as given.
fn run(build: &str, suites: &str, python: &str) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::create_dir(at.join("tests")).unwrap();
    fs::copy(root().join("tests/run"), at.join("tests/run")).unwrap();
    script(&at.join("tests/python"), python);
    script(&at.join("bin/cargo"), &format!("case \"$*\" in *--no-run*) {build};; *) {suites};; esac"));
    fs::create_dir(at.join("temporary")).unwrap();
    let path = format!("{}:{}", at.join("bin").display(), std::env::var("PATH").unwrap());
    let mut command = Command::new(at.join("tests/run"));
    let output = command.env("PATH", path).env("TMPDIR", at.join("temporary")).output().unwrap();
    let left = fs::read_dir(at.join("temporary")).unwrap().count();
    assert_eq!(left, 0, "temporary folders are left");
    let text = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8(text).unwrap())
}

#[test]
fn the_exit_code_of_the_whole_run_is_that_of_its_parts() {
    let passed = "echo 'test result: ok. 1 passed; finished in 2.00s'";
    let cases = [
        ("true", passed, "echo of Python", 0),
        // The Python part may end first or last.
        ("true", passed, "sleep 1; echo of Python", 0),
        ("true", "sleep 1", "echo of Python", 0),
        ("true", "exit 101", "echo of Python", 1),
        ("true", passed, "exit 1", 1),
        ("true", passed, "exit 3", 1),
        ("exit 101", passed, "echo of Python", 1),
    ];
    for (build, suites, python, code) in cases {
        let (ended, text) = run(build, suites, python);
        assert_eq!(ended, Some(code), "build `{build}`, suites `{suites}`, Python `{python}`: {text}");
        let complains = text.contains("tests/run: tests/python failed");
        assert_eq!(complains, python.starts_with("exit"), "{text}");
        assert_eq!(text.contains("tests/run: suites "), build == "true", "{text}");
    }
}
