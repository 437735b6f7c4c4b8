//! One configuration of the machine: every number an architect may choose.
//!
//! ```text
//!  TOML text / preset ──> Machine ──check──> Widths ──> model, rtl, vectors, reports
//!      --set key=value ──────┘  └─> hash
//! ```
//! The fields are documented once, in [`keys::KEYS`]; the symbols are those of `docs/machine.md`.

pub mod check;
pub mod keys;
pub mod nearest;
pub mod presets;
pub mod text;
pub mod widths;

pub use text::MachineError;
pub use widths::Widths;

/// Which pixels a triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fill {
    /// Half-open in both axes, exact for every snapped triangle (design A5, the top-left rule).
    Exact,
    /// Chapter 7: integer vertices, +0.5, `Trunc(X_start)` to `Trunc(X_end)`, both ends and both lines inclusive.
    Textbook,
}

/// How an edge walks from line to line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EdgeKind {
    /// Quotient and remainder (Bresenham's error term): no error at all (A9).
    Exact,
    /// Fixed-point slope with `Machine::edge_fraction` bits, rounded to nearest (A5).
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

/// The formats of one interpolated channel: words of `bits + fraction` bits, modular.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Channel {
    /// Output bits b; the value is unorm, integer / (2^b - 1).
    pub bits: u32,
    /// Fraction bits r of the interpolator below the output's last bit.
    pub fraction: u32,
    /// Fraction bits e of the vertex value below the output's last bit, e <= r.
    pub vertex_fraction: u32,
}

impl Channel {
    /// Bits of the interpolated word, b + r.
    #[must_use]
    pub fn word(self) -> u32 {
        self.bits + self.fraction
    }

    /// Bits of the vertex value at the port, b + e.
    #[must_use]
    pub fn vertex_bits(self) -> u32 {
        self.bits + self.vertex_fraction
    }

    /// The largest output, 2^b - 1, which stands for 1.0.
    #[must_use]
    pub fn max(self) -> u64 {
        (1 << self.bits) - 1
    }
}

/// One machine. Fields are plain; [`Machine::check`] says whether it can be built.
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
    pub z: Channel,
    /// Red, green and blue.
    pub color: Channel,
    /// Adders A shared by the four channels: 4, 2 or 1; 4/A clocks a pixel.
    pub adders: u32,
    /// Segments D of each adder: 1, 2 or 4.
    pub segments: u32,
    /// Setup lanes, each one serial multiplier-divider: 1, 2 or 4.
    pub dividers: u32,
    /// Radix of the lanes: 2, 4 or 16.
    pub radix: u32,
    /// Depth of the span FIFO, spans.
    pub span_fifo: u32,
    /// Depth of the in-flight queue of DEPTH, fragments.
    pub inflight: u32,
    /// Latency L of the depth memory, clocks.
    pub latency: u32,
    /// Hazard policy of DEPTH.
    pub hazard: Hazard,
    /// Bits of the tag that travels with a triangle to its writes; 0 leaves the ports out.
    pub tag_bits: u32,
}

impl Machine {
    /// The four channels in the order of the adder: Z, R, G, B.
    #[must_use]
    pub fn channels(&self) -> [Channel; 4] {
        [self.z, self.color, self.color, self.color]
    }

    /// Clocks a pixel inside a span, T = 4 / A.
    #[must_use]
    pub fn clocks_per_pixel(&self) -> u32 {
        4 / self.adders
    }

    /// Setup bits a clock, k = log2(radix).
    #[must_use]
    pub fn bits_per_clock(&self) -> u32 {
        self.radix.ilog2()
    }
}
