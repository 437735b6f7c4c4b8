//! Native code against the interpreter on machines: a directed suite with stalls, a reset in the middle.
#![allow(clippy::unwrap_used)] // a test may

mod common {
    pub mod pair;
}
#[path = "../../vectors/tests/common"]
mod vectors {
    #[path = "mod.rs"]
    pub mod machines;
}

use common::pair::Pair;
use edgewalk_model::DrawState;
use edgewalk_vectors::bench::Bench;
use edgewalk_vectors::{StallKind, Suite, Trace, Unit, capture, design};

/// Cycles until the machine is reset.
const FIRST: u64 = 600;
/// Cycles from then on.
const SECOND: u64 = 2000;

/// Runs the stimulus of a trace from its beginning.
fn run(pair: &mut Pair, trace: &Trace, ports: &[String], cycles: u64) {
    let mut bench = Bench::new(&trace.interface, trace.setting.clone());
    while bench.cycle() < cycles {
        for (port, value) in ports.iter().zip(bench.inputs()) {
            pair.set(port, *value);
        }
        pair.compare(bench.cycle());
        let outputs = pair.outputs();
        pair.tick(bench.cycle());
        bench.clock(&outputs);
    }
}

#[test]
fn every_signal_of_twelve_machines() {
    let machines = vectors::machines::twelve();
    let mut compared = 0;
    for (i, (name, machine)) in machines.iter().enumerate() {
        let suite = Suite::named(machine, ["hazards", "corners", "random"][i % 3], 3, 30).unwrap();
        let trace = capture(machine, Unit::Machine, &suite, DrawState::default(), StallKind::ALL[i / 3 % 3]);
        let netlist = design::netlist(machine, Unit::Machine).unwrap();
        let ports: Vec<String> = trace.interface.inputs().into_iter().map(|(port, _)| port).collect();
        let mut pair = Pair::new(&netlist);
        run(&mut pair, &trace, &ports, FIRST);
        pair.set("rst", 1);
        pair.tick(FIRST);
        pair.set("rst", 0);
        run(&mut pair, &trace, &ports, SECOND);
        println!("{name}: {} values compared", pair.compared);
        compared += pair.compared;
    }
    println!("{compared} values of {} machines compared", machines.len());
    assert!(compared > 10_000_000);
}
