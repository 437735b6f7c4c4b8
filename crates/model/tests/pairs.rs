//! SETUP by pairs, step by step as `docs/machine.md` describes its lanes, against what the model gives by closed
//! formulae: every field of every prim, and the clocks that the steps took.

mod lane;

use crate::common::{Triangle, any_triangle, random_machine};
use edgewalk_machine::{Channel, EdgeKind, Fill, MAX_CHANNELS, Machine, Plan};
use edgewalk_model::setup::Setup;
use edgewalk_model::tokens::{EdgeWalk, Prim, sign_extend};
use edgewalk_model::{Culled, Events, SetupClocks, longest_setup, setup_clocks};
use lane::{Lane, Pair, over_bits, s, u};
use rand::{SeedableRng, rngs::StdRng};
use std::array::from_fn;

/// What all lanes of a round took, as they do the same steps.
fn all_equal<T: PartialEq + std::fmt::Debug>(mut taken: impl Iterator<Item = T>) -> T {
    let first = taken.next().expect("a lane");
    taken.for_each(|other| assert_eq!(other, first, "lanes of a round"));
    first
}

/// A vertex in centre coordinates with its values.
#[derive(Clone, Copy)]
struct Corner {
    u: i128,
    v: i128,
    values: [i128; MAX_CHANNELS],
}

/// A triangle as SETUP has sorted it.
struct Work<'a> {
    plan: &'a Plan,
    t: u32,
    /// The whole number that textbook fill adds.
    o: i128,
    corners: [Corner; 3],
    area: i128,
    first: [i128; 2],
    lines: [i128; 2],
}

/// One edge as the lanes take it: not walked, it asks for nothing.
struct Task {
    a: Corner,
    b: Corner,
    j: i128,
    walked: bool,
}

impl<'a> Work<'a> {
    fn new(plan: &'a Plan, triangle: &Triangle) -> Self {
        let t = plan.widths().center_fraction;
        let centre = |x: i32| match (plan.fill, plan.subpixel_bits) {
            (Fill::Textbook, _) => 2 * i128::from(x),
            (Fill::Exact, 0) => 2 * i128::from(x) - 1,
            (Fill::Exact, s) => i128::from(x) - (1 << (s - 1)),
        };
        let mut corners = triangle.map(|vertex| Corner {
            u: centre(vertex.x()),
            v: centre(vertex.y()),
            values: from_fn(|i| vertex.values().get(i).map_or(0, |value| i128::from(*value))),
        });
        corners.sort_by_key(|corner| corner.v);
        let [p0, p1, p2] = corners;
        let area = (p1.u - p0.u) * (p2.v - p0.v) - (p2.u - p0.u) * (p1.v - p0.v);
        let up = |v: i128| -(-v >> t);
        let height = i128::from(plan.height);
        let (first, lines) = match plan.fill {
            Fill::Exact => {
                let j0 = up(p0.v).max(0);
                let end = up(p2.v).min(height).max(j0);
                let j1 = up(p1.v).clamp(j0, end);
                ([j0, j1], [j1 - j0, end - j1])
            }
            Fill::Textbook => {
                let part = |a: Corner, b: Corner| {
                    let all = (b.v >> t).min(height - 1) - (a.v >> t).max(0) + 1;
                    if b.v > a.v { all.max(0) } else { 0 }
                };
                ([p0.v, p1.v].map(|v| (v >> t).max(0)), [part(p0, p1), part(p1, p2)])
            }
        };
        Work { plan, t, o: i128::from(plan.fill == Fill::Textbook), corners, area, first, lines }
    }

    fn jm(&self) -> i128 {
        self.first[usize::from(self.lines[0] == 0)]
    }

    fn culled(&self) -> Option<Culled> {
        let columns = self.corners.map(|corner| -(-corner.u >> self.t));
        let k0 = columns.into_iter().min().unwrap_or(0).max(0);
        let k1 = columns.into_iter().max().unwrap_or(0).min(i128::from(self.plan.width));
        if self.lines == [0, 0] {
            Some(Culled::Lines)
        } else if self.plan.fill == Fill::Exact && k1 <= k0 {
            Some(Culled::Columns)
        } else {
            (self.area == 0).then_some(Culled::Area)
        }
    }

    /// Major, first and second minor; q·h of the major edge; S1.
    fn edges(&self) -> ([EdgeWalk; 3], i128, u32) {
        let [p0, p1, p2] = self.corners;
        let [walked0, walked1] = self.lines.map(|lines| lines > 0);
        let tasks = [
            Task { a: p0, b: p2, j: self.jm(), walked: true },
            Task { a: p0, b: p1, j: self.first[0], walked: walked0 },
            Task { a: p1, b: p2, j: self.first[1], walked: walked1 },
        ];
        // In the first clock the vertices are subtracted.
        let (mut edges, mut sheared, mut clocks) = (Vec::new(), Vec::new(), 1);
        for round in tasks.chunks(self.plan.lanes as usize) {
            clocks += self.edge_round(round, &mut edges, &mut sheared);
        }
        let (du1, dv1, du2, dv2) = (p1.u - p0.u, p1.v - p0.v, p2.u - p0.u, p2.v - p0.v);
        let area = over_bits(u(&[dv2]), |i| du1 * (dv2 >> i & 1) - du2 * (dv1 >> i & 1));
        assert_eq!(area, self.area, "summed up over the bits of dv2 and dv1");
        let area = u(&[dv2]).max(2) + 4 + self.scale(0);
        (edges.try_into().expect("three edges"), sheared[0], clocks.max(area))
    }

    fn edge_round(&self, round: &[Task], edges: &mut Vec<EdgeWalk>, sheared: &mut Vec<i128>) -> u32 {
        let (w, t, p) = (self.plan.widths(), self.t, 1i128 << self.t);
        let exact = self.plan.edge_kind == EdgeKind::Exact;
        let f = if exact { 0 } else { self.plan.edge_fraction };
        // DX, DY, ua + o, and h; one that is not walked has what asks for nothing.
        let numbers = |task: &Task| match task {
            Task { walked: false, .. } => [0, 1, 0, 0],
            Task { a, b, j, .. } => [b.u - a.u, b.v - a.v, a.u + self.o, j * p - a.v],
        };
        let all_fit = round.iter().map(numbers).all(|[dx, dy, ..]| Lane::fits(p * dy, dx));
        let factors = |[_, _, column, h]: [i128; 4]| [column & (p - 1), h];
        let bits = u(&round.iter().map(numbers).flat_map(factors).collect::<Vec<_>>());
        let taken = round.iter().map(|task| {
            let numbers = numbers(task);
            let [dx, dy, column, h] = numbers;
            let mut lane = Lane::new(p * dy, w.column + f);
            let slope = lane.take_in(dx, all_fit, w.difference - 1);
            let step = lane.double(slope, t + f, (t + f).div_ceil(2));
            let sl = lane.round(step);
            let one = lane.take_in(dy, true, 0);
            let both = lane.add(one, slope);
            lane.wait(2);
            let low = |n: i128| sign_extend(n as i32, w.column);
            let (mut q, mut fraction) =
                if exact { (step.w, step.rest >> t) } else { (sl >> f, sl & ((1 << f) - 1)) };
            if dy < p {
                (q, fraction) = (0, 0);
            }
            lane.knows(step); // q, beside this sum it is summed up
            sheared.push(over_bits(bits, |i| i128::from(low(q)) * (h >> i & 1)));
            let at = lane.sum(factors(numbers), [one, slope, both], bits, false);
            let columns = column >> t; // added where the result is given out
            let (c, r);
            if exact {
                // m = -w·DY - over, where 0 <= over <= DY
                let over = -(-(at.rest + self.o) >> t);
                c = at.w + columns + i128::from(over > 0);
                r = if over > 0 { dy - over } else { 0 };
            } else {
                let at = lane.double(at, f, f.div_ceil(2));
                let m = -(lane.round(at) + (columns << f)) - self.o;
                lane.wait(2);
                (c, r) = (-(m >> f), m & ((1 << f) - 1));
            }
            let edge =
                EdgeWalk { c: low(c), r: r as i32, q: low(q), f: fraction as i32, ..EdgeWalk::default() };
            let m = if exact { task.b.v - task.a.v } else { 1 << f } as i32;
            edges.push(EdgeWalk { m, ..if task.walked { edge } else { EdgeWalk::default() } });
            lane.end()
        });
        all_equal(taken)
    }

    /// Fills in the words of all channels; S2.
    fn channels(&self, prim: &mut Prim<MAX_CHANNELS>, sheared: i128) -> u32 {
        let channels: Vec<_> = self.plan.channels().iter().enumerate().collect();
        let mut clocks = 4;
        for (number, round) in channels.chunks(self.plan.lanes as usize).enumerate() {
            let last = channels.len() <= (number + 1) * self.plan.lanes as usize;
            let least = if last { 0 } else { 4 + self.scale(number + 1) };
            let (gx, all) = self.channel_round(round, self.scale(number), prim, sheared);
            clocks += all.max(gx + least);
        }
        clocks
    }

    /// i of a round: the modulus |area|·4^i takes in all its differences, of either sign.
    fn scale(&self, round: usize) -> u32 {
        let lanes = self.plan.lanes as usize;
        let values = self.corners.map(|corner| corner.values);
        let channels = (0..self.plan.channels().len()).skip(round * lanes).take(lanes);
        let between = |i: usize, [a, b]: [usize; 2]| values[a][i] - values[b][i];
        let differences = channels.flat_map(|i| [[1, 0], [0, 2], [1, 2]].map(|ends| between(i, ends)));
        let all = differences.map(|d| if d < 0 { -d - 1 } else { d }).fold(0, |all, d| all | d);
        let mut i = 0;
        while self.area != 0 && all + i128::from(self.area < 0) >= self.area.abs() << (2 * i) {
            i += 1;
        }
        i
    }

    /// Clocks until gx is known, and of all steps.
    fn channel_round(
        &self,
        round: &[(usize, &Channel)],
        scale: u32,
        prim: &mut Prim<MAX_CHANNELS>,
        sheared: i128,
    ) -> (u32, u32) {
        let [p0, p1, p2] = self.corners;
        let (t, p) = (self.t, 1i128 << self.t);
        let (du1, dv1, du2, dv2) = (p1.u - p0.u, p1.v - p0.v, p2.u - p0.u, p2.v - p0.v);
        let sigma = self.area.signum();
        let bits = round.iter().map(|(_, c)| c.vertex_bits()).max().expect("a channel");
        let up = |channel: &Channel| channel.fraction - channel.vertex_fraction;
        let doublings =
            |more: u32| round.iter().map(|(_, c)| (more + up(c)).div_ceil(2)).max().expect("a channel");
        let along = u(&[dv2, dv1]);
        let q = i128::from(prim.major.q);
        // Beside gx, over the bits of dv2 and dv1.
        let down = [(du2, dv2), (du1, dv1)].map(|(x, y)| over_bits(along, |i| q * (y >> i & 1)) - x);
        if self.plan.edge_kind == EdgeKind::Exact && dv2 >= p {
            assert_eq!(-down[0], i128::from(prim.major.f), "f");
        }
        let px = i128::from(prim.major.c) - i128::from(prim.major_right);
        let h = i128::from(prim.line) * p - p0.v;
        let across = [px * p - p0.u - sheared, h];
        let parts = [0, 1].map(|part| {
            let (a, b) = match (self.area < 0, part) {
                (false, _) => (p0, p2),
                (true, 0) => (p0, p1),
                (true, _) => (p1, p2),
            };
            Task { a, b, j: self.first[part], walked: self.lines[part] > 0 }
        });
        let fit = parts.each_ref().map(|Task { a, b, walked, .. }| {
            let fits = |i: usize| Lane::fits(p * (b.v - a.v), b.values[i] - a.values[i]);
            !walked || round.iter().all(|(i, _)| fits(*i))
        });
        all_equal(round.iter().map(|(i, channel)| {
            let i = *i;
            let (up, word) = (up(channel), |value: i128| (value & ((1 << channel.word()) - 1)) as u64);
            let mut lane = Lane::new(self.area.abs() << (2 * scale), channel.word() + t);
            let (dc1, dc2) = (sigma * (p1.values[i] - p0.values[i]), sigma * (p2.values[i] - p0.values[i]));
            let both = lane.take_in(dc1 - dc2, true, bits);
            let first = lane.take_in(dc1, true, bits);
            let second = lane.take_in(-dc2, true, bits);
            lane.wait(1);
            let pairs = [first, second, both];
            let gx = lane.sum([dv2, dv1], pairs, along, false);
            let gx = lane.double(gx, 2 * scale + t + up, scale + doublings(t));
            let gx_known = lane.clock;
            let gradient = lane.round(gx);
            if self.plan.fill == Fill::Exact {
                prim.gradient[i] = word(if prim.major_right { -gradient } else { gradient });
                let d0 = lane.sum(down, pairs, s(&down), true);
                let d0 = lane.double(d0, 2 * scale + t + up, scale + doublings(t));
                let d1 = lane.add(d0, gx);
                prim.delta[0][i] = word(lane.round(d0));
                prim.delta[1][i] = word(lane.round(d1));
                lane.wait(1);
                let start = lane.sum(across, [gx, d0, d1], s(&across), true);
                prim.start[0][i] = word((start.w + p / 2 + self.value(i, channel, &p0) * p) >> t);
                return (gx_known, lane.end());
            }
            prim.gradient[i] = word(gradient);
            lane.wait(2);
            for (part, (Task { a, b, j, walked }, fit)) in parts.iter().zip(fit).enumerate() {
                // One without lines has what asks for nothing.
                let (dc, dy, h) =
                    if *walked { (b.values[i] - a.values[i], b.v - a.v, j * p - a.v) } else { (0, 1, 0) };
                lane.change_m(p * dy);
                let pair = lane.take_in(dc, fit, bits);
                let step = lane.double(pair, 2 * t + up, doublings(2 * t));
                let delta = lane.round(step);
                lane.wait(1);
                let start = lane.sum([h, 0], [pair, Pair::default(), pair], u(&[h]), false);
                let start = lane.double(start, t + up, doublings(t));
                let start = lane.round(start) + self.value(i, channel, a);
                lane.wait(2);
                if *walked {
                    (prim.delta[part][i], prim.start[part][i]) = (word(delta), word(start));
                }
            }
            (gx_known, lane.end())
        }))
    }

    /// A vertex's value and half, 2^-r LSB.
    fn value(&self, i: usize, channel: &Channel, corner: &Corner) -> i128 {
        let half = if channel.kind.is_rounded() { (1i128 << channel.fraction) >> 1 } else { 0 };
        (corner.values[i] << (channel.fraction - channel.vertex_fraction)) + half
    }

    /// What SETUP gives, and its clocks.
    fn prim(&self) -> (SetupClocks, Option<Prim<MAX_CHANNELS>>) {
        let culled = self.culled();
        if matches!(culled, Some(Culled::Lines | Culled::Columns)) {
            return (SetupClocks { phase1: 2, phase2: 0 }, None);
        }
        let (edges, sheared, phase1) = self.edges();
        if culled.is_some() {
            return (SetupClocks { phase1, phase2: 0 }, None);
        }
        let mut prim = Prim {
            line: self.jm() as u32,
            lines: self.lines.map(|lines| lines as u32),
            major_right: self.area < 0,
            major: edges[0],
            minor: [edges[1], edges[2]],
            ..Prim::default()
        };
        let phase2 = self.channels(&mut prim, sheared);
        (SetupClocks { phase1, phase2 }, Some(prim))
    }
}

/// The model's, with the cycles in which it was not ready.
fn ticked(setup: &mut Setup<MAX_CHANNELS>, triangle: &Triangle) -> (u32, Option<Prim<MAX_CHANNELS>>) {
    let events = &mut Events::default();
    setup.step(Some((triangle, 0)), false, false, events);
    let mut cycles = 0;
    while setup.prim().is_none() && !setup.tri_ready() {
        setup.step(None, false, false, events);
        cycles += 1;
    }
    let prim = setup.prim().map(|prim| Prim { source: Default::default(), ..*prim });
    if prim.is_some() {
        setup.step(None, true, false, events);
    }
    (cycles, prim)
}

#[derive(Default)]
struct Seen {
    checked: usize,
    culled: [usize; 3],
    /// Most clocks, and the largest share of the bound that formats give.
    most: u32,
    of_bound: f64,
}

impl Seen {
    fn check(&mut self, plan: &Plan, count: usize, rng: &mut StdRng) {
        let mut setup = Setup::new(plan);
        let longest = longest_setup(plan);
        for number in 0..count as u32 {
            let triangle = any_triangle(plan, rng);
            let work = Work::new(plan, &triangle);
            let (clocks, prim) = work.prim();
            // The k-th triangle has record k mod 2^p, culled or not; k_t is that of its first vertex.
            let record = number % (1 << plan.shade.record_bits);
            let kt = if plan.has_triangle_kt() { triangle[0].kt() } else { 0 };
            let prim = prim.map(|prim| Prim { record, kt, ..prim });
            let (cycles, ticked) = ticked(&mut setup, &triangle);
            let context = || format!("{triangle:?} on {plan:?}");
            assert_eq!(ticked, prim, "{}", context());
            assert_eq!(setup_clocks(plan, &triangle), clocks, "{}", context());
            assert_eq!(cycles, clocks.all(), "{}", context());
            assert!(clocks.phase1 <= longest.phase1 && clocks.phase2 <= longest.phase2, "{}", context());
            if let Some(cause) = work.culled() {
                self.culled[cause as usize] += 1;
            }
            self.most = self.most.max(clocks.all());
            self.of_bound = self.of_bound.max(f64::from(clocks.all()) / f64::from(longest.all()));
            self.checked += 1;
        }
    }
}

#[test]
fn pairs_give_what_the_formulae_say() {
    const COUNT: usize = 100_000;
    const RANDOM: usize = 30;
    let kinds = [("exact", "exact"), ("exact", "slope"), ("textbook", "slope"), ("textbook", "exact")];
    let mut all = 0;
    for (seed, (fill, kind)) in kinds.into_iter().enumerate() {
        let mut rng = StdRng::seed_from_u64(seed as u64);
        let mut settings = vec![("edge.fill", fill), ("edge.kind", kind), ("setup.kind", "parallel")];
        if fill == "textbook" {
            settings.push(("screen.subpixel_bits", "0"));
        }
        let share = COUNT / kinds.len() / 2;
        let mut own = Seen::default();
        let mut plain = Machine::default();
        for (key, value) in &settings {
            plain.set(key, value).expect("a key");
        }
        own.check(&plain.plan().expect("can be built"), share, &mut rng);
        let mut others = Seen::default();
        for _ in 0..RANDOM {
            others.check(&random_machine(&settings, &mut rng), share.div_ceil(RANDOM), &mut rng);
        }
        for (name, seen) in [("default formats", &own), ("random machines", &others)] {
            println!(
                "{fill} fill, {kind} edges, {name}: {} triangles equal, culled by lines, columns, area {:?}, at most {} clocks, {:.0} % of the bound",
                seen.checked,
                seen.culled,
                seen.most,
                100.0 * seen.of_bound
            );
            let [lines, columns, area] = seen.culled;
            assert!(lines > 0 && area > 0 && (columns > 0) == (fill == "exact"), "{:?}", seen.culled);
            assert!(4 * (lines + columns + area) < 3 * seen.checked, "{:?}", seen.culled);
            all += seen.checked;
        }
    }
    println!("checked {all} / at least {COUNT} triangles");
    assert!(all >= COUNT);
}
