//! A span's pixels: interpolate, test, store, LANES at a time.
//!
//! Formats: words of b + r bits stand at the left end of a lane, so that adding wraps by itself and the output is the
//! highest b bits; z in lanes of 64 bits, colours in lanes of a packed colour. The last chunk is drawn whole, and the
//! pixels behind the span keep what they hold.

use super::picture::{Color, Picture};
use crate::tokens::Words;

/// Pixels of a chunk.
pub(super) const LANES: usize = 8;

/// The increments along a span to the right, for every lane of a chunk.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ramp<C> {
    /// The gradient, aligned to the left of 64 bits.
    pub gradient: Words,
    z: [u64; LANES],
    z_step: u64,
    rgb: [[C; LANES]; 3],
    rgb_step: [C; 3],
}

impl<C: Color> Ramp<C> {
    #[inline(always)]
    pub(super) fn new(gradient: Words) -> Self {
        let [z, rgb @ ..] = gradient;
        let times = |word: u64, i: usize| word.wrapping_mul(i as u64);
        Ramp {
            gradient,
            z: std::array::from_fn(|i| times(z, i)),
            z_step: times(z, LANES),
            rgb: rgb.map(|c| std::array::from_fn(|i| C::from_left(times(c, i)))),
            rgb_step: rgb.map(|c| C::from_left(times(c, LANES))),
        }
    }
}

/// Compare function and write mask of DEPTH.
#[derive(Clone, Copy, Debug)]
pub(super) struct DepthTest {
    /// Passes if less, equal, greater.
    pub less: bool,
    pub equal: bool,
    pub greater: bool,
    /// What passes stores its depth.
    pub write: bool,
    /// Output bits of depth and colour.
    pub z_bits: u32,
    pub color_bits: u32,
}

impl DepthTest {
    #[inline(always)]
    pub(super) fn passes(&self, new: u32, old: u32) -> bool {
        (new < old) & self.less | (new == old) & self.equal | (new > old) & self.greater
    }

    /// The depth of a word.
    #[inline(always)]
    pub(super) fn depth(&self, word: u64) -> u32 {
        (word >> (64 - self.z_bits)) as u32
    }
}

/// Draws `count` pixels from `pixel` on to the right, of these words at the first one; returns how many passed.
#[inline(always)]
pub(super) fn draw<C: Color, const DETAILS: bool>(
    picture: &mut Picture<C>,
    pixel: usize,
    count: u32,
    words: &Words,
    ramp: &Ramp<C>,
    test: &DepthTest,
    id: i32,
) -> u32 {
    let mut z: [u64; LANES] = std::array::from_fn(|i| words[0].wrapping_add(ramp.z[i]));
    let mut rgb: [[C; LANES]; 3] = std::array::from_fn(|c| {
        let word = C::from_left(words[c + 1]);
        std::array::from_fn(|i| word.step(ramp.rgb[c][i]))
    });
    let mut passed = [0u32; LANES];
    let (mut at, mut left) = (pixel, count as i32);
    while left > 0 {
        let (Some(old_z), Some(old_rgb)) = (chunk(&mut picture.z, at), chunk(&mut picture.rgb, at)) else {
            break; // not reached: the memory ends LANES words behind the last pixel
        };
        let mut pass = [false; LANES];
        for i in 0..LANES {
            let new = test.depth(z[i]);
            pass[i] = test.passes(new, old_z[i]) & ((i as i32) < left);
            old_z[i] = if pass[i] & test.write { new } else { old_z[i] };
            z[i] = z[i].wrapping_add(ramp.z_step);
        }
        for i in 0..LANES {
            let new = C::pack([rgb[0][i], rgb[1][i], rgb[2][i]], test.color_bits);
            old_rgb[i] = if pass[i] { new } else { old_rgb[i] };
            passed[i] += u32::from(pass[i]);
        }
        for (words, step) in rgb.iter_mut().zip(ramp.rgb_step) {
            *words = words.map(|word| word.step(step));
        }
        if DETAILS {
            for (i, pass) in pass.into_iter().enumerate().take(left as usize) {
                picture.details.coverage[at + i] += 1;
                if pass {
                    picture.details.writes[at + i] += 1;
                    picture.details.id[at + i] = id;
                }
            }
        }
        at += LANES;
        left -= LANES as i32;
    }
    passed.iter().sum()
}

#[inline(always)]
fn chunk<T>(words: &mut [T], at: usize) -> Option<&mut [T; LANES]> {
    words.get_mut(at..)?.first_chunk_mut()
}
