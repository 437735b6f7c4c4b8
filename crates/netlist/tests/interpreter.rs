//! The suites, on the interpreter. Another simulator joins by the same lines.
#![allow(clippy::unwrap_used)] // a test may

mod suites {
    mod choices;
    mod operators;
    mod state;
}

use edgewalk_netlist::{Netlist, Simulator};

fn simulator(netlist: &Netlist) -> Simulator {
    Simulator::new(netlist)
}
