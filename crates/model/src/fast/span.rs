//! A span's pixels: interpolate, test, store, LANES at a time.
//!
//! Formats: words of b + r bits stand at the left end of a lane, so that adding wraps by itself and the output is the
//! highest b bits; z in lanes of 64 bits, colours in lanes of [`Pixel::Color`]. Conditions are masks, all ones or zero.
//! The last chunk is drawn whole, and the pixels behind the span keep what they hold.
//!
//! Every statement does one thing to all lanes: so the compiler makes it one vector instruction.

use super::picture::{LANES, Picture};
use super::pixel::Pixel;
use super::walk::Span;
use crate::DrawState;
use crate::tokens::{FEW, Words};
use edgewalk_machine::Plan;
use std::array::from_fn;

/// The increments along a span to the right, for every lane of a chunk.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ramp<P: Pixel> {
    z: [u64; LANES],
    z_step: u64,
    rgb: [[P::Color; LANES]; 3],
    rgb_step: [P::Color; 3],
}

impl<P: Pixel> Ramp<P> {
    #[inline(always)]
    pub(super) fn new(gradient: Words<FEW>) -> Self {
        let [z, rgb @ ..] = gradient;
        let times = |word: u64, i: usize| word.wrapping_mul(i as u64);
        // Through memory, as `place` below: that the first lane adds nothing is not worth knowing.
        std::hint::black_box(Ramp {
            z: from_fn(|i| times(z, i)),
            z_step: times(z, LANES),
            rgb: rgb.map(|c| from_fn(|i| P::color(times(c, i)))),
            rgb_step: rgb.map(|c| P::color(times(c, LANES))),
        })
    }
}

/// What DEPTH does with every fragment of a frame, and how many passed.
#[derive(Clone, Debug)]
pub(super) struct DepthTest {
    /// Masks: less, equal, greater passes.
    less: u32,
    equal: u32,
    greater: u32,
    /// Mask: what passes stores its depth.
    write: u32,
    /// 64 - b of depth, width of a colour lane - b of colour.
    z_drop: u32,
    rgb_drop: u32,
    /// 0 to LANES - 1. From memory: known numbers tempt the compiler to treat every lane in its own way.
    place: [i32; LANES],
    /// Fragments that passed.
    passed: u64,
}

#[inline(always)]
fn mask(condition: bool) -> u32 {
    if condition { !0 } else { 0 }
}

impl DepthTest {
    pub(super) fn new<P: Pixel>(plan: &Plan, state: &DrawState) -> Self {
        DepthTest {
            less: mask(state.depth_func & 1 != 0),
            equal: mask(state.depth_func & 2 != 0),
            greater: mask(state.depth_func & 4 != 0),
            write: mask(state.depth_write),
            z_drop: 64 - plan.z.bits,
            rgb_drop: P::COLOR_BITS - plan.color.bits,
            place: std::hint::black_box(from_fn(|i| i as i32)),
            passed: 0,
        }
    }

    /// Fragments that passed.
    #[inline(always)]
    pub(super) fn passed(&self) -> u64 {
        self.passed
    }

    /// Draws spans, at least one. Returns whether the leftmost and the rightmost pixel of the last passed.
    #[inline(always)]
    pub(super) fn draw<P: Pixel, const DETAILS: bool>(
        &mut self,
        picture: &mut Picture<P>,
        spans: &[Span],
        ramp: &Ramp<P>,
        id: i32,
    ) -> [bool; 2] {
        // In registers: what is stored below might be these, for all the compiler knows.
        let DepthTest { less, equal, greater, write, z_drop, rgb_drop, place, .. } = *self;
        let (not_less, equal) = (less ^ greater, greater ^ equal);
        let (clear, stamp) = (picture.clear, picture.stamp());
        let mut lanes = [0u32; LANES]; // a triangle has fewer pixels
        let (mut leftmost, mut pass) = (0, [0; LANES]);
        for span in spans {
            let mut z: [u64; LANES] = from_fn(|i| span.words[0].wrapping_add(ramp.z[i]));
            let mut rgb: [[P::Color; LANES]; 3] = from_fn(|c| {
                let word = P::color(span.words[c + 1]);
                from_fn(|i| P::step(word, ramp.rgb[c][i]))
            });
            let (mut at, mut remaining) = (span.pixel as usize, span.count as i32);
            while let Some(stored) = picture.pixels.get_mut(at..).and_then(|p| p.first_chunk_mut::<LANES>()) {
                let old = stored.map(|pixel| pixel.or_clear(clear, stamp));
                let old_z = old.map(P::depth);
                let new_z: [u32; LANES] = from_fn(|i| z[i].wrapping_shr(z_drop) as u32);
                let inside: [u32; LANES] = from_fn(|i| mask(place[i] < remaining));
                // What is not less, and equal or not, differs from what is less as its masks do.
                pass = from_fn(|i| {
                    let at_least = mask(new_z[i] >= old_z[i]) & not_less;
                    let same = mask(new_z[i] == old_z[i]) & equal;
                    (less ^ at_least ^ same) & inside[i]
                });
                let new: [P; LANES] =
                    from_fn(|i| P::pack(new_z[i], [rgb[0][i], rgb[1][i], rgb[2][i]], rgb_drop, stamp));
                *stored = from_fn(|i| new[i].select(old[i], pass[i], write));
                lanes = from_fn(|i| lanes[i].wrapping_sub(pass[i])); // all ones is -1
                if at == span.pixel as usize {
                    leftmost = pass[0];
                }
                if DETAILS {
                    picture.details.count(at, remaining, &pass, id);
                }
                if remaining <= LANES as i32 {
                    break;
                }
                z = z.map(|word| word.wrapping_add(ramp.z_step));
                rgb = from_fn(|c| rgb[c].map(|color| P::step(color, ramp.rgb_step[c])));
                at += LANES;
                remaining -= LANES as i32;
            }
        }
        self.passed += lanes.iter().map(|count| u64::from(*count)).sum::<u64>();
        let rightmost = spans.last().map_or(0, |span| pass[span.count.wrapping_sub(1) as usize % LANES]);
        [leftmost != 0, rightmost != 0]
    }
}
