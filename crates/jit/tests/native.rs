//! The interpreter's suites, on native code.
#![allow(clippy::unwrap_used)] // a test may

#[path = "../../netlist/tests/suites"]
mod suites {
    mod choices;
    mod operators;
    mod state;
}

use edgewalk_jit::Simulator;
use edgewalk_netlist::Netlist;

fn simulator(netlist: &Netlist) -> Simulator {
    Simulator::new(netlist).unwrap()
}
