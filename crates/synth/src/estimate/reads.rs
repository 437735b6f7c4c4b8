//! Which keys of a machine file a unit's netlist follows from.

use edgewalk_machine::Plan;
use edgewalk_machine::keys::KEYS;

/// What joins the units.
pub(super) const JOINTS: &str = "joints";

/// Keys that few units read, and these. All units read the other keys.
const READERS: &[(&str, &[&str])] = &[
    ("screen.subpixel_bits", &["edge", "poly", "setup", JOINTS]),
    ("setup.lanes", &["setup"]),
    ("edge.fraction_bits", &["edge", "poly", "setup", JOINTS]),
    ("fifo.span", &["span"]),
    ("formats.z_fraction", &["edge", "pixel", "poly", "setup", "span", "term", JOINTS]),
    ("formats.z_vertex", &["setup", JOINTS]),
    ("formats.color_fraction", &["edge", "pixel", "poly", "setup", "span", "term", JOINTS]),
    ("formats.color_vertex", &["poly", "setup", JOINTS]),
    ("interpolator.adders", &["pixel"]),
    ("interpolator.segments", &["pixel"]),
    ("fifo.texel", &["texel"]),
    ("memory.hazard", &["depth"]),
    ("memory.latency", &["depth"]),
    ("fifo.inflight", &["depth"]),
    ("shadow.project", &["project", JOINTS]),
    ("shadow.gate", &["shadow", JOINTS]),
    ("fifo.shadow", &["shadow"]),
    ("blend.multipliers", &["blend"]),
    ("fifo.blend", &["blend"]),
    ("memory.color_hazard", &["blend"]),
];

/// The values of the keys that a unit reads, in the order of all keys.
pub(super) fn keys_read(unit: &str, plan: &Plan) -> Vec<u32> {
    let ignores = |key: &str| READERS.iter().any(|(name, readers)| *name == key && !readers.contains(&unit));
    KEYS.iter().filter(|key| !ignores(key.name)).map(|key| (key.get)(plan)).collect()
}
