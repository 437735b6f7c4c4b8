//! BUMP: from fragments to fragments whose normal a relief has turned.

use super::tokens;
use crate::link::{Link, Ready, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Event, Ports, UnitSpec};

/// What BUMP declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "bump",
    purpose: "turns the normal of a fragment by the slopes of a relief",
    section: 16,
    present: there,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.shade.bumps()
}

fn normalises(plan: &Plan) -> bool {
    there(plan) && plan.shade.normalises()
}

fn ports(plan: &Plan) -> Ports {
    Ports {
        takes: Some(Link { ready: Ready::Always, ..Link::new("frag", tokens::textured(plan)) }),
        gives: Some(Link::new("bumped", tokens::bumped(plan))),
        status: vec![Status::new("occupied", "a fragment is in a stage")],
        ..Ports::default()
    }
}

const EVENTS: &[Event] = &[
    Event { name: "slope_up", doc: "cosines that the relief makes larger", can_happen: there },
    Event { name: "slope_down", doc: "cosines that the relief makes smaller", can_happen: there },
    Event { name: "slope_lowest", doc: "slopes of the lowest number that there is", can_happen: there },
    Event { name: "bump_cut", doc: "cosines cut at the end of their bits", can_happen: there },
    Event { name: "square_cut", doc: "N·N cut at the end of its bits", can_happen: normalises },
    Event { name: "bump_stall", doc: "cycles in which all stages stand still", can_happen: there },
];
