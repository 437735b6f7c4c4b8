//! What a directory of vectors has for other tools than its Makefile's simulators: a core file for FuseSoC, and cocotb.

use crate::support::{edgewalk, root};
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use yaml_rust2::{Yaml, YamlLoader};

fn run(folder: &Path, arguments: &[&str]) {
    let output = edgewalk(folder, arguments).output().expect("the program runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Our PIXEL, and a design of another hand.
fn directories(folder: &Path) -> [PathBuf; 2] {
    for name in ["pixel.toml", "my_pixel.v"] {
        fs::copy(root().join("docs/own_rtl").join(name), folder.join(name)).expect("copied");
    }
    let of =
        ["vectors", "--suite", "hazards", "--only", "flat_top", "--suite", "corners", "--no-csv", "--quiet"];
    run(folder, &[&of[..], &["--unit", "pixel", "--out", "ours"]].concat());
    run(folder, &[&of[..], &["--dut", "pixel.toml", "--out", "own"]].concat());
    ["ours", "own"].map(|out| folder.join(out).join("corners_pixel"))
}

/// The core file of a folder, and the names of its files by how they are used: compiled, included, read.
fn core(folder: &Path) -> (Yaml, [Vec<String>; 3]) {
    let text = fs::read_to_string(folder.join("edgewalk.core")).expect("a file");
    assert!(text.starts_with("CAPI=2:\n# SPDX-License-Identifier: "), "{text}");
    let core = YamlLoader::load_from_str(&text).expect("YAML").remove(0);
    let mut used: [Vec<String>; 3] = Default::default();
    for set in core["filesets"].as_hash().expect("a table").values() {
        for file in set["files"].as_vec().expect("a list") {
            let Some(table) = file.as_hash() else {
                used[0].push(file.as_str().expect("a name").to_owned());
                continue;
            };
            let (name, how) = table.iter().next().expect("a file");
            let name = name.as_str().expect("a name").to_owned();
            match how["is_include_file"].as_bool() {
                Some(true) => used[1].push(name),
                _ => {
                    assert_eq!(
                        (how["file_type"].as_str(), how["copyto"].as_str()),
                        (Some("user"), Some(&*name))
                    );
                    used[2].push(name);
                }
            }
        }
    }
    (core, used)
}

#[test]
fn core_files_name_what_the_bench_needs() {
    let folder = tempfile::tempdir().expect("a folder");
    for (directory, top) in directories(folder.path()).into_iter().zip(["edgewalk_pixel", "my_pixel"]) {
        let (core, [compiled, included, read]) = core(&directory);
        assert_eq!(core["name"].as_str(), Some("edgewalk:vectors:corners_pixel:0.1.0"));
        let list = fs::read_to_string(directory.join("filelist.f")).expect("a file");
        let list: Vec<&str> =
            list.lines().filter(|line| !line.starts_with("//") && !line.starts_with('+')).collect();
        assert_eq!(compiled, list);
        let sums = fs::read_to_string(directory.join("SHA256SUMS")).expect("a file");
        let summed: BTreeSet<&str> = sums.lines().filter_map(|line| Some(line.split_once("  ")?.1)).collect();
        assert_eq!(included.iter().chain(&read).map(String::as_str).collect::<BTreeSet<_>>(), summed);
        let targets = &core["targets"];
        assert_eq!(targets["default"]["toplevel"].as_str(), Some(top));
        assert_eq!(targets["lint"]["toplevel"].as_str(), Some(top));
        for simulator in ["icarus", "verilator"] {
            assert_eq!(targets[simulator]["toplevel"].as_str(), Some("tb"));
            assert_eq!(targets[simulator]["default_tool"].as_str(), Some(simulator));
        }
    }
    run(folder.path(), &["emit", "--quiet", "--out", "hdl"]);
    let (core, [compiled, included, read]) = core(&folder.path().join("hdl"));
    assert!(core["name"].as_str().is_some_and(|name| name.starts_with("edgewalk:hdl:machine_")));
    let list = fs::read_to_string(folder.path().join("hdl/filelist.f")).expect("a file");
    assert_eq!(compiled, list.lines().filter(|line| !line.starts_with("//")).collect::<Vec<_>>());
    assert!(included.is_empty() && read.is_empty());
}

/// No part of the test run, as it needs FuseSoC:
/// `EDGEWALK_FUSESOC=venv/bin/fusesoc cargo test --release -p edgewalk-cli targets:: -- --ignored`
#[test]
#[ignore = "needs FuseSoC"]
fn fusesoc_runs_and_lints_the_cores() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = std::env::var("EDGEWALK_FUSESOC").unwrap_or_else(|_| "fusesoc".to_owned());
    let fusesoc = |library: &Path, target: &str, core: &str| {
        let mut command = Command::new(&program);
        command.arg("--cores-root").arg(library).args(["run", "--target", target, core]);
        let output = command.current_dir(folder.path()).output().expect("FuseSoC runs");
        let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
        assert!(output.status.success(), "{target}: {text}");
        text
    };
    for directory in directories(folder.path()) {
        for simulator in ["icarus", "verilator"] {
            let text = fusesoc(&directory, simulator, "edgewalk:vectors:corners_pixel");
            assert!(text.lines().any(|line| line == "PASS"), "{simulator}: {text}");
        }
        fusesoc(&directory, "lint", "edgewalk:vectors:corners_pixel");
    }
    run(folder.path(), &["emit", "--quiet", "--out", "hdl"]);
    let hash = core(&folder.path().join("hdl")).0["name"].as_str().expect("a name").to_owned();
    fusesoc(&folder.path().join("hdl"), "lint", &hash);
}

/// `make cocotb` calls the package for the directory by the Python and the simulator that are asked for.
#[test]
fn make_calls_the_package_of_cocotb() {
    let folder = tempfile::tempdir().expect("a folder");
    let [ours, _] = directories(folder.path());
    let python = folder.path().join("python");
    let make = |script: &str| {
        fs::write(&python, format!("#!/bin/sh\n{script}\n")).expect("written");
        fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).expect("a file of ours");
        let mut command = Command::new("make");
        command.arg("-C").arg(&ours).args(["--no-print-directory", "cocotb", "SIMULATOR=verilator"]);
        let output = command.arg(format!("PYTHON={}", python.display())).output().expect("make is installed");
        (output.status.code(), [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat())
    };
    let wanted = format!("-m edgewalk_vectors {} --simulator verilator\n", ours.display());
    assert_eq!(make("if [ $1 = -m ]; then echo $@; fi"), (Some(0), wanted));
    let (code, said) = make("exit 1");
    assert!(
        code == Some(2) && said.contains("has no package edgewalk_vectors; try: pip install ./python"),
        "{said}"
    );
}
