//! DEPTH: from fragments to writes.

use super::tokens;
use crate::channel::{Channel, Kind};
use crate::field::Field;
use crate::link::{Link, MemoryPort, Ready, Status};
use crate::machine::{Hazard, Machine};
use crate::plan::Plan;
use crate::unit::{Event, Ports, UnitSpec, always};

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
            "0 never 1 less 2 equal 3 lequal 4 greater 5 notequal 6 gequal 7 always: new ? old",
        ),
        Field::count("depth_write", 1, "depths of passing fragments are written"),
    ];
    // Without BLEND one write has it all; with BLEND depths and colours part.
    let forks = plan.blend.is_there();
    let (gives, writes) = if forks {
        constants.push(Field::count("color_write", 1, "colours of passing fragments go on to BLEND"));
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
            Status::new("hazard", "the fragment must wait for one in flight").during("frag_valid"),
            Status::new("full", "the in-flight queue is full"),
            Status::new("occupied", "something is in flight"),
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

const EVENTS: &[Event] = &[
    Event { name: "drain_stall", doc: "cycles in which DEPTH waits at a fence", can_happen: drains },
    Event {
        name: "interlock_stall",
        doc: "cycles in which DEPTH waits for an address in flight",
        can_happen: interlocks,
    },
    Event {
        name: "queue_full",
        doc: "cycles in which a fragment waits for the in-flight queue",
        can_happen: always,
    },
    Event { name: "memory_stall", doc: "cycles in which a read waits for the memory", can_happen: always },
    Event { name: "write_stall", doc: "cycles in which a write waits for the memory", can_happen: always },
    Event {
        name: "forward_compare",
        doc: "fragments in the queue, or entering it, that took their old depth from a compare",
        can_happen: forwards_in_queue,
    },
    Event {
        name: "forward_write",
        doc: "fragments entering the queue that took it from the write register",
        can_happen: forwards,
    },
    Event { name: "forward_used", doc: "compares that used a forwarded depth", can_happen: forwards },
    Event { name: "depth_fail", doc: "fragments that failed the compare", can_happen: always },
    Event { name: "depth_first", doc: "depths written before BLEND took the colour", can_happen: forks },
    Event {
        name: "color_first",
        doc: "colours that BLEND took before the depth was written",
        can_happen: forks,
    },
    Event {
        name: "depth_write_waits",
        doc: "cycles in which a depth alone keeps the write register",
        can_happen: forks,
    },
    Event {
        name: "fence_handed_on",
        doc: "fragments that took over the fence of one that failed",
        can_happen: forks,
    },
];
