//! BLEND: its keys.

use crate::channel::Precision;
use crate::dither;
use crate::key::Domain::{OneOf, Range};
use crate::key::{Domain, Key, number, word};
use crate::machine::{Hazard, Machine};

/// The kind of blending: the transmission coefficient k_t belongs to a triangle or to a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BlendKind {
    /// Nobody's: the machine has no BLEND.
    None,
    /// One for a triangle.
    Constant,
    /// One for a pixel: it is a channel.
    Interpolated,
}

/// BLEND, and the colour memory behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Blend {
    /// The kind of blending.
    pub kind: BlendKind,
    /// Bits of k_t below 1.
    pub kt_bits: u32,
    /// Interpolator fraction bits of k_t where it is a channel.
    pub kt_fraction: u32,
    /// Fraction bits of its vertex value.
    pub kt_vertex: u32,
    /// Multipliers: 3, 1, or 0 for bit by bit.
    pub multipliers: u32,
    /// Stages M between the queue and the write.
    pub stages: u32,
    /// Depth of its queue, fragments.
    pub queue: u32,
    /// What it does when a fragment's pixel is still in flight.
    pub hazard: Hazard,
    /// Latency of the colour memory, clocks.
    pub latency: u32,
}

impl Blend {
    /// The unit is there.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.kind != BlendKind::None
    }

    /// Word lengths of k_t: one bit more than below 1, so that 1 is exact.
    #[must_use]
    pub fn kt(&self) -> Precision {
        Precision { bits: self.kt_bits + 1, fraction: self.kt_fraction, vertex_fraction: self.kt_vertex }
    }
}

/// No BLEND, and what it is until more is set: pixels rarely come again at once, so interlock costs little.
impl Default for Blend {
    fn default() -> Self {
        Blend {
            kind: BlendKind::None,
            kt_bits: 8,
            kt_fraction: 14,
            kt_vertex: 4,
            multipliers: 3,
            stages: 1,
            queue: 4,
            hazard: Hazard::Interlock,
            latency: 2,
        }
    }
}

fn there(machine: &Machine) -> bool {
    machine.blend.is_there()
}

fn interpolates(machine: &Machine) -> bool {
    machine.blend.kind == BlendKind::Interpolated
}

/// The keys of BLEND.
pub const KEYS: &[Key] = &[
    Key {
        absent: Some(BlendKind::None as u32),
        ..word!(
            "blend.kind",
            BlendKind { "none" => None, "constant" => Constant, "interpolated" => Interpolated },
            "blending with the pixel: none, by a k_t of the triangle (constant) or of the pixel (interpolated)",
            blend.kind
        )
    },
    number!(
        "blend.kt_bits",
        Range(4, 12),
        "bits of k_t below 1; 1 is exact",
        blend.kt_bits,
        if |machine| there(machine) || dither::drops(machine)
    ),
    number!(
        "blend.kt_fraction",
        Range(0, 24),
        "k_t as a channel: interpolator fraction bits",
        blend.kt_fraction,
        if interpolates
    ),
    number!(
        "blend.kt_vertex",
        Range(0, 16),
        "k_t as a channel: fraction bits of the vertex value",
        blend.kt_vertex,
        if interpolates
    ),
    number!(
        "blend.multipliers",
        OneOf(&[0, 1, 3]),
        "3: the colours side by side; 1: one after the other, 3 clocks; 0: bit by bit, kt_bits/2 clocks",
        blend.multipliers,
        if there
    ),
    number!("blend.stages", Range(1, 2), "stages between BLEND's queue and its write", blend.stages, if there),
    number!("fifo.blend", Range(1, 16), "fragments in BLEND's queue", blend.queue, if there),
    word!(
        "memory.color_hazard",
        Hazard { "drain" => Drain, "interlock" => Interlock, "forward" => Forward },
        "BLEND: while a pixel is in flight, its next fragment waits for all (drain) or for that one (interlock), or takes its colour (forward)",
        blend.hazard,
        if there
    ),
    number!(
        "memory.color_latency",
        Range(1, 8),
        "clocks from a colour read to its data, at the least",
        blend.latency,
        if there
    ),
];
