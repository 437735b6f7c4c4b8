//! NORMAL: from products with a normal of any length to cosines.

use super::tokens;
use crate::field::Field;
use crate::link::{Link, MemoryPort, Ready, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Event, Ports, UnitSpec};

/// What NORMAL declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "normal",
    purpose: "divides the products of a fragment's normal by the normal's length",
    section: 13,
    present: there,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.shade.has_normal()
}

fn ports(plan: &Plan) -> Ports {
    Ports {
        takes: Some(Link { ready: Ready::Always, ..Link::new("frag", tokens::bumped(plan)) }),
        gives: Some(Link::new("normed", tokens::cosines(plan))),
        memory: vec![MemoryPort {
            name: "roots",
            read: Link::new("rrd", vec![Field::count("addr", 8, "k: of the root of k/256")]),
            data: Link::new("rdata", vec![Field::count("word", 27, "v of 17 bits, slope of 10")]),
            write: "",
            word: "",
            enable: None,
            latency: plan.shade.root_latency,
        }],
        status: vec![
            Status::new("table_wait", "a fragment waits for the roots"),
            Status::new("occupied", "a fragment is in a stage"),
        ],
        ..Ports::default()
    }
}

const EVENTS: &[Event] = &[
    Event { name: "roots_read", doc: "times that the roots were fetched", can_happen: there },
    Event { name: "root_read_stall", doc: "cycles in which a read waits for the roots", can_happen: there },
    Event { name: "normal_short", doc: "normals shorter than half", can_happen: there },
    Event { name: "normal_long", doc: "normals of length 1, or longer", can_happen: there },
    Event { name: "cosine_cut", doc: "cosines beyond what SHADE takes", can_happen: there },
    Event { name: "normal_stall", doc: "cycles in which all stages stand still", can_happen: there },
];
