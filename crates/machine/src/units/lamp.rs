//! LAMP: from products with the way to a light at a point to cosines, and what is left of the light.

use super::tokens;
use crate::field::Field;
use crate::link::{Link, MemoryPort, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, events};

/// What LAMP declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "lamp",
    purpose: "finds the cosines of a light at a point, and how much of it comes",
    section: 17,
    present: there,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.shade.is_positional()
}

fn ports(plan: &Plan) -> Ports {
    Ports {
        takes: Some(Link::new("frag", tokens::bumped(plan))),
        gives: Some(Link::new("normed", tokens::cosines(plan))),
        memory: vec![MemoryPort {
            name: "roots",
            read: Link::new("rrd", vec![Field::count("addr", 10, "entry: R from 0, C from 256, A from 512")]),
            data: Link::new(
                "rdata",
                vec![Field::count("word", plan.root_word_bits(), "{v: 17 bits, slope: 16 bits}")],
            ),
            write: "",
            word: "",
            enable: None,
            latency: plan.shade.root_latency,
        }],
        status: vec![
            Status::new("table_wait", "the offered fragment waits for the tables"),
            Status::new("working", "fragments are inside, and none is offered"),
            Status::new("occupied", "the unit holds a fragment"),
        ],
        ..Ports::default()
    }
}

events! {
    lamp_read = "times that the tables of the light were fetched" if there;
    lamp_read_stall = "cycles in which a read waits for the tables" if there;
    lamp_near = "fragments nearer to the light than half the unit of length" if there;
    lamp_beside = "fragments outside the light's cone" if there;
    lamp_short = "roots of arguments below the tables' range" if there;
    lamp_cut = "numbers cut at the end of their bits" if there;
    lamp_wait = "cycles in which a fragment waits for those in the unit" if there;
    lamp_stall = "cycles in which a finished fragment waits" if there;
}
