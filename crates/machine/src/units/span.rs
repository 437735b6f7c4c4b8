//! SPAN: from lines to the pixels of a line.

use super::tokens;
use crate::link::{Link, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, always, events, light_pass};

/// What SPAN declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "span",
    purpose: "cuts a line at the screen, drops it where it is empty, and queues it",
    section: 4,
    present: always,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn ports(plan: &Plan) -> Ports {
    Ports {
        takes: Some(Link::new("line", tokens::line(plan))),
        gives: Some(Link::new("span", tokens::span(plan))),
        constants: light_pass(plan).into_iter().collect(),
        status: vec![
            Status::new(
                "fresh_queued",
                "the first span of a triangle is queued, or may come of the line held",
            ),
            Status::new("line_held", "a line stands before the queue"),
        ],
        ..Ports::default()
    }
}

/// POLY cuts what it gives at the screen itself.
fn cuts(plan: &Plan) -> bool {
    !plan.polygon.is_there()
}

/// But for the pixels of lines.
fn drops(plan: &Plan) -> bool {
    cuts(plan) || plan.polygon.has_lines()
}

events! {
    empty_span = "lines without a pixel" if drops;
    dropped_fresh = "lines without a pixel that passed on the mark of a triangle's first line" if drops;
    line_off = "pixels of lines beside the screen" if |plan| plan.polygon.has_lines();
    scissor_cut = "spans cut by the screen at the side where they end" if cuts;
}
