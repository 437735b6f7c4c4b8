//! Textbook fill against the listing of chapter 7 in exact fractions: inclusive lines and spans, +0.5, Trunc.

mod common;

use common::{ALWAYS, Triangle, outputs, place, random_machine, random_values, vertex};
use edgewalk_model::{Event, Stalls, render_with};
use edgewalk_numerics::{Machine, PortVertex};
use num_rational::Ratio;
use rand::{Rng, SeedableRng, rngs::StdRng};

type Q = Ratio<i128>;

/// A fragment of the listing: pixel, exact Z, R, G, B in LSB, and the additions that led there.
struct Pixel {
    x: i64,
    y: i64,
    value: [Q; 4],
    steps: i128,
}

/// The listing (A 7.10), part by part; what is off the screen is left out.
fn listing(machine: &Machine, triangle: &Triangle) -> Vec<Pixel> {
    let mut corner = *triangle;
    corner.sort_by_key(|v| v.y);
    let [a, b, c] = corner;
    let whole = |v: i32| Q::from_integer(i128::from(v));
    let cross = whole(b.x - a.x) * whole(c.y - a.y) - whole(c.x - a.x) * whole(b.y - a.y);
    let mut pixels = Vec::new();
    if cross == whole(0) {
        return pixels;
    }
    let knee_left = cross < whole(0);
    let mut walked = 0;
    for (upper, lower) in [(a, b), (b, c)] {
        if upper.y == lower.y {
            continue;
        }
        let (left, right) = if knee_left { ((upper, lower), (a, c)) } else { ((a, c), (upper, lower)) };
        let first = upper.y.max(0);
        for y in first..=lower.y.min(machine.height as i32 - 1) {
            let along = |e: (PortVertex, PortVertex), from: Q, to: Q| {
                from + (to - from) * whole(y - e.0.y) / whole(e.1.y - e.0.y)
            };
            let x_on = |e: (PortVertex, PortVertex)| {
                (along(e, whole(e.0.x), whole(e.1.x)) + Q::new(1, 2)).floor().to_integer()
            };
            let (start, end) = (x_on(left), x_on(right));
            for x in start.max(start)..=end {
                if x < 0 || x >= i128::from(machine.width) {
                    continue;
                }
                let value = std::array::from_fn(|i| {
                    let one = 1i128 << machine.channels()[i].vertex_fraction;
                    let [va, vb, vc] = corner.map(|v| Q::new(i128::from(v.value[i]), one));
                    let gradient = ((vb - va) * whole(c.y - a.y) - (vc - va) * whole(b.y - a.y)) / cross;
                    let of = |v: PortVertex| Q::new(i128::from(v.value[i]), one);
                    along(left, of(left.0), of(left.1)) + gradient * Q::from_integer(x - start)
                });
                let lines = if knee_left { y - first } else { walked };
                pixels.push(Pixel {
                    x: x as i64,
                    y: i64::from(y),
                    value,
                    steps: i128::from(lines) + x - start,
                });
            }
            walked += i32::from(y < lower.y);
        }
    }
    pixels
}

fn compare(machine: &Machine, triangles: &[Triangle]) -> usize {
    let mut drawn = Vec::new();
    let hook = |event: Event| {
        if let Event::Fragment(f) = event {
            drawn.push((f.source.id as usize, place(machine, f.addr), outputs(f)));
        }
    };
    render_with(machine, triangles.iter().copied(), ALWAYS, Stalls::NONE, hook);
    let mut drawn = drawn.into_iter();
    let mut checked = 0;
    for (number, triangle) in triangles.iter().enumerate() {
        for pixel in listing(machine, triangle) {
            let (id, at, output) = drawn.next().expect("as many fragments as in the listing");
            assert_eq!((id, at), (number, (pixel.x, pixel.y)), "{triangle:?} in {machine:?}");
            for (i, channel) in machine.channels().into_iter().enumerate() {
                let turn = Q::from_integer(1 << channel.bits);
                let error = pixel.value[i] - Q::from_integer(i128::from(output[i]));
                let error = error - (error / turn + Q::new(1, 2)).floor() * turn; // modulo 2^b
                let bound = Q::new(1, 2) + Q::new(1 + pixel.steps, 2 << channel.fraction);
                let error = if error < Q::from_integer(0) { -error } else { error };
                assert!(error <= bound, "channel {i}: {error} LSB at {at:?} of {triangle:?} in {machine:?}");
            }
            checked += 1;
        }
    }
    assert_eq!(drawn.next(), None, "a fragment too many");
    checked
}

fn random(machine: &Machine, size: i32, rng: &mut impl Rng) -> Triangle {
    let limit = (1 << machine.guard_bits) - 1;
    let middle = [machine.width, machine.height].map(|side| rng.random_range(0..side as i32));
    std::array::from_fn(|_| {
        let [x, y] = middle.map(|m| (m + rng.random_range(-size..=size)).clamp(-limit, limit));
        vertex(x, y, random_values(machine, rng))
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
                [i % 25, i / 25 % 25, i / 625]
                    .map(|k| vertex(origin + k % 5, origin + k / 5, random_values(&machine, &mut rng)))
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
    let machine = Machine::preset("textbook").expect("a preset");
    let v = |x, y| vertex(x, y, [0; 4]);
    let square = [[v(10, 10), v(14, 10), v(10, 14)], [v(14, 10), v(14, 14), v(10, 14)]];
    let frame = edgewalk_model::render(&machine, square, ALWAYS, Stalls::NONE);
    let at = |x: usize, y: usize| frame.coverage[y * 640 + x];
    for y in 10..=14 {
        for x in 10..=14 {
            assert_eq!(at(x, y), if x + y == 24 { 2 } else { 1 }, "({x}, {y})");
        }
    }
    assert_eq!(frame.coverage.iter().sum::<u32>(), 15 + 15);
}
