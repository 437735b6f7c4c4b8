//! SETUP takes the clocks that `docs/machine.md`, section 2, gives: S1 until a triangle is culled, S1 + S2 + 1 until its prim is
//! there.

use edgewalk_machine::{Machine, Plan};
use edgewalk_netlist::Simulator;
use edgewalk_rtl as rtl;

/// Cycles after the one in which the triangle fired, until this port is 1.
fn cycles_until(plan: &Plan, triangle: [[i64; 2]; 3], port: &str) -> u32 {
    let netlist = rtl::setup(plan).unwrap_or_else(|errors| panic!("{plan:?}\n{errors}"));
    let mut sim = Simulator::new(&netlist);
    let set = |sim: &mut Simulator, name: &str, value: i64| {
        let id = sim.input(name).expect("a port of SETUP");
        sim.set(id, value as u128);
    };
    set(&mut sim, "rst", 1);
    sim.tick();
    set(&mut sim, "rst", 0);
    for (place, [x, y]) in triangle.into_iter().enumerate() {
        set(&mut sim, &format!("tri_x{place}"), x << plan.subpixel_bits);
        set(&mut sim, &format!("tri_y{place}"), y << plan.subpixel_bits);
    }
    set(&mut sim, "tri_valid", 1);
    assert_eq!(sim.get("tri_ready"), Ok(1));
    sim.tick();
    set(&mut sim, "tri_valid", 0);
    (1..100_000)
        .find(|_| {
            let there = sim.get(port) == Ok(1);
            sim.tick();
            there
        })
        .unwrap_or_else(|| panic!("{port} stays 0: {plan:?}"))
}

/// The default machine with so many lanes.
fn with_lanes(lanes: u32) -> Plan {
    Machine { lanes, ..Machine::default() }.plan().expect("can be built")
}

/// Worked by hand from the tables. In 1/256 pixel dv2 is 12800, of 14 bits; q is 0, so nothing is sheared: du1 is 7680 and
/// du2 2560, -7680 is of 14 bits with its sign; the columns' parts and h are 128, of 8; px·P - u0 is 128, of 9 with a sign. All
/// numbers fit.
#[test]
fn a_triangle_takes_the_clocks_of_its_bits() {
    let edges = 1 + 4 + 2 + 2 + 8;
    let channels = 3 + 1 + (14 + 9) + (14 + 9) + 1 + 1 + 9;
    for (lanes, edge_rounds, channel_rounds) in [(4, 1, 1), (2, 2, 2), (1, 3, 4)] {
        let clocks = 1 + edge_rounds * edges + channel_rounds * channels + 4;
        let found = cycles_until(&with_lanes(lanes), [[10, 10], [40, 20], [20, 60]], "prim_valid");
        assert_eq!(found, clocks + 1, "{lanes} lanes");
    }
}

/// Slopes of more than 256 pixels a line do not fit: 3 and 11 clocks in place of 1. The first minor edge is flat, not walked.
#[test]
fn a_number_that_does_not_fit_takes_its_digits() {
    let flat = |x: i64| [[0, 10], [x, 10], [x, 11]];
    let [fits, not] = [200, 600].map(|x| cycles_until(&with_lanes(4), flat(x), "prim_valid"));
    // Of the longer triangle du has two bits more: in d0.
    assert!(not >= fits + 2 + 11, "{not} after {fits}");
}

#[test]
fn culls() {
    for (lanes, edges) in [(4, 18), (2, 35), (1, 52)] {
        let ready = |triangle| cycles_until(&with_lanes(lanes), triangle, "tri_ready");
        assert_eq!(ready([[10, 10], [40, 10], [20, 10]]), 3, "no line");
        assert_eq!(ready([[-50, 10], [-40, 30], [-20, 20]]), 3, "no column: before the screen");
        assert_eq!(ready([[640, 10], [700, 30], [680, 20]]), 3, "no column: behind it");
        assert_eq!(ready([[10, 10], [10, 30], [10, 20]]), 3, "no column between");
        assert_eq!(ready([[10, 10], [20, 20], [30, 30]]), edges + 1, "no area");
    }
}
