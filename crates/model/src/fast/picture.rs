//! The frame memory of the fast path and, on request, what happened at every pixel.

use super::edge::LINES;
use super::pixel::{Pixel, pixel};
use crate::run::DrawState;
use edgewalk_machine::Plan;
use std::array::from_fn;
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

/// Rows of W pixels from the top, and a few behind the last, so that a span may be drawn by whole chunks.
#[derive(Clone, Debug, Default)]
pub(super) struct Picture<P> {
    pub pixels: Vec<P>,
    /// Of every row the columns outside of which it is clear, the first and that behind the last; and room for some more rows.
    drawn: [Vec<i32>; 2],
    /// What a clear pixel is.
    clear: P,
    pub details: Details,
}

impl<P: Pixel> Picture<P> {
    /// The farthest depth and the clear colour everywhere.
    pub(super) fn clear(&mut self, plan: &Plan, state: &DrawState, details: bool) {
        let (width, height) = (plan.width as usize, plan.height as usize);
        let pixels = width * height + LANES;
        let clear = pixel(plan, plan.z.max(), state.clear);
        let rows = height + LINES;
        let [from, to] = &mut self.drawn;
        if (self.pixels.len(), from.len(), self.clear) == (pixels, rows, clear) {
            for ((row, from), to) in self.pixels.chunks_exact_mut(width).zip(&*from).zip(&*to) {
                if let Some(drawn) = row.get_mut((*from).max(0) as usize..(*to).max(0) as usize) {
                    drawn.fill(clear);
                }
            }
        } else {
            refill(&mut self.pixels, pixels, clear);
        }
        refill(from, rows, i32::MAX);
        refill(to, rows, 0);
        self.clear = clear;
        if details {
            refill(&mut self.details.coverage, pixels, 0);
            refill(&mut self.details.writes, pixels, 0);
            refill(&mut self.details.id, pixels, -1);
        }
    }

    /// Marks columns, from the first to that behind the last, of rows from this on; not of those outside.
    #[inline(always)]
    pub(super) fn mark(&mut self, row: usize, first: [i32; LINES], end: [i32; LINES], inside: [bool; LINES]) {
        let [from, to] = self
            .drawn
            .each_mut()
            .map(|rows| rows.get_mut(row..).and_then(|rows| rows.first_chunk_mut::<LINES>()));
        if let (Some(from), Some(to)) = (from, to) {
            *from = from_fn(|i| from[i].min(if inside[i] { first[i] } else { i32::MAX }));
            *to = from_fn(|i| to[i].max(if inside[i] { end[i] } else { 0 }));
        }
    }

    /// Stored depths and colours of these pixels, b bits each, and what happened to all.
    pub(super) fn outputs(&self, pixels: Range<usize>) -> (Vec<u64>, Vec<[u64; 3]>, &Details) {
        let stored = || self.pixels.get(pixels.clone()).unwrap_or_default().iter();
        (stored().map(|p| u64::from(p.depth())).collect(), stored().map(|p| p.rgb()).collect(), &self.details)
    }
}

/// Without a new allocation if the size stays.
fn refill<T: Copy>(words: &mut Vec<T>, len: usize, value: T) {
    words.clear();
    words.resize(len, value);
}
