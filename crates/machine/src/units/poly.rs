//! POLY: from the edges of a polygon to lines, in EDGE's place.

use super::tokens;
use crate::field::Field;
use crate::link::{Held, Link, Ready, Status, Until};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, always, events, light_pass};

/// What POLY declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "poly",
    purpose: "walks all edges of a polygon in a table and an active list, a pair of them a span",
    section: 19,
    present: |plan: &Plan| plan.polygon.is_there(),
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn ports(plan: &Plan) -> Ports {
    // Colours along edges have increments of their own in each span.
    let until = if plan.polygon.is_bilinear() { Until::Offered } else { Until::TakenWith("ends") };
    Ports {
        // Whether there is a side left is asked of a prim only.
        takes: Some(Link { ready: Ready::WhileValid, ..Link::new("prim", tokens::prim(plan)) }),
        gives: Some(Link::new("line", tokens::line(plan))),
        held_out: vec![Held { name: "inc", fields: tokens::held_by_edge(plan), beside: "line", until }],
        constants: light_pass(plan).into_iter().collect(),
        levels: vec![Field::count("fresh_queued", 1, "the polygon before has not reached PIXEL yet")],
        status: vec![
            Status::new("walking", "a polygon is walked, or its last span waits"),
            Status::new(
                "refused",
                "a polygon ends here that has more edges than the table: nothing of it is drawn",
            ),
        ],
        ..Ports::default()
    }
}

events! {
    polygon_moves = "words of the active list that an insertion moves" if always;
    polygon_whole_list = "edges that go before all others of the line" if always;
    polygon_touching = "spans that begin where the one before ends" if always;
    polygon_empty_pair = "pairs of edges without a pixel between them" if always;
    polygon_gap = "lines without an active edge inside a polygon" if always;
    polygon_left = "spans cut at the left of the screen" if always;
    polygon_blocked = "cycles in which a pair waits for MOVER" if always;
    polygon_refused = "polygons of more edges than the table holds" if always;
    polygon_full = "polygons of as many edges as the table holds" if always;
    polygon_void = "polygons whose plane has no area" if always;
    polygon_ends_only = "ends of a polygon without an edge on a line" if always;
    load_moves = "edges of the order list that make room for an earlier one" if always;
    load_waits = "cycles in which an edge waits for the write port of the table" if always;
    load_overlap = "edges loaded while another polygon is walked" if always;
    polygon_fresh_wait = "cycles in which a polygon waits for the one before" if always;
    polygon_tie = "edges that go before another of the same column" if |plan| plan.polygon.is_bilinear();
    polygon_narrow = "spans between edges at most a pixel apart" if |plan| plan.polygon.is_bilinear();
    polygon_divides = "cycles in which a span waits for its colours alone" if |plan| plan.polygon.is_bilinear();
    load_divides = "cycles in which an edge waits for its colours" if |plan| plan.polygon.is_bilinear();
    polygon_fifo_full = "cycles in which a span waits for the span FIFO" if always;
}
