//! One configuration of the machine: every number an architect may choose. Units that not every machine has
//! keep theirs in files of their own.
//!
//! To add a parameter: a field, its value in the default machine and its line among the keys, all in one
//! file; a rule in `check.rs` if it can clash with another. The symbols are those of `docs/machine.md`.

use crate::blend::{Blend, BlendKind};
use crate::channel::{MAX_CHANNELS, Precision};
use crate::dither::Dither;
use crate::extra::ExtraChannel;
use crate::key::Domain::{OneOf, Range};
use crate::key::{Domain, Key, number, word};
use crate::polygon::Polygon;
use crate::shade::Shade;
use crate::shadow::Shadow;

/// Which pixels a triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fill {
    /// Half-open in both axes, exact for every snapped triangle: the top-left rule.
    Exact,
    /// Chapter 7: integer vertices, +0.5, `Trunc(X_start)` to `Trunc(X_end)`, both ends and both lines
    /// inclusive.
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

/// How SETUP does its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SetupKind {
    /// A triangle comes at once; hardware of its own for each number.
    Parallel,
    /// A triangle comes word by word; a program of words, executed by the lanes.
    Sequenced,
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
    /// How SETUP does its work.
    pub setup_kind: SetupKind,
    /// Lines beside triangles.
    pub polygon: Polygon,
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
    /// DITHER.
    pub dither: Dither,
    /// BLEND.
    pub blend: Blend,
    /// Bits of the tag that travels with a triangle to its writes; 0 leaves the ports out.
    pub tag_bits: u32,
}

impl Machine {
    /// The same machine with what `change` sets.
    ///
    /// ```
    /// # use edgewalk_machine::Machine;
    /// assert_eq!(Machine::default().with(|m| m.adders = 1).adders, 1);
    /// ```
    #[must_use]
    pub fn with(&self, change: impl FnOnce(&mut Machine)) -> Machine {
        let mut machine = self.clone();
        change(&mut machine);
        machine
    }

    /// A triangle has one transmission coefficient, that of its first vertex: for BLEND or for DITHER.
    #[must_use]
    pub fn has_triangle_kt(&self) -> bool {
        self.blend.kind == BlendKind::Constant || self.dither.drops()
    }
}

impl Default for Machine {
    /// The preset `default`. r = 14 because a span may step over up to 2^13 columns of the guard band before
    /// the screen (bound 4).
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
            extras: [ExtraChannel::default(); 4],
            extra: 0,
            adders: 4,
            segments: 1,
            setup_kind: SetupKind::Parallel,
            polygon: Polygon::default(),
            lanes: 4,
            span_fifo: 2,
            inflight: 4,
            latency: 2,
            hazard: Hazard::Forward,
            shade: Shade::default(),
            shadow: Shadow::default(),
            dither: Dither::default(),
            blend: Blend::default(),
            tag_bits: 0,
        }
    }
}

/// The keys of screen, SETUP, EDGE, SPAN and of the channels that each machine has.
pub(crate) const FRONT: &[Key] = &[
    number!("screen.width", Range(1, 8192), "visible columns, pixels", width),
    number!("screen.height", Range(1, 8192), "visible lines, pixels", height),
    number!(
        "screen.guard_bits",
        Range(2, 14),
        "vertices lie in |x|,|y| <= 2^guard_bits - 1 pixels; nothing inside is clipped",
        guard_bits
    ),
    number!("screen.subpixel_bits", Range(0, 8), "fraction bits of vertex coordinates", subpixel_bits),
    Key {
        absent: Some(SetupKind::Parallel as u32),
        ..word!(
            "setup.kind",
            SetupKind { "parallel" => Parallel, "sequenced" => Sequenced },
            "SETUP: parallel (fast, a triangle comes at once) or sequenced (small, a program; a triangle comes word by word)",
            setup_kind
        )
    },
    number!(
        "setup.lanes",
        OneOf(&[1, 2, 4]),
        "lanes that work side by side, each on a quotient with its exact remainder",
        lanes
    ),
    word!(
        "edge.fill",
        Fill { "exact" => Exact, "textbook" => Textbook },
        "fill rule: exact (half-open, top-left) or textbook (inclusive, integer vertices)",
        fill
    ),
    word!(
        "edge.kind",
        EdgeKind { "exact" => Exact, "slope" => Slope },
        "edge walk: exact (quotient and remainder) or slope (fixed point; may decide a centre beside an edge otherwise)",
        edge_kind
    ),
    number!(
        "edge.fraction_bits",
        Range(1, 30),
        "fraction bits of a slope edge; unused by exact edges",
        edge_fraction
    ),
    number!("fifo.span", Range(1, 64), "depth of the span FIFO, spans", span_fifo),
    number!("formats.z_bits", Range(4, 32), "depth: output bits", z.bits),
    number!("formats.z_fraction", Range(0, 24), "depth: interpolator fraction bits", z.fraction),
    number!("formats.z_vertex", Range(0, 16), "depth: fraction bits of the vertex value", z.vertex_fraction),
    number!("formats.color_bits", Range(2, 16), "colour: output bits", color.bits),
    number!("formats.color_fraction", Range(0, 24), "colour: interpolator fraction bits", color.fraction),
    number!(
        "formats.color_vertex",
        Range(0, 16),
        "colour: fraction bits of the vertex value",
        color.vertex_fraction
    ),
];

/// The keys of PIXEL.
pub(crate) const PIXEL: &[Key] = &[
    number!(
        "interpolator.adders",
        Range(1, MAX_CHANNELS as u32),
        "adders shared by the N channels: ceil(N/adders) clocks a pixel",
        adders
    ),
    number!(
        "interpolator.segments",
        OneOf(&[1, 2, 4]),
        "pipeline segments of each adder; the carry moves a segment a clock",
        segments
    ),
];

/// The keys of DEPTH.
pub(crate) const DEPTH: &[Key] = &[
    word!(
        "memory.hazard",
        Hazard { "drain" => Drain, "interlock" => Interlock, "forward" => Forward },
        "while a pixel is in flight, its next fragment waits for all (drain) or for that one (interlock), or takes its depth (forward)",
        hazard
    ),
    number!("memory.latency", Range(1, 8), "clocks from a depth read to its data, at the least", latency),
    number!("fifo.inflight", Range(1, 16), "fragments in flight between read and compare", inflight),
];

/// The key of what goes with a triangle to its writes.
pub(crate) const TAG: &[Key] = &[number!(
    "memory.tag_bits",
    Range(0, 32),
    "bits of a tag that travels with a triangle to its writes; 0: none",
    tag_bits
)];
