//! The machines that come with the program.

use crate::channel::{Kind, Precision};
use crate::machine::{
    Blend, BlendKind, EdgeKind, ExtraChannel, Fill, Gate, Hazard, Machine, Shadow, ShadowLight,
};
use crate::plan::Plan;
use crate::shading::{Shade, ShadeColour, ShadeKind, Texture, Walk};

/// Names of the presets, for `--machine` and its hints.
pub const PRESETS: &[(&str, &str)] = &[
    ("default", "640x480, exact fill, 24-bit depth, 8-bit colour, one pixel a clock"),
    ("textbook", "chapter 7: integer vertices, inclusive spans, slopes, one shared adder pipeline"),
    ("small", "240x160, 16-bit depth, 5-bit colour, one pixel a clock, one lane: for an iCE40 UP5K"),
    ("ecp5", "640x480, 16-bit depth, 8-bit colour, one pixel a clock, one lane: for a small ECP5"),
];

/// What a channel of the user is until it is set: a texture coordinate of 12 bits.
const EXTRA: ExtraChannel =
    ExtraChannel { kind: Kind::Floor, precision: Precision { bits: 12, fraction: 14, vertex_fraction: 4 } };

/// Neither TERM nor SHADE, and what they are until more is set.
const SHADE: Shade = Shade {
    kind: ShadeKind::None,
    colour: ShadeColour::Tables,
    table_bits: 9,
    gloss_bits: 4,
    lights: 1,
    material_bits: 4,
    table_latency: 2,
    walk: Walk::Register,
    fraction: 17,
    linear_fraction: 10,
    root_latency: 2,
    texture: Texture::None,
    texture_bits: 8,
    texel_queue: 4,
    texel_latency: 2,
    record_bits: 12,
    term_latency: 2,
};

/// No SHADOW, and what it is until more is set.
const SHADOW: Shadow = Shadow {
    light: ShadowLight::None,
    size: 512,
    guard_bits: 2,
    depth_bits: 16,
    fraction: 14,
    vertex_fraction: 4,
    gate: Gate::And,
    queue: 4,
    latency: 2,
};

/// No BLEND, and what it is until more is set: pixels rarely come again at once, so interlock costs little.
const BLEND: Blend = Blend {
    kind: BlendKind::None,
    kt_bits: 8,
    kt_fraction: 14,
    kt_vertex: 4,
    multipliers: 3,
    stages: 1,
    queue: 4,
    hazard: Hazard::Interlock,
    latency: 2,
};

impl Default for Machine {
    /// The preset `default`. r = 14 because a span may step over up to 2^13 columns of the guard band before the screen (bound 4).
    fn default() -> Self {
        Machine {
            width: 640,
            height: 480,
            guard_bits: 13,
            subpixel_bits: 8,
            fill: Fill::Exact,
            edge_kind: EdgeKind::Exact,
            edge_fraction: 16,
            z: Precision { bits: 24, fraction: 14, vertex_fraction: 4 },
            color: Precision { bits: 8, fraction: 14, vertex_fraction: 4 },
            extras: [EXTRA; 4],
            extra: 0,
            adders: 4,
            segments: 1,
            lanes: 4,
            span_fifo: 2,
            inflight: 4,
            latency: 2,
            hazard: Hazard::Forward,
            shade: SHADE,
            shadow: SHADOW,
            blend: BLEND,
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
                z: Precision { bits: 16, fraction: 14, vertex_fraction: 0 },
                color: Precision { bits: 8, fraction: 14, vertex_fraction: 0 },
                adders: 1,
                segments: 4,
                lanes: 1,
                hazard: Hazard::Drain,
                ..Machine::default()
            }),
            "small" => Some(Machine {
                width: 240,
                height: 160,
                guard_bits: 8,
                z: Precision { bits: 16, fraction: 10, vertex_fraction: 0 },
                color: Precision { bits: 5, fraction: 10, vertex_fraction: 0 },
                span_fifo: 1,
                inflight: 2,
                latency: 1,
                ..narrow()
            }),
            "ecp5" => Some(narrow()),
            _ => None,
        }
    }
}

/// Coordinates and words as short as the screen allows, one lane: SETUP takes three times as long as with four. Fragments wait
/// between triangles, which costs a few clocks where a triangle takes hundreds.
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

impl Plan {
    /// The preset of that name.
    #[must_use]
    pub fn preset(name: &str) -> Option<Plan> {
        Machine::preset(name).and_then(|machine| machine.plan().ok())
    }
}
