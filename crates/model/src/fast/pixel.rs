//! A pixel of the frame memory in one word, depth below, packed colour above, and at the top the frame that stored it: a span is
//! one stretch of memory.

use edgewalk_machine::Plan;

/// A stored pixel: depth in the low 32 bits, colour above, the number of its frame in the high 8. Numbers
/// only grow, so that pixels of earlier frames are less than any of this one.
pub(super) trait Pixel: Copy + Default + Eq {
    /// Lane of an interpolated colour; the word stands at its left end.
    type Color: Copy + Default;
    /// Width of that lane.
    const COLOR_BITS: u32;

    /// A frame's number where it stands.
    fn stamp(frame: u8) -> Self;
    /// Depth, three colour words without their lowest `drop` bits, and a stamp.
    fn pack(z: u32, rgb: [Self::Color; 3], drop: u32, stamp: Self) -> Self;
    /// `clear` instead of a pixel of an earlier frame; `stamp` is that of this frame.
    fn or_clear(self, clear: Self, stamp: Self) -> Self;
    /// Depth.
    fn depth(self) -> u32;
    /// Red, green, blue.
    fn rgb(self) -> [u64; 3];
    /// `self` where the mask is all ones, `old` where it is zero; the depth only if `write` is all ones as well.
    fn select(self, old: Self, mask: u32, write: u32) -> Self;
    /// The high bits of a word at the left end of 64.
    fn color(word: u64) -> Self::Color;
    /// The next colour word along a span.
    fn step(color: Self::Color, gradient: Self::Color) -> Self::Color;
}

macro_rules! pixel {
    ($pixel:ty, $color:ty, $field:literal) => {
        impl Pixel for $pixel {
            type Color = $color;
            const COLOR_BITS: u32 = <$color>::BITS;

            fn stamp(frame: u8) -> Self {
                <$pixel>::from(frame) << (<$pixel>::BITS - 8)
            }
            #[inline(always)]
            fn pack(z: u32, [r, g, b]: [$color; 3], drop: u32, stamp: Self) -> Self {
                let (r, g, b) = (r.wrapping_shr(drop), g.wrapping_shr(drop), b.wrapping_shr(drop));
                <$pixel>::from(r | g << $field | b << (2 * $field)) << 32 | <$pixel>::from(z) | stamp
            }
            #[inline(always)]
            fn or_clear(self, clear: Self, stamp: Self) -> Self {
                if self < stamp { clear } else { self }
            }
            #[inline(always)]
            fn depth(self) -> u32 {
                self as u32
            }
            fn rgb(self) -> [u64; 3] {
                [0, 1, 2].map(|i| (self >> (32 + $field * i)) as u64 & ((1 << $field) - 1))
            }
            #[inline(always)]
            fn select(self, old: Self, mask: u32, write: u32) -> Self {
                let mask = mask as i32 as $pixel & (write as i32 as $pixel | !0 << 32); // sign-extended
                self & mask | old & !mask
            }
            #[inline(always)]
            fn color(word: u64) -> $color {
                (word >> (64 - <$color>::BITS)) as $color
            }
            #[inline(always)]
            fn step(color: $color, gradient: $color) -> $color {
                color.wrapping_add(gradient)
            }
        }
    };
}

// Channels of at most 8 bits, their words at most 8 + 24.
pixel!(u64, u32, 8);
// Channels of at most 16 bits, their words at most 16 + 24.
pixel!(u128, u64, 16);

/// A pixel of these outputs, b bits each, and a stamp.
pub(super) fn pixel<P: Pixel>(plan: &Plan, z: u64, rgb: [u64; 3], stamp: P) -> P {
    let bits = plan.color.bits;
    P::pack(z as u32, rgb.map(|c| P::color(c << (64 - bits))), P::COLOR_BITS - bits, stamp)
}
