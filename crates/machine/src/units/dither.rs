//! DITHER: from fragments to fragments whose colours have fewer bits, and to fewer fragments.

use super::tokens;
use crate::channel::Channel;
use crate::link::{Link, Ready};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, events};

/// What DITHER declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "dither",
    purpose: "rounds colours to fewer bits by a pattern, and drops fragments by the same pattern",
    section: 18,
    present: there,
    wants: |_: &Machine| Vec::<Channel>::new(),
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.dither.is_there()
}

fn rounds(plan: &Plan) -> bool {
    plan.dither.rounds()
}

fn drops(plan: &Plan) -> bool {
    plan.dither.drops()
}

fn ports(plan: &Plan) -> Ports {
    // Whether a fragment is dropped is asked of fragments only, and DEPTH behind it asks likewise.
    let frag = Link { ready: Ready::WhileValid, ..Link::new("frag", tokens::shaded(plan)) };
    let dithered = Link { ready: Ready::WhileValid, ..Link::new("dithered", tokens::dithered(plan)) };
    Ports { takes: Some(frag), gives: Some(dithered), ..Ports::default() }
}

events! {
    dither_up = "colours whose lower bits and pattern carry into the bits that are left" if rounds;
    dither_down = "colours with lower bits that do not carry" if rounds;
    dither_white = "colours of all ones" if rounds;
    door_dropped = "fragments that the pattern drops" if drops;
    door_passed = "fragments of a k_t above 0 that the pattern lets pass" if drops;
    door_fence = "fragments that took over the fence of a dropped one" if drops;
}
