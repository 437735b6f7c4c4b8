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
use edgewalk_lockstep::{Rig, StallKind, Unit, netlist};
use edgewalk_model::DrawState;
use edgewalk_vectors::{Suite, Trace, capture};

/// Cycles until the machine is reset.
const FIRST: u64 = 600;
/// Cycles from then on.
const SECOND: u64 = 2000;

/// Runs the stimulus of a trace from its beginning.
fn run(pair: &mut Pair, trace: &Trace, cycles: u64) {
    let interface = &trace.interface;
    let mut rig = Rig::new(interface, trace.setting.clone());
    let mut ports = interface.values();
    while rig.cycle() < cycles {
        rig.drive(&mut ports);
        for port in interface.inputs() {
            pair.set(&port.name, ports[port.id]);
        }
        pair.compare(rig.cycle());
        for port in interface.outputs() {
            ports[port.id] = pair.output(&port.name);
        }
        pair.tick(rig.cycle());
        rig.clock(&ports);
    }
}

#[test]
fn every_signal_of_twelve_machines() {
    let machines = vectors::machines::twelve();
    let mut compared = 0;
    for (i, (name, machine)) in machines.iter().enumerate() {
        let suite = Suite::named(machine, ["hazards", "corners", "random"][i % 3], 3, 30).unwrap();
        let trace = capture(machine, Unit::MACHINE, &suite, DrawState::default(), StallKind::ALL[i / 3 % 3]);
        let netlist = netlist(machine, Unit::MACHINE).unwrap();
        let mut pair = Pair::new(&netlist);
        run(&mut pair, &trace, FIRST);
        pair.set("rst", 1);
        pair.tick(FIRST);
        pair.set("rst", 0);
        run(&mut pair, &trace, SECOND);
        println!("{name}: {} values compared", pair.compared);
        compared += pair.compared;
    }
    println!("{compared} values of {} machines compared", machines.len());
    assert!(compared > 10_000_000);
}
