//! The share of single faults in the netlists that the lock-step comparison finds, and the names of those it does not.
//!
//! Many survivors change nothing that can be seen: an or of two conditions that never hold together made an exclusive or, the
//! extension of a word whose top bit is dropped, an enable of a register that nobody reads then. They are not taken out
//! of the count, so the share is a lower bound.

mod common;

use edgewalk_model::DrawState;
use edgewalk_netlist::mutate::mutants;
use edgewalk_vectors::{StallKind, Suite, Trace, Unit, capture, design, lockstep};

/// Unit, and how many of its mutants are passed over for each that is tried: setup is slow to run.
const UNITS: [(Unit, usize); 5] =
    [(Unit::Setup, 8), (Unit::Edge, 1), (Unit::Span, 1), (Unit::Pixel, 1), (Unit::Depth, 1)];

/// Least share killed, in percent; what is measured is printed.
const LEAST: usize = 92;

#[test]
fn single_faults_are_found() {
    let machine = common::small();
    let suites = ["hazards", "corners", "random"].map(|n| Suite::named(&machine, n, 1, 24).expect("listed"));
    let suite = Suite::joined("mutants", "all that is directed, and some at random", suites);
    let (mut tried, mut killed) = (0, 0);
    for (unit, step) in UNITS {
        let netlist = design::netlist(&machine, unit).expect("a checked machine");
        let traces = traces(&machine, unit, &suite);
        for trace in &traces {
            lockstep(trace, &netlist).expect("the netlist without a fault agrees");
        }
        let (mut of_unit, mut found) = (0, 0);
        for mutant in mutants(&netlist).iter().step_by(step) {
            let faulty = mutant.apply(&netlist);
            of_unit += 1;
            if traces.iter().any(|trace| lockstep(trace, &faulty).is_err()) {
                found += 1;
            } else {
                println!("  survives: {}: {}", mutant.module, mutant.description);
            }
        }
        println!("{}: {found} of {of_unit} killed", unit.name());
        tried += of_unit;
        killed += found;
    }
    println!("killed {killed} / {tried}, {:.1} %", 100.0 * killed as f64 / tried as f64);
    assert!(tried >= 40);
    assert!(100 * killed >= LEAST * tried, "only {killed} of {tried} killed");
}

fn traces(machine: &edgewalk_numerics::Machine, unit: Unit, suite: &Suite) -> Vec<Trace> {
    // Only DEPTH looks at the function and the write mask.
    let functions = if unit == Unit::Depth { 0..8 } else { 1..2 };
    let mut traces = Vec::new();
    for depth_func in functions {
        for stalls in StallKind::ALL {
            let state = DrawState { depth_func, ..DrawState::default() };
            traces.push(capture(machine, unit, suite, state, stalls));
        }
    }
    traces.push(capture(
        machine,
        unit,
        suite,
        DrawState { depth_write: false, ..DrawState::default() },
        StallKind::Mixed,
    ));
    // A function that lets nothing pass leaves nothing to compare.
    traces.retain(|trace| trace.channels.last().is_some_and(|c| !c.tokens.is_empty()));
    traces
}
