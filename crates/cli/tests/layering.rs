//! What each crate may know, read from the manifests (`docs/architecture.md`).

use std::collections::BTreeSet;
use std::path::PathBuf;

/// Every crate, in the order of the data, with all it may depend on outside its tests.
const LAYERS: &[(&str, &[&str])] = &[
    ("nearest", &[]),
    ("numerics", &[]),
    ("machine", &["nearest", "numerics"]),
    ("scene", &["nearest"]),
    ("golden", &["scene"]),
    ("model", &["machine"]),
    ("host", &["numerics", "machine", "scene", "golden", "model"]),
    ("judge", &["numerics", "machine", "scene", "golden", "model", "host"]),
    ("explain", &["numerics", "machine", "scene", "golden", "model", "host", "judge"]),
    ("gallery", &["machine", "scene", "golden", "model", "host", "judge", "explain"]),
    ("netlist", &[]),
    ("verilog", &["netlist"]),
    ("jit", &["netlist"]),
    ("rtl", &["machine", "netlist"]),
    ("lockstep", &["machine", "model", "netlist", "rtl"]),
    ("tool", &[]),
    ("vectors", &["nearest", "machine", "model", "netlist", "verilog", "rtl", "lockstep", "tool"]),
    ("replay", &["machine", "model"]),
    ("synth", &["machine", "netlist", "verilog", "rtl", "tool"]),
    ("bench", &["machine", "model", "netlist", "verilog", "jit", "rtl", "lockstep", "tool"]),
    ("explore", &["numerics", "machine", "scene", "golden", "model", "host", "judge"]),
    ("files", &["scene", "host", "judge", "tool"]),
    (
        "cli",
        &[
            "numerics", "machine", "scene", "golden", "model", "host", "judge", "gallery", "explain",
            "netlist", "verilog", "jit", "rtl", "lockstep", "tool", "vectors", "replay", "synth", "bench",
            "explore", "files",
        ],
    ),
    ("capi", &["machine", "scene", "model", "lockstep", "host"]),
    ("python", &["machine", "scene", "model", "jit", "host", "judge", "lockstep", "vectors", "explore"]),
];

/// What the tests of a crate may know beyond that.
const TESTS: &[(&str, &[&str])] = &[
    ("golden", &["numerics"]),                             // its proved bounds
    ("model", &["numerics", "scene", "golden"]),           // proved bounds, and what ought to be drawn
    ("jit", &["machine", "model", "lockstep", "vectors"]), // whole machines, and what drives them
    ("lockstep", &["jit"]),                                // what runs netlists quickly
    ("vectors", &["jit"]),                                 // the same
    ("replay", &["netlist", "lockstep"]),                  // the machine's registers in the netlist
];

/// Written from the same text by different hands: neither may know the other, not in tests either, nor through a third crate.
const STRANGERS: [&str; 2] = ["model", "rtl"];

/// Crates that read and write no files: they may not even name the standard library's file or process modules.
const NO_FILES: &[&str] = &[
    "nearest", "numerics", "machine", "golden", "model", "judge", "gallery", "explain", "netlist", "verilog",
    "jit", "rtl", "lockstep", "replay",
];

fn crates() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The crates of the workspace that some kinds of a crate's dependencies name, whatever they are called there.
fn known(name: &str, kinds: &[&str]) -> BTreeSet<String> {
    let text = std::fs::read_to_string(crates().join(name).join("Cargo.toml")).expect("a manifest");
    let manifest: toml::Table = text.parse().expect("TOML");
    // `[dependencies]`, and `[target.'cfg(..)'.dependencies]`.
    let targets = manifest.get("target").and_then(toml::Value::as_table).into_iter().flat_map(|t| t.values());
    let tables = targets.filter_map(toml::Value::as_table).chain([&manifest]);
    let lists = tables.flat_map(|table| kinds.iter().filter_map(|kind| table.get(*kind)?.as_table()));
    let names = lists.flatten().map(|(key, value)| {
        let package = value.get("package").and_then(toml::Value::as_str);
        package.unwrap_or(key).to_owned()
    });
    names.filter_map(|name| name.strip_prefix("edgewalk-").map(str::to_owned)).collect()
}

const OWN: &[&str] = &["dependencies", "build-dependencies"];
const OF_TESTS: &[&str] = &["dev-dependencies"];

/// Everything a crate's tests know, through others too.
fn reached(name: &str) -> BTreeSet<String> {
    let mut waiting: Vec<String> = known(name, OWN).union(&known(name, OF_TESTS)).cloned().collect();
    let mut reached = BTreeSet::new();
    while let Some(next) = waiting.pop() {
        if reached.insert(next.clone()) {
            waiting.extend(known(&next, OWN));
        }
    }
    reached
}

#[test]
fn manifests_name_only_what_a_crate_may_know() {
    let on_disk: BTreeSet<String> = std::fs::read_dir(crates())
        .expect("the crates folder")
        .map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    let listed: BTreeSet<String> = LAYERS.iter().map(|(n, _)| (*n).to_owned()).collect();
    assert_eq!(on_disk, listed, "a crate is missing from the table of layers, or the other way round");
    let (mut edges, mut in_tests) = (0, 0);
    for (name, allowed) in LAYERS {
        for dependency in known(name, OWN) {
            assert!(allowed.contains(&&*dependency), "{name} must not know {dependency}");
            edges += 1;
        }
        let beyond: &[&str] = TESTS.iter().find(|(n, _)| n == name).map_or(&[], |(_, beyond)| beyond);
        for dependency in known(name, OF_TESTS) {
            let may = allowed.contains(&&*dependency) || beyond.contains(&&*dependency);
            assert!(may, "the tests of {name} must not know {dependency}");
            in_tests += 1;
        }
    }
    println!("checked {edges} arrows between {} crates, {in_tests} of their tests", LAYERS.len());
    assert!(edges > 10 && in_tests > 3);
}

#[test]
fn strangers_do_not_meet_in_tests_either() {
    let [a, b] = STRANGERS;
    for (one, other) in [(a, b), (b, a)] {
        assert!(!reached(one).contains(other), "{one} knows {other}");
    }
}

#[test]
fn the_core_reads_and_writes_no_files() {
    let mut checked = 0;
    for name in NO_FILES {
        let mut folders = vec![crates().join(name).join("src")];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).expect("a source folder") {
                let path = entry.expect("an entry").path();
                if path.is_dir() {
                    folders.push(path);
                    continue;
                }
                let text = std::fs::read_to_string(&path).expect("a source file");
                for forbidden in ["std::fs", "std::net", "std::process", "std::env"] {
                    assert!(!text.contains(forbidden), "{} uses {forbidden}", path.display());
                }
                checked += 1;
            }
        }
    }
    println!("checked {checked} source files");
    assert!(checked >= 2 * NO_FILES.len());
}

/// A suite is a file of `tests`, or a folder with a `mod.rs`; where they are one program, `main.rs` lists them.
#[test]
fn every_suite_is_listed() {
    let (mut programs, mut suites) = (0, 0);
    for (name, _) in LAYERS {
        let tests = crates().join(name).join("tests");
        let Ok(list) = std::fs::read_to_string(tests.join("main.rs")) else {
            continue; // each file is a program of its own
        };
        let manifest = std::fs::read_to_string(crates().join(name).join("Cargo.toml")).expect("a manifest");
        programs += 1;
        for entry in std::fs::read_dir(&tests).expect("a folder of suites") {
            let path = entry.expect("an entry").path();
            let suite = path.file_stem().and_then(|stem| stem.to_str()).expect("a name").to_owned();
            let is_module = path.join("mod.rs").exists() || path.extension().is_some_and(|end| end == "rs");
            if is_module && suite != "main" && !manifest.contains(&format!("path = \"tests/{suite}.rs\"")) {
                assert!(
                    list.contains(&format!("mod {suite};\n")),
                    "{name}/tests/main.rs lacks `mod {suite};`"
                );
                suites += 1;
            }
        }
    }
    println!("checked {suites} suites in {programs} programs");
    assert!(programs >= 7 && suites > 100);
}
