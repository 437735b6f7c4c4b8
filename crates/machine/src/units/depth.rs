//! DEPTH: from fragments to writes.

use super::tokens;
use crate::channel::{Channel, Kind};
use crate::field::Field;
use crate::link::{Link, MemoryPort, Ready, Status};
use crate::machine::{Hazard, Machine};
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, always, events};

/// What DEPTH declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "depth",
    purpose: "reads the old depth of every fragment, compares, and writes what passes",
    section: 6,
    present: always,
    wants: |machine: &Machine| vec![Channel { name: "z", kind: Kind::Unorm, precision: machine.z }],
    ports,
    events: EVENTS,
};

fn ports(plan: &Plan) -> Ports {
    // Whether a pixel is in flight is asked of fragments only.
    let frag = Link { ready: Ready::WhileValid, ..Link::new("frag", tokens::shaded(plan)) };
    let mut constants = vec![
        Field::count(
            "depth_func",
            3,
            "new ? old: 0 never 1 less 2 equal 3 lequal 4 greater 5 notequal 6 gequal 7 always",
        ),
        Field::count("depth_write", 1, "write depths of fragments that pass"),
    ];
    // Without BLEND one write has it all; with BLEND depths and colours part.
    let forks = plan.blend.is_there();
    let (gives, writes) = if forks {
        constants.push(Field::count("color_write", 1, "send colours of fragments that pass to BLEND"));
        let zwr = Link::new("zwr", tokens::depth_write(plan));
        let pass = Link { ready: Ready::WhileValid, ..Link::new("pass", tokens::passed(plan)) };
        (pass, vec![zwr])
    } else {
        (Link::new("wr", tokens::write(plan)), Vec::new())
    };
    Ports {
        takes: Some(frag),
        gives: Some(gives),
        writes,
        memory: vec![MemoryPort {
            name: "depth",
            read: Link::new("rd", vec![tokens::address(plan)]),
            data: Link::new("data", vec![tokens::depth_word(plan)]),
            write: if forks { "zwr" } else { "wr" },
            word: "z",
            enable: (!forks).then_some("z_en"),
            latency: plan.latency,
        }],
        constants,
        status: vec![
            Status::new("hazard", "the offered fragment waits for one in flight").during("frag_valid"),
            Status::new("full", "the in-flight queue is full"),
            Status::new("occupied", "a fragment is in flight"),
        ],
        ..Ports::default()
    }
}

fn forks(plan: &Plan) -> bool {
    plan.blend.is_there()
}

fn drains(plan: &Plan) -> bool {
    plan.hazard == Hazard::Drain
}

fn interlocks(plan: &Plan) -> bool {
    plan.hazard == Hazard::Interlock
}

fn forwards(plan: &Plan) -> bool {
    plan.hazard == Hazard::Forward
}

/// A queue of one place is full in the cycle of the compare: nothing stands behind it then, and nothing enters.
fn forwards_in_queue(plan: &Plan) -> bool {
    forwards(plan) && plan.inflight > 1
}

events! {
    drain_stall = "cycles in which DEPTH waits at a fence" if drains;
    interlock_stall = "cycles in which DEPTH waits for an address in flight" if interlocks;
    queue_full = "cycles in which a fragment waits for the in-flight queue" if always;
    memory_stall = "cycles in which a read waits for the memory" if always;
    write_stall = "cycles in which a write waits for the memory" if always;
    forward_compare = "fragments in the queue, or entering it, that took their old depth from a compare" if forwards_in_queue;
    forward_write = "fragments entering the queue that took their old depth from the write register" if forwards;
    forward_used = "compares that used a forwarded depth" if forwards;
    depth_fail = "fragments that failed the compare" if always;
    depth_first = "depths written before BLEND took the colour" if forks;
    color_first = "colours that BLEND took before the depth was written" if forks;
    depth_write_waits = "cycles in which a depth alone keeps the write register" if forks;
    fence_handed_on = "fragments that took over the fence of one that failed" if forks;
}
