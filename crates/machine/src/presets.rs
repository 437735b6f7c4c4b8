//! The machines that come with the program.

use crate::channel::Precision;
use crate::machine::{EdgeKind, Fill, Hazard, Machine};
use crate::plan::Plan;

/// Names of the presets, for `--machine` and its hints.
pub const PRESETS: &[(&str, &str)] = &[
    ("default", "640x480, exact fill, 24-bit depth, 8-bit colour, one pixel a clock"),
    ("textbook", "chapter 7: integer vertices, inclusive spans, slopes, one shared adder pipeline"),
];

impl Machine {
    /// The preset of that name.
    #[must_use]
    pub fn preset(name: &str) -> Option<Machine> {
        match name {
            "default" => Some(Machine::default()),
            "textbook" => Some(Machine {
                subpixel_bits: 0,
                fill: Fill::Textbook,
                edge_kind: EdgeKind::Slope,
                z: Precision { bits: 16, fraction: 14, vertex_fraction: 0 },
                color: Precision { bits: 8, fraction: 14, vertex_fraction: 0 },
                adders: 1,
                segments: 4,
                lanes: 1,
                hazard: Hazard::Drain,
                ..Machine::default()
            }),
            _ => None,
        }
    }
}

impl Plan {
    /// The preset of that name.
    #[must_use]
    pub fn preset(name: &str) -> Option<Plan> {
        Machine::preset(name).and_then(|machine| machine.plan().ok())
    }
}
