//! SETUP by pairs, step by step as `docs/machine.md` describes its lanes, against what the model gives by closed
//! formulae: every field of every prim, and the clocks that the steps took.

use crate::common::{Triangle, moved, random_machine, random_triangle};
use edgewalk_machine::{Channel, EdgeKind, Fill, MAX_CHANNELS, Machine, Plan};
use edgewalk_model::setup::Setup;
use edgewalk_model::tokens::{EdgeWalk, Prim, sign_extend};
use edgewalk_model::{Culled, Events, SetupClocks, longest_setup, setup_clocks};
use rand::{Rng, SeedableRng, rngs::StdRng};
use std::array::from_fn;

/// The number w + rest/M; w modular.
#[derive(Clone, Copy, Debug, Default)]
struct Pair {
    w: i128,
    rest: i128,
}

/// What a lane divides by, and the bits of its w.
#[derive(Clone, Copy, Debug)]
struct Lane {
    m: i128,
    bits: u32,
}

impl Lane {
    /// w + rest/M of a rest below 3M.
    fn pair(self, w: i128, rest: i128) -> Pair {
        let over = i128::from(rest >= self.m) + i128::from(rest >= 2 * self.m);
        let rest = rest - over * self.m;
        assert!((0..self.m).contains(&rest), "{rest} of {self:?}");
        Pair { w: (w + over) & ((1 << self.bits) - 1), rest }
    }

    fn fits(self, d: i128) -> bool {
        -self.m <= d && d < self.m
    }

    /// D/M: had by a test, or from its sign and `bits` more, one by one.
    fn take_in(self, d: i128, tested: bool, bits: u32) -> Pair {
        if tested {
            return if d < 0 { self.pair(-1, d + self.m) } else { self.pair(0, d) };
        }
        let mut pair = if d < 0 { self.pair(-1, self.m - 1) } else { Pair::default() };
        for i in (0..bits).rev() {
            pair = self.pair(2 * pair.w, 2 * pair.rest + (d >> i & 1));
        }
        pair
    }

    fn add(self, a: Pair, b: Pair) -> Pair {
        self.pair(a.w + b.w, a.rest + b.rest)
    }

    fn add_whole(self, a: Pair, n: i128) -> Pair {
        self.pair(a.w + n, a.rest)
    }

    fn double(self, a: Pair, times: u32) -> Pair {
        (0..times).fold(a, |a, _| self.pair(2 * a.w, 2 * a.rest))
    }

    /// f·a + g·b, the most significant of `bits` first; of numbers with a sign that bit subtracts.
    fn sum(self, [f, g]: [i128; 2], [a, b]: [Pair; 2], bits: u32, signed: bool) -> Pair {
        let both = self.add(a, b);
        let mut sum = Pair::default();
        for i in (0..bits).rev() {
            let chosen = match (f >> i & 1, g >> i & 1) {
                (0, 0) => Pair::default(),
                (_, 0) => a,
                (0, _) => b,
                _ => both,
            };
            let taken_off = signed && i == bits - 1; // from 0
            sum = if taken_off && chosen.rest > 0 {
                self.pair(-chosen.w - 1, self.m - chosen.rest)
            } else if taken_off {
                self.pair(-chosen.w, 0)
            } else {
                self.pair(2 * sum.w + chosen.w, 2 * sum.rest + chosen.rest)
            };
        }
        sum
    }

    /// RN.
    fn round(self, a: Pair) -> i128 {
        a.w + i128::from(2 * a.rest >= self.m)
    }
}

/// Bits of the longest of some numbers that are not negative.
fn u(numbers: &[i128]) -> u32 {
    let bits = |n: &i128| (0..).find(|bits| n >> bits == 0).expect("not negative");
    numbers.iter().map(bits).max().unwrap_or(0).max(1)
}

/// The same in two's complement.
fn s(numbers: &[i128]) -> u32 {
    let bits =
        |n: &i128| (1..).find(|bits| (-1..=0).contains(&(n >> (bits - 1)))).expect("no number is longer");
    numbers.iter().map(bits).max().unwrap_or(0).max(2)
}

/// The clocks of taking in numbers on all lanes.
fn takes(all_fit: bool, bits: u32) -> u32 {
    if all_fit { 2 } else { 5 + bits.div_ceil(2) }
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

    /// Major, first and second minor.
    fn edges(&self) -> ([EdgeWalk; 3], u32) {
        let [p0, p1, p2] = self.corners;
        let [walked0, walked1] = self.lines.map(|lines| lines > 0);
        let tasks = [
            Task { a: p0, b: p2, j: self.jm(), walked: true },
            Task { a: p0, b: p1, j: self.first[0], walked: walked0 },
            Task { a: p1, b: p2, j: self.first[1], walked: walked1 },
        ];
        let (mut edges, mut clocks) = (Vec::new(), 0);
        for round in tasks.chunks(self.plan.lanes as usize) {
            clocks += self.edge_round(round, &mut edges);
        }
        let dv2 = p2.v - p0.v;
        (edges.try_into().expect("three edges"), clocks.max(u(&[dv2]) + 4 + self.scale(0)))
    }

    fn edge_round(&self, round: &[Task], edges: &mut Vec<EdgeWalk>) -> u32 {
        let (w, t, p) = (self.plan.widths(), self.t, 1i128 << self.t);
        let exact = self.plan.edge_kind == EdgeKind::Exact;
        let f = if exact { 0 } else { self.plan.edge_fraction };
        let lane = |task: &Task| Lane { m: p * (task.b.v - task.a.v), bits: w.column + f };
        let at_work = || round.iter().filter(|task| task.walked);
        let all_fit = at_work().all(|task| lane(task).fits(task.b.u - task.a.u));
        let factors = |task: &Task| [(task.a.u + self.o) & (p - 1), task.j * p - task.a.v];
        let bits = u(&at_work().flat_map(factors).collect::<Vec<_>>());
        for task in round {
            let (dx, dy) = (task.b.u - task.a.u, task.b.v - task.a.v);
            let modulus = if exact { dy } else { 1 << f };
            if !task.walked {
                edges.push(EdgeWalk { m: modulus as i32, ..EdgeWalk::default() });
                continue;
            }
            let lane = lane(task);
            let slope = lane.take_in(dx, all_fit, w.difference - 1);
            let step = lane.double(slope, t + f);
            let one = lane.take_in(dy, true, 0);
            let whole = (task.a.u + self.o) >> t;
            let column = lane.sum([factors(task)[0], factors(task)[1]], [one, slope], bits, false);
            let column = lane.add_whole(column, whole);
            let low = |n: i128| sign_extend(n as i32, w.column);
            let (q, fraction, c, r);
            if exact {
                (q, fraction) = if dy < p { (0, 0) } else { (step.w, step.rest >> t) };
                // m = -w·DY - over, where 0 <= over <= DY
                let over = -(-(column.rest + self.o) >> t);
                c = column.w + i128::from(over > 0);
                r = if over > 0 { dy - over } else { 0 };
            } else {
                let sl = if dy < p { 0 } else { lane.round(step) };
                (q, fraction) = (sl >> f, sl & ((1 << f) - 1));
                let m = -lane.round(lane.double(column, f)) - self.o;
                (c, r) = (-(m >> f), m & ((1 << f) - 1));
            }
            edges.push(EdgeWalk { c: low(c), r: r as i32, q: low(q), f: fraction as i32, m: modulus as i32 });
        }
        let rounding = if exact { 0 } else { f.div_ceil(2) + 1 };
        takes(all_fit, w.difference - 1) + (t + f).div_ceil(2) + 2 + 2 + bits + 1 + rounding
    }

    /// Fills in the words of all channels; S2.
    fn channels(&self, prim: &mut Prim<MAX_CHANNELS>) -> u32 {
        let channels: Vec<_> = self.plan.channels().iter().enumerate().collect();
        let mut clocks = 4;
        for (number, round) in channels.chunks(self.plan.lanes as usize).enumerate() {
            let last = channels.len() <= (number + 1) * self.plan.lanes as usize;
            let least = if last { 0 } else { 8 + self.scale(number + 1) };
            clocks += self.channel_round(round, self.scale(number), prim).max(least);
        }
        clocks
    }

    /// i of a round: the modulus |area|·4^i takes in all its differences, of either sign.
    fn scale(&self, round: usize) -> u32 {
        let lanes = self.plan.lanes as usize;
        let [p0, p1, p2] = self.corners;
        let channels = (0..self.plan.channels().len()).skip(round * lanes).take(lanes);
        let differences = channels.flat_map(|i| [p1.values[i] - p0.values[i], p0.values[i] - p2.values[i]]);
        let all = differences.map(|d| if d < 0 { -d - 1 } else { d }).fold(0, |all, d| all | d);
        let mut i = 0;
        while self.area != 0 && all + i128::from(self.area < 0) >= self.area.abs() << (2 * i) {
            i += 1;
        }
        i
    }

    fn channel_round(&self, round: &[(usize, &Channel)], scale: u32, prim: &mut Prim<MAX_CHANNELS>) -> u32 {
        let [p0, p1, p2] = self.corners;
        let (t, p) = (self.t, 1i128 << self.t);
        let (dv1, dv2) = (p1.v - p0.v, p2.v - p0.v);
        let sigma = self.area.signum();
        let bits = round.iter().map(|(_, c)| c.vertex_bits()).max().expect("a channel");
        let up = |channel: &Channel| channel.fraction - channel.vertex_fraction;
        let doublings =
            |more: u32| round.iter().map(|(_, c)| (more + up(c)).div_ceil(2)).max().expect("a channel");
        let lane = |channel: &Channel, m: i128| Lane { m, bits: channel.word() + t };
        let modulus = self.area.abs() << (2 * scale);
        let dc1 = |i: usize| sigma * (p1.values[i] - p0.values[i]);
        let dc2 = |i: usize| -sigma * (p2.values[i] - p0.values[i]);
        let tested =
            |m: i128, number: &dyn Fn(usize) -> i128| round.iter().all(|(i, c)| lane(c, m).fits(number(*i)));
        assert!(tested(modulus, &dc1) && tested(modulus, &dc2), "scaled so that all fit");
        let along = u(&[dv2, dv1]);
        let mut clocks = 2 + 2 + 1 + 2 + along + scale + doublings(t);
        let q = i128::from(prim.major.q);
        let px = i128::from(prim.major.c) - i128::from(prim.major_right);
        let (down, across) = ([p0.u - p2.u, p0.u - p1.u], [px * p - p0.u, i128::from(prim.line) * p - p0.v]);
        for (i, channel) in round {
            let (i, lane) = (*i, lane(channel, modulus));
            let word = |value: i128| (value & ((1 << channel.word()) - 1)) as u64;
            let first = lane.take_in(dc1(i), true, bits);
            let second = lane.take_in(dc2(i), true, bits);
            let both = [first, second];
            let gx = lane.double(lane.sum([dv2, dv1], both, along, false), 2 * scale + t + up(channel));
            let sign = if prim.major_right && self.plan.fill == Fill::Exact { -1 } else { 1 };
            prim.gradient[i] = word(sign * lane.round(gx));
            if self.plan.fill == Fill::Exact {
                let gy = lane.double(lane.sum(down, both, s(&down), true), 2 * scale + t + up(channel));
                let d0 = lane.add(lane.sum([q, 0], [gx, gy], s(&[q]), true), gy);
                let d1 = lane.add(d0, gx);
                prim.delta[0][i] = word(lane.round(d0));
                prim.delta[1][i] = word(lane.round(d1));
                let start = lane.sum(across, [gx, gy], s(&across), true);
                let start = lane.add_whole(start, p / 2 + self.value(i, channel, &p0) * p);
                prim.start[0][i] = word(start.w >> t);
            }
        }
        if self.plan.fill == Fill::Exact {
            let gy = s(&down) + scale + doublings(t) + 1;
            return clocks + gy + s(&[q]) + 1 + 1 + s(&across) + 1;
        }
        for part in 0..2 {
            let (a, b) = match (self.area < 0, part) {
                (false, _) => (p0, p2),
                (true, 0) => (p0, p1),
                (true, _) => (p1, p2),
            };
            let walked = self.lines[part] > 0;
            let m = p * (b.v - a.v);
            let dc = |i: usize| b.values[i] - a.values[i];
            let fit = !walked || tested(m, &dc);
            let h = if walked { self.first[part] * p - a.v } else { 0 };
            for (i, channel) in round.iter().filter(|_| walked) {
                let (i, lane) = (*i, lane(channel, m));
                let word = |value: i128| (value & ((1 << channel.word()) - 1)) as u64;
                let pair = lane.take_in(dc(i), fit, bits);
                prim.delta[part][i] = word(lane.round(lane.double(pair, 2 * t + up(channel))));
                let start = lane.sum([h, 0], [pair, Pair::default()], u(&[h]), false);
                let start = lane.double(start, t + up(channel));
                let start = lane.add_whole(start, self.value(i, channel, &a));
                prim.start[part][i] = word(lane.round(start));
            }
            clocks += 1 + takes(fit, bits) + doublings(2 * t) + 1 + u(&[h]) + doublings(t) + 2;
        }
        clocks
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
        let (edges, phase1) = self.edges();
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
        let phase2 = self.channels(&mut prim);
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

/// Triangles of every size and place, degenerate ones among them.
fn any_triangle(plan: &Plan, rng: &mut StdRng) -> Triangle {
    let size = 2f64.powf(rng.random_range(-3.0..f64::from(plan.guard_bits) + 1.0));
    let mut triangle = random_triangle(plan, size, rng);
    let limit = ((1i32 << plan.guard_bits) - 1) << plan.subpixel_bits;
    for corner in &mut triangle {
        if rng.random_bool(0.05) {
            let x = rng.random_range(-limit..=limit);
            let y = rng.random_range(-limit..=limit);
            *corner = moved(plan, corner, x, y);
        }
    }
    match rng.random_range(0..16) {
        0 => triangle[1] = triangle[0],
        1 => triangle[2] = moved(plan, &triangle[2], triangle[2].x(), triangle[1].y()),
        2 => triangle[1] = moved(plan, &triangle[1], triangle[1].x(), triangle[0].y()),
        3 => triangle[2] = moved(plan, &triangle[2], triangle[0].x(), triangle[2].y()),
        4 => {
            let middle = |a: i32, b: i32| a + (b - a) / 2;
            let [a, b, _] = triangle;
            triangle[2] = moved(plan, &a, middle(a.x(), b.x()), middle(a.y(), b.y()));
        }
        _ => {}
    }
    triangle
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
        let mut settings = vec![("edge.fill", fill), ("edge.kind", kind)];
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
