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
    /// Of every row so many columns, counted from the right end, and from the left: outside of what lies in both it is clear. And
    /// room for some more rows.
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
        let [right, left] = &mut self.drawn;
        if (self.pixels.len(), right.len(), self.clear) == (pixels, rows, clear) {
            for ((row, right), left) in self.pixels.chunks_exact_mut(width).zip(&*right).zip(&*left) {
                if let Some(drawn) = row.get_mut(width.saturating_sub(*right as usize)..*left as usize) {
                    drawn.fill(clear);
                }
            }
        } else {
            refill(&mut self.pixels, pixels, clear);
        }
        refill(right, rows, 0);
        refill(left, rows, 0);
        self.clear = clear;
        if details {
            refill(&mut self.details.coverage, pixels, 0);
            refill(&mut self.details.writes, pixels, 0);
            refill(&mut self.details.id, pixels, -1);
        }
    }

    /// Marks rows from this on, as [`Picture::drawn`] has it; of LINES of them those for which `rows` is all ones.
    #[inline(always)]
    pub(super) fn mark(
        &mut self,
        row: usize,
        rows: [i32; LINES],
        to_right: [i32; LINES],
        to_left: [i32; LINES],
    ) {
        let [right, left] = &mut self.drawn;
        for (drawn, marked) in [(right, to_right), (left, to_left)] {
            let Some(drawn) = drawn.get_mut(row..).and_then(|rows| rows.first_chunk_mut::<LINES>()) else {
                return;
            };
            *drawn = from_fn(|i| drawn[i].max(marked[i] & rows[i]));
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
