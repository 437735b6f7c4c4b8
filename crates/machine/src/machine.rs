//! One configuration of the machine: every number an architect may choose.
//!
//! The fields are documented once, in [`crate::keys::KEYS`]; the symbols are those of `docs/machine.md`.

use crate::channel::{Kind, Precision};
use crate::shading::Shade;

/// Which pixels a triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fill {
    /// Half-open in both axes, exact for every snapped triangle: the top-left rule.
    Exact,
    /// Chapter 7: integer vertices, +0.5, `Trunc(X_start)` to `Trunc(X_end)`, both ends and both lines inclusive.
    Textbook,
}

/// How an edge walks from line to line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EdgeKind {
    /// Quotient and remainder (Bresenham's error term): no error at all (bound 9).
    Exact,
    /// Fixed-point slope with `Machine::edge_fraction` bits, rounded to nearest (bound 5).
    Slope,
}

/// What DEPTH does when a fragment's pixel is still in flight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Hazard {
    /// The first fragment of a triangle waits until nothing is in flight.
    Drain,
    /// A fragment waits while its own address is in flight.
    Interlock,
    /// A fragment takes the depth from the older fragment that writes it.
    Forward,
}

/// Whose transmission coefficient k_t BLEND takes.
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
    /// Whose k_t.
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

/// The light whose map SHADOW looks up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShadowLight {
    /// None: the machine has no SHADOW.
    None,
    /// Parallel: light-space values are linear over the screen.
    Parallel,
}

/// What becomes of the colour of a fragment in shadow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Gate {
    /// 0.
    And,
    /// The share `ambient` of it.
    Scale,
}

/// SHADOW, and the map behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shadow {
    /// Which light.
    pub light: ShadowLight,
    /// Side of the map, texels.
    pub size: u32,
    /// Bits that light-space texels have beyond the map.
    pub guard_bits: u32,
    /// Bits of a depth in the map.
    pub depth_bits: u32,
    /// Interpolator fraction bits of light-space values.
    pub fraction: u32,
    /// Fraction bits of their vertex values.
    pub vertex_fraction: u32,
    /// What shadow does.
    pub gate: Gate,
    /// Depth of its queue, fragments.
    pub queue: u32,
    /// Latency of the map, clocks.
    pub latency: u32,
}

impl Shadow {
    /// The unit is there.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.light != ShadowLight::None
    }

    /// SB: bits of a texel's column or line.
    #[must_use]
    pub fn side_bits(&self) -> u32 {
        self.size.next_power_of_two().ilog2().max(1)
    }

    /// Word lengths of lx and ly.
    #[must_use]
    pub fn texel(&self) -> Precision {
        self.precision(self.side_bits() + 1 + self.guard_bits)
    }

    /// Word lengths of lz.
    #[must_use]
    pub fn light_depth(&self) -> Precision {
        self.precision(self.depth_bits + 2)
    }

    fn precision(&self, bits: u32) -> Precision {
        Precision { bits, fraction: self.fraction, vertex_fraction: self.vertex_fraction }
    }
}

/// A channel that the user adds: it is interpolated and written beside the colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ExtraChannel {
    /// How it is read and rounded.
    pub kind: Kind,
    /// Its word lengths.
    pub precision: Precision,
}

/// The keys of one machine, which may clash; [`Machine::plan`] says whether it can be built.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Machine {
    /// Visible columns W.
    pub width: u32,
    /// Visible lines H.
    pub height: u32,
    /// Guard bits G: vertices lie in |x|, |y| <= 2^G - 1 px.
    pub guard_bits: u32,
    /// Sub-pixel bits s of vertex coordinates.
    pub subpixel_bits: u32,
    /// Fill rule.
    pub fill: Fill,
    /// Edge walk.
    pub edge_kind: EdgeKind,
    /// Fraction bits F of a slope edge (unused by exact edges).
    pub edge_fraction: u32,
    /// Depth.
    pub z: Precision,
    /// Red, green and blue.
    pub color: Precision,
    /// Channels that the user adds, in order; the first `extra` of them are there.
    pub extras: [ExtraChannel; 4],
    /// How many.
    pub extra: u32,
    /// Adders A shared by the N channels; ceil(N/A) clocks a pixel.
    pub adders: u32,
    /// Segments D of each adder: 1, 2 or 4.
    pub segments: u32,
    /// Setup lanes, each with one pair of quotient and remainder: 1, 2 or 4.
    pub lanes: u32,
    /// Depth of the span FIFO, spans.
    pub span_fifo: u32,
    /// Depth of the in-flight queue of DEPTH, fragments.
    pub inflight: u32,
    /// Latency L of the depth memory, clocks.
    pub latency: u32,
    /// Hazard policy of DEPTH.
    pub hazard: Hazard,
    /// TERM and SHADE.
    pub shade: Shade,
    /// SHADOW.
    pub shadow: Shadow,
    /// BLEND.
    pub blend: Blend,
    /// Bits of the tag that travels with a triangle to its writes; 0 leaves the ports out.
    pub tag_bits: u32,
}
