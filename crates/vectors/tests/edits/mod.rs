//! Faults planted in the emitted Verilog (`edits.toml`) make the shipped vectors fail, run as a user runs them.
//!
//! A few are part of the test run. All of them, on the whole machine and on the unit with the fault:
//! `cargo test --release -p edgewalk-vectors edits:: -- --ignored --nocapture`; with `EDGEWALK_EDITS=TEXT` those whose name has this text.

use crate::common;
use crate::common::{made, write};
use edgewalk_machine::{Machine, Plan};
use edgewalk_vectors::{Suite, Tables, Unit, capture, design, directory};
use serde::Deserialize;
use std::collections::BTreeSet;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Edits {
    edit: Vec<Edit>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Edit {
    name: String,
    /// Keys of the machine that differ from the default.
    #[serde(default)]
    machine: Vec<String>,
    suite: String,
    file: String,
    text: String,
    replacement: String,
    #[serde(default)]
    quick: bool,
}

impl Edit {
    /// The unit whose file it is: `edgewalk_setup_lane0.v` belongs to SETUP.
    fn unit(&self) -> Unit {
        let of = |unit: &Unit| self.file.starts_with(&unit.module()) && *unit != Unit::MACHINE;
        Unit::known().find(of).unwrap_or(Unit::MACHINE)
    }
}

fn edits() -> Vec<Edit> {
    let edits: Edits = toml::from_str(include_str!("edits.toml")).expect("a list of edits");
    edits.edit
}

/// A directory of vectors: keys of the machine, suite, unit.
type Place = (Vec<String>, String, Unit);

/// The machine with these keys.
fn machine(keys: &[String]) -> Plan {
    let mut machine = Machine { width: 32, height: 24, ..Machine::default() };
    for key in keys {
        let (key, value) = key.split_once('=').expect("key=value");
        machine.set(key, value).expect("a key of the machine");
    }
    machine.plan().expect("can be built")
}

/// Writes the directory, with a fault or without, and runs it: exit code 0, and what was said. Of the whole machine Icarus
/// takes several times as long as Verilator, building included; of a unit it is the other way round.
fn run(place: &Place, edit: Option<&Edit>) -> (bool, String) {
    let (keys, suite, unit) = place;
    let machine = machine(keys);
    let suite = Suite::named(&machine, suite, 1, 100).expect("listed");
    let trace = capture(&machine, *unit, &suite, suite.state, suite.stalls);
    let verilog = design::verilog(&machine, *unit).expect("a checked machine");
    let folder = tempfile::tempdir().expect("a folder");
    write(&directory(&suite, &trace, &verilog, Tables::LeftOut), folder.path());
    if let Some(edit) = edit {
        let path = folder.path().join("hdl").join(&edit.file);
        let text = std::fs::read_to_string(&path).expect("a file of the design");
        assert!(text.contains(&edit.text), "{}: {} has no `{}`", edit.name, edit.file, edit.text);
        std::fs::write(&path, text.replacen(&edit.text, &edit.replacement, 1)).expect("written");
    }
    made(folder.path(), &[if *unit == Unit::MACHINE { "verilator" } else { "icarus" }])
}

/// The edits that pass; every place is run without a fault first.
fn survivors(runs: &[(Place, Edit)]) -> Vec<String> {
    let places: BTreeSet<_> =
        runs.iter().map(|((keys, suite, unit), _)| (keys, suite, unit.name())).collect();
    let places: Vec<_> = places.into_iter().collect();
    common::two_at_a_time(&places, |_, (keys, suite, unit)| {
        let unit = Unit::known().find(|other| other.name() == *unit).expect("one of them");
        let (passed, said) = run(&((*keys).clone(), (*suite).clone(), unit), None);
        assert!(passed, "{suite}_{} without a fault: {said}", unit.name());
    });
    let results = common::two_at_a_time(runs, |_, (place, edit)| {
        let (passed, said) = run(place, Some(edit));
        let name = format!("{} ({}_{})", edit.name, place.1, place.2.name());
        // It failed because of what the design did, not because it could not be compiled.
        assert!(passed || said.lines().any(|line| line == "FAIL"), "{name} was not run: {said}");
        println!("{}  {name}", if passed { "PASSES" } else { "fails " });
        passed.then_some(name)
    });
    println!("{} of {} edits fail", results.iter().filter(|name| name.is_none()).count(), runs.len());
    results.into_iter().flatten().collect()
}

/// The Verilog of today has what each edit changes.
#[test]
fn every_edit_fits_what_is_emitted() {
    let edits = edits();
    let unfit = edits.iter().filter(|edit| {
        let files = design::verilog(&machine(&edit.machine), Unit::MACHINE).expect("a checked machine");
        !files.iter().any(|(name, text)| *name == edit.file && text.contains(&edit.text))
    });
    assert_eq!(unfit.map(|edit| &edit.name).collect::<Vec<_>>(), Vec::<&String>::new());
    println!("{0} of {0} edits fit", edits.len());
    assert!(edits.len() >= 40);
}

#[test]
fn quick_edits_fail() {
    // The first on the whole machine, the others on their unit, which is sooner done.
    let quick = edits().into_iter().filter(|edit| edit.quick).enumerate();
    let unit = |k: usize, edit: &Edit| if k == 0 { Unit::MACHINE } else { edit.unit() };
    let runs: Vec<_> =
        quick.map(|(k, edit)| ((edit.machine.clone(), edit.suite.clone(), unit(k, &edit)), edit)).collect();
    assert!(runs.len() >= 4);
    assert_eq!(survivors(&runs), Vec::<String>::new());
}

#[test]
#[ignore = "minutes: all edits, on the machine and on the unit"]
fn every_edit_fails() {
    let units = |edit: Edit| {
        let units = [Unit::MACHINE, edit.unit()];
        units.map(|unit| ((edit.machine.clone(), edit.suite.clone(), unit), edit.clone()))
    };
    let text = std::env::var("EDGEWALK_EDITS").unwrap_or_default();
    let runs: Vec<_> = edits().into_iter().filter(|edit| edit.name.contains(&text)).flat_map(units).collect();
    assert!(runs.len() >= if text.is_empty() { 80 } else { 1 }, "no edit has {text} in its name");
    assert_eq!(survivors(&runs), Vec::<String>::new());
}
