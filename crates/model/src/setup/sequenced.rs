//! S and L: the words that the program of a sequenced SETUP executes for a triangle, counted without running it.
//!
//! Between branches and loops the words are those of the listing, once each; they are counted when a machine is made. What is
//! left for a triangle: the digits of the sums, how often a number is doubled, which numbers do not fit, which parts have lines.
//! A test runs the program itself beside this, word by word.
//!
//! Rules: `docs/machine.md`, section 2, "The sequencer".

mod listing;

use self::listing::{Block, Listing};
use super::edges::{Parts, Screen};
use super::sort::{Corner, Sorted};
use super::spent::SetupClocks;
use crate::tokens::Prim;
use edgewalk_machine::sequencer::word::{Act, Control, Drop};
use edgewalk_machine::sequencer::{Program, edges_are_beside, rounds};
use edgewalk_machine::{EdgeKind, Fill, Plan, Role};
use std::ops::Range;

/// Clocks from the word that loads g until its first skipped digit shows.
const SKIP_SHOWS: u32 = 3;

/// The channels that the lanes do side by side.
#[derive(Clone, Debug)]
struct Round {
    channels: Range<usize>,
    /// t + r - e, the largest of them.
    doublings: u32,
    /// b + e, the largest of them.
    bits: u32,
}

/// Words of a part's values in textbook fill.
#[derive(Clone, Copy, Debug)]
struct PartWords {
    /// Up to the first round, if the part has lines; the first of them is executed in any case.
    enter: u32,
    /// Of a round.
    round: Block,
    /// Of a round up to the test whether the differences fit.
    test: u32,
    scale: u32,
}

/// Behind the sums of gx.
#[derive(Clone, Copy, Debug)]
enum Values {
    /// Exact fill: the triangle is sheared before the rounds, and each round goes on with d0 and start.
    Sheared { shear: [Block; 3], d0: Block, start: Block, round_end: u32 },
    /// Textbook fill: words before the rounds, behind gx of a round, and those of the parts.
    Parts { before: u32, round_end: u32, parts: [PartWords; 2] },
}

/// The counts of a machine's program.
#[derive(Clone, Debug)]
pub(crate) struct ProgramClocks {
    /// log2 P.
    t: u32,
    /// F of slope edges, else 0.
    edge_fraction: u32,
    /// Digits of a factor behind its sign.
    digits: u32,
    beside: bool,
    no_lines: u32,
    no_columns: u32,
    /// Up to the area, by the test that finds a column; in textbook fill there is none.
    columns: [u32; 4],
    area: Block,
    no_area: u32,
    /// From the area to the edges; those of the test for an upper part, a lower one, and of the major edge.
    calls: [u32; 3],
    edge: Block,
    slow: Block,
    /// Up to the test whether the differences fit.
    differences: Block,
    scale: u32,
    values: Values,
    /// Behind the rounds, up to the word that waits for room.
    room: u32,
    /// L.
    load: u32,
    /// In the order of the program: the last channels first.
    rounds: Vec<Round>,
}

impl ProgramClocks {
    pub(super) fn new(plan: &Plan) -> ProgramClocks {
        let listing = Listing(Program::of(plan));
        let label = |name: &str| listing.label(name);
        let at = |name: &str| listing.label(name) as u16;
        let lanes = plan.lanes as usize;
        let beside = edges_are_beside(plan);
        let all = plan.channels();
        let most =
            |channels: &Range<usize>, of: &dyn Fn(usize) -> u32| channels.clone().map(of).max().unwrap_or(0);
        let t = plan.widths().center_fraction;
        let rounds = (0..rounds(plan)).rev().map(|round| {
            let channels = round * lanes..all.len().min((round + 1) * lanes);
            let doublings = most(&channels, &|i| t + all[i].fraction - all[i].vertex_fraction);
            let bits = most(&channels, &|i| all[i].vertex_bits());
            Round { channels, doublings, bits }
        });
        let rounds: Vec<Round> = rounds.collect();
        let textbook = plan.fill == Fill::Textbook;
        let area_test = listing.branch(Control::Negative(at("noarea")));
        let (columns, no_columns) = if textbook {
            ([label("area") as u32; 4], 0)
        } else {
            let dropped = listing.find(0, |word| word.act == Some(Act::Drop(Drop::Columns)));
            (listing.columns(), dropped as u32 + 1)
        };
        let call = |from| listing.find(from, |word| word.control == Control::Call(at("edge")));
        let (calls, last) = if beside {
            let call = call(area_test);
            ([0, 0, (call - area_test) as u32], call)
        } else {
            let upper = listing.branch(Control::NoUpper(at("minor2")));
            let lower = listing.branch(Control::NoLower(at("major")));
            let last = call(label("major"));
            let words = [upper - area_test, lower + 1 - label("minor2"), last + 1 - label("major")];
            (words.map(|words| words as u32), last)
        };
        let returns = listing.find(label("edge"), |word| word.control == Control::Return);
        let unfit_edge = listing.branch(Control::Unfit(at("slow")));
        let unfit = listing.branch(Control::Unfit(at("scale")));
        let room = listing.branch(Control::Room);
        let scaled = listing.find(label("scale"), |word| word.act == Some(Act::Scale));
        let fits = listing.find(label("slow"), |word| word.control == Control::Goto(at("fits")));
        // Of a sum by zeros and digits only what stands before and behind it counts here.
        let looped = |from: usize, sum: &str, behind: &str, to: usize| {
            let block = listing.block(from..label(sum));
            Block { words: block.words + (to - label(behind)) as u32, ..block }
        };
        debug_assert!(unfit_edge < returns);
        let again = listing.branch(Control::Rounds(at("round")));
        let (values, behind) = if textbook {
            let part = |from: usize, rounds: &str, sum: &str, behind: &str, scale: &str| {
                let again = listing.branch(Control::Rounds(at(rounds)));
                let unfit = listing.branch(Control::Unfit(at(scale)));
                let scaled = listing.find(label(scale), |word| word.act == Some(Act::Scale));
                PartWords {
                    enter: (label(rounds) - from) as u32,
                    round: looped(label(rounds), sum, behind, again + 1),
                    test: (unfit + 1 - label(rounds)) as u32,
                    scale: (scaled + 1 - label(scale)) as u32,
                }
            };
            let below = label("below");
            let parts = [
                part(again + 1, "parta", "pa", "pa1", "scalea"),
                part(below, "partb", "pb", "pb1", "scaleb"),
            ];
            let before = (label("round") - last - 1) as u32;
            let round_end = (again + 1 - label("gx1")) as u32;
            (Values::Parts { before, round_end, parts }, listing.branch(Control::Rounds(at("partb"))))
        } else {
            let d0 = listing.block(label("gx1")..label("d0"));
            let start = listing.block(label("d01")..label("st"));
            let round_end = (again + 1 - label("st1")) as u32;
            (Values::Sheared { shear: listing.shear(last + 1), d0, start, round_end }, again)
        };
        ProgramClocks {
            t,
            edge_fraction: if plan.edge_kind == EdgeKind::Slope { plan.edge_fraction } else { 0 },
            digits: plan.widths().center + 1,
            beside,
            no_lines: listing.branch(Control::Negative(at("nolines"))) as u32 + 2,
            no_columns,
            columns,
            area: listing.block(label("area")..area_test + 1),
            no_area: 1,
            calls,
            edge: looped(label("edge"), "ed", "ed1", returns + 1),
            slow: looped(label("slow"), "sl", "sl1", fits + 1),
            differences: listing.block(label("round")..unfit + 1),
            scale: (scaled + 1 - label("scale")) as u32,
            values,
            room: (room - behind) as u32,
            load: listing.load(room, if beside { 1 } else { 3 }, rounds.len() as u32),
            rounds,
        }
    }

    /// S and L of a triangle on this screen; `prim` has its edges, unless it is culled.
    pub(crate) fn clocks<const C: usize>(
        &self,
        screen: Screen,
        sorted: &Sorted<C>,
        parts: &Parts,
        prim: &Prim<C>,
    ) -> SetupClocks {
        let culled = |phase1| SetupClocks { phase1, phase2: 0 };
        if parts.lines == [0, 0] {
            return culled(self.no_lines);
        }
        let Some(columns) = self.columns(screen, sorted) else { return culled(self.no_columns) };
        let [a, b, c] = &sorted.corners;
        let (du1, dv1, du2, dv2) = (b.u - a.u, b.v - a.v, c.u - a.u, c.v - a.v);
        let (area, along) = (sorted.area(), [dv2, dv1]);
        let front = columns + self.count(self.area, along, 0) + length(along) - 1;
        if area == 0 {
            return culled(front + self.no_area);
        }
        let edges = self.edges(sorted, parts);
        let mut clocks = front + edges + self.room;
        let side = if area < 0 { -1 } else { 1 };
        let (mut modulus, mut scale) = (area.abs(), 0);
        for round in &self.rounds {
            let fits = |modulus: i64| {
                round.channels.clone().all(|i| {
                    let [a, b, c] = [a.values[i], b.values[i], c.values[i]];
                    [b - a, a - c, b - c].iter().all(|d| (-modulus..modulus).contains(&(side * d)))
                })
            };
            let differences = self.count(self.differences, along, 0);
            while !fits(modulus) {
                modulus <<= 3;
                scale += 3;
                clocks += differences + self.scale;
            }
            let doubled = round.doublings + scale - 1;
            clocks += differences + sum(along);
            clocks += match &self.values {
                Values::Sheared { d0, start, round_end, .. } => {
                    let q = i64::from(prim.major.q);
                    let h = (i64::from(prim.line) << self.t) - a.v;
                    let x = i64::from(prim.major.c) - i64::from(prim.major_right);
                    let down = [q * dv2 - du2, q * dv1 - du1];
                    let across = [(x << self.t) - a.u - q * h, h];
                    let d0 = self.count(*d0, down, doubled) + sum(down);
                    d0 + self.count(*start, across, doubled) + sum(across) + round_end
                }
                Values::Parts { round_end, .. } => round_end + doubled,
            };
        }
        clocks += match &self.values {
            Values::Sheared { shear, .. } => {
                let q = [i64::from(prim.major.q), 0];
                shear.iter().map(|block| self.count(*block, q, 0) + length(q) - 1).sum::<u32>()
            }
            Values::Parts { before, parts: words, .. } => {
                let of_parts = words.iter().enumerate();
                before + of_parts.map(|(part, words)| self.part(words, sorted, parts, part)).sum::<u32>()
            }
        };
        SetupClocks { phase1: clocks, phase2: self.load }
    }

    /// The values of a part in textbook fill.
    fn part<const C: usize>(&self, words: &PartWords, sorted: &Sorted<C>, parts: &Parts, part: usize) -> u32 {
        if parts.lines[part] == 0 {
            return 1;
        }
        let (from, to) = sorted.left_edge(part);
        let down = [(parts.first[part] << self.t) - from.v, 0];
        let (mut modulus, mut scale) = ((to.v - from.v) << self.t, 0);
        let mut clocks = words.enter;
        for round in &self.rounds {
            let fits = |modulus: i64| {
                let mut differences = round.channels.clone().map(|i| to.values[i] - from.values[i]);
                differences.all(|d| (-modulus..modulus).contains(&d))
            };
            while !fits(modulus) {
                modulus <<= 3;
                scale += 3;
                clocks += words.test + words.scale;
            }
            let doubled = round.doublings + scale - 1;
            clocks += self.count(words.round, down, doubled) + sum(down) + doubled;
        }
        clocks
    }

    /// The words up to the area; none if there is no column.
    fn columns<const C: usize>(&self, screen: Screen, sorted: &Sorted<C>) -> Option<u32> {
        if matches!(self.values, Values::Parts { .. }) {
            return Some(self.columns[0]);
        }
        let [i0, i1, i2] = screen.columns(self.t, sorted);
        let tests = [i2 < i0, i1 < i0, i0 < i2, i0 < i1 || sorted.role != Role::Triangle];
        tests.iter().position(|found| *found).map(|test| self.columns[test])
    }

    /// The edges, with what stands between them.
    fn edges<const C: usize>(&self, sorted: &Sorted<C>, parts: &Parts) -> u32 {
        let [a, b, c] = &sorted.corners;
        let [upper, lower] = parts.lines.map(|lines| lines > 0);
        let major = (a, c, parts.drawn());
        let minors = [(a, b, parts.first[0]), (b, c, parts.first[1])];
        let walked = [upper.then_some(minors[0]), lower.then_some(minors[1])];
        let [before, between, last] = self.calls;
        if self.beside {
            let all: Vec<_> = std::iter::once(major).chain(walked.into_iter().flatten()).collect();
            return last + self.edge(&all);
        }
        let minor = |edge: Option<_>| edge.map_or(0, |edge| 1 + self.edge(&[edge]));
        before + minor(walked[0]) + between + minor(walked[1]) + last + self.edge(&[major])
    }

    /// Edges side by side, each from its upper end to its lower, and its first line.
    fn edge<const C: usize>(&self, edges: &[(&Corner<C>, &Corner<C>, i64)]) -> u32 {
        let (p, o) = (1 << self.t, i64::from(matches!(self.values, Values::Parts { .. })));
        let (mut slow, mut factors, mut differences) = (false, [0, 0], [0, 0]);
        let mut signs = 0;
        for (from, to, line) in edges {
            let (dx, modulus) = (to.u - from.u, (to.v - from.v) << self.t);
            slow |= !(-modulus..modulus).contains(&dx);
            factors[0] |= (from.u + o) & (p - 1);
            factors[1] |= (line << self.t) - from.v;
            differences[0] |= dx;
            signs |= magnitude(dx);
        }
        let mut clocks = self.count(self.edge, factors, self.t + self.edge_fraction - 1) + sum(factors);
        clocks += 2 * (self.t - 1) + self.edge_fraction.saturating_sub(1);
        if slow {
            // The digits of all of them, and as many as the longest has.
            let digits = bits(signs);
            let nonzero = (differences[0] as u64 & (u64::MAX >> (64 - digits))).count_ones();
            clocks += self.words(self.slow, digits, 0) + digits + 2 * nonzero;
        }
        clocks
    }

    /// The words of a block before whose wait the factors of its sum are loaded, and a word is executed so many times more.
    fn count(&self, block: Block, factors: [i64; 2], more: u32) -> u32 {
        self.words(block, length(factors), more)
    }

    fn words(&self, block: Block, digits: u32, more: u32) -> u32 {
        let skipped = self.digits - digits;
        let shows = SKIP_SHOWS + skipped / 4 + skipped % 4;
        block.words + more + shows.saturating_sub(block.wait + more)
    }

    /// At least S and L of any triangle.
    pub(super) fn longest(&self) -> SetupClocks {
        let block = |block: Block, more: u32| self.words(block, self.digits, more);
        let sum = 3 * self.digits;
        let doubled = self.t + self.edge_fraction - 1;
        let edge = block(self.edge, doubled) + 2 * sum + 2 * doubled + block(self.slow, 0);
        let edges = self.calls.iter().sum::<u32>() + if self.beside { edge } else { 2 + 3 * edge };
        let single = |of: &Block| block(*of, 0) + self.digits - 1;
        let front = self.columns[3] + single(&self.area) + edges;
        let scales = self.rounds.iter().map(|round| round.bits / 3 + 1).max().unwrap_or(0);
        let rounds = self.rounds.iter().map(|round| {
            let doubled = round.doublings + 3 * scales - 1;
            let values = match &self.values {
                Values::Sheared { d0, start, round_end, .. } => {
                    block(*d0, doubled) + block(*start, doubled) + 2 * sum + round_end
                }
                Values::Parts { round_end, parts, .. } => {
                    let part = |words: &PartWords| block(words.round, doubled) + sum + doubled;
                    round_end + doubled + parts.iter().map(part).sum::<u32>()
                }
            };
            block(self.differences, 0) + sum + values
        });
        let once = match &self.values {
            Values::Sheared { shear, .. } => shear.iter().map(single).sum::<u32>(),
            Values::Parts { before, parts, .. } => {
                let part = |words: &PartWords| words.enter + scales * (words.test + words.scale);
                before + parts.iter().map(part).sum::<u32>()
            }
        };
        let scaled = scales * (block(self.differences, 0) + self.scale) + once;
        let phase1 = (front + rounds.sum::<u32>() + scaled + self.room).max(self.no_columns);
        SetupClocks { phase1, phase2: self.load }
    }
}

/// n or -n - 1: what says how many bits it has.
#[inline(always)]
fn magnitude(n: i64) -> i64 {
    n ^ (n >> 63)
}

/// Bits of a number >= 0, at least 1.
#[inline(always)]
fn bits(n: i64) -> u32 {
    64 - (n | 1).leading_zeros()
}

/// Digits of the longer factor behind its sign.
#[inline(always)]
fn length(factors: [i64; 2]) -> u32 {
    bits(magnitude(factors[0]) | magnitude(factors[1]))
}

/// Clocks of a sum: a digit of both factors takes three, or one if both are 0.
#[inline(always)]
fn sum(factors: [i64; 2]) -> u32 {
    let digits = length(factors);
    let any = (factors[0] | factors[1]) as u64 & (u64::MAX >> (64 - digits));
    digits + 2 * any.count_ones()
}
