//! An edge's columns on many lines side by side, without going down line by line.
//!
//! EDGE steps C and R by q and f modulo m: k lines down, C is the least integer not below the edge's column
//! X = c − r/m + k·(q + f/m). That is a multiple of 1/m, so C is the integer nearest to X + 1/2 − 1/(2m), and no tie is nearer
//! to that than 1/(2m), 2^-31 or more: m is at most 2^30 (the F of a slope), or 2^23 (DY). In f64 it is off by less than 2^-34:
//! an edge is walked from end to end, in textbook fill a line further, so X and k·(q + f/m) are below 2^16 (COLW <= 16), and k
//! below 2^14; the step is off by 2^-52 and 2^-53 of itself, so k steps by (2^15 + 2^16)·2^-53, all operations with numbers up to
//! 2^17 by 2^-53 of these, and of such there are few.

use super::divide::integer;
use crate::tokens::EdgeWalk;
use std::array::from_fn;

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

    /// An edge that begins so many lines further down.
    #[inline(always)]
    pub(super) fn begun_later(self, lines: u32) -> Self {
        Edge { at: self.at - f64::from(lines) * self.step, ..self }
    }

    /// C on these lines, not yet cut to COLW bits.
    #[inline(always)]
    pub(super) fn columns(&self, lines: &[i32; LINES]) -> [i32; LINES] {
        lines.map(|line| integer(self.at + f64::from(line) * self.step) as i32)
    }

    /// Like `columns`, of two edges, the second from line `knee` on.
    #[inline(always)]
    pub(super) fn columns_of_two(edges: &[Edge; 2], knee: i32, lines: &[i32; LINES]) -> [i32; LINES] {
        let [upper, lower] = edges;
        let at = lines.map(|line| if line < knee { upper.at } else { lower.at });
        let step = lines.map(|line| if line < knee { upper.step } else { lower.step });
        from_fn(|i| integer(at[i] + f64::from(lines[i]) * step[i]) as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{RngCore, SeedableRng};

    /// So many lines, within which an edge keeps to columns below 2^16.
    fn lines_within(edge: &EdgeWalk, most: i64) -> i64 {
        let step = i64::from(edge.q.abs()) + 1;
        most.min((1 << 15) / step)
    }

    #[test]
    fn columns_are_those_that_stepping_finds() {
        let mut random = Pcg64::seed_from_u64(1);
        let mut compared = 0;
        for _ in 0..20_000 {
            let below = |random: &mut Pcg64, n: i64| (random.next_u64() % n as u64) as i64;
            let length = 1 + random.next_u32() % 30;
            let m = 1 + below(&mut random, 1 << length); // up to 2^30
            let near = |random: &mut Pcg64| match random.next_u32() % 4 {
                0 => below(random, m.min(3)),
                1 => m - 1 - below(random, m.min(3)),
                _ => below(random, m),
            };
            let [r, f] = [near(&mut random), near(&mut random)].map(|n| n as i32);
            let q = (below(&mut random, 1 << 16) - (1 << 15)) >> (random.next_u32() % 16);
            let c = below(&mut random, 1 << 15) - (1 << 14);
            let mut walk = EdgeWalk { c: c as i32, r, q: q as i32, f, m: m as i32 };
            let edge = Edge::new(&walk);
            let lines = lines_within(&walk, 8193);
            let knee = 1 + below(&mut random, lines);
            let late = [Edge { at: f64::NAN, step: f64::NAN }, edge.begun_later(knee as u32)];
            for first in 0..lines {
                let all: [i32; LINES] = from_fn(|i| first as i32 + i as i32);
                assert_eq!(edge.columns(&all)[0], walk.c, "line {first} of {walk:?}");
                let moved = all.map(|line| line + knee as i32);
                assert_eq!(Edge::columns_of_two(&late, knee as i32, &moved)[0], walk.c, "{knee}, {first}");
                walk.step(32);
                compared += 1;
            }
        }
        assert!(compared > 10_000_000, "{compared}");
    }
}
