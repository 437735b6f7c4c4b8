//! Which events of a unit the ports of a user's design show, and how: the design's own run is then asked for them, and
//! what no port shows is said.
//!
//! Beside an event stands what its unit declares (`machine/src/units`).

use crate::dut::{Wire, Wiring};
use edgewalk_lockstep::{Interface, Link, Unit};
use std::collections::BTreeMap;

/// How an event can be seen in the run of a user's design.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sight {
    /// The tokens tell: a design whose tokens are right met the event as often as the model.
    Tokens,
    /// The bench counts the cycles in which this expression of Verilog is 1.
    Cycles(String),
    /// No port of the design shows the event: the reason.
    Hidden(String),
}

/// Links at which waiting is an event: a token is offered and not taken.
const WAITS: [(&str, &[&str]); 18] = [
    ("span_fifo_full", &["line"]),
    ("polygon_fifo_full", &["line"]),
    ("walk_waits", &["walked"]),
    ("term_read_stall", &["trd"]),
    ("texel_read_stall", &["xrd"]),
    ("bump_stall", &["bumped"]),
    ("root_read_stall", &["rrd"]),
    ("normal_stall", &["normed"]),
    ("lamp_read_stall", &["rrd"]),
    ("lamp_stall", &["normed"]),
    ("table_read_stall", &["srd"]),
    ("shade_stall", &["tinted"]),
    ("project_stall", &["projected"]),
    ("map_stall", &["mrd"]),
    ("memory_stall", &["rd"]),
    // With BLEND depths and colours are written apart.
    ("write_stall", &["wr", "zwr"]),
    ("color_read_stall", &["crd"]),
    ("color_write_stall", &["cwr"]),
];

/// Status ports that show an event while a token is offered at a link.
const FLAGS: [(&str, &str, &str); 6] = [
    ("drain_stall", "hazard", "frag"),
    ("interlock_stall", "hazard", "frag"),
    ("queue_full", "full", "frag"),
    ("color_drain_stall", "color_hazard", "pass"),
    ("color_interlock_stall", "color_hazard", "pass"),
    ("color_queue_full", "color_full", "pass"),
];

/// Events of how our units work inside: another design of the same tokens need not have them.
const INSIDE: [&str; 36] = [
    "fresh_wait",
    "polygon_moves",
    "polygon_whole_list",
    "polygon_blocked",
    "polygon_fresh_wait",
    "load_moves",
    "load_waits",
    "load_overlap",
    "record_read",
    "walk_down",
    "walk_forward",
    "walk_back",
    "walk_result_last",
    "texel_queue_full",
    "texel_data_wait",
    "lamp_wait",
    "tables_drain",
    "project_wait",
    "texel_wait",
    "shadow_queue_full",
    "known_behind_read",
    "forward_compare",
    "forward_write",
    "forward_used",
    "depth_first",
    "color_first",
    "depth_write_waits",
    "opaque_behind",
    "behind_opaque",
    "color_head_wait",
    "color_forward_queue",
    "color_forward_entry",
    "color_forward_write",
    "color_forward_used",
    "door_fence",
    "fence_handed_on",
];

/// Steps of our EDGE, which the ports of the whole machine do not have.
const STEPS: [&str; 3] = ["carry", "no_carry", "wrap"];

/// Fields without which the tokens do not tell of an event.
const FIELDS: [(&str, &str); 4] = [
    ("dropped_fresh", "span_fresh"),
    ("scissor_cut", "span_count"),
    ("fence", "frag_fence"),
    ("off_screen", "frag_addr"),
];

/// How each of these events can be seen at the ports that the design has.
#[must_use]
pub fn sights<'a>(
    interface: &Interface,
    wiring: &Wiring,
    events: impl IntoIterator<Item = &'a str>,
) -> BTreeMap<&'a str, Sight> {
    events.into_iter().map(|event| (event, sight(interface, wiring, event))).collect()
}

fn sight(interface: &Interface, wiring: &Wiring, event: &str) -> Sight {
    let inside = INSIDE.contains(&event) || (interface.unit == Unit::MACHINE && STEPS.contains(&event));
    if inside {
        return Sight::Hidden("no port shows it".to_owned());
    }
    if let Some((_, links)) = WAITS.iter().find(|(name, _)| *name == event) {
        return waits(interface, wiring, links);
    }
    if let Some((_, flag, link)) = FLAGS.iter().find(|(name, ..)| *name == event) {
        return shown_by(interface, wiring, flag, link);
    }
    let field = FIELDS.iter().find(|(name, _)| *name == event).map(|(_, field)| *field);
    match field.filter(|field| wiring.not_compared().iter().any(|absent| absent == field)) {
        Some(field) => Sight::Hidden(format!("no port for {field}")),
        None => Sight::Tokens,
    }
}

/// Cycles in which a token stands at the link, and is not taken.
fn waits(interface: &Interface, wiring: &Wiring, links: &[&str]) -> Sight {
    let of_unit = |link: &Link| links.contains(&link.name);
    let Some(place) = interface.links.iter().position(of_unit) else {
        return Sight::Hidden("no port shows it".to_owned());
    };
    let link = interface.links[place].name;
    match wiring.links[place].ready {
        Some(_) => Sight::Cycles(format!("{link}_valid && !{link}_ready")),
        None => Sight::Hidden(format!("no port for {link}_ready")),
    }
}

/// Cycles in which a status port is 1 while a token is offered at the link.
fn shown_by(interface: &Interface, wiring: &Wiring, flag: &str, link: &str) -> Sight {
    let Some(place) = interface.status.iter().position(|status| status.port.name == flag) else {
        return Sight::Hidden("no port shows it".to_owned());
    };
    match wiring.status[place] {
        Wire::Port { .. } => Sight::Cycles(format!("{link}_valid && {flag}")),
        Wire::Packed | Wire::Absent => Sight::Hidden(format!("no port for {flag}")),
    }
}
