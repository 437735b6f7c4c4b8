//! TERM: from spans to spans with the words of the terms at their first pixel.

use super::tokens;
use crate::field::Field;
use crate::link::{Held, Link, MemoryPort, Ready, Status, Until};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::shade::Walk;
use crate::unit::{Ports, UnitSpec, events};

/// What TERM declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "term",
    purpose: "walks polynomials of the pixel's place from the start of a span to the start of the next",
    section: 11,
    present: there,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.shade.is_there()
}

fn ports(plan: &Plan) -> Ports {
    // Whether the walk is there depends on the span.
    let span = Link { ready: Ready::WhileValid, ..Link::new("span", tokens::span(plan)) };
    let bits = plan.record_word_bits();
    Ports {
        takes: Some(span),
        gives: Some(Link::new("walked", tokens::walked(plan))),
        held_in: vec![Held {
            name: "inc",
            fields: tokens::held_record(plan),
            beside: "span",
            until: Until::Offered,
        }],
        memory: vec![MemoryPort {
            name: "terms",
            read: Link::new("trd", vec![tokens::term_address(plan)]),
            data: Link::new(
                "tdata",
                vec![Field::count("word", bits, "word of a record; the low bits count")],
            ),
            write: "",
            word: "",
            enable: None,
            latency: plan.shade.term_latency,
        }],
        status: vec![Status::new("term_wait", "the offered span waits for the walk")],
        ..Ports::default()
    }
}

fn in_memory(plan: &Plan) -> bool {
    there(plan) && plan.shade.walk == Walk::Memory
}

events! {
    record_read = "records that were read" if there;
    walk_down = "steps of the walk to the next line" if there;
    walk_forward = "steps of the walk towards the end of a span" if there;
    walk_back = "steps of the walk away from the end of a span" if there;
    walk_waits = "cycles in which the walk stands at a span that PIXEL does not take yet" if there;
    walk_result_last = "cycles in which a span waits for the last result of the walk alone" if in_memory;
    term_read_stall = "cycles in which a read waits for the memory of the terms" if there;
}
