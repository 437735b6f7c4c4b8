//! SHADE: from cosines to colours.

use super::tokens;
use crate::field::Field;
use crate::link::{Link, MemoryPort, Ready, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, events};

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
            data: Link::new("sdata", vec![Field::count("word", bits, "{diffuse light, highlight}")]),
            write: "",
            word: "",
            enable: None,
            latency: plan.shade.table_latency,
        }],
        status: vec![
            Status::new("table_wait", "the offered fragment waits for its material's tables"),
            Status::new("occupied", "a stage holds a fragment"),
        ],
        ..Ports::default()
    }
}

fn changes(plan: &Plan) -> bool {
    there(plan) && plan.shade.material_bits > 0
}

events! {
    tables_read = "materials whose tables were fetched" if there;
    material_change = "materials replaced by another" if changes;
    tables_drain = "cycles in which new tables wait for fragments of the old ones" if changes;
    table_read_stall = "cycles in which a read waits for the memory of the tables" if there;
    diffuse_below = "cosines N·L below 0, a light a fragment" if there;
    diffuse_above = "cosines N·L beyond the table's end" if there;
    highlight_below = "cosines N·H before the table's beginning" if there;
    highlight_above = "cosines N·H beyond the table's end" if there;
    highlight_unlit = "highlights dropped because the light is below the horizon" if there;
    color_saturated = "colours cut to the largest" if there;
    shade_stall = "cycles in which all stages stand still" if there;
}
