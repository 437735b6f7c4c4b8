//! The tokens that move between the units.

pub use edgewalk_machine::MAX_CHANNELS;
use edgewalk_machine::{Channel, Plan};

/// Declares tokens of `C` channels, and with the value behind each field the token that says nothing. (An array of any
/// length has no `Default`.)
macro_rules! tokens {
    ($($(#[$doc:meta])* $name:ident { $($(#[$what:meta])* $field:ident: $type:ty = $nothing:expr,)* })*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub struct $name<const C: usize> { $($(#[$what])* pub $field: $type,)* }

            impl<const C: usize> Default for $name<C> {
                fn default() -> Self {
                    $name { $($field: $nothing,)* }
                }
            }
        )*
    };
}

/// Channels of a machine without BLEND, TERM and SHADE and channels of the user's own: units of `C` = 4 serve it, of `C` = 8 any machine.
pub const FEW: usize = 4;

/// One word per channel, in the order of [`Plan::channels`]: z, r, g, b, then the user's own; behind the last 0. Words of
/// b + r bits, modular. `C` is at least the number of channels: 4 or 8.
pub type Words<const C: usize> = [u64; C];

/// The output of every channel in the same order, b <= 32 bits; of a signed one in two's complement, [`Plan`] knows which.
pub type OutputWords<const C: usize> = [u32; C];

/// Runs the body with `$C` as the constant that serves the machine, 4 or 8.
#[macro_export]
macro_rules! for_channels {
    ($plan:expr, $C:ident => $body:expr) => {
        if $plan.channels().len() <= $crate::tokens::FEW && !$plan.blend.is_there() && !$plan.shade.is_there()
        {
            const $C: usize = $crate::tokens::FEW;
            $body
        } else {
            const $C: usize = $crate::tokens::MAX_CHANNELS;
            $body
        }
    };
}
pub(crate) use for_channels;

/// The triangle a token comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// The triangle's tag, `tag_bits` bits.
    pub tag: u32,
    /// Not hardware: the triangle's number in the order of arrival, so that a picture can say who drew a pixel.
    pub id: u32,
}

/// An edge on its way from line to line (bound 9): column `c` and remainder `r`, stepped by quotient `q` and fraction `f`.
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

tokens! {
    /// SETUP to EDGE: a triangle as increments.
    Prim {
        /// jm: first drawn line.
        line: u32 = 0,
        /// n1 and n2: lines of the upper and the lower part.
        lines: [u32; 2] = [0; 2],
        /// The major edge lies right.
        major_right: bool = false,
        /// Edge 0-2.
        major: EdgeWalk = EdgeWalk::default(),
        /// Edges 0-1 and 1-2.
        minor: [EdgeWalk; 2] = [EdgeWalk::default(); 2],
        /// First values. Exact fill: `start`, and 0. Textbook fill: startA of part 1, startB of part 2.
        start: [Words<C>; 2] = [[0; C]; 2],
        /// Increments a line. Exact fill: d0 without and d1 with the major edge's carry. Textbook fill: dA and dB.
        delta: [Words<C>; 2] = [[0; C]; 2],
        /// g: increment a pixel along the span.
        gradient: Words<C> = [0; C],
        /// k_t of the triangle, 2^-kt_bits; 0 where that is a channel.
        kt: u32 = 0,
        /// With TERM: the number of its record.
        record: u32 = 0,
        /// The triangle.
        source: Source = Source::default(),
    }

    /// EDGE to SPAN: a scan line between two edges.
    Line {
        /// Line on the screen.
        y: u32 = 0,
        /// Column of the major edge, signed, COLW bits.
        major: i32 = 0,
        /// Column of the minor edge, signed, COLW bits.
        minor: i32 = 0,
        /// The major edge lies right.
        major_right: bool = false,
        /// Values at the first pixel.
        values: Words<C> = [0; C],
        /// First line of its triangle.
        fresh: bool = false,
        /// First line of its triangle or, in textbook fill, of its lower part.
        fence: bool = false,
        /// The triangle.
        source: Source = Source::default(),
    }

    /// SPAN to PIXEL: pixels of a line, from the first on.
    Span {
        /// First column, signed, COLW bits; may lie off the screen.
        x: i32 = 0,
        /// Line on the screen.
        y: u32 = 0,
        /// Pixels, at least 1.
        count: u32 = 0,
        /// Runs to the left.
        leftward: bool = false,
        /// Values at the first pixel.
        values: Words<C> = [0; C],
        /// First span of its triangle.
        fresh: bool = false,
        /// First span of its triangle or, in textbook fill, of its lower part.
        fence: bool = false,
        /// The triangle.
        source: Source = Source::default(),
    }

    /// PIXEL to DEPTH, and with BLEND on to it: one pixel of one triangle.
    Fragment {
        /// y·2^xb + x.
        addr: u32 = 0,
        /// Depth, colour, the user's own, and k_t where it is a channel.
        values: OutputWords<C> = [0; C],
        /// k_t of the triangle; 0 where it is a channel.
        kt: u32 = 0,
        /// Behind SHADOW: the light reaches it.
        lit: bool = false,
        /// First fragment of its triangle or, in textbook fill, of its lower part; behind DEPTH of those that passed.
        fence: bool = false,
        /// The triangle.
        source: Source = Source::default(),
    }

    /// DEPTH to the frame memory, in a machine without BLEND.
    Write {
        /// y·2^xb + x.
        addr: u32 = 0,
        /// Depth, stored if `z_en`; colour and the user's own, always stored.
        values: OutputWords<C> = [0; C],
        /// The depth is stored.
        z_en: bool = false,
        /// With SHADOW: the light reaches it.
        lit: bool = false,
        /// The triangle.
        source: Source = Source::default(),
    }
}

tokens! {
    /// BLEND to the colour memory.
    ColorWrite {
        /// y·2^xb + x.
        addr: u32 = 0,
        /// Red, green and blue of b bits, red the most significant.
        rgb: u64 = 0,
        /// The same colours, the user's own, and the fragment's depth, at their places.
        values: OutputWords<C> = [0; C],
        /// With SHADOW: the light reaches it.
        lit: bool = false,
        /// The triangle.
        source: Source = Source::default(),
    }
}

/// The masks of the channel words, 2^(b+r) - 1; 0 behind the last channel.
#[must_use]
pub fn word_masks<const C: usize>(plan: &Plan) -> Words<C> {
    per_channel(plan, |c| (1 << c.word()) - 1)
}

/// One value a channel; nothing behind the last.
pub(crate) fn per_channel<T: Default, const C: usize>(plan: &Plan, value: impl Fn(&Channel) -> T) -> [T; C] {
    debug_assert!(plan.channels().len() <= C, "more channels than words");
    std::array::from_fn(|i| plan.channels().get(i).map_or_else(T::default, &value))
}

/// An output as a number, LSB: of a signed channel its b bits are two's complement.
#[must_use]
pub fn output(channel: &Channel, word: u32) -> i64 {
    if channel.kind.is_signed() { sign_extend(word as i32, channel.bits).into() } else { word.into() }
}

/// Adds modulo 2^(b+r), channel by channel.
#[inline]
#[must_use]
pub fn add<const C: usize>(a: &Words<C>, b: &Words<C>, masks: &Words<C>) -> Words<C> {
    std::array::from_fn(|i| a[i].wrapping_add(b[i]) & masks[i])
}

/// Keeps the low `bits` bits as a signed number.
#[inline]
#[must_use]
pub fn sign_extend(value: i32, bits: u32) -> i32 {
    (value << (32 - bits)) >> (32 - bits)
}
