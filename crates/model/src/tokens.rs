//! The tokens that move between the units.

use edgewalk_machine::{Channel, Plan};

/// One word per channel, in the order of the adder: Z, R, G, B. Words of b + r bits, modular.
pub type Words = [u64; 4];

/// Red, green and blue of b <= 16 bits each, in one word, so that a pixel's colour moves in one piece.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rgb(u64);

impl Rgb {
    /// From red, green, blue.
    #[inline]
    #[must_use]
    pub fn new([r, g, b]: [u16; 3]) -> Self {
        Rgb(u64::from(r) | u64::from(g) << 16 | u64::from(b) << 32)
    }

    /// Red, green, blue.
    #[inline]
    #[must_use]
    pub fn channels(self) -> [u16; 3] {
        [0, 16, 32].map(|shift| (self.0 >> shift) as u16)
    }
}

/// The triangle a token comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// The triangle's tag, `tag_bits` bits.
    pub tag: u32,
    /// Not hardware: the triangle's number in the order of arrival, so that a picture can say who drew a pixel.
    pub id: u32,
}

/// An edge on its way from line to line (A9): column `c` and remainder `r`, stepped by quotient `q` and fraction `f`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EdgeWalk {
    /// C: first column whose centre lies on or right of the edge (textbook: 1 + Trunc(X)); signed, COLW bits, px.
    pub c: i32,
    /// R: 0 <= r < m, in 1/m px below `c`.
    pub r: i32,
    /// Whole part of the step, signed, COLW bits, px/line.
    pub q: i32,
    /// Fraction of the step, 0 <= f < m, in 1/m px/line.
    pub f: i32,
    /// M: the modulus, DY (exact edge, 2^-t px) or 2^F (slope edge).
    pub m: i32,
}

impl EdgeWalk {
    /// Goes down a line; true is the carry. `column_bits` is COLW.
    #[inline]
    pub fn step(&mut self, column_bits: u32) -> bool {
        let carry = self.r < self.f;
        self.r += if carry { self.m - self.f } else { -self.f };
        self.c = sign_extend(self.c + self.q + i32::from(carry), column_bits);
        carry
    }
}

/// SETUP to EDGE: a triangle as increments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Prim {
    /// jm: first drawn line.
    pub line: u32,
    /// n1 and n2: lines of the upper and the lower part.
    pub lines: [u32; 2],
    /// The major edge lies right.
    pub left: bool,
    /// Edge 0-2.
    pub major: EdgeWalk,
    /// Edges 0-1 and 1-2.
    pub minor: [EdgeWalk; 2],
    /// First values. Exact fill: `start`, and 0. Textbook fill: startA of part 1, startB of part 2.
    pub start: [Words; 2],
    /// Increments a line. Exact fill: d0 without and d1 with the major edge's carry. Textbook fill: dA and dB.
    pub delta: [Words; 2],
    /// g: increment a pixel along the span.
    pub gradient: Words,
    /// The triangle.
    pub source: Source,
}

/// EDGE to SPAN: a scan line between two edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Line {
    /// Line on the screen.
    pub y: u32,
    /// Column of the major edge, signed, COLW bits.
    pub major: i32,
    /// Column of the minor edge, signed, COLW bits.
    pub minor: i32,
    /// The major edge lies right.
    pub left: bool,
    /// Values at the first pixel.
    pub values: Words,
    /// First line of its triangle.
    pub fresh: bool,
    /// First line of its triangle or, in textbook fill, of its lower part.
    pub fence: bool,
    /// The triangle.
    pub source: Source,
}

/// SPAN to PIXEL: pixels of a line, from the first on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Span {
    /// First column, signed, COLW bits; may lie off the screen.
    pub x: i32,
    /// Line on the screen.
    pub y: u32,
    /// Pixels, at least 1.
    pub count: u32,
    /// Runs to the left.
    pub left: bool,
    /// Values at the first pixel.
    pub values: Words,
    /// First span of its triangle.
    pub fresh: bool,
    /// First span of its triangle or, in textbook fill, of its lower part.
    pub fence: bool,
    /// The triangle.
    pub source: Source,
}

/// PIXEL to DEPTH: one pixel of one triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fragment {
    /// y·2^xb + x.
    pub addr: u32,
    /// Depth, b <= 32 bits.
    pub z: u32,
    /// Colour, b <= 16 bits a channel.
    pub rgb: Rgb,
    /// First fragment of its triangle or, in textbook fill, of its lower part.
    pub fence: bool,
    /// The triangle.
    pub source: Source,
}

/// DEPTH to the frame memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Write {
    /// y·2^xb + x.
    pub addr: u32,
    /// Depth, b <= 32 bits, stored if `z_en`.
    pub z: u32,
    /// Colour, b <= 16 bits a channel, always stored.
    pub rgb: Rgb,
    /// The depth is stored.
    pub z_en: bool,
    /// The triangle.
    pub source: Source,
}

/// The masks of the four channel words, 2^(b+r) - 1.
#[must_use]
pub fn word_masks(machine: &Plan) -> Words {
    per_channel(machine, |c| (1 << c.word()) - 1)
}

/// One value a channel.
pub(crate) fn per_channel<T>(machine: &Plan, value: impl Fn(&Channel) -> T) -> [T; 4] {
    std::array::from_fn(|i| value(&machine.channels()[i]))
}

/// Adds modulo 2^(b+r), channel by channel.
#[inline]
#[must_use]
pub fn add(a: &Words, b: &Words, masks: &Words) -> Words {
    std::array::from_fn(|i| a[i].wrapping_add(b[i]) & masks[i])
}

/// Keeps the low `bits` bits as a signed number.
#[inline]
#[must_use]
pub fn sign_extend(value: i32, bits: u32) -> i32 {
    (value << (32 - bits)) >> (32 - bits)
}
