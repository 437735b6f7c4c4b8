//! SHADOW: from fragments to fragments that are lit or not.

use super::tokens;
use crate::field::Field;
use crate::link::{Link, MemoryPort, Ready, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::shadow::Gate;
use crate::unit::{Ports, UnitSpec, events, light_pass};

/// What SHADOW declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "shadow",
    purpose: "looks up a light's depth map, and darkens what lies behind it",
    section: 10,
    present: there,
    wants: |machine: &Machine| machine.shadow.channels(),
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.shadow.is_there()
}

fn draws_map(plan: &Plan) -> bool {
    plan.shadow.draws_map()
}

fn transmits(plan: &Plan) -> bool {
    plan.shadow.transmits()
}

/// Behind a fragment in the queue there is room for another.
fn several(plan: &Plan) -> bool {
    plan.shadow.is_there() && plan.shadow.queue > 1
}

fn ports(plan: &Plan) -> Ports {
    // Whether a texel has to be read is asked of fragments only.
    let frag = Link { ready: Ready::WhileValid, ..Link::new("frag", tokens::projected(plan)) };
    let mut constants = vec![Field::count("shadow_on", 1, "1: look up the map; 0: every fragment is lit")];
    if plan.shadow.gate == Gate::Scale {
        let doc = "factor of a colour in shadow, all ones for 1";
        constants.push(Field::count("ambient", plan.color.bits, doc));
    }
    constants.extend(light_pass(plan));
    // Whether a word is taken depends on whether the fragment it lights is.
    Ports {
        takes: Some(frag),
        gives: Some(Link::new("shaded", tokens::shaded(plan))),
        memory: vec![MemoryPort {
            name: "map",
            read: Link::new("mrd", vec![tokens::texel_address(plan)]),
            data: Link { ready: Ready::WhileValid, ..Link::new("mdata", vec![tokens::map_word(plan)]) },
            write: "",
            word: "",
            enable: None,
            latency: plan.shadow.latency,
        }],
        constants,
        status: vec![
            Status::new("shadow_full", "the queue is full"),
            Status::new("occupied", "a fragment waits for its texel, or at the output"),
        ],
        ..Ports::default()
    }
}

events! {
    shadow_off = "fragments not looked up because the map is off" if there;
    own_map = "fragments of the light's own pass: none is looked up" if draws_map;
    outside_map = "fragments outside the map: lit" if there;
    before_map = "fragments nearer to the light than the map begins: lit" if there;
    behind_map = "fragments farther from the light than the map ends: in shadow" if there;
    texel_lit = "fragments lit by their texel" if there;
    texel_shadow = "fragments in shadow by their texel" if there;
    texel_tie = "fragments exactly as far as their texel: lit" if there;
    texel_glass = "fragments lit through glass: a share of the light is left" if transmits;
    texel_wait = "cycles in which the oldest fragment waits for its texel alone" if there;
    shadow_queue_full = "cycles in which a fragment waits for SHADOW's queue" if there;
    map_stall = "cycles in which a read waits for the map" if there;
    known_behind_read = "fragments without a texel behind one that waits for its texel" if several;
}
