//! The frame memory of the fast path: depth, packed colour and, on request, what happened at every pixel.

use super::span::LANES;
use crate::run::{DrawState, Frame};
use edgewalk_numerics::Machine;

/// A packed colour, and the words its channels are interpolated in, aligned to the left.
pub(super) trait Color: Copy + Default {
    /// Distance of two channels in a packed colour, bits.
    const FIELD: u32;
    /// The high bits of a word that is aligned to the left of 64 bits.
    fn from_left(word: u64) -> Self;
    /// The next word along a span.
    fn step(self, gradient: Self) -> Self;
    /// Packs the highest `bits` bits of three words.
    fn pack(words: [Self; 3], bits: u32) -> Self;
    /// A packed colour as 64 bits.
    fn wide(self) -> u64;
}

macro_rules! color {
    ($type:ty, $field:literal) => {
        impl Color for $type {
            const FIELD: u32 = $field;
            #[inline(always)]
            fn from_left(word: u64) -> Self {
                (word >> (64 - <$type>::BITS)) as $type
            }
            #[inline(always)]
            fn step(self, gradient: Self) -> Self {
                self.wrapping_add(gradient)
            }
            #[inline(always)]
            fn pack([r, g, b]: [Self; 3], bits: u32) -> Self {
                let drop = <$type>::BITS - bits;
                r >> drop | g >> drop << $field | b >> drop << (2 * $field)
            }
            #[inline(always)]
            fn wide(self) -> u64 {
                u64::from(self)
            }
        }
    };
}

// Channels of at most 8 bits, words of at most 8 + 24.
color!(u32, 8);
// Channels of at most 16 bits, words of at most 16 + 24.
color!(u64, 16);

/// What happened at every pixel.
#[derive(Clone, Debug, Default)]
pub(super) struct Details {
    pub coverage: Vec<u32>,
    pub writes: Vec<u32>,
    pub id: Vec<i32>,
}

/// Rows of W pixels from the top, and a few words behind the last, so that a span may be drawn by whole chunks.
#[derive(Clone, Debug, Default)]
pub(super) struct Picture<C> {
    pub z: Vec<u32>,
    pub rgb: Vec<C>,
    pub details: Details,
}

impl<C: Color> Picture<C> {
    /// The farthest depth and the clear colour everywhere.
    pub(super) fn clear(&mut self, machine: &Machine, state: &DrawState, details: bool) {
        let words = machine.width as usize * machine.height as usize + LANES;
        let [r, g, b] = state.clear.map(|c| C::from_left(c << (64 - machine.color.bits)));
        refill(&mut self.z, words, machine.z.max() as u32);
        refill(&mut self.rgb, words, C::pack([r, g, b], machine.color.bits));
        if details {
            refill(&mut self.details.coverage, words, 0);
            refill(&mut self.details.writes, words, 0);
            refill(&mut self.details.id, words, -1);
        }
    }

    /// Takes over what the ticking model drew.
    pub(super) fn copy(&mut self, machine: &Machine, frame: Frame) {
        let align = |c: u64| C::from_left(c << (64 - machine.color.bits));
        self.z = frame.z.iter().map(|z| *z as u32).collect(); // b <= 32 bits
        self.rgb = frame.rgb.iter().map(|c| C::pack(c.map(align), machine.color.bits)).collect();
        self.details = Details { coverage: frame.coverage, writes: frame.writes, id: frame.id };
    }

    /// Red, green, blue of a pixel, b bits each.
    pub(super) fn rgb(&self, pixel: usize) -> [u64; 3] {
        let packed = self.rgb[pixel].wide();
        [0, 1, 2].map(|i| packed >> (i * C::FIELD) & ((1 << C::FIELD) - 1))
    }
}

/// Without a new allocation if the size stays.
fn refill<T: Copy>(words: &mut Vec<T>, len: usize, value: T) {
    words.clear();
    words.resize(len, value);
}
