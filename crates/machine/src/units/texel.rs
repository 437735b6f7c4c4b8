//! TEXEL: from fragments to fragments whose colour is that of their texel too.

use super::tokens;
use crate::field::Field;
use crate::link::{Link, MemoryPort, Ready, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, events};

/// What TEXEL declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "texel",
    purpose: "multiplies the colour of a fragment by that of the nearest texel",
    section: 14,
    present: there,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.shade.textures()
}

fn ports(plan: &Plan) -> Ports {
    let bits = plan.shade.material_bits + 2 * plan.shade.texture_bits;
    let doc = format!("(material * 2^{0} + line) * 2^{0} + column", plan.shade.texture_bits);
    // Whether a fragment is taken depends on whether its read is, and whether a word is taken on who takes the fragment it colours.
    let frag = Link { ready: Ready::WhileValid, ..Link::new("frag", tokens::fragment(plan)) };
    Ports {
        takes: Some(frag),
        gives: Some(Link::new("textured", tokens::textured(plan))),
        memory: vec![MemoryPort {
            name: "textures",
            read: Link::new("xrd", vec![Field::count("addr", bits, doc)]),
            data: Link { ready: Ready::WhileValid, ..Link::new("xdata", vec![tokens::texture_word(plan)]) },
            write: "",
            word: "",
            enable: None,
            latency: plan.shade.texel_latency,
        }],
        status: vec![
            Status::new("texel_full", "the queue is full"),
            Status::new("occupied", "a fragment waits for its texel, or at the output"),
        ],
        ..Ports::default()
    }
}

events! {
    texel_read = "texels that were read" if there;
    texel_read_stall = "cycles in which a read waits for the memory of the textures" if there;
    texel_queue_full = "cycles in which a fragment waits for TEXEL's queue" if there;
    texel_data_wait = "cycles in which the oldest fragment waits for its texel" if there;
}
