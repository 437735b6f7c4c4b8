//! What registers hold before the first reset does not matter: Verilator begins with random bits in all that have no start
//! value, others with each seed.

use crate::common;
use crate::common::{made, small, write};
use edgewalk_machine::{Machine, Plan, SetupKind};
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

/// SETUP's memories have first contents. Without the start of the registers that let them be written some seeds write
/// over them.
#[test]
fn registers_that_need_their_start_are_found_by_a_seed() {
    let parallel = small();
    let sequenced = Machine { setup_kind: SetupKind::Sequenced, lanes: 1, ..Machine::clone(&parallel) };
    let writes = ["runs", "write_a_next", "write_a_now", "write_w_next", "write_w_now"];
    for (machine, file, expected) in [
        (parallel, "edgewalk_setup_lane0.v", &["write_then"][..]),
        (sequenced.plan().expect("can be built"), "edgewalk_setup.v", &writes),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        vectors(&machine, folder.path());
        assert_eq!(fails(folder.path(), 1..=4), None);
        let path = folder.path().join("hdl").join(file);
        let text = std::fs::read_to_string(&path).expect("a file of the design");
        let start = |line: &str| Some(line.strip_prefix("  initial ")?.strip_suffix(" = 1'b0;")?.to_owned());
        assert_eq!(text.lines().filter_map(start).collect::<Vec<_>>(), expected);
        let without = text.lines().filter(|line| start(line).is_none()).collect::<Vec<_>>().join("\n");
        std::fs::write(&path, without + "\n").expect("written");
        let found = fails(folder.path(), 1..=40);
        println!("{file}: seed {found:?}");
        assert!(found.is_some());
        // Icarus has unknown bits there, and a condition that is unknown writes nothing.
        assert!(made(folder.path(), &["icarus"]).0);
    }
}

/// The reset leaves out the valid of DEPTH's output, and the bench sees it. The bench gives no ready during a reset: a ready
/// would empty that register and hide the fault.
#[test]
fn a_valid_that_no_reset_reaches_is_found() {
    let machine = small();
    let suite = Suite::named(&machine, "hazards", 0, 0).expect("listed");
    let trace = capture(&machine, common::DEPTH, &suite, suite.state, StallKind::Mixed);
    let verilog = design::verilog(&machine, common::DEPTH).expect("a checked machine");
    let reset = "    if (rst) begin\n      wr_valid <= 1'b0;\n    end else begin\n";
    for (start, simulator) in [("", "icarus"), (" = 1'b0", "icarus"), (" = 1'b0", "verilator")] {
        let folder = tempfile::tempdir().expect("a folder");
        write(&directory(&suite, &trace, &verilog, Tables::LeftOut), folder.path());
        let path = folder.path().join("hdl").join(&verilog[0].0);
        let text = std::fs::read_to_string(&path).expect("the design");
        assert!(text.contains(reset) && text.contains("wr_valid, "));
        let without =
            text.replacen(reset, "    begin\n", 1).replacen("wr_valid, ", &format!("wr_valid{start}, "), 1);
        std::fs::write(&path, without).expect("written");
        let (passed, said) = made(folder.path(), &[simulator]);
        assert!(!passed && said.lines().any(|line| line == "FAIL"), "{simulator}, `{start}`: {said}");
    }
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
