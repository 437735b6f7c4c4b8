//! BUMP: from fragments to fragments whose normal a relief has turned.

use super::tokens;
use crate::link::{Link, Ready, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, events};

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
        status: vec![Status::new("occupied", "a stage holds a fragment")],
        ..Ports::default()
    }
}

events! {
    slope_up = "cosines that the relief makes larger" if there;
    slope_down = "cosines that the relief makes smaller" if there;
    slope_lowest = "slopes with the lowest number of their format" if there;
    bump_cut = "cosines cut at the end of their bits" if there;
    square_cut = "N·N cut at the end of its bits" if normalises;
    bump_stall = "cycles in which all stages stand still" if there;
}
