//! What registers hold before the first reset does not matter: Verilator begins with random bits in all that have no start
//! value, others with each seed.

use crate::common;
use crate::common::{made, small, write};
use edgewalk_machine::Plan;
use edgewalk_vectors::{StallKind, Suite, Tables, Unit, capture, design, directory};
use std::path::Path;

/// Vectors of SETUP with a few triangles.
fn vectors(machine: &Plan, folder: &Path) {
    let suite = Suite::named(machine, "random", 5, 4).expect("listed");
    let trace = capture(machine, common::SETUP, &suite, suite.state, StallKind::None);
    let verilog = design::verilog(machine, common::SETUP).expect("a checked machine");
    write(&directory(&suite, &trace, &verilog, Tables::LeftOut), folder);
}

/// The first of the seeds with which the design fails.
fn fails(folder: &Path, mut seeds: std::ops::RangeInclusive<u32>) -> Option<u32> {
    seeds.find(|seed| {
        let (passed, said) = made(folder, &["verilator", &format!("SEED={seed}")]);
        assert!(passed || said.lines().any(|line| line == "FAIL"), "{said}");
        !passed
    })
}

/// The number 0 of the lanes is in a memory: without the start of the register that lets it be written, some seeds write it.
#[test]
fn a_register_that_needs_its_start_is_found_by_a_seed() {
    let folder = tempfile::tempdir().expect("a folder");
    vectors(&small(), folder.path());
    assert_eq!(fails(folder.path(), 1..=4), None);
    let path = folder.path().join("hdl/edgewalk_setup_lane0.v");
    let text = std::fs::read_to_string(&path).expect("a file of the design");
    let start = "  initial write_then = 1'b0;\n";
    assert!(text.contains(start), "{text}");
    std::fs::write(&path, text.replace(start, "")).expect("written");
    let found = fails(folder.path(), 1..=40);
    println!("seed {found:?}");
    assert!(found.is_some());
    // Icarus has unknown bits there, and a condition that is unknown writes nothing.
    assert!(made(folder.path(), &["icarus"]).0);
}

/// Every kind of machine with many seeds, not part of the test run:
/// `cargo test --release -p edgewalk-vectors power_up:: -- --ignored --nocapture`
#[test]
#[ignore = "minutes"]
fn no_seed_changes_anything() {
    let kinds: [(Vec<(&str, Plan)>, &str, u32); 6] = [
        (common::twelve(), "random", 100),
        (common::shades(), "shade", 20),
        (common::lights(), "light", 20),
        (common::glass(), "blend_add", 20),
        (common::polygonal(), "polygon", 20),
        (common::lined(), "lines", 20),
    ];
    let mut runs = Vec::new();
    for (machines, suite, seeds) in &kinds {
        for (name, machine) in machines {
            runs.extend([Unit::MACHINE, common::SETUP].map(|unit| (*name, machine, unit, *suite, *seeds)));
        }
    }
    let of = |sequenced: bool| runs.iter().filter(|run| run.1.is_sequenced() == sequenced).count();
    assert!(of(true) > 10 && of(false) > 10, "both kinds of SETUP");
    let done = common::two_at_a_time(&runs, |_, (name, machine, unit, suite, seeds)| {
        let folder = tempfile::tempdir().expect("a folder");
        let suite = Suite::named(machine, suite, 5, 12).expect("listed");
        let trace = capture(machine, *unit, &suite, suite.state, StallKind::Mixed);
        let verilog = design::verilog(machine, *unit).expect("a checked machine");
        write(&directory(&suite, &trace, &verilog, Tables::LeftOut), folder.path());
        assert_eq!(fails(folder.path(), 1..=*seeds), None, "{name}, {}", unit.name());
        println!("{name}, {}: {seeds} / {seeds} seeds pass", unit.name());
        u64::from(*seeds)
    });
    println!("{} machines and units, {} runs pass", done.len(), done.iter().sum::<u64>());
    assert_eq!(done.len(), runs.len());
}
