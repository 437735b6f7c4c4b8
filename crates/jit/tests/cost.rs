//! What a clock of the presets costs, by count: speed is not asserted by time, and a step that saves instructions changes no value, so that
//! without this nobody would see it undone. After a change that is meant: `UPDATE_EXPECT=1 cargo test --release -p edgewalk-jit --test cost`.
#![allow(clippy::unwrap_used)] // a test may

use edgewalk_jit::{Cost, Simulator};
use edgewalk_lockstep::{Unit, netlist};
use edgewalk_machine::Machine;
use expect_test::expect_file;
use std::fmt::Write as _;

#[test]
fn a_clock_of_the_presets() {
    let mut costs = String::new();
    for preset in ["default", "textbook", "small", "ecp5"] {
        let plan = Machine::preset(preset).unwrap().plan().unwrap();
        let simulator = Simulator::new(&netlist(&plan, Unit::MACHINE).unwrap()).unwrap();
        let Cost { instructions, loads, stores, blocks } = simulator.cost();
        writeln!(
            costs,
            "{preset}: {instructions} instructions, {loads} loads, {stores} stores, {blocks} blocks"
        )
        .unwrap();
    }
    expect_file!["snapshots/cost.txt"].assert_eq(&costs);
}
