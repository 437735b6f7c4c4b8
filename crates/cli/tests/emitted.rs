//! Comments of emitted Verilog say what the machine does: they are compared with its code, its trace and its vectors.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::run;
use std::path::Path;

fn edgewalk(folder: &Path, arguments: &[&str]) {
    let (code, told) = run(folder, arguments);
    assert_eq!(code, Some(0), "{arguments:?}: {told}");
}

fn text(folder: &Path, file: &str) -> String {
    std::fs::read_to_string(folder.join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

/// Emits a machine into the folder `hdl`.
fn emit(folder: &Path, machine: &[&str]) {
    edgewalk(folder, &[&["emit", "--quiet", "--out", "hdl"][..], machine].concat());
}

/// The comment behind the declaration of a port or register.
fn comment<'a>(verilog: &'a str, name: &str) -> &'a str {
    let declares = |line: &&str| {
        let code = line.split("//").next().unwrap().trim().trim_end_matches([',', ';']);
        code.ends_with(&format!(" {name}"))
    };
    let line = verilog.lines().find(declares).unwrap_or_else(|| panic!("no {name}"));
    line.split_once("// ").unwrap_or_else(|| panic!("no comment: {line}")).1
}

/// The comment of `kind` names a line where SETUP compares it with the code of a line, and nowhere else.
#[test]
fn comments_of_kind_name_the_codes_compared() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (machine, lines) in [
        (&["--machine", "polygon"][..], false),
        (&["--machine", "bilinear"], false),
        (&["--machine", "polygon", "--set", "polygon.lines=yes"], true),
    ] {
        emit(folder, machine);
        let [top, setup] = ["edgewalk", "edgewalk_setup"].map(|name| text(folder, &format!("hdl/{name}.v")));
        assert_eq!(setup.contains("== 2'd3"), lines, "{machine:?}");
        for told in [comment(&top, "tri_kind"), comment(&setup, "tri_kind"), comment(&setup, "kind")] {
            assert_eq!(told.contains("3 line"), lines, "{machine:?}: {told}");
            assert_eq!(told.contains("0 or 3 triangle"), !lines, "{machine:?}: {told}");
        }
    }
}
