//! How long SETUP takes over a triangle or a part of a polygon in a machine with POLY.
//!
//! Rules: `docs/machine.md`, section 19, "Setup".

use super::{AREA, BEHIND, FITS, NEXT_SCALE, SUBTRACT, Timing, signed, unsigned};
use crate::setup::edges::Parts;
use crate::setup::sort::Sorted;

/// Clocks a round waits longer before start, whose factors may have a sign.
pub(super) const WAITS: u32 = 1;

impl Timing {
    /// TE: edges, area and cull.
    #[inline(always)]
    pub(crate) fn phase1_of_sides<const C: usize>(
        &self,
        sorted: &Sorted<C>,
        parts: &Parts,
        scale: u32,
    ) -> u32 {
        let [a, b, c] = &sorted.corners;
        let ([j0, j1], [n1, n2]) = (parts.first, parts.lines);
        let [major, upper, lower] = sorted.counts;
        let asked = [
            self.asked(a, c, parts.drawn(), major && n1 + n2 > 0),
            self.asked(a, b, j0, upper && n1 > 0),
            self.asked(b, c, j1, lower && n2 > 0),
        ];
        let mut clocks = SUBTRACT;
        for (round, counts) in asked.chunks(self.lanes).zip(sorted.counts.chunks(self.lanes)) {
            if counts.contains(&true) {
                let long = round.iter().any(|(long, _)| *long);
                let factors = round.iter().fold(0, |all, (_, factors)| all | factors);
                clocks += self.edges + if long { self.long } else { FITS } + unsigned(factors);
            }
        }
        clocks.max(unsigned(c.v - a.v).max(2) + AREA + scale)
    }

    /// S1 of edges without a plane: their results are behind the last step.
    pub(crate) fn without_plane(phase1: u32) -> u32 {
        phase1 + BEHIND
    }

    /// S2 of a plane.
    #[inline(always)]
    pub(crate) fn phase2_of_plane<const C: usize>(
        &self,
        sorted: &Sorted<C>,
        mut scale: u32,
        area: i64,
    ) -> u32 {
        let [a, b, c] = &sorted.corners;
        let (du1, dv1, du2, dv2) = (b.u - a.u, b.v - a.v, c.u - a.u, c.v - a.v);
        let along = unsigned(dv1 | dv2);
        let window = sorted.window;
        let to_start = [(i64::from(window.x0) << self.t) - a.u, (i64::from(window.y0) << self.t) - a.v];
        let sums = along + signed([-du2, -du1]) + signed(to_start);
        let mut clocks = BEHIND;
        for (i, round) in self.rounds.iter().enumerate() {
            let mut steps = round.clocks + WAITS + sums + 2 * scale;
            if let Some(next) = self.rounds.get(i + 1) {
                let gx = round.gx + along + scale;
                scale = next.scale(sorted, area);
                steps = steps.max(gx + NEXT_SCALE + scale);
            }
            clocks += steps;
        }
        clocks
    }
}
