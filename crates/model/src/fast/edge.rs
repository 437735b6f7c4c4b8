//! An edge's columns on many lines side by side, without going down line by line.
//!
//! EDGE steps C and R by q and f modulo m: k lines down, C is the least integer not below the edge's column
//! X = c − r/m + k·(q + f/m). That is a multiple of 1/m, so C is the integer nearest to X + 1/2 − 1/(2m), and no tie is nearer
//! than 1/(2m). In f64 it is off by less than 2^-34: an edge is walked between its ends, a line further in textbook fill, so
//! |X| and |k·(q + f/m)| are below 2^17 (COLW <= 16), k is below 2^14, and the few operations are each off by at most 2^-53 of such
//! a number, or 2^-52 in the step, k times. m is at most 2^30 (a slope's F), or 2^23 (DW <= 24).

use super::divide::integer;
use crate::tokens::EdgeWalk;

/// Lines that are walked side by side.
pub(super) const LINES: usize = 8;

/// An edge on its first line, and how it goes on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// X + 1/2 - 1/(2m), and from line to line, px.
    at: f64,
    step: f64,
}

impl Edge {
    /// An edge that is walked; of any other nothing may be asked.
    #[inline(always)]
    pub(super) fn new(walk: &EdgeWalk) -> Self {
        let [c, r, q, f, m] = [walk.c, walk.r, walk.q, walk.f, walk.m].map(f64::from);
        let unit = 1.0 / m;
        Edge { at: c + (m - 2.0 * r - 1.0) * (0.5 * unit), step: q + f * unit }
    }

    /// C on these lines, not yet cut to COLW bits.
    #[inline(always)]
    pub(super) fn columns(&self, lines: &[f64; LINES]) -> [i32; LINES] {
        lines.map(|line| integer(self.at + line * self.step) as i32)
    }
}
