//! What the lanes of SETUP do, job after job, and the clocks of each: for a recording, as the model itself computes a
//! triangle at once and only counts its clocks.
//!
//! Rules: `docs/machine.md`, section 2, "Pairs"; written from there and not from `clocks`, whose sums a test holds against these.

use super::edges::Parts;
use super::sort::Sorted;
use crate::tokens::Prim;
use edgewalk_machine::{EdgeKind, Fill, Plan, Role};

/// What the lanes do in a clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Job {
    Rest,
    Look,
    Subtract,
    TakeDx,
    Slope,
    TakeDy,
    WaitDy,
    SumE,
    RoundX,
    Area,
    TakeBoth,
    TakeP1,
    TakeP2,
    WaitPairs,
    Gx,
    RoundGx,
    D0,
    D1,
    WaitSteps,
    Start,
    TakeDc,
    D,
    WaitD,
    SumH,
    DoubleH,
    RoundStart,
    Behind,
    Program,
}

impl Job {
    /// Names of the jobs, in their order.
    pub const NAMES: [&'static str; 28] = [
        "-",
        "look",
        "subtract",
        "take DX",
        "slope",
        "take DY",
        "wait",
        "sum E",
        "round X",
        "area",
        "take p1+p2",
        "take p1",
        "take p2",
        "wait",
        "gx",
        "round gx",
        "d0",
        "d1",
        "wait",
        "start",
        "take DC",
        "d",
        "wait",
        "sum h",
        "double",
        "round",
        "behind",
        "program",
    ];

    /// What each does, in a sentence.
    pub const SAYS: [&'static str; 28] = [
        "",
        "looks whether any line and column of the screen lies in the triangle",
        "subtracts the vertices: the lanes get DX and DY of the edges",
        "every lane takes in DX of its edge as whole + rest / M, M = P DY",
        "doubles DX / M until it is DX / DY: whole part q, rest f",
        "takes in DY and adds DX: the sum that follows needs both and their sum",
        "waits until the pairs stand",
        "sums up E, the edge at its first line, a bit of both factors a clock; given out with its whole part: the column C, and R from the rest",
        "doubles and rounds: the column with its fraction bits",
        "waits for the area, and for its scale: fourfold until the differences of values fit",
        "every lane takes in dc1 - dc2 of its channel as whole + rest / M, M the area, scaled: p1 + p2",
        "takes in dc1: p1",
        "takes in -dc2: p2",
        "waits until the pairs stand",
        "sums up gx = dv2 p1 + dv1 p2, a bit of both factors a clock, and doubles it: the step to the right",
        "rounds gx, while M still is the area",
        "sums up d0, the step along the major edge without a carry, the same way: the factors are columns, less q a line",
        "adds gx: d1, the step with a carry; with POLY only start needs it",
        "waits until the steps stand",
        "sums up start: from the top vertex the lines down by d0, and what is left of the way to the first pixel by gx; given out with the top vertex' value and the half that rounds",
        "takes in the difference of the left edge's values; M is now P times the height of that edge",
        "doubles it: d, the step of a line",
        "waits until the pair stands",
        "sums up h DC / M: from the left edge's upper end to its first line",
        "doubles it",
        "rounds, with the upper end's value: start",
        "the last results come out of the lanes",
        "executes its program, a word a clock: edges, area, then the channels",
    ];
}

/// The jobs of both phases.
pub(super) struct Schedule(pub [Vec<(Job, u32)>; 2]);

impl Schedule {
    /// Clocks of a phase.
    pub fn clocks(&self, phase: usize) -> u32 {
        self.0[phase].iter().map(|(_, clocks)| clocks).sum()
    }

    /// The job of a phase in this clock of it, from 0; which clock of the job, from 1; and how many the job has.
    pub fn at(&self, phase: usize, clock: u32) -> (Job, u32, u32) {
        let mut left = clock;
        for (job, clocks) in &self.0[phase] {
            if left < *clocks {
                return (*job, left + 1, *clocks);
            }
            left -= clocks;
        }
        (Job::Rest, 0, 0)
    }
}

/// The jobs of a triangle; `prim` has its edges, unless it is culled before them.
pub(super) fn schedule<const C: usize>(
    plan: &Plan,
    sorted: &Sorted<C>,
    parts: &Parts,
    seen_at_once: bool,
    prim: &Prim<C>,
) -> Schedule {
    if seen_at_once {
        return Schedule([vec![(Job::Look, 2)], Vec::new()]);
    }
    let work = Work { plan, sorted, parts, prim, t: plan.widths().center_fraction };
    Schedule([work.edges(), if work.has_channels() { work.channels() } else { Vec::new() }])
}

struct Work<'a, const C: usize> {
    plan: &'a Plan,
    sorted: &'a Sorted<C>,
    parts: &'a Parts,
    prim: &'a Prim<C>,
    /// log2 P.
    t: u32,
}

impl<const C: usize> Work<'_, C> {
    fn edges(&self) -> Vec<(Job, u32)> {
        let plan = self.plan;
        let [a, b, c] = &self.sorted.corners;
        let [n1, n2] = self.parts.lines;
        let [j0, j1] = self.parts.first;
        let [major, upper, lower] = self.sorted.counts;
        let edges = [
            (a, c, self.parts.drawn(), major && n1 + n2 > 0, major),
            (a, b, j0, upper && n1 > 0, upper),
            (b, c, j1, lower && n2 > 0, lower),
        ];
        let o = i64::from(plan.fill == Fill::Textbook);
        let (f, slope) = match plan.edge_kind {
            EdgeKind::Exact => (0, false),
            EdgeKind::Slope => (plan.edge_fraction, true),
        };
        let mut jobs = vec![(Job::Subtract, 1)];
        for round in edges.chunks(plan.lanes as usize) {
            if round.iter().all(|(.., counts)| !counts) {
                continue; // only with POLY: elsewhere each edge counts
            }
            let walked = || round.iter().filter(|(.., walked, _)| *walked);
            let fits = walked().all(|(from, to, ..)| is_within(to.u - from.u, (to.v - from.v) << self.t));
            let factors = walked()
                .flat_map(|(from, _, j, ..)| [(from.u + o).rem_euclid(1 << self.t), (j << self.t) - from.v]);
            let take = if fits { 1 } else { 3 + (plan.widths().difference - 1).div_ceil(2) };
            jobs.extend([(Job::TakeDx, take), (Job::Slope, (self.t + f).div_ceil(2))]);
            jobs.extend([(Job::TakeDy, 2), (Job::WaitDy, 2), (Job::SumE, bits(factors))]);
            if slope {
                jobs.push((Job::RoundX, f.div_ceil(2) + 2));
            }
        }
        let so_far: u32 = jobs.iter().map(|(_, clocks)| clocks).sum();
        let area = bits([c.v - a.v]).max(2) + 4 + self.scale(0);
        jobs.extend((area > so_far).then(|| (Job::Area, area - so_far)));
        if plan.polygon.is_there() && !self.has_channels() && !self.is_culled() {
            jobs.push((Job::Behind, 4));
        }
        jobs
    }

    /// The token has an area, and a plane of its own.
    fn has_channels(&self) -> bool {
        self.sorted.area() != 0 && self.sorted.role.ends()
    }

    /// A triangle or line without area.
    fn is_culled(&self) -> bool {
        self.sorted.role.ends() && !matches!(self.sorted.role, Role::Plane(_))
    }

    fn channels(&self) -> Vec<(Job, u32)> {
        let plan = self.plan;
        let [a, b, c] = &self.sorted.corners;
        let (dv1, dv2) = (b.v - a.v, c.v - a.v);
        let mut jobs = Vec::new();
        let planes: Vec<_> = plan.planes().collect();
        for (round, in_round) in planes.chunks(plan.lanes as usize).enumerate() {
            let places = || in_round.iter().map(|(place, _)| *place);
            let channels: Vec<_> = in_round.iter().map(|(_, channel)| *channel).collect();
            let widest = channels.iter().map(|channel| channel.bits + channel.vertex_fraction).max();
            let long = 3 + widest.unwrap_or(0).div_ceil(2);
            let take = |mut all: Box<dyn Iterator<Item = (i64, i64)>>| {
                if all.all(|(d, m)| is_within(d, m)) { 1 } else { long }
            };
            let dbl = |whole: u32| {
                let each =
                    channels.iter().map(|c| (whole * self.t + c.fraction - c.vertex_fraction).div_ceil(2));
                each.max().unwrap_or(0)
            };
            let scale = self.scale(round);
            jobs.extend([(Job::TakeBoth, 1), (Job::TakeP1, 1), (Job::TakeP2, 1), (Job::WaitPairs, 1)]);
            jobs.push((Job::Gx, bits([dv2, dv1]) + scale + dbl(1)));
            let behind_gx = jobs.len();
            match plan.fill {
                _ if plan.polygon.is_there() => {
                    let window = self.sorted.window;
                    let [x, y] = [window.x0, window.y0].map(|place| i64::from(place) << self.t);
                    jobs.extend([
                        (Job::D0, signed_bits([a.u - c.u, a.u - b.u]) + scale + dbl(1)),
                        (Job::D1, 1),
                        (Job::WaitSteps, 2),
                        (Job::Start, signed_bits([x - a.u, y - a.v])),
                    ]);
                }
                Fill::Exact => {
                    let sheared = |x: i64, y: i64| x - i64::from(self.prim.major.q) * y;
                    let down = [-sheared(c.u - a.u, dv2), -sheared(b.u - a.u, dv1)];
                    let px = i64::from(self.prim.major.c) - i64::from(self.prim.major_right);
                    let h = (i64::from(self.prim.line) << self.t) - a.v;
                    jobs.extend([
                        (Job::D0, signed_bits(down) + scale + dbl(1)),
                        (Job::D1, 1),
                        (Job::WaitSteps, 1),
                        (Job::Start, signed_bits([sheared((px << self.t) - a.u, h), h])),
                    ]);
                }
                Fill::Textbook => {
                    jobs.push((Job::RoundGx, 2));
                    for part in 0..2 {
                        let (from, to) = self.sorted.left_edge(part);
                        let drawn = self.parts.lines[part] > 0;
                        let m = (to.v - from.v) << self.t;
                        let numbers: Vec<(i64, i64)> =
                            places().map(|i| (to.values[i] - from.values[i], m)).collect();
                        let taken = if drawn { take(Box::new(numbers.into_iter())) } else { 1 };
                        let h = if drawn { (self.parts.first[part] << self.t) - from.v } else { 0 };
                        jobs.extend([
                            (Job::TakeDc, taken),
                            (Job::D, dbl(2)),
                            (Job::WaitD, 1),
                            (Job::SumH, bits([h])),
                            (Job::DoubleH, dbl(1)),
                            (Job::RoundStart, 2),
                        ]);
                    }
                }
            }
            if (round + 1) * (plan.lanes as usize) < planes.len() {
                let taken: u32 = jobs[behind_gx..].iter().map(|(_, clocks)| clocks).sum();
                let scaled = 4 + self.scale(round + 1);
                jobs.extend((scaled > taken).then(|| (Job::Area, scaled - taken)));
            }
        }
        jobs.push((Job::Behind, 4));
        jobs
    }

    /// How often the area is fourfold for a round of channels.
    fn scale(&self, round: usize) -> u32 {
        let lanes = self.plan.lanes as usize;
        let [a, b, c] = &self.sorted.corners;
        let places = self.plan.planes().map(|(place, _)| place).skip(round * lanes).take(lanes);
        let ends = [(b, a), (a, c), (b, c)];
        let differences = places.flat_map(|i| ends.map(|(to, from)| to.values[i] - from.values[i]));
        let longest = differences.fold(0, |all, d| all | if d < 0 { -d - 1 } else { d });
        let (area, right) = (self.sorted.area().abs(), i64::from(self.sorted.area() < 0));
        if area == 0 { 0 } else { (0..).find(|i| longest + right < area << (2 * i)).unwrap_or(0) }
    }
}

/// -M <= D < M.
fn is_within(d: i64, m: i64) -> bool {
    (-m..m).contains(&d)
}

/// u: bits of the longest of some numbers >= 0, at least 1.
fn bits(numbers: impl IntoIterator<Item = i64>) -> u32 {
    let longest = numbers.into_iter().map(|n| i64::BITS - n.leading_zeros()).max();
    longest.unwrap_or(0).max(1)
}

/// s: in two's complement, at least 2.
fn signed_bits(numbers: impl IntoIterator<Item = i64>) -> u32 {
    let of =
        |n: i64| if n < 0 { i64::BITS - (!n).leading_zeros() + 1 } else { i64::BITS - n.leading_zeros() + 1 };
    numbers.into_iter().map(of).max().unwrap_or(0).max(2)
}
