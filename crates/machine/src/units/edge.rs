//! EDGE: from edges to lines.

use super::tokens;
use crate::field::Field;
use crate::link::{Held, Link, Until};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, always, events};

/// What EDGE declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "edge",
    purpose: "walks the major and the minor edge of a triangle, a line a step",
    section: 3,
    present: |plan: &Plan| !plan.polygon.is_there(),
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn ports(plan: &Plan) -> Ports {
    // A triangle that stays at the port while it is walked waits for its own increments to be loaded.
    let of = if plan.is_sequenced() { "that is walked" } else { "before" };
    Ports {
        takes: Some(Link::new("prim", tokens::prim(plan))),
        gives: Some(Link::new("line", tokens::line(plan))),
        held_out: vec![Held {
            name: "inc",
            fields: tokens::held_by_edge(plan),
            beside: "line",
            until: Until::Taken,
        }],
        levels: vec![Field::count("fresh_queued", 1, format!("the triangle {of} has not reached PIXEL yet"))],
        ..Ports::default()
    }
}

events! {
    carry = "steps of the major edge with a carry" if always;
    no_carry = "steps of the major edge without a carry" if always;
    wrap = "steps of an edge value that leave the range of its word" if always;
    fresh_wait = "cycles in which a triangle waits until the first span of the one before is taken" if |plan| !plan.is_sequenced();
    span_fifo_full = "cycles in which a line waits for the span FIFO" if always;
}
