//! Units stand still where nothing is to be done, though places that are free load in every clock.
#![allow(clippy::unwrap_used)] // a test may

use edgewalk_jit::Simulator;
use edgewalk_lockstep::{Unit, netlist};
use edgewalk_machine::Machine;

const PRESETS: [&str; 4] = ["default", "textbook", "small", "ecp5"];

/// Clocks after which a triangle has been set up, at most, and some more.
const MOST: u32 = 600;

/// A machine that has been reset, with memories that are always ready, and a triangle offered in one clock.
fn with_triangle(preset: &str) -> Simulator {
    let plan = Machine::preset(preset).unwrap().plan().unwrap();
    let mut simulator = Simulator::new(&netlist(&plan, Unit::MACHINE).unwrap()).unwrap();
    let memories = [("rd_ready", 1), ("wr_ready", 1), ("data_valid", 1), ("depth_func", 7)];
    for (input, value) in [("rst", 1)].iter().chain(&memories) {
        simulator.set_input(input, *value).unwrap();
    }
    simulator.tick();
    simulator.set_input("rst", 0).unwrap();
    for (port, pixels) in [("x0", 10), ("y0", 10), ("x1", 60), ("y1", 20), ("x2", 20), ("y2", 50)] {
        simulator.set_input(&format!("tri_{port}"), pixels << plan.subpixel_bits).unwrap();
    }
    for port in ["z0", "z1", "z2", "r1", "g2"] {
        simulator.set_input(&format!("tri_{port}"), 9).unwrap();
    }
    simulator.set_input("tri_valid", 1).unwrap();
    simulator.tick();
    simulator.set_input("tri_valid", 0).unwrap();
    simulator
}

#[test]
fn a_machine_that_has_drawn() {
    for preset in PRESETS {
        let mut simulator = with_triangle(preset);
        let idle = simulator.signal("idle").unwrap();
        let mut clocks = 0;
        while simulator.value(idle) == 0 {
            simulator.tick();
            clocks += 1;
            assert!(clocks < 10 * MOST, "{preset} is not done");
        }
        assert!(clocks > 900, "{preset}: {clocks} clocks for a thousand pixels");
        assert!(simulator.working() > 0, "{preset}: what has just changed may change something");
        (0..64).for_each(|_| simulator.tick());
        assert_eq!(simulator.working(), 0, "{preset}");
    }
}

/// While SETUP works, what draws stands still, whatever the registers hold that SETUP fills one after the other.
#[test]
fn what_draws_while_a_triangle_is_set_up() {
    for preset in PRESETS {
        let mut simulator = with_triangle(preset);
        let running = simulator.signal("u_edge.running").unwrap();
        let (mut all, mut alone) = (0, 0);
        while simulator.value(running) == 0 {
            // SETUP, and what follows from the triangle's corners alone: no unit that draws.
            (all, alone) = (all + 1, alone + u32::from(simulator.working() <= 2));
            simulator.tick();
            assert!(all < MOST, "{preset}: EDGE does not begin");
        }
        // What the reset has woken works for a while, and each result wakes EDGE for some clocks.
        assert!(all > 60 && 3 * alone > 2 * all, "{preset}: {alone} of {all} clocks");
        (0..8).for_each(|_| simulator.tick());
        assert!(simulator.working() >= 3, "{preset}: it draws");
    }
}
