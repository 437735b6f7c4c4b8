//! Textbook fill against the listing of chapter 7 in exact fractions: inclusive lines and spans, +0.5, Trunc.

use crate::common;
use crate::common::{ALWAYS, Triangle, random_machine, random_values, render};
use edgewalk_machine::{Kind, Machine, Plan, PortVertex};
use edgewalk_model::Stalls;
use num_rational::Ratio;
use rand::{Rng, SeedableRng, rngs::StdRng};
use std::collections::HashMap;

type Q = Ratio<i128>;

/// A line of the listing.
struct Row {
    y: i64,
    /// X_start + 1/2 and X_end + 1/2, px.
    ends: [Q; 2],
    /// Lines that each edge has walked.
    lines: [i128; 2],
    /// The channels at Trunc(X_start + 1/2), LSB.
    first: Vec<Q>,
    /// Their increments, LSB/px.
    gradient: Vec<Q>,
    /// Additions that lead to the first values.
    steps: i128,
}

/// A fragment of the listing: pixel, exact values of the channels in LSB, and the additions that led there.
struct Pixel {
    x: i64,
    y: i64,
    value: Vec<Q>,
    steps: i128,
}

type Edge = (PortVertex, PortVertex);

fn whole(v: i32) -> Q {
    Q::from_integer(i128::from(v))
}

/// What goes from `from` to `to` along an edge, at line y.
fn along((top, bottom): Edge, y: i32, from: Q, to: Q) -> Q {
    from + (to - from) * whole(y - top.y()) / whole(bottom.y() - top.y())
}

/// The lines of the listing (ch. 7.10) on the screen, part by part.
fn rows(machine: &Plan, triangle: &Triangle) -> Vec<Row> {
    let mut corner = *triangle;
    corner.sort_by_key(|v| v.y());
    let [a, b, c] = corner;
    let cross = whole(b.x() - a.x()) * whole(c.y() - a.y()) - whole(c.x() - a.x()) * whole(b.y() - a.y());
    if cross == whole(0) {
        return Vec::new();
    }
    let lsb = |i: usize, v: PortVertex| {
        Q::new(i128::from(v.values()[i]), 1 << machine.channels()[i].vertex_fraction)
    };
    let channels = 0..machine.channels().len();
    let slope = |i| {
        let [va, vb, vc] = corner.map(|v| lsb(i, v));
        ((vb - va) * whole(c.y() - a.y()) - (vc - va) * whole(b.y() - a.y())) / cross
    };
    let gradient: Vec<Q> = channels.clone().map(slope).collect();
    let knee_left = cross < whole(0);
    let mut rows = Vec::new();
    for minor in [(a, b), (b, c)].into_iter().filter(|(top, bottom)| top.y() < bottom.y()) {
        let [left, right] = if knee_left { [minor, (a, c)] } else { [(a, c), minor] };
        for y in minor.0.y().max(0)..=minor.1.y().min(machine.height as i32 - 1) {
            let lines = [left, right].map(|e| i128::from(y - e.0.y().max(0)));
            rows.push(Row {
                y: i64::from(y),
                ends: [left, right].map(|e| along(e, y, whole(e.0.x()), whole(e.1.x())) + Q::new(1, 2)),
                lines,
                first: channels.clone().map(|i| along(left, y, lsb(i, left.0), lsb(i, left.1))).collect(),
                gradient: gradient.clone(),
                steps: lines[0],
            });
        }
    }
    rows
}

/// The fragments of the listing in its order; what is off the screen is left out.
fn listing(machine: &Plan, triangle: &Triangle) -> Vec<Pixel> {
    let mut pixels = Vec::new();
    for row in rows(machine, triangle) {
        let [start, end] = row.ends.map(|x| x.floor().to_integer());
        for x in start.max(0)..=end.min(i128::from(machine.width) - 1) {
            let moved = Q::from_integer(x - start);
            pixels.push(Pixel {
                x: x as i64,
                y: row.y,
                value: row.first.iter().zip(&row.gradient).map(|(first, g)| first + g * moved).collect(),
                steps: row.steps + x - start,
            });
        }
    }
    pixels
}

fn compare(machine: &Plan, triangles: &[Triangle]) -> usize {
    let mut drawn = Vec::new();
    common::fragments(machine, triangles, |id, at, outputs| drawn.push((id, at, outputs)));
    let mut drawn = drawn.into_iter();
    let mut checked = 0;
    for (number, triangle) in triangles.iter().enumerate() {
        for pixel in listing(machine, triangle) {
            let (id, at, output) = drawn.next().expect("as many fragments as in the listing");
            assert_eq!((id, at), (number, (pixel.x, pixel.y)), "{triangle:?} in {machine:?}");
            for (i, channel) in machine.channels().iter().enumerate() {
                if common::is_divided(machine, channel) {
                    continue;
                }
                let turn = Q::from_integer(1 << channel.bits);
                let error = pixel.value[i] - Q::from_integer(i128::from(output[i]));
                let error = error - (error / turn + Q::new(1, 2)).floor() * turn; // modulo 2^b
                let steps = Q::new(1 + pixel.steps, 2 << channel.fraction);
                // How far the exact value may lie above and below the output.
                let (above, below) = match channel.kind {
                    Kind::Unorm | Kind::Signed | Kind::Weight => (Q::new(1, 2) + steps, Q::new(1, 2) + steps),
                    Kind::Floor => (Q::from_integer(1) + steps, steps),
                };
                // Modulo 2^b, as a bound may be longer than half of that.
                let far = above + below >= turn || -below <= error && error <= above || error + turn <= above;
                assert!(far, "channel {i}: {error} LSB at {at:?} of {triangle:?} in {machine:?}");
            }
            checked += 1;
        }
    }
    assert_eq!(drawn.next(), None, "a fragment too many");
    checked
}

fn random(machine: &Plan, size: i32, rng: &mut impl Rng) -> Triangle {
    let limit = (1 << machine.guard_bits) - 1;
    let middle = [machine.width, machine.height].map(|side| rng.random_range(0..side as i32));
    std::array::from_fn(|_| {
        let [x, y] = middle.map(|m| (m + rng.random_range(-size..=size)).clamp(-limit, limit));
        machine.raw_vertex(x, y, &random_values(machine, rng))
    })
}

#[test]
fn the_listing_fragment_by_fragment() {
    let mut rng = StdRng::seed_from_u64(1);
    let fixed = [
        ("screen.width", "30"),
        ("screen.height", "24"),
        ("screen.subpixel_bits", "0"),
        ("edge.fill", "textbook"),
        ("edge.kind", "exact"),
    ];
    let mut checked = 0;
    for _ in 0..60 {
        let machine = random_machine(&fixed, &mut rng);
        let triangles: Vec<_> = (0..40)
            .map(|_| {
                let size = rng.random_range(1..40);
                random(&machine, size, &mut rng)
            })
            .collect();
        checked += compare(&machine, &triangles);
    }
    println!("{checked} fragments as in the listing");
    assert!(checked > 100_000);
}

#[test]
fn every_triangle_on_a_small_grid() {
    let machine = common::machine(&[
        ("screen.width", "5"),
        ("screen.height", "5"),
        ("screen.guard_bits", "3"),
        ("screen.subpixel_bits", "0"),
        ("edge.fill", "textbook"),
    ]);
    let mut rng = StdRng::seed_from_u64(2);
    for origin in [-2, 0, 2] {
        let triangles: Vec<_> = (0..25 * 25 * 25)
            .map(|i| {
                [i % 25, i / 25 % 25, i / 625].map(|k| {
                    let values = random_values(&machine, &mut rng);
                    machine.raw_vertex(origin + k % 5, origin + k / 5, &values)
                })
            })
            .collect();
        let checked = compare(&machine, &triangles);
        println!("grid at {origin}: {checked} fragments as in the listing");
        assert!(checked > 10_000);
    }
}

/// A 5x5 square cut along its diagonal: the textbook draws the diagonal twice.
#[test]
fn the_square_cut_in_two_shares_its_diagonal() {
    let machine = Plan::preset("textbook").expect("a preset");
    let v = |x, y| machine.raw_vertex(x, y, &[]);
    let square = [[v(10, 10), v(14, 10), v(10, 14)], [v(14, 10), v(14, 14), v(10, 14)]];
    let frame = render(&machine, &square, ALWAYS, Stalls::NONE);
    let at = |x: usize, y: usize| frame.coverage[y * 640 + x];
    for y in 10..=14 {
        for x in 10..=14 {
            assert_eq!(at(x, y), if x + y == 24 { 2 } else { 1 }, "({x}, {y})");
        }
    }
    assert_eq!(frame.coverage.iter().sum::<u32>(), 15 + 15);
}

/// The slopes of the preset: a span may end a pixel off only where X + 1/2 comes as near to a whole number as bound 5 says.
#[test]
fn slope_edges_differ_from_the_listing_within_their_bound() {
    let mut rng = StdRng::seed_from_u64(3);
    let (mut checked, mut differ) = (0, 0);
    for fraction in [2, 6, 16, 24] {
        let mut machine = Machine::preset("textbook").expect("a preset");
        (machine.width, machine.height, machine.edge_fraction) = (80, 60, fraction);
        let machine = machine.plan().expect("can be built");
        let triangles: Vec<_> = (0..200).map(|_| random(&machine, 40, &mut rng)).collect();
        let mut drawn: HashMap<(usize, i64, i64), i32> = HashMap::new();
        common::fragments(&machine, &triangles, |id, (x, y), _| *drawn.entry((id, x, y)).or_default() += 1);
        for (number, triangle) in triangles.iter().enumerate() {
            for pixel in listing(&machine, triangle) {
                *drawn.entry((number, pixel.x, pixel.y)).or_default() -= 1;
                checked += 1;
            }
        }
        for ((number, x, y), _) in drawn.into_iter().filter(|(_, count)| *count != 0) {
            // The rule decides by X_start + 1/2 < x + 1 and by X_end + 1/2 >= x.
            let explained = rows(&machine, &triangles[number]).iter().any(|row| {
                let bound = row.lines.map(|lines| Q::new(lines + 1, 2 << fraction));
                let whole = [x + 1, x].map(|x| Q::from_integer(i128::from(x)));
                row.y == y
                    && (0..2)
                        .any(|i| whole[i] - bound[i] <= row.ends[i] && row.ends[i] <= whole[i] + bound[i])
            });
            assert!(explained, "({x}, {y}) of {:?}, F = {fraction}", triangles[number]);
            differ += 1;
        }
    }
    println!("{differ} of {checked} fragments differ");
    assert!(checked > 100_000 && differ > 0);
}
