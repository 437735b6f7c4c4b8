//! What each crate may know, read from the manifests (`docs/architecture.md`).

use std::collections::BTreeSet;
use std::path::PathBuf;

/// Every crate, in the order of the data, with all it may depend on outside its tests.
const LAYERS: &[(&str, &[&str])] = &[
    ("numerics", &[]),
    ("machine", &["numerics"]),
    ("scene", &[]),
    ("golden", &["scene"]),
    ("gallery", &["scene", "golden"]),
    ("model", &["machine"]),
    ("netlist", &[]),
    ("verilog", &["netlist"]),
    ("jit", &["netlist"]),
    ("rtl", &["machine", "netlist"]),
    ("vectors", &["machine", "model", "netlist", "verilog", "rtl"]),
    (
        "cli",
        &[
            "numerics", "machine", "scene", "golden", "gallery", "model", "netlist", "verilog", "jit", "rtl",
            "vectors",
        ],
    ),
];

/// Crates that read and write no files: they may not even name the standard library's file or process modules.
const NO_FILES: &[&str] =
    &["numerics", "machine", "golden", "gallery", "model", "netlist", "verilog", "jit", "rtl"];

fn crates() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

#[test]
fn manifests_name_only_what_a_crate_may_know() {
    let on_disk: BTreeSet<String> = std::fs::read_dir(crates())
        .expect("the crates folder")
        .map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    let listed: BTreeSet<String> = LAYERS.iter().map(|(n, _)| (*n).to_owned()).collect();
    assert_eq!(on_disk, listed, "a crate is missing from the table of layers, or the other way round");
    let mut edges = 0;
    for (name, allowed) in LAYERS {
        let text = std::fs::read_to_string(crates().join(name).join("Cargo.toml")).expect("a manifest");
        let manifest: toml::Table = text.parse().expect("TOML");
        let Some(dependencies) = manifest.get("dependencies").and_then(toml::Value::as_table) else {
            continue;
        };
        for dependency in dependencies.keys().filter_map(|d| d.strip_prefix("edgewalk-")) {
            assert!(allowed.contains(&dependency), "{name} must not know {dependency}");
            edges += 1;
        }
    }
    println!("checked {edges} arrows between {} crates", LAYERS.len());
    assert!(edges > 10);
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
