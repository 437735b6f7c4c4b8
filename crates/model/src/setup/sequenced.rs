//! S and L: the words that the program of a sequenced SETUP executes for a triangle, counted without running it.
//!
//! Between branches and loops the words are those of the listing, once each; they are counted when a machine is made. What is
//! left for a triangle: the digits of the sums, how often a number is doubled, which numbers do not fit, which parts have lines.
//! A test runs the program itself beside this, word by word.
//!
//! Rules: `docs/machine.md`, section 2, "The sequencer".

use super::edges::{Parts, Screen};
use super::sort::{Corner, Sorted};
use super::spent::SetupClocks;
use crate::tokens::Prim;
use edgewalk_machine::sequencer::word::{Act, Control, Drop, Factor, Word};
use edgewalk_machine::sequencer::{Program, edges_are_beside, rounds};
use edgewalk_machine::{Plan, Role};
use std::ops::Range;

/// Clocks from the word that loads g until its first skipped digit shows.
const SKIP_SHOWS: u32 = 3;

/// Words of the listing that stand behind one another, and how far the word that waits for the last skipped digit stands behind the
/// one that loads g.
#[derive(Clone, Copy, Debug)]
struct Block {
    words: u32,
    wait: u32,
}

/// The channels that the lanes do side by side.
#[derive(Clone, Debug)]
struct Round {
    channels: Range<usize>,
    /// t + r - e, the largest of them.
    doublings: u32,
    /// b + e, the largest of them.
    bits: u32,
}

/// The counts of a machine's program.
#[derive(Clone, Debug)]
pub(crate) struct ProgramClocks {
    /// log2 P.
    t: u32,
    /// Digits of a factor behind its sign.
    digits: u32,
    beside: bool,
    no_lines: u32,
    no_columns: u32,
    /// Up to the area, by the test that finds a column.
    columns: [u32; 4],
    area: Block,
    no_area: u32,
    /// From the area to the edges; those of the test for an upper part, a lower one, and of the major edge.
    calls: [u32; 3],
    edge: Block,
    slow: Block,
    shear: [Block; 3],
    /// Up to the test whether the differences fit.
    differences: Block,
    scale: u32,
    d0: Block,
    start: Block,
    /// Behind the sum of start.
    round_end: u32,
    /// Behind the rounds, up to the word that waits for room.
    room: u32,
    /// L.
    load: u32,
    /// In the order of the program: the last channels first.
    rounds: Vec<Round>,
}

/// Finds places in a program.
struct Listing(Program);

impl Listing {
    fn label(&self, name: &str) -> usize {
        let place = self.0.labels().find(|(label, _)| *label == name).map(|(_, place)| place);
        place.expect("the listing has the labels of its sums and branches").into()
    }

    /// The first word from a place on of which this holds.
    fn find(&self, from: usize, is: impl Fn(&Word) -> bool) -> usize {
        let found = self.0.words[from..].iter().position(is);
        from + found.expect("the listing has a word for each branch")
    }

    fn branch(&self, control: Control) -> usize {
        self.find(0, |word| word.control == control)
    }

    /// Words behind the one that waits for room: two loops, over edges and rounds, and what stands between and behind them.
    fn load(&self, room: usize, edges: u32, rounds: u32) -> u32 {
        let done = self.find(room, |word| word.act == Some(Act::Done));
        let length = |label: &str| {
            let first = self.label(label);
            (self.branch(Control::Rounds(first as u16)) + 1 - first) as u32
        };
        (done - room) as u32 + (edges - 1) * length("edges") + (rounds - 1) * length("given")
    }

    fn block(&self, places: Range<usize>) -> Block {
        let loads_g = |word: &Word| word.factor.is_some_and(|(factor, _)| factor == Factor::G);
        let words = places.len() as u32;
        let wait = self.find(places.start, |word| word.control == Control::Settle);
        let load = self.0.words[places.start..wait].iter().rposition(loads_g);
        let load = places.start + load.expect("a sum loads its factors before it waits for their digits");
        Block { words, wait: (wait - load) as u32 }
    }
}

impl ProgramClocks {
    pub(super) fn new(plan: &Plan) -> ProgramClocks {
        let listing = Listing(Program::of(plan));
        let label = |name: &str| listing.label(name);
        let at = |name| listing.label(name) as u16;
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
        let drops = |drop| listing.find(0, |word| word.act == Some(Act::Drop(drop)));
        let area_test = listing.branch(Control::Negative(at("noarea")));
        let mut columns = [0; 4];
        let mut place = 0;
        for exit in &mut columns {
            place = listing.find(place, |word| word.control == Control::Negative(at("area"))) + 1;
            *exit = place as u32;
        }
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
        let sums: Vec<usize> = (last + 1..label("round"))
            .filter(|place| listing.0.words[*place].control == Control::Digits)
            .map(|place| place + 1)
            .collect();
        let shear =
            [last + 1..sums[0], sums[0]..sums[1], sums[1]..sums[2]].map(|places| listing.block(places));
        let tail = (label("round") - sums[2]) as u32;
        let returns = listing.find(label("edge"), |word| word.control == Control::Return);
        let unfit_edge = listing.branch(Control::Unfit(at("slow")));
        let unfit = listing.branch(Control::Unfit(at("scale")));
        let again = listing.branch(Control::Rounds(at("round")));
        let room = listing.branch(Control::Room);
        let scaled = listing.find(label("scale"), |word| word.act == Some(Act::Scale));
        let fits = listing.find(label("slow"), |word| word.control == Control::Goto(at("fits")));
        // Of a sum by zeros and digits only what stands before and behind it counts here.
        let looped = |from: usize, sum: &str, behind: &str, to: usize| {
            let block = listing.block(from..label(sum));
            Block { words: block.words + (to - label(behind)) as u32, ..block }
        };
        debug_assert!(unfit_edge < returns);
        ProgramClocks {
            t,
            digits: plan.widths().center + 1,
            beside,
            no_lines: listing.branch(Control::Negative(at("nolines"))) as u32 + 2,
            no_columns: drops(Drop::Columns) as u32 + 1,
            columns,
            area: listing.block(label("area")..area_test + 1),
            no_area: 1,
            calls,
            edge: looped(label("edge"), "ed", "ed1", returns + 1),
            slow: looped(label("slow"), "sl", "sl1", fits + 1),
            shear: [shear[0], shear[1], Block { words: shear[2].words + tail, ..shear[2] }],
            differences: listing.block(label("round")..unfit + 1),
            scale: (scaled + 1 - label("scale")) as u32,
            d0: listing.block(label("gx1")..label("d0")),
            start: listing.block(label("d01")..label("st")),
            round_end: (again + 1 - label("st1")) as u32,
            room: (room - again) as u32,
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
        let q = i64::from(prim.major.q);
        let h = (i64::from(prim.line) << self.t) - a.v;
        let of_q = |block: &Block| self.count(*block, [q, 0], 0) + length([q, 0]) - 1;
        let shear: u32 = self.shear.iter().map(of_q).sum();
        let x = i64::from(prim.major.c) - i64::from(prim.major_right);
        let down = [q * dv2 - du2, q * dv1 - du1];
        let across = [(x << self.t) - a.u - q * h, h];
        let mut clocks = front + edges + shear + self.room;
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
            clocks += self.count(self.d0, down, doubled) + sum(down);
            clocks += self.count(self.start, across, doubled) + sum(across) + self.round_end;
        }
        SetupClocks { phase1: clocks, phase2: self.load }
    }

    /// The words up to the area; none if there is no column.
    fn columns<const C: usize>(&self, screen: Screen, sorted: &Sorted<C>) -> Option<u32> {
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
        let p = 1 << self.t;
        let (mut slow, mut factors, mut differences) = (false, [0, 0], [0, 0]);
        let mut signs = 0;
        for (from, to, line) in edges {
            let (dx, modulus) = (to.u - from.u, (to.v - from.v) << self.t);
            slow |= !(-modulus..modulus).contains(&dx);
            factors[0] |= from.u & (p - 1);
            factors[1] |= (line << self.t) - from.v;
            differences[0] |= dx;
            signs |= magnitude(dx);
        }
        let mut clocks = self.count(self.edge, factors, self.t - 1) + sum(factors) + 2 * (self.t - 1);
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
        let edge = block(self.edge, self.t - 1) + sum + 2 * (self.t - 1) + block(self.slow, 0) + sum;
        let edges = self.calls.iter().sum::<u32>() + if self.beside { edge } else { 2 + 3 * edge };
        let single = |of: &Block| block(*of, 0) + self.digits - 1;
        let front = self.columns[3] + single(&self.area) + edges + self.shear.iter().map(single).sum::<u32>();
        let scales = self.rounds.iter().map(|round| round.bits / 3 + 1).max().unwrap_or(0);
        let rounds = self.rounds.iter().map(|round| {
            let doubled = round.doublings + 3 * scales - 1;
            let sums = block(self.d0, doubled) + block(self.start, doubled) + 3 * sum;
            block(self.differences, 0) + sums + self.round_end
        });
        let scaled = scales * (block(self.differences, 0) + self.scale);
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
