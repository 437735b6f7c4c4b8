//! SHADE: from cosines to colours.

use super::tokens;
use crate::field::Field;
use crate::link::{Link, MemoryPort, Ready, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Event, Ports, UnitSpec};

/// What SHADE declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "shade",
    purpose: "makes the colour of a fragment of its cosines, by tables that hold the material",
    section: 12,
    present: there,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.shade.is_there()
}

fn ports(plan: &Plan) -> Ports {
    // Whether its material's tables are inside is asked of fragments only.
    let frag = Link { ready: Ready::WhileValid, ..Link::new("frag", tokens::cosines(plan)) };
    let bits = plan.shade.diffuse_bits(plan.color.bits) + plan.color.bits;
    Ports {
        takes: Some(frag),
        gives: Some(Link::new("tinted", tokens::tinted(plan))),
        memory: vec![MemoryPort {
            name: "tables",
            read: Link::new("srd", vec![tokens::table_address(plan)]),
            data: Link::new("sdata", vec![Field::count("word", bits, "diffuse light, highlight")]),
            write: "",
            word: "",
            enable: None,
            latency: plan.shade.table_latency,
        }],
        status: vec![
            Status::new("table_wait", "a fragment waits for the tables of its material"),
            Status::new("occupied", "a fragment is in a stage"),
        ],
        ..Ports::default()
    }
}

fn changes(plan: &Plan) -> bool {
    there(plan) && plan.shade.material_bits > 0
}

const EVENTS: &[Event] = &[
    Event { name: "tables_read", doc: "materials whose tables were fetched", can_happen: there },
    Event {
        name: "material_change",
        doc: "materials that another one took the place of",
        can_happen: changes,
    },
    Event {
        name: "tables_drain",
        doc: "cycles in which new tables wait for fragments of the old ones",
        can_happen: changes,
    },
    Event {
        name: "table_read_stall",
        doc: "cycles in which a read waits for the memory of the tables",
        can_happen: there,
    },
    Event { name: "diffuse_below", doc: "cosines N·L below 0, a light a fragment", can_happen: there },
    Event { name: "diffuse_above", doc: "cosines N·L beyond the table's end", can_happen: there },
    Event { name: "highlight_below", doc: "cosines N·H before the table's beginning", can_happen: there },
    Event { name: "highlight_above", doc: "cosines N·H beyond the table's end", can_happen: there },
    Event {
        name: "highlight_unlit",
        doc: "highlights that are dropped, as the light is below the horizon",
        can_happen: there,
    },
    Event { name: "color_saturated", doc: "colours cut to the largest", can_happen: there },
    Event { name: "shade_stall", doc: "cycles in which all stages stand still", can_happen: there },
];
