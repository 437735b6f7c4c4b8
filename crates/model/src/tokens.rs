//! The tokens that move between the units.

use crate::named::{Named, named};
pub use edgewalk_machine::MAX_CHANNELS;
use edgewalk_machine::{Channel, EdgeKind, Plan};

/// Declares tokens of `C` channels: every field with the value in the token that says nothing, and with its declared names
/// as [`named!`] reads them. (An array of any length has no `Default`.)
macro_rules! tokens {
    ($($(#[$doc:meta])* $name:ident $(blank $blank:ident)? {
        $($(#[$what:meta])* $field:ident: $type:ty = $nothing:expr => [$($own:tt)*] $(channels [$($channel:tt)*])?;)*
    })*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub struct $name<const C: usize> { $($(#[$what])* pub $field: $type,)* }

            impl<const C: usize> Default for $name<C> {
                fn default() -> Self {
                    $name { $($field: $nothing,)* }
                }
            }

            named! {
                [<const C: usize>] $name<C>, blank_of!($($blank)?),
                { $($field [$($own)*] $(channels [$($channel)*])?;)* }
            }

            impl<const C: usize> Sourced for $name<C> {
                fn source(&mut self) -> &mut Source {
                    &mut self.source
                }
            }
        )*
    };
}

/// How a token begins before its fields are set from ports.
macro_rules! blank_of {
    () => {
        |_| Self::default()
    };
    ($blank:ident) => {
        $blank
    };
}

/// Channels of a machine without POLY, BLEND, DITHER, TERM and SHADE and channels of the user's own: units of `C` = 4 serve it, of `C` = 8 any machine.
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
        if $plan.channels().len() <= $crate::tokens::FEW
            && !$plan.polygon.is_there()
            && !$plan.blend.is_there()
            && !$plan.dither.is_there()
            && !$plan.shade.is_there()
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

/// A token with the triangle that it comes from.
pub trait Sourced: Named {
    /// The triangle.
    fn source(&mut self) -> &mut Source;
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
    #[inline(always)]
    pub fn step(&mut self, column_bits: u32) -> bool {
        let carry = self.r < self.f;
        self.r += if carry { self.m - self.f } else { -self.f };
        self.c = sign_extend(self.c + self.q + i32::from(carry), column_bits);
        carry
    }
}

tokens! {
    /// SETUP to EDGE or POLY: a triangle, or a part of a polygon, as increments.
    Prim blank with_slope_modulus {
        /// jm: first drawn line.
        line: u32 = 0 => [jm()];
        /// n1 and n2: lines of the upper and the lower part.
        lines: [u32; 2] = [0; 2] => [n1([0]), n2([1])];
        /// The major edge lies right.
        major_right: bool = false => [major_right()];
        /// A line, a pixel wide.
        thin: bool = false => [thin()];
        /// Of a line: x and y have changed places.
        flat: bool = false => [flat()];
        /// With POLY: bits for the major, the first and the second minor edge, those that count.
        sides: u32 = 0 => [sides()];
        /// With POLY: a whole triangle or line, or the last edges of a polygon with its plane.
        ends: bool = false => [ends()];
        /// With POLY: the plane has no area, nothing is drawn.
        void: bool = false => [void()];
        /// With POLY: column and line of the pixel at which values start; the line is the first that is drawn.
        start_pixel: [u32; 2] = [0; 2] => [start_x([0]), start_y([1])];
        /// Edge 0-2.
        major: EdgeWalk = EdgeWalk::default() => [major_c(.c), major_dist(.r), major_q(.q), major_f(.f), major_m(.m)];
        /// Edges 0-1 and 1-2.
        minor: [EdgeWalk; 2] = [EdgeWalk::default(); 2] => [
            minor1_c([0].c), minor1_dist([0].r), minor1_q([0].q), minor1_f([0].f), minor1_m([0].m),
            minor2_c([1].c), minor2_dist([1].r), minor2_q([1].q), minor2_f([1].f), minor2_m([1].m)
        ];
        /// With bilinear colours: DY of edges 0-2, 0-1 and 1-2, 2^-t px.
        heights: [u32; 3] = [0; 3] => [height02([0]), height01([1]), height12([2])];
        /// From vertex 0 to the first line, and from vertex 1 to that of the lower part, 2^-t px.
        down: [u32; 2] = [0; 2] => [down0([0]), down1([1])];
        /// Red, green and blue at the vertices sorted by line, 2^-e LSB.
        colours: [[u32; 3]; 3] = [[0; 3]; 3] => [
            r_at0([0][0]), r_at1([0][1]), r_at2([0][2]),
            g_at0([1][0]), g_at1([1][1]), g_at2([1][2]),
            b_at0([2][0]), b_at1([2][1]), b_at2([2][2])
        ];
        /// First values. Exact fill: `start`, and 0; with POLY at `start_pixel`. Textbook fill: startA of part 1, startB of part 2.
        start: [Words<C>; 2] = [[0; C]; 2] => [] channels ["_start"([0]), "_start_a"([0]), "_start_b"([1])];
        /// Increments a line. Exact fill: d0 without and d1 with the major edge's carry; with POLY d0 straight down, and 0. Textbook fill: dA and dB.
        delta: [Words<C>; 2] = [[0; C]; 2] => [] channels ["_d0"([0]), "_d1"([1]), "_d_a"([0]), "_d_b"([1])];
        /// g: increment a pixel along the span.
        gradient: Words<C> = [0; C] => [] channels ["_g"()];
        /// k_t of the triangle, 2^-kt_bits; 0 where that is a channel.
        kt: u32 = 0 => [kt()];
        /// With TERM: the number of its record.
        record: u32 = 0 => [record()];
        /// The triangle.
        source: Source = Source::default() => [tag(.tag)];
    }

    /// EDGE or POLY to SPAN: a scan line between two edges.
    Line {
        /// Line on the screen.
        y: u32 = 0 => [y()];
        /// Column of the major edge, signed, COLW bits.
        major: i32 = 0 => [cmaj()];
        /// Column of the minor edge, signed, COLW bits.
        minor: i32 = 0 => [cmin()];
        /// The major edge lies right.
        major_right: bool = false => [major_right()];
        /// A pixel of a line.
        thin: bool = false => [thin()];
        /// Of a line: x and y have changed places.
        flat: bool = false => [flat()];
        /// Values at the first pixel.
        values: Words<C> = [0; C] => [] channels [""()];
        /// First line of its triangle.
        fresh: bool = false => [fresh()];
        /// First line of its triangle or, in textbook fill, of its lower part.
        fence: bool = false => [fence()];
        /// The triangle.
        source: Source = Source::default() => [tag(.tag)];
    }

    /// SPAN to PIXEL: pixels of a line, from the first on.
    Span {
        /// First column, signed, COLW bits; may lie off the screen.
        x: i32 = 0 => [x()];
        /// Line on the screen.
        y: u32 = 0 => [y()];
        /// Pixels, at least 1.
        count: u32 = 0 => [count()];
        /// Runs to the left.
        leftward: bool = false => [leftward()];
        /// Values at the first pixel.
        values: Words<C> = [0; C] => [] channels [""()];
        /// First span of its triangle.
        fresh: bool = false => [fresh()];
        /// First span of its triangle or, in textbook fill, of its lower part.
        fence: bool = false => [fence()];
        /// The triangle.
        source: Source = Source::default() => [tag(.tag)];
    }

    /// PIXEL to DEPTH, and with BLEND on to it: one pixel of one triangle.
    Fragment {
        /// y·2^xb + x.
        addr: u32 = 0 => [addr()];
        /// Depth, colour, the user's own, and k_t where it is a channel.
        values: OutputWords<C> = [0; C] => [] channels [""()];
        /// k_t of the triangle; 0 where it is a channel.
        kt: u16 = 0 => [kt()];
        /// Behind SHADOW: the light reaches it.
        lit: bool = false => [lit()];
        /// First fragment of its triangle or, in textbook fill, of its lower part; behind DEPTH of those that passed.
        fence: bool = false => [fence()];
        /// The triangle.
        source: Source = Source::default() => [tag(.tag)];
    }

    /// DEPTH to the frame memory, in a machine without BLEND.
    Write {
        /// y·2^xb + x.
        addr: u32 = 0 => [addr()];
        /// Depth, stored if `z_en`; colour and the user's own, always stored.
        values: OutputWords<C> = [0; C] => [] channels [""()];
        /// The depth is stored.
        z_en: bool = false => [z_en()];
        /// With SHADOW: the light reaches it.
        lit: bool = false => [lit()];
        /// The triangle.
        source: Source = Source::default() => [tag(.tag)];
    }
}

tokens! {
    /// BLEND to the colour memory.
    ColorWrite {
        /// y·2^xb + x.
        addr: u32 = 0 => [addr()];
        /// Red, green and blue of b bits, red the most significant.
        rgb: u64 = 0 => [rgb()];
        /// The same colours, the user's own, and the fragment's depth, at their places.
        values: OutputWords<C> = [0; C] => [] channels [""()];
        /// With SHADOW: the light reaches it.
        lit: bool = false => [lit()];
        /// The triangle.
        source: Source = Source::default() => [tag(.tag)];
    }
}

impl<const C: usize> Prim<C> {
    /// The triangle's spans run to the left.
    #[inline(always)]
    pub(crate) fn runs_left(&self, textbook: bool) -> bool {
        self.major_right && !textbook && !self.thin
    }
}

/// The modulus of a slope edge is the constant 2^F, and no field.
fn with_slope_modulus<const C: usize>(plan: &Plan) -> Prim<C> {
    let m = if plan.edge_kind == EdgeKind::Slope { 1 << plan.edge_fraction } else { 0 };
    let edge = EdgeWalk { m, ..EdgeWalk::default() };
    Prim { major: edge, minor: [edge; 2], ..Prim::default() }
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
