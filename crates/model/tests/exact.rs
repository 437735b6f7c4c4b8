//! Exact fill with exact edges: coverage equal to the rule at every pixel; z within 1 LSB of 24 bits and colour within
//! 1 LSB of 8 bits of the exact value, and within the proved bound.

use crate::common::{Check, Triangle, machine, moved, random_triangle, random_values};
use edgewalk_machine::Plan;
use edgewalk_model::{Events, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};

fn check(name: &str, machine: &Plan, triangles: &[Triangle]) -> (Vec<u32>, Events) {
    let (check, frame) = Check::run(machine, triangles, Stalls::NONE);
    check.report(name);
    check.passes();
    assert!(frame.counters.add_up());
    assert_eq!(frame.counters.triangles, triangles.len() as u64);
    assert_eq!(frame.coverage, check.count, "counted at the reads");
    (check.count, frame.events)
}

#[test]
fn triangles_of_all_sizes() {
    let machine = Plan::default();
    let mut rng = StdRng::seed_from_u64(1);
    let triangles: Vec<_> = (0..4000)
        .map(|_| {
            let size = 2f64.powf(rng.random_range(-6.0..9.5));
            random_triangle(&machine, size, &mut rng)
        })
        .collect();
    check("all sizes", &machine, &triangles);
}

#[test]
fn slivers_down_to_a_256th_of_a_pixel() {
    let machine = Plan::default();
    let mut rng = StdRng::seed_from_u64(2);
    let triangles: Vec<_> = (0..4000)
        .map(|_| {
            let mut triangle = random_triangle(&machine, 400.0, &mut rng);
            let along = f64::from(rng.random_range(0..=4u8)) / 4.0;
            let between = |a: i32, b: i32| (f64::from(a) + along * f64::from(b - a)).round() as i32;
            let x = between(triangle[0].x(), triangle[1].x()) + rng.random_range(-3..=3);
            let y = between(triangle[0].y(), triangle[1].y()) + rng.random_range(-3..=3);
            triangle[2] = moved(&machine, &triangle[2], x, y);
            triangle
        })
        .collect();
    let (_, events) = check("slivers", &machine, &triangles);
    assert!(events.edge.wrap > 0 && events.span.empty_span > 0, "no sliver: {events:?}");
}

#[test]
fn triangles_that_reach_to_the_guard_band() {
    let machine = Plan::default();
    let mut rng = StdRng::seed_from_u64(3);
    let limit = ((1 << machine.guard_bits) - 1) << machine.subpixel_bits;
    let triangles: Vec<_> = (0..120)
        .map(|_| {
            let mut triangle = random_triangle(&machine, 600.0, &mut rng);
            for corner in &mut triangle {
                let (mut x, mut y) = (corner.x(), corner.y());
                if rng.random_bool(0.6) {
                    x = rng.random_range(-limit..=limit);
                }
                if rng.random_bool(0.6) {
                    y = rng.random_range(-limit..=limit);
                }
                if rng.random_bool(0.2) {
                    x = if rng.random_bool(0.5) { limit } else { -limit };
                }
                *corner = moved(&machine, corner, x, y);
            }
            triangle
        })
        .collect();
    let (_, events) = check("guard band", &machine, &triangles);
    assert!(events.pixel.off_screen > 0 && events.span.scissor_cut > 0, "none left the screen: {events:?}");
}

/// Every triple of points of a 5x5 grid at half-pixel pitch, degenerate ones too, on and over the screen's border.
#[test]
fn every_triangle_on_a_small_grid() {
    let mut events = Events::default();
    for (s, corner, name) in
        [("8", 1.0, "inside"), ("1", -1.0, "over the top left"), ("8", 5.5, "over the bottom right")]
    {
        let machine = machine(&[
            ("screen.width", "7"),
            ("screen.height", "7"),
            ("screen.guard_bits", "4"),
            ("screen.subpixel_bits", s),
        ]);
        let mut rng = StdRng::seed_from_u64(4);
        let half = 1 << (machine.subpixel_bits - 1);
        let origin = (corner * f64::from(2 * half)) as i32;
        let at = |i: i32| [origin + i % 5 * half, origin + i / 5 * half];
        let triangles: Vec<_> = (0..25 * 25 * 25)
            .map(|i| {
                [i % 25, i / 25 % 25, i / 625]
                    .map(|k| machine.raw_vertex(at(k)[0], at(k)[1], &random_values(&machine, &mut rng)))
            })
            .collect();
        events.merge(&check(name, &machine, &triangles).1);
    }
    assert!(
        events.setup.culled_area > 0
            && events.setup.culled_lines > 0
            && events.setup.culled_columns > 0
            && events.setup.knee_on_line > 0,
        "{events:?}"
    );
    assert!(events.setup.no_upper_part > 0 && events.setup.no_lower_part > 0, "{events:?}");
}

/// A screen tiled by triangles of either winding: every pixel once, whatever the edges.
#[test]
fn a_tiled_screen_is_drawn_once() {
    for s in ["0", "1", "4", "8"] {
        let machine =
            machine(&[("screen.width", "64"), ("screen.height", "64"), ("screen.subpixel_bits", s)]);
        let mut rng = StdRng::seed_from_u64(5);
        let one = 1 << machine.subpixel_bits;
        let side = 17usize; // tiles of 5 px, from -8 px on
        let points: Vec<[i32; 2]> = (0..side * side)
            .map(|i| [i % side, i / side].map(|c| (c as i32 * 5 - 8) * one + rng.random_range(-one..=one)))
            .collect();
        let mut triangles = Vec::new();
        for row in 0..side - 1 {
            for column in 0..side - 1 {
                let i = row * side + column;
                for tile in [[i, i + 1, i + side], [i + side + 1, i + side, i + 1]] {
                    let mut tile = tile.map(|k| {
                        machine.raw_vertex(points[k][0], points[k][1], &random_values(&machine, &mut rng))
                    });
                    if rng.random_bool(0.5) {
                        tile.swap(0, 1);
                    }
                    triangles.push(tile);
                }
            }
        }
        let (count, _) = check("tiles", &machine, &triangles);
        assert!(count.iter().all(|c| *c == 1), "s = {s}");
    }
}

/// Fans around a point, all the way round, of any number of triangles: once inside, never outside.
#[test]
fn a_fan_is_drawn_once() {
    let machine = machine(&[("screen.width", "64"), ("screen.height", "64")]);
    let mut rng = StdRng::seed_from_u64(6);
    for _ in 0..30 {
        let blades = rng.random_range(3..40);
        let centre =
            machine.raw_vertex(rng.random_range(24..40) * 256, rng.random_range(24..40) * 256 + 128, &[]);
        let rim: Vec<_> = (0..blades)
            .map(|i| {
                let turn = f64::from(i) / f64::from(blades) * std::f64::consts::TAU;
                let radius = rng.random_range(10.0..24.0) * 256.0;
                let x = centre.x() + (turn.cos() * radius) as i32;
                let y = centre.y() + (turn.sin() * radius) as i32;
                machine.raw_vertex(x, y, &random_values(&machine, &mut rng))
            })
            .collect();
        let fan: Vec<_> = (0..rim.len()).map(|i| [centre, rim[i], rim[(i + 1) % rim.len()]]).collect();
        let (count, _) = check("fan", &machine, &fan);
        assert!(count.iter().all(|c| *c <= 1));
    }
}

#[test]
fn closed_meshes_cover_every_pixel_an_even_number_of_times() {
    let machine = machine(&[("screen.width", "100"), ("screen.height", "80")]);
    let mut rng = StdRng::seed_from_u64(7);
    // An octahedron with its corners anywhere: it folds over itself, and stays closed.
    for _ in 0..60 {
        let corner: Vec<_> = (0..2).flat_map(|_| random_triangle(&machine, 90.0, &mut rng)).collect();
        let mut faces = Vec::new();
        for i in 0..4 {
            faces.push([corner[4], corner[i], corner[(i + 1) % 4]]);
            faces.push([corner[5], corner[(i + 1) % 4], corner[i]]);
        }
        let (count, _) = check("octahedron", &machine, &faces);
        assert!(count.iter().all(|c| c % 2 == 0));
    }
}
