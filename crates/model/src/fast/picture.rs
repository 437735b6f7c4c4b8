//! The frame memory of the fast path and, on request, what happened at every pixel.

use super::pixel::{Pixel, pixel};
use crate::DrawState;
use crate::dither::Cut;
use edgewalk_machine::Plan;
use std::ops::Range;

/// Pixels of a chunk, which are drawn side by side.
pub(super) const LANES: usize = 4;

/// What happened at every pixel.
#[derive(Clone, Debug, Default)]
pub(super) struct Details {
    pub coverage: Vec<u32>,
    pub writes: Vec<u32>,
    pub id: Vec<i32>,
}

impl Details {
    /// Counts a chunk's pixels, `remaining` of them, and the masks of those that passed.
    #[inline(always)]
    pub(super) fn count(&mut self, at: usize, remaining: i32, pass: &[u32; LANES], id: i32) {
        for (place, pass) in pass.iter().enumerate().take(remaining as usize) {
            self.coverage[at + place] += 1;
            if *pass != 0 {
                self.writes[at + place] += 1;
                self.id[at + place] = id;
            }
        }
    }
}

/// Rows of W pixels from the top, and a few behind the last, so that a span may be drawn by whole chunks. Nothing is cleared: a
/// pixel that an earlier frame stored counts as clear.
#[derive(Clone, Debug, Default)]
pub(super) struct Picture<P> {
    pub pixels: Vec<P>,
    /// Number of the frame, from 1 on; pixels of no frame have 0.
    frame: u8,
    /// What a clear pixel of this frame is.
    pub clear: P,
    pub details: Details,
}

impl<P: Pixel> Picture<P> {
    /// The farthest depth and the clear colour everywhere.
    pub(super) fn clear(&mut self, plan: &Plan, state: &DrawState, details: bool) {
        let pixels = plan.width as usize * plan.height as usize + LANES;
        if self.pixels.len() != pixels || self.frame == u8::MAX {
            self.pixels = vec![P::default(); pixels];
            self.frame = 0;
        }
        self.frame += 1;
        // The colour of the empty screen is not rounded: one is kept that no place of the pattern changes.
        let cut = plan.dither.rounds().then(|| Cut::new(plan));
        let clear = state.clear.map(|c| cut.as_ref().map_or(c, |cut| cut.color_of(c as u32).into())); // b <= 16 bits
        self.clear = pixel(plan, plan.z.max(), clear, self.stamp());
        if details {
            refill(&mut self.details.coverage, pixels, 0);
            refill(&mut self.details.writes, pixels, 0);
            refill(&mut self.details.id, pixels, -1);
        }
    }

    /// What pixels of this frame have at their top.
    #[inline(always)]
    pub(super) fn stamp(&self) -> P {
        P::stamp(self.frame)
    }

    /// Stored depths and colours of these pixels; with DITHER of n bits.
    pub(super) fn outputs(&self, plan: &Plan, pixels: Range<usize>) -> (Vec<u64>, Vec<[u64; 3]>) {
        let (first, width) = (pixels.start, plan.width as usize);
        let stored = self.pixels.get(pixels).unwrap_or_default().iter();
        let (z, mut rgb): (Vec<u64>, Vec<[u64; 3]>) = stored
            .map(|pixel| pixel.or_clear(self.clear, self.stamp()))
            .map(|p| (u64::from(p.depth()), p.rgb()))
            .unzip();
        if plan.dither.rounds() {
            let cut = Cut::new(plan);
            for (place, rgb) in (first..).zip(&mut rgb) {
                let pattern = cut.pattern(((place / width) << plan.widths().x | (place % width)) as u32);
                *rgb = rgb.map(|color| cut.color(color as u32, pattern).into()); // b <= 16 bits
            }
        }
        (z, rgb)
    }
}

/// Without a new allocation if the size stays.
fn refill<T: Copy>(words: &mut Vec<T>, len: usize, value: T) {
    words.clear();
    words.resize(len, value);
}
