//! Lines against their rule (`docs/machine.md`, section 2), each pixel and value an exact quotient.

use crate::common::{fragments, machine, random_values};
use edgewalk_machine::{Plan, PortVertex, Role};
use edgewalk_model::{DrawState, Stalls};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// An end: x and y, 2^-s px, and the values at the port.
type End = ([i64; 2], Vec<i64>);

/// A line as the host sends it; a flat one has x and y exchanged.
fn line(plan: &Plan, [a, b]: [&End; 2]) -> [PortVertex; 3] {
    let flat = is_flat([a, b]);
    let main = usize::from(!flat);
    let [a, b] = if a.0[main] <= b.0[main] { [a, b] } else { [b, a] };
    let (one, half) = (1 << plan.subpixel_bits, 1 << (plan.subpixel_bits - 1));
    let vertex = |end: &End, right: i64| {
        let across = end.0[1 - main] - half + right;
        plan.raw_vertex(across as i32, end.0[main] as i32, &end.1)
    };
    plan.with_role([vertex(a, 0), vertex(a, one), vertex(b, 0)], Role::Line { flat })
}

fn is_flat([a, b]: [&End; 2]) -> bool {
    (b.0[0] - a.0[0]).abs() >= (b.0[1] - a.0[1]).abs()
}

/// The pixels of the rule, in the order of the main axis, each with how far along the line its centre lies: a quotient.
fn pixels(plan: &Plan, [a, b]: [&End; 2]) -> Vec<((i64, i64), [i64; 2])> {
    let (unit, half) = (1i64 << plan.subpixel_bits, 1i64 << (plan.subpixel_bits - 1));
    let flat = is_flat([a, b]);
    let main = usize::from(!flat);
    let sides = [i64::from(plan.width), i64::from(plan.height)];
    let (length, wide) = (b.0[main] - a.0[main], b.0[1 - main] - a.0[1 - main]);
    let mut found = Vec::new();
    for along in 0..sides[main] {
        let centre = along * unit + half;
        let (from, to) = (a.0[main].min(b.0[main]), a.0[main].max(b.0[main]));
        if !(from..to).contains(&centre) {
            continue;
        }
        // The line at this centre, over 2 * |length| to keep halves whole; the pixel below the middle between two centres.
        let way = centre - a.0[main];
        let place = 2 * (a.0[1 - main] * length + way * wide) * length.signum();
        let of = 2 * length.abs() * unit;
        let across = -(-(place - of)).div_euclid(of);
        if (0..sides[1 - main]).contains(&across) {
            let at = if flat { (along, across) } else { (across, along) };
            found.push((at, [way, length]));
        }
    }
    found
}

/// Draws these lines and holds every pixel and value to the rule; gives how many pixels there were.
fn held_to_rule(plan: &Plan, lines: &[[End; 2]]) -> usize {
    let expected: Vec<_> = lines.iter().map(|[a, b]| pixels(plan, [a, b])).collect();
    let mut next = vec![0; lines.len()];
    let port: Vec<_> = lines.iter().map(|[a, b]| line(plan, [a, b])).collect();
    fragments(plan, &port, |id, at, outputs| {
        let place = next[id];
        next[id] += 1;
        let Some((pixel, [way, length])) = expected[id].get(place) else {
            panic!("line {id} {:?}: pixel {at:?} is too many", lines[id]);
        };
        assert_eq!(at, *pixel, "line {id} {:?}", lines[id]);
        let [a, b] = &lines[id];
        for ((channel, output), (from, to)) in plan.channels().iter().zip(outputs).zip(a.1.iter().zip(&b.1)) {
            // Start and d are rounded once each, and d is added for each line.
            let value = *from as f64 + (to - from) as f64 * *way as f64 / *length as f64;
            let value = value / f64::from(1u32 << channel.vertex_fraction);
            // From the end that comes first.
            let walked = if *length < 0 { way - length } else { *way };
            let lines = (walked as f64 / f64::from(1u32 << plan.subpixel_bits)).abs() + 2.0;
            let bound = 0.5 + lines / 2.0 / f64::from(1u32 << channel.fraction) + 1e-9;
            let error = (output as f64 - value).abs();
            assert!(error <= bound, "line {id} {:?}, {}: {output} for {value}", [a.0, b.0], channel.name);
        }
    });
    for (id, (found, expected)) in next.iter().zip(&expected).enumerate() {
        assert_eq!(*found, expected.len(), "line {id} {:?}: {expected:?}", lines[id]);
    }
    expected.iter().map(Vec::len).sum()
}

/// Machines of several precisions, with the longest words of all where a line is long.
fn machines() -> Vec<Plan> {
    let keys = |bits: &'static str, lanes: &'static str| {
        [
            ("screen.width", "61"),
            ("screen.height", "43"),
            ("screen.guard_bits", "8"),
            ("screen.subpixel_bits", bits),
            ("setup.lanes", lanes),
            ("polygon.lines", "yes"),
        ]
    };
    [("8", "4"), ("1", "4"), ("4", "1"), ("2", "2")].map(|(bits, lanes)| machine(&keys(bits, lanes))).into()
}

/// An end near the screen, now and then far off, on a centre or on a whole pixel.
fn end(plan: &Plan, near: &End, random: &mut Pcg64) -> End {
    let (unit, limit) = (1i64 << plan.subpixel_bits, ((1i64 << plan.guard_bits) - 1) << plan.subpixel_bits);
    let reach = unit * [3, 20, 80, 300][random.random_range(0..4)];
    let place = |near: i64, random: &mut Pcg64| {
        let place = near + random.random_range(-reach..=reach);
        let place = match random.random_range(0..8) {
            0 => place & -unit,
            1 => (place & -unit) + unit / 2,
            2 => near,
            _ => place,
        };
        place.clamp(-limit, limit)
    };
    ([place(near.0[0], random), place(near.0[1], random)], random_values(plan, random))
}

fn random_lines(plan: &Plan, count: usize, random: &mut Pcg64) -> Vec<[End; 2]> {
    let unit = 1i64 << plan.subpixel_bits;
    let one = |_| {
        let near = [plan.width, plan.height]
            .map(|side| random.random_range(-2 * unit..(i64::from(side) + 2) * unit));
        let a = end(plan, &(near, Vec::new()), random);
        let b = end(plan, &a, random);
        [a, b]
    };
    (0..count).map(one).collect()
}

/// As many lines on each machine.
fn campaign(lines: usize) {
    let (mut random, mut drawn, mut pixels) = (Pcg64::seed_from_u64(32), 0, 0);
    for plan in machines() {
        let lines = random_lines(&plan, lines, &mut random);
        pixels += held_to_rule(&plan, &lines);
        drawn += lines.len();
    }
    println!("{drawn} lines, {pixels} pixels: 0 differ from the rule, no value beyond its bound");
    assert!(pixels > 2 * drawn, "{pixels} pixels of {drawn} lines");
}

#[test]
fn random_lines_follow_the_rule() {
    campaign(2_000);
}

/// The command: `cargo test --release -p edgewalk-model -- --ignored lines:: --nocapture`.
#[test]
#[ignore = "a campaign of 200,000 lines"]
fn many_lines_follow_the_rule() {
    campaign(50_000);
}

#[test]
fn corners_of_the_rule_are_met() {
    let plan = &machines()[0];
    let values = |share: i64| {
        let most = |c: &edgewalk_machine::Channel| (c.limit() << c.vertex_fraction) as i64 * share / 4;
        plan.channels().iter().map(most).collect::<Vec<_>>()
    };
    let at = |x: f64, y: f64, share: i64| ([(x * 256.0) as i64, (y * 256.0) as i64], values(share));
    let both = |a: &End, b: &End| [[a.clone(), b.clone()], [b.clone(), a.clone()]];
    let ends = [
        // On centres, in eight directions: the first is drawn, the last is not.
        ((5.5, 5.5), (9.5, 5.5), 4),
        ((5.5, 5.5), (5.5, 9.5), 4),
        ((5.5, 5.5), (9.5, 9.5), 4),
        ((5.5, 9.5), (9.5, 5.5), 4),
        // Between two pixels all along: the left, the upper one.
        ((3.0, 5.0), (9.0, 5.0), 6),
        ((5.0, 3.0), (5.0, 9.0), 6),
        // Between two pixels at one centre in two.
        ((2.5, 4.5), (12.5, 9.5), 10),
        // Within a pixel, with its centre and without; a point.
        ((4.25, 7.5), (4.75, 7.5), 1),
        ((4.75, 7.5), (5.25, 7.5), 0),
        ((4.5, 7.5), (4.5, 7.5), 0),
        // Over each side of the screen, and beside all of it.
        ((-20.5, 3.5), (70.5, 30.5), 61),
        ((30.25, -20.0), (20.0, 90.0), 43),
        ((-30.0, 50.0), (70.0, 60.0), 0),
        // All vertices lie before column 0, or line 0, and a pixel does not.
        ((-3.0, 3.5), (0.4, 40.5), 4),
        ((3.5, -3.0), (40.5, 0.4), 4),
    ];
    let mut drawn = 0;
    for ((ax, ay), (bx, by), count) in ends {
        let (a, b) = (at(ax, ay, 0), at(bx, by, 4));
        for line in both(&a, &b) {
            let pixels = held_to_rule(plan, &[line]);
            assert_eq!(pixels, count, "({ax}, {ay}) to ({bx}, {by})");
            drawn += pixels;
        }
    }
    assert_eq!(drawn, 2 * (4 * 4 + 12 + 10 + 1 + 61 + 43 + 8));
}

/// A line may have a pixel in a column that none of its vertices has; triangles are culled there.
#[test]
fn a_line_is_not_culled_by_columns() {
    let plan = &machines()[0];
    let end = |x: f64, y: f64| ([(x * 256.0) as i64, (y * 256.0) as i64], vec![0; 4]);
    let (a, b) = (end(-3.0, 3.5), end(0.4, 40.5));
    let port = line(plan, [&a, &b]);
    let all_left = port.iter().all(|v| v.x() - 128 <= 0);
    assert!(all_left, "{port:?}");
    let as_triangle = plan.with_role(port, Role::Triangle);
    assert_eq!(edgewalk_model::cull(plan, &as_triangle), Some(edgewalk_model::Culled::Columns));
    assert_eq!(edgewalk_model::cull(plan, &port), None);
}

/// Half-open along the main axis: nothing is drawn twice where one line ends and the next begins in the same direction.
#[test]
fn lines_that_follow_each_other_share_no_pixel() {
    let plan = &machines()[0];
    let mut random = Pcg64::seed_from_u64(5);
    let mut twice = 0;
    let mut pixels = 0;
    for _ in 0..500 {
        // Three points on a line: whichever way it runs, both parts are flat, or both are steep.
        let [a, step] = [(); 2].map(|()| [(); 2].map(|()| random.random_range(-4000..=4000i64)));
        let point = |k: i64| ([a[0] + 5000 + k * step[0], a[1] + 5000 + k * step[1]], vec![0; 4]);
        let ends = [point(0), point(1), point(2)];
        let lines = [line(plan, [&ends[0], &ends[1]]), line(plan, [&ends[1], &ends[2]])];
        let state = DrawState { depth_func: 7, ..DrawState::default() };
        let frame = crate::common::render(plan, &lines, state, Stalls::NONE);
        twice += frame.coverage.iter().filter(|count| **count > 1).count();
        pixels += frame.coverage.iter().map(|count| *count as usize).sum::<usize>();
    }
    assert!(pixels > 5_000, "{pixels} pixels");
    assert_eq!(twice, 0);
}
