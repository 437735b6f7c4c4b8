//! The Verilog of the presets, committed under `hdl/`, is what the generator prints today.
//!
//! `EDGEWALK_BLESS=1 cargo test -p edgewalk-cli presets::` rewrites it after a deliberate change.

use edgewalk_machine::presets::PRESETS;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The files of a folder with their texts, without those below it.
fn files(folder: &Path) -> BTreeMap<String, String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return BTreeMap::new() };
    entries
        .map(|e| e.expect("an entry").path())
        .filter(|p| p.is_file())
        .map(|p| {
            (
                p.file_name().expect("a file").to_string_lossy().into_owned(),
                std::fs::read_to_string(p).expect("text"),
            )
        })
        .collect()
}

/// `hdl/README.md`: which machine each folder holds, in the words of `edgewalk config explain`.
#[test]
fn page_of_hdl_lists_every_preset() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../hdl/README.md");
    let mut page = "# The Verilog of the presets\n\n\
        One folder a machine, written by `edgewalk emit --machine NAME --out DIR`. `filelist.f` has the files in compile order.\n\
        Ports: [machine, section 20](../docs/machine.md#20-ports). Onto a chip: [tutorial](../docs/tutorial/chip.md).\n\n\
        | folder | machine |\n|---|---|\n"
        .to_owned();
    for (name, description) in PRESETS {
        page += &format!("| [`{name}`]({name}) | {description} |\n");
    }
    if std::env::var_os("EDGEWALK_BLESS").is_some() {
        std::fs::write(&path, &page).expect("written");
    }
    assert_eq!(std::fs::read_to_string(path).expect("hdl/README.md"), page);
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

/// Every file that is emitted says its licence, what wrote it and of which machine it is; the list names every module, those
/// that others use first, and a simulator takes it.
#[test]
fn emitted_files_say_what_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
        let output = command.args(arguments).current_dir(&folder).output().expect("the program runs");
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("text")
    };
    let four = ["--set", "setup.lanes=4", "--set", "screen.width=24", "--set", "screen.height=20"];
    let told = run(&[&["emit", "--out", "e"], &four[..]].concat());
    run(&[&["vectors", "--suite", "hazards", "--unit", "setup", "--no-csv", "--out", "v", "-q"], &four[..]]
        .concat());
    let hash = told.split_whitespace().nth(1).expect("the hash");
    let mut checked = 0;
    for part in ["e", "v/hazards_setup", "v/hazards_setup/hdl"] {
        for (name, text) in files(&folder.path().join(part)) {
            let mark = match name.rsplit_once('.').map_or("", |(_, end)| end) {
                "v" | "vh" | "f" => "//",
                "toml" | "" => "#",
                _ => continue,
            };
            if name == "SHA256SUMS" {
                continue;
            }
            let version = env!("CARGO_PKG_VERSION");
            let head = format!(
                "{mark} SPDX-License-Identifier: MIT OR Apache-2.0\n{mark} edgewalk {version}, machine {hash}\n"
            );
            assert!(text.starts_with(&head), "{part}/{name}: {text:.200}");
            checked += 1;
        }
    }
    assert!(checked > 20, "{checked}");
    println!("checked {checked} files");

    let printed = files(&folder.path().join("e"));
    let listed: Vec<&str> = printed["filelist.f"].lines().filter(|line| !line.starts_with("//")).collect();
    assert_eq!(listed, told.lines().skip(1).map(str::trim).collect::<Vec<_>>(), "in the order that is said");
    let mut modules: Vec<&str> =
        printed.keys().map(String::as_str).filter(|name| name.ends_with(".v")).collect();
    modules.sort_unstable();
    let mut sorted = listed.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, modules);
    // A module is named behind those that it has instances of.
    let mut uses = 0;
    for (place, user) in listed.iter().enumerate() {
        for (other, used) in listed.iter().enumerate() {
            let instance = format!("\n  {} ", used.trim_end_matches(".v"));
            let instances = printed[*user].matches(&instance).count();
            assert!(instances == 0 || other < place, "{user} has an instance of {used}");
            uses += instances;
        }
    }
    assert!(uses >= 6, "{uses} instances");
    let mut icarus = Command::new("iverilog");
    icarus
        .args(["-g2001", "-s", "edgewalk", "-c", "filelist.f", "-o", "all.vvp"])
        .current_dir(folder.path().join("e"));
    assert!(icarus.status().expect("iverilog is installed").success());
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
