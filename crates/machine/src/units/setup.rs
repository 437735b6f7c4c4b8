//! SETUP: from three vertices to edges and increments.

use super::tokens;
use crate::link::Link;
use crate::machine::{Fill, Machine};
use crate::plan::Plan;
use crate::unit::{Event, Ports, UnitSpec, always, light_pass};

/// What SETUP declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "setup",
    purpose: "turns three vertices into edges and increments",
    section: 2,
    present: always,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn ports(plan: &Plan) -> Ports {
    Ports {
        takes: Some(Link::new("tri", tokens::triangle(plan))),
        gives: Some(Link::new("prim", tokens::prim(plan))),
        constants: light_pass(plan).into_iter().collect(),
        ..Ports::default()
    }
}

const EVENTS: &[Event] = &[
    Event { name: "culled_lines", doc: "triangles without a line on the screen", can_happen: always },
    Event {
        name: "culled_columns",
        doc: "triangles with lines, but without a column on the screen",
        can_happen: |plan| plan.fill == Fill::Exact,
    },
    Event {
        name: "culled_area",
        doc: "triangles with lines and columns, but without area",
        can_happen: always,
    },
    Event { name: "major_left", doc: "triangles whose major edge lies left", can_happen: always },
    Event { name: "major_right", doc: "triangles whose major edge lies right", can_happen: always },
    Event {
        name: "no_upper_part",
        doc: "triangles without an upper part on the screen, n1 = 0",
        can_happen: always,
    },
    Event {
        name: "no_lower_part",
        doc: "triangles without a lower part on the screen, n2 = 0",
        can_happen: always,
    },
    Event {
        name: "knee_on_line",
        doc: "triangles of two parts whose knee lies on a line of pixel centres",
        can_happen: always,
    },
];
