//! NORMAL: from products with a normal of any length to cosines.

use super::tokens;
use crate::field::Field;
use crate::link::{Link, MemoryPort, Ready, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, events};

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
            read: Link::new("rrd", vec![Field::count("addr", 8, "k, for 1/sqrt(k/256)")]),
            data: Link::new("rdata", vec![Field::count("word", 27, "{v: 17 bits, slope: 10 bits}")]),
            write: "",
            word: "",
            enable: None,
            latency: plan.shade.root_latency,
        }],
        status: vec![
            Status::new("table_wait", "the offered fragment waits for the roots"),
            Status::new("occupied", "a stage holds a fragment"),
        ],
        ..Ports::default()
    }
}

events! {
    roots_read = "times that the roots were fetched" if there;
    root_read_stall = "cycles in which a read waits for the roots" if there;
    normal_short = "normals shorter than half" if there;
    normal_long = "normals of length 1, or longer" if there;
    cosine_cut = "cosines beyond the ends of SHADE's tables" if there;
    normal_stall = "cycles in which all stages stand still" if there;
}
