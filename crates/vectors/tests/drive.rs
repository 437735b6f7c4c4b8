//! The netlist draws what the model draws, in the same cycles.

mod common;

use edgewalk_model::{DrawState, Stalls, render};
use edgewalk_vectors::{Suite, render_rtl, render_rtl_with};

#[test]
fn the_picture_of_the_netlist_is_that_of_the_model() {
    let mut compared = 0;
    for (i, (name, machine)) in common::twelve().into_iter().enumerate() {
        let suite = Suite::named(&machine, "sphere", 0, 0).expect("listed");
        let stalls = Stalls { seed: 1, rd: 40, data: 80 * (i % 3) as u8, wr: 60 };
        let state = DrawState { depth_func: [1, 3, 7][i % 3], clear: [1, 2, 3], ..DrawState::default() };
        let model = render(&machine, suite.triangles().copied(), state, stalls);
        let rtl = render_rtl(&machine, suite.triangles().copied(), state, stalls).expect("a checked machine");
        assert_eq!(rtl.z, model.z, "{name}");
        assert_eq!(rtl.rgb, model.rgb, "{name}");
        assert_eq!(rtl.coverage, model.coverage, "{name}");
        assert_eq!(rtl.writes, model.writes, "{name}");
        assert_eq!(rtl.id, model.id, "{name}");
        let seen = |c: &edgewalk_model::Counters| (c.cycles, c.activity, c.triangles, c.fragments, c.writes);
        assert_eq!(seen(&rtl.counters), seen(&model.counters), "{name}");
        compared += model.counters.fragments;
    }
    println!("{compared} fragments compared");
    assert!(compared > 3000, "{compared}");
}

#[test]
fn a_watcher_sees_every_cycle_and_may_end_the_run() {
    let machine = common::small();
    let suite = Suite::named(&machine, "sphere", 0, 0).expect("listed");
    let mut seen = 0;
    let watch = |simulator: &mut edgewalk_netlist::Simulator| {
        seen += 1;
        assert!(simulator.get("activity").is_ok());
        seen < 100
    };
    let triangles = suite.triangles().copied();
    let frame = render_rtl_with(&machine, triangles, DrawState::default(), Stalls::NONE, watch);
    assert_eq!(frame.expect("a checked machine").counters.cycles, 100);
    assert_eq!(seen, 100);
}
