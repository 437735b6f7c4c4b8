//! The Verilog of the presets, committed under `hdl/`, is what the generator prints today.
//!
//! `EDGEWALK_BLESS=1 cargo test -p edgewalk-cli presets::` rewrites it after a deliberate change.

use edgewalk_machine::presets::PRESETS;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

fn files(folder: &Path) -> BTreeMap<String, String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return BTreeMap::new() };
    entries
        .map(|e| e.expect("an entry").path())
        .map(|p| {
            (
                p.file_name().expect("a file").to_string_lossy().into_owned(),
                std::fs::read_to_string(p).expect("text"),
            )
        })
        .collect()
}

#[test]
fn hdl_is_what_is_printed_today() {
    let hdl = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../hdl");
    let mut checked = 0;
    for (preset, _) in PRESETS {
        let out = tempfile::tempdir().expect("a folder");
        let printed = out.path().join(preset);
        let status = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
            .args(["emit", "--quiet", "--machine", preset, "--out"])
            .arg(&printed)
            .status()
            .expect("the program runs");
        assert!(status.success(), "emit --machine {preset}");
        let committed = hdl.join(preset);
        let (new, old) = (files(&printed), files(&committed));
        if std::env::var_os("EDGEWALK_BLESS").is_some() {
            let _ = std::fs::remove_dir_all(&committed);
            std::fs::create_dir_all(&committed).expect("the folder");
            for (name, text) in &new {
                std::fs::write(committed.join(name), text).expect("written");
            }
            continue;
        }
        assert_eq!(new.keys().collect::<Vec<_>>(), old.keys().collect::<Vec<_>>(), "files of hdl/{preset}");
        for (name, text) in &new {
            assert!(old[name] == *text, "hdl/{preset}/{name} differs from what is printed today");
            checked += 1;
        }
    }
    println!("checked {checked} files");
    assert!(checked >= 10 || std::env::var_os("EDGEWALK_BLESS").is_some());
}

/// The help of every command that takes a machine names all of them.
#[test]
fn help_names_the_presets() {
    for command in ["raster", "emit", "verify", "vectors", "synth", "sweep", "bench", "config"] {
        let output = Command::new(env!("CARGO_BIN_EXE_edgewalk")).args([command, "--help"]).output();
        let text = String::from_utf8(output.expect("the program runs").stdout).expect("text");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let names: Vec<&str> = PRESETS.iter().map(|preset| preset.0).collect();
        assert!(text.contains(&format!("the name of a preset: {}", names.join(", "))), "{command}: {text}");
    }
}
