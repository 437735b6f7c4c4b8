//! The machines that come with the program.

use super::{Channel, EdgeKind, Fill, Hazard, Machine};

/// Names of the presets, for `--machine` and its hints.
pub const PRESETS: &[(&str, &str)] = &[
    ("default", "640x480, exact fill, 24-bit depth, 8-bit colour, one pixel a clock"),
    ("textbook", "chapter 7: integer vertices, inclusive spans, slopes, one shared adder pipeline"),
];

impl Default for Machine {
    /// The preset `default`. r = 14 because a span may step over up to 2^13 columns of the guard band before the screen (A4).
    fn default() -> Self {
        Machine {
            width: 640,
            height: 480,
            guard_bits: 13,
            subpixel_bits: 8,
            fill: Fill::Exact,
            edge_kind: EdgeKind::Exact,
            edge_fraction: 16,
            z: Channel { bits: 24, fraction: 14, vertex_fraction: 4 },
            color: Channel { bits: 8, fraction: 14, vertex_fraction: 4 },
            adders: 4,
            segments: 1,
            dividers: 4,
            radix: 4,
            span_fifo: 2,
            inflight: 4,
            latency: 2,
            hazard: Hazard::Forward,
            tag_bits: 0,
        }
    }
}

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
                z: Channel { bits: 16, fraction: 14, vertex_fraction: 0 },
                color: Channel { bits: 8, fraction: 14, vertex_fraction: 0 },
                adders: 1,
                segments: 4,
                dividers: 1,
                radix: 2,
                hazard: Hazard::Drain,
                ..Machine::default()
            }),
            _ => None,
        }
    }
}
