//! Each JSON document of each command says first which format it has, and which version; errors too.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::standard_output::{COMMANDS, arguments, folder};
use crate::support::edgewalk;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What is said of the formats.
const TOLD: &str = include_str!("../../../docs/json.md");

/// The format of a document whose first keys are `format` and `version`; of a manifest, `format_version`.
fn format(document: &Value, from: &str) -> String {
    let keys: Vec<&String> =
        document.as_object().unwrap_or_else(|| panic!("{from}: no object")).keys().collect();
    let second = if document["format"] == "edgewalk-vectors" { "format_version" } else { "version" };
    assert_eq!(keys[..2], ["format", second], "{from}");
    let version = &document[second];
    assert!(version.is_u64() || version.as_array().is_some_and(|list| list.len() == 2), "{from}: {version}");
    let format = document["format"].as_str().unwrap();
    assert!(format.starts_with("edgewalk-"), "{from}: {format}");
    if let [major, minor] = version.as_array().map_or(&[][..], Vec::as_slice) {
        // A row names the version of a format that has new keys.
        let row = TOLD.lines().find_map(|line| line.strip_prefix(&format!("| `{format}` | ")));
        let named = row.and_then(|row| row.split(" | ").next()).filter(|cell| cell.starts_with("1."));
        assert_eq!(format!("{major}.{minor}"), named.unwrap_or("1.0"), "docs/json.md of {format}");
    }
    format.to_owned()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|end| end == "json") && !path.ends_with("manifest.schema.json")
        {
            found.push(path);
        }
    }
}

#[test]
fn every_document_has_format_and_version() {
    let folder = folder();
    let mut printed = BTreeSet::new();
    let more: [&[&str]; 3] = [
        &["config", "explain", "memory.hazard"],
        &["replay", "d.tri", "--out", "r.json"],
        &[
            "synth",
            "--unit",
            "span",
            "--seeds",
            "1",
            "--cache",
            concat!(env!("CARGO_TARGET_TMPDIR"), "/synth"),
            "--out",
            "synth",
        ],
    ];
    for command in COMMANDS.iter().chain(&more) {
        let arguments = arguments(command, true);
        let output = edgewalk(folder.path(), &arguments).output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        let document: Value = serde_json::from_slice(&output.stdout).unwrap();
        printed.insert(format(&document, &format!("{arguments:?}")));
    }
    // Reports of pictures are of one format, whichever command draws them.
    assert_eq!(printed.len(), COMMANDS.len() - 2, "{printed:?}");
    let (mut found, mut kinds) = (Vec::new(), BTreeSet::new());
    files(folder.path(), &mut found);
    for path in &found {
        let document = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        kinds.insert(format(&document, &path.display().to_string()));
    }
    for format in printed.iter().chain(&kinds) {
        assert!(TOLD.contains(&format!("`{format}`")), "docs/json.md does not tell of {format}");
    }
    println!(
        "checked {} printed documents, {} files of {} formats",
        COMMANDS.len() + 3,
        found.len(),
        kinds.len()
    );
    assert!(found.len() > 15 && kinds.len() > 6, "{kinds:?}");
}

/// With --json standard error is JSON: one line, whatever is wrong, with the code that the program ends with.
#[test]
fn errors_are_json_where_it_is_asked_for() {
    let folder = folder();
    let settings =
        ["z_fraction", "z_vertex", "color_fraction", "color_vertex"].map(|key| format!("formats.{key}=0"));
    let mut coarse =
        vec!["render", "sphere", "--quiet", "--set", "screen.width=64", "--set", "screen.height=48"];
    settings.iter().for_each(|setting| coarse.extend(["--set", setting]));
    for (arguments, code, said) in [
        (&["render", "none.obj"][..], 2, "none.obj: cannot be read"),
        (&["render", "--nothing"], 2, "unexpected argument '--nothing' found"),
        (&["synth", "--target", "foo"], 2, "unknown target foo; permitted: ice40-hx8k"),
        (&["nothing"], 2, "unrecognized subcommand 'nothing'"),
        (&["config", "check", "--set", "setup.lanes=3"], 2, "--set setup.lanes=3: "),
        (&coarse, 1, "mismatch: what was compared differs"),
    ] {
        let plain = edgewalk(folder.path(), arguments).output().unwrap();
        let plain_text = String::from_utf8(plain.stderr).unwrap();
        assert!(plain_text.starts_with("error: ") && plain_text.contains(said), "{plain_text}");
        let output = edgewalk(folder.path(), &[arguments, &["--json"]].concat()).output().unwrap();
        assert_eq!((plain.status.code(), output.status.code()), (Some(code), Some(code)), "{arguments:?}");
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(text.lines().count(), 1, "{text}");
        let error: Value = serde_json::from_str(&text).unwrap();
        assert_eq!((&error["format"], &error["version"]), (&json!("edgewalk-error"), &json!([1, 0])));
        assert_eq!(error["exit_code"], code);
        let why = error["error"].as_str().unwrap();
        assert!(why.contains(said) && !why.starts_with("error: "), "{why}");
    }
}

/// A warning beside JSON is a document too.
#[test]
fn warnings_are_json_where_it_is_asked_for() {
    let folder = folder();
    // One triangle meets little, and that is said.
    let vectors = ["vectors", "d.tri", "--unit", "pixel", "--unit", "depth", "--no-csv", "--out", "v"];
    let plain = edgewalk(folder.path(), &vectors).output().unwrap();
    let plain = String::from_utf8(plain.stderr).unwrap();
    let output = edgewalk(folder.path(), &[&vectors[..], &["--json"]].concat()).output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    let mut checked = 0;
    for (line, plain) in text.lines().zip(plain.lines()) {
        let warning: Value = serde_json::from_str(line).unwrap();
        assert_eq!(format(&warning, line), "edgewalk-warning");
        assert_eq!(plain, format!("warning: {}", warning["warning"].as_str().unwrap()));
        checked += 1;
    }
    assert!(checked > 0 && text.lines().count() == plain.lines().count(), "{plain}");
}

/// The machine as a document has the keys and values of the machine as a file.
#[test]
fn config_prints_one_machine_in_both_forms() {
    let folder = folder();
    let mut checked = 0;
    for machine in ["textbook", "small,shade.kind=phong"] {
        let (preset, set) = machine.split_once(',').unwrap_or((machine, "memory.hazard=drain"));
        let arguments = ["config", "print", "--machine", preset, "--set", set];
        let text = edgewalk(folder.path(), &arguments).output().unwrap().stdout;
        let text = String::from_utf8(text).unwrap();
        let json = edgewalk(folder.path(), &[&arguments[..], &["--json"]].concat()).output().unwrap().stdout;
        let json: Value = serde_json::from_slice(&json).unwrap();
        assert!(text.starts_with(&format!("# machine {}\n", json["hash"].as_str().unwrap())), "{text}");
        let file: toml::Table = text.parse().unwrap();
        let mut keys = json["keys"].as_object().unwrap().clone();
        for (section, values) in &file {
            for (name, value) in values.as_table().unwrap() {
                let value = value.as_integer().map_or_else(|| json!(value.as_str()), |number| json!(number));
                assert_eq!(keys.remove(&format!("{section}.{name}")), Some(value), "{section}.{name}");
                checked += 1;
            }
        }
        assert!(keys.is_empty(), "{keys:?}");
    }
    println!("checked {checked} keys");
    assert!(checked > 50);
}
