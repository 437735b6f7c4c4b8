//! The machines that come with the program.

use crate::channel::Precision;
use crate::machine::{EdgeKind, Fill, Hazard, Machine, SetupKind};
use crate::polygon::Values;

/// Names of the presets, for `--machine` and its hints.
pub const PRESETS: &[(&str, &str)] = &[
    ("default", "640x480, exact fill, 24-bit depth, 8-bit colour, one pixel a clock"),
    ("textbook", "chapter 7: integer vertices, inclusive spans, slopes, one shared adder pipeline"),
    ("polygon", "the default machine with POLY in EDGE's place: polygons of up to 64 edges"),
    (
        "bilinear",
        "the polygon machine with slope edges, and colours along them: from edge to edge instead of planes",
    ),
    (
        "small",
        "240x160, 16-bit depth, 5-bit colour, one pixel a clock, one lane: its cells fit an iCE40 UP5K, its memories do not",
    ),
    (
        "ecp5",
        "640x480, 16-bit depth, 8-bit colour, one pixel a clock, one lane: its cells fit a small ECP5, its memories do not",
    ),
    (
        "hx8k",
        "default, but a triangle comes word by word to a SETUP that is a program: its cells fit an iCE40 HX8K",
    ),
    (
        "up5k",
        "160x120, 16-bit depth, 5-bit colour, two clocks a pixel, SETUP as a program: fits an iCE40 UP5K with its memories",
    ),
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
            "polygon" => Some(Machine::default().with(|machine| machine.polygon.edges = 64)),
            "bilinear" => Some(Machine::default().with(|machine| {
                machine.edge_kind = EdgeKind::Slope;
                (machine.polygon.edges, machine.polygon.values) = (64, Values::Bilinear);
            })),
            "small" => Some(small()),
            "ecp5" => Some(narrow()),
            "hx8k" => Some(Machine { setup_kind: SetupKind::Sequenced, ..Machine::default() }),
            // A pixel's read and its write share the one port of a block.
            "up5k" => Some(Machine {
                setup_kind: SetupKind::Sequenced,
                width: 160,
                height: 120,
                adders: 2,
                ..small()
            }),
            _ => None,
        }
    }
}

/// What fits the cells of an iCE40 UP5K.
fn small() -> Machine {
    Machine {
        width: 240,
        height: 160,
        guard_bits: 8,
        subpixel_bits: 3,
        z: Precision { bits: 16, fraction: 10, vertex_fraction: 0 },
        color: Precision { bits: 5, fraction: 10, vertex_fraction: 0 },
        span_fifo: 1,
        inflight: 2,
        latency: 1,
        ..narrow()
    }
}

/// Coordinates and words as short as the screen allows, one lane: SETUP takes three times as long as with
/// four. Fragments wait between triangles, which costs a few clocks where a triangle takes hundreds.
fn narrow() -> Machine {
    Machine {
        guard_bits: 10,
        subpixel_bits: 4,
        z: Precision { bits: 16, fraction: 12, vertex_fraction: 0 },
        color: Precision { bits: 8, fraction: 12, vertex_fraction: 0 },
        lanes: 1,
        hazard: Hazard::Drain,
        ..Machine::default()
    }
}
