//! The printed design replays vectors in Icarus and Verilator, is lint-clean, and synthesises; and a design with a
//! fault, or a directory with nothing in it, does not pass.

mod common;

use edgewalk_model::DrawState;
use edgewalk_numerics::Machine;
use edgewalk_vectors::{
    Files, Outcome, Simulator, StallKind, Suite, Unit, capture, design, directory, lint, simulate,
    synth_ice40,
};
use std::path::Path;
use std::time::{Duration, Instant};

const LIMIT: Duration = Duration::from_secs(240);

/// The directed suites, a few random triangles and a small mesh, one after the other.
fn replay(machine: &Machine) -> Suite {
    let suites = ["hazards", "corners", "random", "sphere"];
    Suite::joined("replay", "", suites.map(|name| Suite::named(machine, name, 5, 12).expect("listed")))
}

fn files(machine: &Machine, unit: Unit, suite: &Suite, stalls: StallKind) -> Files {
    let trace = capture(machine, unit, suite, DrawState::default(), stalls);
    directory(suite, &trace, &design::verilog(machine, unit).expect("a checked machine"))
}

fn write(files: &Files, to: &Path) {
    for (name, bytes) in files {
        let path = to.join(name);
        std::fs::create_dir_all(path.parent().expect("inside")).expect("a directory");
        std::fs::write(path, bytes).expect("a file");
    }
}

fn passes(simulator: Simulator, files: &Files) -> u64 {
    let place = tempfile::tempdir().expect("a directory");
    // Tools must cope with a path that has a space in it.
    let vectors = place.path().join("the vectors");
    write(files, &vectors);
    match simulate(simulator, &vectors, &place.path().join("work"), LIMIT) {
        Ok(Outcome::Pass { checked }) => checked,
        other => panic!("{}: {other:?}", simulator.name()),
    }
}

#[test]
fn twelve_machines_replay_are_clean_and_synthesise() {
    let machines = common::twelve();
    let start = Instant::now();
    let done = common::two_at_a_time(&machines, |i, (name, machine)| {
        let suite = replay(machine);
        let mut line = format!("{name:28}");
        let mut checked = 0;
        for (j, simulator) in Simulator::ALL.into_iter().enumerate() {
            let start = Instant::now();
            let stalls = StallKind::ALL[(i + j) % 3];
            let n = passes(simulator, &files(machine, Unit::Machine, &suite, stalls));
            checked += n;
            line +=
                &format!(" {} ({}) {n} / {n} in {:.1?};", simulator.name(), stalls.name(), start.elapsed());
        }
        let place = tempfile::tempdir().expect("a directory");
        let vectors = place.path().join("the vectors");
        write(&files(machine, Unit::Machine, &suite, StallKind::None), &vectors);
        lint(&vectors, LIMIT).unwrap_or_else(|error| panic!("{name}: {error}"));
        let start = Instant::now();
        let cells = synth_ice40(&vectors, LIMIT).unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("{line} lint clean; {cells:?} in {:.1?}", start.elapsed());
        checked
    });
    println!("{} machines, {} checked, {:.1?}", done.len(), done.iter().sum::<u64>(), start.elapsed());
    assert_eq!(done.len(), 12);
    assert!(done.iter().all(|checked| *checked > 5000), "{done:?}");
}

#[test]
fn every_unit_replays_in_icarus() {
    let mut replayed = 0;
    for (name, machine) in common::twelve().into_iter().step_by(4) {
        for unit in [Unit::Setup, Unit::Edge, Unit::Span, Unit::Pixel, Unit::Depth] {
            let checked =
                passes(Simulator::Icarus, &files(&machine, unit, &replay(&machine), StallKind::Mixed));
            assert!(checked > 500, "{name}, {}: {checked}", unit.name());
            replayed += 1;
        }
    }
    assert_eq!(replayed, 15);
}

/// DEPTH with one text exchanged, its manifest made anew.
fn faulty(cases: usize, from: &str, to: &str) -> Outcome {
    let machine = common::small();
    let mut suite = Suite::named(&machine, "hazards", 0, 0).expect("listed");
    suite.cases.truncate(cases);
    let trace = capture(&machine, Unit::Depth, &suite, DrawState::default(), StallKind::Mixed);
    let mut design = design::verilog(&machine, Unit::Depth).expect("a checked machine");
    assert!(design[0].1.contains(from), "{from}");
    design[0].1 = design[0].1.replacen(from, to, 1);
    let place = tempfile::tempdir().expect("a directory");
    write(&directory(&suite, &trace, &design), place.path());
    simulate(Simulator::Icarus, place.path(), &place.path().join("work"), LIMIT).expect("Icarus runs")
}

#[test]
fn a_fault_is_found_and_said() {
    assert!(matches!(faulty(4, "endmodule", "endmodule"), Outcome::Pass { checked } if checked > 50));
    assert_eq!(faulty(0, "endmodule", "endmodule"), Outcome::Vacuous);
    let cases = [
        ("a wrong value", "rd_addr = frag_addr", "rd_addr = ~frag_addr", ": expected "),
        ("an unknown value", "rd_addr = frag_addr", "rd_addr = frag_addr | 10'bx", ": unknown bits: "),
        ("missing outputs", "rd_valid = frag_valid && clear_to_read", "rd_valid = 1'b0", " never came"),
        ("extra outputs", "rd_valid = frag_valid &&", "rd_valid =", " is one more than the "),
        ("late outputs", "w_free = !wr_valid || wr_ready", "w_free = !wr_valid", ": expected in cycle "),
        ("no bypass", "place0_fwd_valid ? place0_fwd_z : data_z", "data_z", "wr: token "),
    ];
    for (name, from, to, told) in cases {
        match faulty(4, from, to) {
            Outcome::Mismatch { lines, .. } => {
                assert!(lines.iter().any(|line| line.contains(told)), "{name}: {lines:#?}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}
