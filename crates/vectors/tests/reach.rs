//! What the state of a picture rules out: what is missing from a run is then no gap in it, and anything else is.

use crate::common;
use edgewalk_model::DrawState;
use edgewalk_vectors::{StallKind, Suite, Unit, capture, reached};
use std::collections::BTreeSet;

const OPAQUE: [&str; 3] = ["opaque", "opaque_behind", "behind_opaque"];
const MAP: [&str; 9] = [
    "outside_map",
    "before_map",
    "behind_map",
    "texel_lit",
    "texel_shadow",
    "texel_tie",
    "texel_wait",
    "map_stall",
    "known_behind_read",
];
const FORWARDED: [&str; 3] = ["forward_write", "forward_used", "forward_compare"];

/// All of what is read and written.
const ALL: DrawState = DrawState {
    depth_func: 1,
    depth_write: true,
    shadow_on: true,
    light_pass: false,
    ambient: 0,
    color_write: true,
    blend_add: false,
    clear: [0; 3],
};

#[test]
fn what_the_state_rules_out_need_not_be_met() {
    // A state, and beside the events of BLEND's colours what cannot happen there.
    let blended = ["depth_first", "color_first", "fence_handed_on"];
    let unwritten = ["depth_first", "color_first", "depth_write_waits", "interlock_stall"];
    let states: [(DrawState, bool, Vec<&str>); 9] = [
        (ALL, true, vec!["own_map", "shadow_off"]),
        (DrawState { blend_add: true, ..ALL }, true, [&["own_map", "shadow_off"][..], &OPAQUE].concat()),
        (
            DrawState { color_write: false, ..ALL },
            false,
            [&["own_map", "shadow_off"][..], &OPAQUE, &blended].concat(),
        ),
        (
            DrawState { depth_func: 0, ..ALL },
            false,
            [&["own_map", "shadow_off", "depth_write_waits"][..], &OPAQUE, &blended, &FORWARDED].concat(),
        ),
        (
            DrawState { depth_write: false, ..ALL },
            true,
            [&["own_map", "shadow_off"][..], &unwritten, &FORWARDED].concat(),
        ),
        (
            DrawState { depth_func: 7, ..ALL },
            true,
            vec!["own_map", "shadow_off", "fence_handed_on", "depth_fail"],
        ),
        (DrawState { light_pass: true, ..ALL }, true, [&["shadow_off"][..], &MAP].concat()),
        (DrawState { shadow_on: false, ..ALL }, true, [&["own_map"][..], &MAP].concat()),
        (DrawState { shadow_on: false, light_pass: true, ..ALL }, true, [&["shadow_off"][..], &MAP].concat()),
    ];
    let machines = [common::twelve(), common::glass(), common::lights()].concat();
    let (mut checked, mut named) = (0, BTreeSet::new());
    for (name, plan) in &machines {
        let suite = Suite::named(plan, "hazards", 1, 1).expect("listed");
        let one = Suite { cases: suite.cases[..1].to_vec(), ..suite };
        let mut trace = capture(plan, Unit::MACHINE, &one, ALL, StallKind::None);
        let declared: BTreeSet<&str> =
            Unit::MACHINE.events(plan).into_iter().map(|event| event.name).collect();
        for (state, colors, ruled_out) in &states {
            trace.state = *state;
            let can: BTreeSet<&str> = reached(&trace).into_keys().collect();
            let cannot: BTreeSet<&str> = declared.difference(&can).copied().collect();
            let of_colors = |event: &&str| !colors && event.starts_with("color_");
            let wanted: BTreeSet<&str> = declared
                .iter()
                .copied()
                .filter(|event| ruled_out.contains(event) || of_colors(event))
                .collect();
            assert_eq!(cannot, wanted, "{name}, {state:?}");
            named.extend(wanted);
            checked += 1;
        }
    }
    println!("{checked} states of {} machines", machines.len());
    let all: BTreeSet<&str> = states.iter().flat_map(|(_, _, out)| out.iter().copied()).collect();
    assert!(checked == 9 * machines.len() && all.is_subset(&named), "{:?}", all.difference(&named));
}
