//! PIXEL: from spans to fragments.

use super::tokens;
use crate::link::{Held, Link, Status, Until};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, always, events, light_pass};

/// What PIXEL declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "pixel",
    purpose: "steps along a span, all channels through the shared adders",
    section: 5,
    present: always,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn ports(plan: &Plan) -> Ports {
    Ports {
        takes: Some(Link::new("span", tokens::walked(plan))),
        gives: Some(Link::new("frag", tokens::fragment(plan))),
        held_in: vec![Held {
            name: "inc",
            fields: tokens::held(plan),
            beside: "span",
            until: Until::Offered,
        }],
        constants: light_pass(plan).into_iter().collect(),
        status: vec![
            Status::new("active", "a span is in progress"),
            Status::new("visible", "the current pixel is on the screen").during("active"),
            Status::new("advance", "the output is free or taken: the unit advances"),
            Status::new("occupied", "an output stage holds a fragment"),
        ],
        ..Ports::default()
    }
}

events! {
    fence = "fragments that carry a fence" if always;
    off_screen = "pixels stepped over off the screen" if |plan| !plan.polygon.is_there();
}
