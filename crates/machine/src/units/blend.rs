//! BLEND: from fragments that passed to colours.

use super::tokens;
use crate::blend::BlendKind;
use crate::channel::{Channel, Kind};
use crate::field::Field;
use crate::link::{Link, MemoryPort, Ready, Status};
use crate::machine::{Hazard, Machine};
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, events};

/// What BLEND declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "blend",
    purpose: "weighs the colour of a fragment against that of its pixel, or adds it",
    section: 9,
    present: there,
    wants,
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.blend.is_there()
}

fn wants(machine: &Machine) -> Vec<Channel> {
    let interpolated = machine.blend.kind == BlendKind::Interpolated;
    let kt = Channel { name: "kt", kind: Kind::Weight, precision: machine.blend.kt() };
    interpolated.then_some(kt).into_iter().collect()
}

fn ports(plan: &Plan) -> Ports {
    // Whether a pixel is in flight, and whether it has to be read, is asked of fragments only.
    let pass = Link { ready: Ready::WhileValid, ..Link::new("pass", tokens::passed(plan)) };
    Ports {
        takes: Some(pass),
        gives: Some(Link::new("cwr", tokens::color_write(plan))),
        memory: vec![MemoryPort {
            name: "color",
            read: Link::new("crd", vec![tokens::address(plan)]),
            data: Link::new("cdata", vec![tokens::color_word(plan)]),
            write: "cwr",
            word: "rgb",
            enable: None,
            latency: plan.blend.latency,
        }],
        constants: vec![Field::count("blend_add", 1, "0 mix by kt, 1 add and saturate; stable while busy")],
        status: vec![
            Status::new("color_hazard", "the offered fragment waits for one in flight").during("pass_valid"),
            Status::new("color_full", "the queue is full"),
            Status::new("occupied", "a fragment is in flight"),
        ],
        ..Ports::default()
    }
}

fn drains(plan: &Plan) -> bool {
    there(plan) && plan.blend.hazard == Hazard::Drain
}

fn interlocks(plan: &Plan) -> bool {
    there(plan) && plan.blend.hazard == Hazard::Interlock
}

fn forwards(plan: &Plan) -> bool {
    there(plan) && plan.blend.hazard == Hazard::Forward
}

events! {
    opaque = "fragments that need no old colour, so none is read" if there;
    opaque_behind = "fragments without an old colour that meet one of the same pixel in flight that needs it" if passes_others;
    behind_opaque = "fragments that take a colour from one in flight without an old colour" if forwards;
    color_drain_stall = "cycles in which BLEND waits at a fence" if drains;
    color_interlock_stall = "cycles in which BLEND waits for an address in flight" if interlocks;
    color_queue_full = "cycles in which a fragment waits for BLEND's queue" if there;
    color_read_stall = "cycles in which a read waits for the colour memory" if there;
    color_write_stall = "cycles in which a write waits for the colour memory" if there;
    color_head_wait = "cycles in which the oldest fragment waits for a result of its pixel" if forwards;
    color_forward_queue = "fragments in the queue that took the colour from a result" if forwards;
    color_forward_entry = "fragments entering the queue that took the colour from a result of the same cycle" if forwards;
    color_forward_write = "fragments entering the queue that took the colour from the write register" if forwards;
    color_forward_used = "fragments blended with a colour that was forwarded" if forwards;
}

/// With drain a fragment that carries a fence waits, opaque or not; the others of a triangle have pixels of their own.
fn passes_others(plan: &Plan) -> bool {
    there(plan) && plan.blend.hazard != Hazard::Drain
}
