//! How long SETUP takes over a triangle: counts of bits, as its lanes go through numbers a bit or two a clock.
//!
//! Rules: `docs/machine.md`, section 2, "Pairs". All that is the same for every triangle is added up once, in [`Timing`].

mod polygon;

use super::edges::{Parts, Screen};
use super::sequenced::ProgramClocks;
use super::sort::{Corner, Sorted};
use super::spent::SetupClocks;
use crate::tokens::{MAX_CHANNELS, Prim};
use edgewalk_machine::{EdgeKind, Fill, Plan};
use std::array::from_fn;

/// S1 of a triangle that is culled by lines or columns.
const SEEN_AT_ONCE: u32 = 2;
/// The vertices are subtracted in the first clock of a triangle.
const SUBTRACT: u32 = 1;
/// Taking in a number that fits.
const FITS: u32 = 1;
/// So far are lanes and results behind the steps of the channels.
const BEHIND: u32 = 4;
/// From the first clock of a triangle until the area is known and scaled, less the bits of dv2 and the scale.
const AREA: u32 = 4;
/// Like `AREA`, behind gx of a round, for the next.
const NEXT_SCALE: u32 = 4;

/// The channels that the lanes do side by side.
#[derive(Clone, Copy, Debug)]
struct Round {
    /// A bit a channel.
    channels: u32,
    /// All ones of each of them.
    counts: [i64; MAX_CHANNELS],
    /// Clocks for taking in numbers that do not all fit.
    long: u32,
    /// Bits of the longest vertex value.
    bits: u32,
    /// Up to gx, less scaling and the bits of the sum.
    gx: u32,
    /// Of all its steps, less those of numbers that do not fit, scaling and the bits of sums.
    clocks: u32,
}

/// What a part of a triangle asks for in textbook fill.
struct Part {
    /// Channels whose difference does not fit, a bit each.
    long: u32,
    /// Clocks of its sum.
    sum: u32,
}

/// The clocks of a machine's steps.
#[derive(Clone, Debug)]
pub(crate) struct Timing {
    lanes: usize,
    textbook: bool,
    polygon: bool,
    /// log2 P.
    t: u32,
    /// Bits of a difference of coordinates: DW.
    difference: u32,
    /// Clocks of a round of edges, less those of DX and of the sum.
    edges: u32,
    /// Clocks for taking in DX, if not all of them fit.
    long: u32,
    rounds: Vec<Round>,
    /// Of a sequenced SETUP, for which nothing else here counts.
    program: Option<ProgramClocks>,
}

impl Timing {
    pub(crate) fn new(plan: &Plan) -> Self {
        let w = plan.widths();
        let t = w.center_fraction;
        let textbook = plan.fill == Fill::Textbook;
        let lanes = plan.lanes as usize;
        let long = |bits: u32| 3 + bits.div_ceil(2);
        let (fraction, rounding) = match plan.edge_kind {
            EdgeKind::Exact => (0, 0),
            EdgeKind::Slope => (plan.edge_fraction, plan.edge_fraction.div_ceil(2) + 2),
        };
        let mut rounds = Vec::new();
        let planes: Vec<_> = plan.planes().collect();
        for round in planes.chunks(lanes) {
            let most = |clocks: &dyn Fn(u32) -> u32| {
                round.iter().map(|(_, c)| clocks(c.fraction - c.vertex_fraction)).max().unwrap_or(0) // never empty
            };
            let (dbl, dbl2) = (most(&|up| (t + up).div_ceil(2)), most(&|up| (2 * t + up).div_ceil(2)));
            let bits = round.iter().map(|(_, c)| c.vertex_bits()).max().unwrap_or(0);
            let gx = 3 * FITS + 1 + dbl;
            let clocks = gx
                + if textbook {
                    2 + 2 * (dbl2 + 1 + dbl + 2)
                } else {
                    let (d0, d1, start) = (dbl, 1, 1);
                    d0 + d1 + start
                };
            let channels = round.iter().map(|(place, _)| 1 << place).sum::<u32>();
            let counts = from_fn(|i| -i64::from(channels >> i & 1));
            rounds.push(Round { channels, counts, long: long(bits), bits, gx, clocks });
        }
        Timing {
            lanes,
            textbook,
            polygon: plan.polygon.is_there(),
            t,
            difference: w.difference,
            edges: (t + fraction).div_ceil(2) + 2 + 2 + rounding,
            long: long(w.difference - 1),
            rounds,
            program: plan.is_sequenced().then(|| ProgramClocks::new(plan)),
        }
    }

    /// S and L of a triangle, if SETUP is sequenced; `prim` has its edges, unless it is culled.
    #[inline(always)]
    pub(crate) fn of_program<const C: usize>(
        &self,
        screen: Screen,
        sorted: &Sorted<C>,
        parts: &Parts,
        prim: &Prim<C>,
    ) -> Option<SetupClocks> {
        let program = self.program.as_ref()?;
        Some(program.clocks(screen, sorted, parts, prim))
    }

    /// Of a triangle that is culled by lines or columns.
    pub(crate) fn culled(&self) -> SetupClocks {
        SetupClocks { phase1: SEEN_AT_ONCE, phase2: 0 }
    }

    /// i of the first round of a triangle with this area.
    #[inline(always)]
    pub(crate) fn scale<const C: usize>(&self, sorted: &Sorted<C>, area: i64) -> u32 {
        // No closure: that would be compiled for any processor, and called.
        match self.rounds.first() {
            Some(round) => round.scale(sorted, area),
            None => 0, // never: there is a channel
        }
    }

    /// S1 of any other.
    #[inline(always)]
    pub(crate) fn phase1<const C: usize>(&self, sorted: &Sorted<C>, parts: &Parts, scale: u32) -> u32 {
        let [a, b, c] = &sorted.corners;
        let (first, walked) = (parts.first, parts.lines.map(|lines| lines > 0));
        let asked = [
            self.asked(a, c, parts.drawn(), true),
            self.asked(a, b, first[0], walked[0]),
            self.asked(b, c, first[1], walked[1]),
        ];
        let round = |edges: &[(bool, i64)]| {
            let (long, factors) = edges.iter().fold((false, 0), |all, edge| (all.0 | edge.0, all.1 | edge.1));
            self.edges + if long { self.long } else { FITS } + unsigned(factors)
        };
        let clocks =
            if self.lanes >= asked.len() { round(&asked) } else { asked.chunks(self.lanes).map(round).sum() };
        (SUBTRACT + clocks).max(unsigned(c.v - a.v).max(2) + AREA + scale)
    }

    /// Whether an edge's DX does not fit, and all factors of its sum.
    #[inline(always)]
    fn asked<const C: usize>(&self, from: &Corner<C>, to: &Corner<C>, j: i64, walked: bool) -> (bool, i64) {
        if !walked {
            return (false, 0);
        }
        let column = from.u + i64::from(self.textbook);
        let factors = column & ((1 << self.t) - 1) | ((j << self.t) - from.v);
        (!fits(to.u - from.u, (to.v - from.v) << self.t), factors)
    }

    /// S2 of a triangle whose edges are known.
    #[inline(always)]
    pub(crate) fn phase2<const C: usize>(
        &self,
        sorted: &Sorted<C>,
        parts: &Parts,
        prim: &Prim<C>,
        (area, mut scale): (i64, u32),
    ) -> u32 {
        let [a, b, c] = &sorted.corners;
        let (du1, dv1, du2, dv2) = (b.u - a.u, b.v - a.v, c.u - a.u, c.v - a.v);
        let along = unsigned(dv1 | dv2);
        let (sums, scaled) = if self.textbook {
            (along, 1)
        } else {
            let q = i64::from(prim.major.q);
            let x = i64::from(prim.major.c) - i64::from(prim.major_right);
            let h = (i64::from(prim.line) << self.t) - a.v;
            let down = [q * dv2 - du2, q * dv1 - du1];
            (along + signed(down) + signed([(x << self.t) - a.u - q * h, h]), 2)
        };
        let parts = self.textbook.then(|| [0, 1].map(|part| self.part(sorted, parts, part)));
        let mut clocks = BEHIND;
        for (i, round) in self.rounds.iter().enumerate() {
            let mut steps = round.clocks + sums + scaled * scale;
            for part in parts.iter().flatten() {
                steps += part.sum + if part.long & round.channels == 0 { FITS } else { round.long };
            }
            if let Some(next) = self.rounds.get(i + 1) {
                let gx = round.gx + along + scale;
                scale = next.scale(sorted, area);
                steps = steps.max(gx + NEXT_SCALE + scale);
            }
            clocks += steps;
        }
        clocks
    }

    /// What a part's left edge asks for in textbook fill.
    fn part<const C: usize>(&self, sorted: &Sorted<C>, parts: &Parts, part: usize) -> Part {
        if parts.lines[part] == 0 {
            return Part { long: 0, sum: unsigned(0) };
        }
        let (from, to): (&Corner<C>, &Corner<C>) = sorted.left_edge(part);
        let modulus = (to.v - from.v) << self.t;
        let long = (0..C).map(|i| u32::from(!fits(to.values[i] - from.values[i], modulus)) << i);
        Part { long: long.sum(), sum: unsigned((parts.first[part] << self.t) - from.v) }
    }

    /// Of a triangle none of whose numbers fits, and whose factors are as long as their formats.
    fn longest(&self) -> SetupClocks {
        if let Some(program) = &self.program {
            return program.longest();
        }
        let (waits, behind) = if self.polygon { (polygon::WAITS, BEHIND) } else { (0, 0) };
        let edge_rounds = 3usize.div_ceil(self.lanes) as u32;
        let unsigned = self.difference - 1;
        let scale = |round: &Round| round.bits / 2 + 1;
        let most = self.rounds.iter().map(scale).max().unwrap_or(0); // never empty
        // Sheared, p1 may be further off than any difference: q·dv1 is up to dv1 less than what the edge moves by.
        let sums = if self.textbook { 3 * unsigned } else { unsigned + 2 * self.difference + 1 };
        let round = |round: &Round| {
            let (scaled, taken) = if self.textbook { (1, 2 * round.long) } else { (2, 0) };
            let gx = round.gx + unsigned + scale(round);
            (round.clocks + sums + scaled * scale(round) + taken + waits).max(gx + NEXT_SCALE + most)
        };
        let edges = edge_rounds * (self.edges + self.long + unsigned);
        SetupClocks {
            phase1: (SUBTRACT + edges).max(unsigned + AREA + most) + behind,
            phase2: BEHIND + self.rounds.iter().map(round).sum::<u32>(),
        }
    }
}

impl Round {
    /// i: so often is the area fourfold for the values' differences to fit.
    #[inline(always)]
    fn scale<const C: usize>(&self, sorted: &Sorted<C>, area: i64) -> u32 {
        let [a, b, c] = &sorted.corners;
        // Values are shorter than 62 bits: nothing wraps, and unchecked they go side by side.
        let length = |d: i64| d ^ (d >> 63);
        let lengths: [i64; C] = from_fn(|i| {
            let [a, b, c] = [a.values[i], b.values[i], c.values[i]];
            (length(b.wrapping_sub(a)) | length(a.wrapping_sub(c)) | length(b.wrapping_sub(c)))
                & self.counts[i]
        });
        let all = lengths.iter().fold(0, |all, length| all | length);
        let (least, area) = ((all + i64::from(area < 0)) as u64, area.unsigned_abs());
        if least < area || area == 0 {
            return 0;
        }
        // By their lengths at the most one too few: the areas are 47 bits, the values 48.
        let few = (area.leading_zeros() - least.leading_zeros()) / 2;
        few + u32::from(area << (2 * few) <= least)
    }
}

/// More clocks than any triangle of this machine takes, or as many: a bound from formats alone.
#[must_use]
pub fn longest_setup(plan: &Plan) -> SetupClocks {
    Timing::new(plan).longest()
}

/// D/M is in [-1, 1): the pair is had by testing.
#[inline(always)]
fn fits(d: i64, m: i64) -> bool {
    (-m <= d) & (d < m)
}

/// u: bits of the longest of some numbers >= 0, at least 1; `all` is their or.
#[inline(always)]
fn unsigned(all: i64) -> u32 {
    64 - (all | 1).leading_zeros()
}

/// s: the same in two's complement, at least 2.
#[inline(always)]
fn signed<const N: usize>(numbers: [i64; N]) -> u32 {
    1 + unsigned(numbers.iter().fold(0, |all, n| all | (n ^ (n >> 63))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup_clocks;
    use edgewalk_machine::Machine;
    use edgewalk_machine::channel::Precision;

    /// S1 and S2 of a triangle, corners in pixels, all values 100 but depths that are `z` higher.
    fn clocks(machine: &Machine, corners: [[i32; 2]; 3], z: [i64; 3]) -> [u32; 2] {
        let plan = machine.plan().expect("can be built");
        let place = |px: i32| px << plan.subpixel_bits;
        let vertex = |i: usize| {
            plan.raw_vertex(place(corners[i][0]), place(corners[i][1]), &[100 + z[i], 100, 100, 100])
        };
        let SetupClocks { phase1, phase2 } = setup_clocks(&plan, &[0, 1, 2].map(vertex));
        [phase1, phase2]
    }

    /// Half of a square of two pixels: u0, v0 and u2 are 384, the others 896; n1 = 0, C = 2, q = 0, A = 2^18.
    const HALF: [[i32; 2]; 3] = [[2, 2], [4, 2], [2, 4]];

    #[test]
    fn exact_by_hand() {
        // Two edges: DX, 8 doublings, DY, wait, u(128) = 8; the one that is not walked asks for u = 1.
        let (edge, idle) = (1 + 4 + 2 + 2 + 8, 1 + 4 + 2 + 2 + 1);
        // p1 + p2, p1, p2, wait; gx, u(512) = 10 and 18 doublings; d0, s(-512) = 10 and 18 doublings; d1, wait; s(128) = 9.
        let round = 3 + 1 + (10 + 9) + (10 + 9) + 1 + 1 + 9;
        for (lanes, edges, rounds) in [(4, edge, 1), (2, edge + edge, 2), (1, edge + idle + edge, 4)] {
            let machine = Machine { lanes, ..Machine::default() };
            assert_eq!(clocks(&machine, HALF, [0; 3]), [1 + edges, rounds * round + 4], "{lanes} lanes");
        }
        // Five channels on four lanes.
        let five = Machine { extra: 1, ..Machine::default() }.plan().expect("can be built");
        let vertices = HALF.map(|[x, y]| five.raw_vertex(x << 8, y << 8, &[100; 5]));
        assert_eq!(setup_clocks(&five, &vertices).phase2, 2 * round + 4);
        // A slope of 16 fraction bits: 8 clocks of doubling more, 8 after the sum, and two of rounding.
        let slope = Machine { edge_kind: EdgeKind::Slope, ..Machine::default() };
        assert_eq!(clocks(&slope, HALF, [0; 3]), [1 + edge + 8 + 8 + 2, round + 4]);
    }

    #[test]
    fn sheared_by_hand() {
        // The major edge from 384, 384 goes 2816 right and 1024 down: q = 2, and 768 = 2816 - 2·1024. p1 stands 256 below its top.
        // On line 2, 128 below, it is at 384 + 128·2816/1024 = 736, 2.875 px: C = 3.
        let knee_at = |x| clocks(&Machine::default(), [[2, 2], [x, 3], [13, 6]], [0; 3])[1];
        let along = 11 + 9; // u(1024), doublings
        let s2 = |down: u32, start: u32| 3 + 1 + along + (down + 9) + 1 + 1 + start + 4;
        // Major right: du1 - q·dv1 = -256 - 2·256, s(-768, 768) = 11; px = 2, s(2·256 - 384 - 2·128, 128) = s(-128, 128) = 9.
        assert_eq!(knee_at(1), s2(11, 9));
        // Major left: s(-768, 512 - 2560) = s(-2048) = 12, but s(512 - 2816) = 13; px = 3, s(384 - 2·128, 128) = 9.
        assert_eq!([12, 13].map(knee_at), [s2(12, 9), s2(13, 9)]);
        // One column back over the whole guard band, q = -1: su of p1 is 2·16381 px, s = 24 = DW + 1. u(16382 px) = 22; line 0 is
        // 8191.5 px below p0, half a px left of it C = -8191: s(8191 px) = 22.
        let whole = clocks(&Machine::default(), [[-8190, -8191], [8191, 8190], [-8191, 8191]], [0; 3])[1];
        assert_eq!(whole, 3 + 1 + (22 + 9) + (24 + 9) + 1 + 1 + 22 + 4);
    }

    #[test]
    fn the_next_scale_may_take_longest() {
        // P = 2, A = 4, h = 1; z needs no doubling but that of P.
        let z = Precision { bits: 24, fraction: 4, vertex_fraction: 4 };
        let plan =
            Machine { lanes: 1, subpixel_bits: 0, z, ..Machine::default() }.plan().expect("can be built");
        let s2 = |red| {
            let vertex = |x, y, red| plan.raw_vertex(x, y, &[100, red, 0, 0]);
            setup_clocks(&plan, &[vertex(2, 2, 0), vertex(3, 2, red), vertex(2, 3, 0)]).phase2
        };
        // p1 + p2, p1, p2, wait, gx: u(2) = 2; behind it d0, d1, wait, start: s(-2) = s(1) = 2.
        let (gx, behind) =
            (|i: u32, dbl: u32| 3 + 1 + (2 + i + dbl), |i: u32, dbl: u32| (2 + i + dbl) + 1 + 1 + 2);
        let color = |i| gx(i, 6) + behind(i, 6);
        // Red has 4^3, 4^4 or 4^5 times the area. Behind gx of z are 7 clocks, but the scales ask for 4 and their number.
        assert_eq!(s2(255), gx(0, 1) + 7 + color(3) + 2 * color(0) + 4);
        assert_eq!(s2(256), gx(0, 1) + 8 + color(4) + 2 * color(0) + 4);
        assert_eq!(s2(1024), gx(0, 1) + 9 + color(5) + 2 * color(0) + 4);
    }

    #[test]
    fn numbers_fit_from_minus_m_to_below_m() {
        let area = 1 << 18;
        for (z, i) in [
            ([0, area - 1, 0], 0),
            ([0, area, 0], 1),
            ([0, 0, area], 0),
            ([0, 0, area + 1], 1),
            ([0, 16 * area - 1, 0], 2),
            ([0, 16 * area, 0], 3),
            ([area, 2 * area - 1, 0], 1), // c0 - c2 = A
            ([area / 2, area - 1, 0], 0),
            ([area / 2, area, 0], 1), // c1 - c2 = A
            ([area / 2, 0, area], 0),
            ([area / 2, 0, area + 1], 1), // c1 - c2 = -A - 1
        ] {
            // On four lanes all wait for z, on one lane only it.
            for (lanes, all) in [(4, 53 + 4), (1, 4 * 53 + 4)] {
                let machine = Machine { lanes, ..Machine::default() };
                assert_eq!(clocks(&machine, HALF, z)[1], all + 2 * i, "{z:?}, {lanes} lanes");
            }
        }
        // The major edge right: dc1 = c0 - c1 may be A.
        let right = [[4, 2], [2, 2], [2, 4]];
        let s2 = |z| clocks(&Machine::default(), right, z)[1];
        assert_eq!(
            [[0, area - 2, 0], [0, area - 1, 0], [area, 0, area]].map(|z| s2(z) - s2([0; 3])),
            [0, 2, 2]
        );
        // Edges: DX = 512 px over DY of one line or two, P·DY = 256 or 512 px; DW - 1 = 22 bits.
        for (height, long) in [(1, 3 + 11), (2, 3 + 11), (3, 1)] {
            let s1 = clocks(&Machine::default(), [[2, 2], [2, 2 + height], [514, 2 + height]], [0; 3])[0];
            assert_eq!(s1, 18 - 1 + long, "{height} lines");
        }
    }

    #[test]
    fn textbook_by_hand() {
        let machine = Machine::preset("textbook").expect("a preset");
        // t = 1: DX, 17 doublings, DY, wait, u(1) = 1; 16 doublings and rounding. Three turns of one lane.
        let edge = 1 + 9 + 2 + 2 + 1 + 8 + 2;
        // gx: u(16) = 5 and 15 doublings, rounding; of each part DC, 16 doublings, wait, u(0) = 1, 15 doublings and rounding.
        let part = 1 + 8 + 1 + 1 + 8 + 2;
        let round = 3 + 1 + (5 + 8) + 2 + 2 * part;
        assert_eq!(clocks(&machine, [[2, 2], [6, 2], [2, 10]], [0; 3]), [1 + 3 * edge, 4 * round + 4]);
        // z = 64: dc2 = 64 < A = 128, but DC = 64 > P·DY = 32, in the part that has lines; 16 bits.
        let long = 3 + 8 - 1;
        assert_eq!(clocks(&machine, [[2, 2], [6, 2], [2, 10]], [0, 0, 64])[1], 4 * round + 4 + long);
    }

    #[test]
    fn culled_by_lines_columns_area_in_this_order() {
        let machine = Machine::default();
        let [above, left, both] = [[[2, -9], [4, -9], [2, -2]], [[-9, 2], [-2, 2], [-9, 4]], [[-9, -9]; 3]];
        for corners in [above, left, both] {
            assert_eq!(clocks(&machine, corners, [0; 3]), [2, 0], "{corners:?}");
        }
        assert_eq!(clocks(&machine, [[2, 2], [4, 4], [6, 6]], [0; 3]), [18, 0]);
        // Textbook fill has no cull by columns.
        let book = Machine::preset("textbook").expect("a preset");
        let [s1, s2] = clocks(&book, [[-9, 2], [-2, 2], [-9, 4]], [0; 3]);
        assert!(s1 > 2 && s2 > 0);
    }

    #[test]
    fn the_area_may_take_longest() {
        // No sub-pixel bits: P = 2, u(1) = 1 for every edge, 1 + 1 + 2 + 2 + 1 = 7 in all; dv2 = 960 has 10 bits.
        let whole = Machine { subpixel_bits: 0, ..Machine::default() };
        let s1 = |z| clocks(&whole, [[2, 0], [4, 0], [2, 480]], [0, z, 0])[0];
        assert_eq!(s1(0), 10 + 4);
        // 4 times 960; differences of 4^3 times as much fit in the fourth scale.
        assert_eq!([3839, 3840, 3840 << 6].map(s1), [14, 14 + 1, 14 + 4]);
    }

    #[test]
    fn longest_by_hand() {
        let longest = longest_setup(&Plan::default());
        // DW = 23, z of 28 bits at most 4^15 times as large as an area.
        let edges = 1 + 14 + 4 + 2 + 2 + 22; // the area and its scale: 22 + 4 + 15
        let channels = 3 + 1 + (22 + 15 + 9) + (24 + 15 + 9) + 1 + 1 + 23;
        assert_eq!(longest, SetupClocks { phase1: edges, phase2: channels + 4 });
    }
}
