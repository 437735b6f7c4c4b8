//! Coverage against the rule stated line by line, in rationals: what the half-planes must amount to.

use edgewalk_golden::{Fill, draw, fragments, snap};
use edgewalk_scene::{Frame, ShadeMode, Triangle, Vertex};
use num_rational::Ratio;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use std::collections::BTreeSet;

type Pixels = BTreeSet<(u32, u32)>;

fn triangle(points: [[f64; 2]; 3]) -> Triangle {
    Triangle(points.map(|[x, y]| Vertex { x, y, ..Vertex::default() }))
}

fn covered(triangle: &Triangle, bits: u32, screen: (u32, u32)) -> Pixels {
    let mut pixels = Pixels::new();
    fragments(triangle, ShadeMode::Gouraud, bits, screen, |f| {
        assert!(pixels.insert((f.x, f.y)), "pixel {} {} drawn twice by one triangle", f.x, f.y);
    });
    pixels
}

/// y_top <= y + 1/2 < y_bottom and x_left <= x + 1/2 < x_right, with each crossing a rational.
fn by_lines(triangle: &Triangle, bits: u32, (width, height): (u32, u32)) -> Pixels {
    let unit = 1i128 << bits;
    let coordinate = |c: f64| Ratio::new(i128::from(snap(c, bits)), unit);
    let points = triangle.0.map(|v| [coordinate(v.x), coordinate(v.y)]);
    let centre = |pixel: u32| Ratio::new(2 * i128::from(pixel) + 1, 2);
    let mut pixels = Pixels::new();
    for y in 0..height {
        let line = centre(y);
        let mut crossings = Vec::new();
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let [top, bottom] = if points[a][1] < points[b][1] { [a, b] } else { [b, a] }.map(|p| points[p]);
            if top[1] <= line && line < bottom[1] {
                crossings.push(top[0] + (line - top[1]) * (bottom[0] - top[0]) / (bottom[1] - top[1]));
            }
        }
        crossings.sort();
        if let [left, right] = crossings[..] {
            pixels.extend((0..width).filter(|x| left <= centre(*x) && centre(*x) < right).map(|x| (x, y)));
        }
    }
    pixels
}

#[test]
fn every_triangle_on_a_small_grid() {
    // Centres, corners and edges of 3x3 pixels, and beyond them on all sides.
    let grid: Vec<[f64; 2]> =
        (-1..=6).flat_map(|x| (-1..=6).map(move |y| [x, y].map(|c| f64::from(c) / 2.0))).collect();
    let (mut triangles, mut pixels) = (0, 0);
    for (i, a) in grid.iter().enumerate() {
        for (j, b) in grid.iter().enumerate().skip(i) {
            for c in &grid[j..] {
                let expected = by_lines(&triangle([*a, *b, *c]), 1, (3, 3));
                for points in [[*a, *b, *c], [*b, *a, *c]] {
                    assert_eq!(covered(&triangle(points), 1, (3, 3)), expected, "{points:?}");
                }
                triangles += 1;
                pixels += expected.len();
            }
        }
    }
    println!("{triangles} triangles in both windings, {pixels} pixels");
    assert_eq!(triangles, 64 * 65 * 66 / 6);
    assert!(pixels > 10_000);
}

#[test]
fn random_triangles_slivers_and_giants() {
    let mut rng = Pcg64::seed_from_u64(1);
    let screen = (48, 32);
    let mut pixels = 0;
    for k in 0..3000 {
        let bits = k % 9;
        let reach = [3.0, 30.0, 300.0, 1e6][k as usize / 9 % 4];
        let mut points: [[f64; 2]; 3] =
            std::array::from_fn(|_| [24.0, 16.0].map(|middle| middle + rng.random_range(-reach..reach)));
        if k % 2 == 0 {
            // A sliver: the third vertex a few sub-pixels off the line of the others.
            let t = rng.random_range(-0.5..1.5);
            points[2] = std::array::from_fn(|axis| {
                let on = points[0][axis] + t * (points[1][axis] - points[0][axis]);
                (on + rng.random_range(-0.02..0.02)).clamp(-1e6, 1e6)
            });
        }
        let expected = by_lines(&triangle(points), bits, screen);
        assert_eq!(covered(&triangle(points), bits, screen), expected, "{bits} bits, {points:?}");
        pixels += expected.len();
    }
    println!("{pixels} pixels");
    assert!(pixels > 100_000);
}

#[test]
fn square_cut_in_two_gives_15_and_10_pixels() {
    // Corners on pixel centres, then on pixel corners: the diagonal's pixels go to the triangle on its right.
    for (corner, bits, sizes) in [(0.5, 1, (15, 10)), (0.0, 0, (10, 15))] {
        let at = |x: f64, y: f64| [x + corner, y + corner];
        let upper_left = triangle([at(0.0, 0.0), at(5.0, 0.0), at(0.0, 5.0)]);
        let lower_right = triangle([at(5.0, 0.0), at(5.0, 5.0), at(0.0, 5.0)]);
        let [first, second] = [upper_left, lower_right].map(|t| covered(&t, bits, (8, 8)));
        assert_eq!((first.len(), second.len()), sizes);
        assert_eq!((&first | &second).len(), 25);
    }
}

#[test]
fn fan_covers_each_pixel_once() {
    let mut rng = Pcg64::seed_from_u64(2);
    for _ in 0..50 {
        // A hub on a pixel centre, its neighbours all around: the worst vertex to share.
        let hub = [10.5, 10.5];
        let spokes: Vec<[f64; 2]> = (0..9)
            .map(|k| {
                let angle = f64::from(k) * std::f64::consts::TAU / 9.0;
                let length = rng.random_range(2.0..12.0);
                [hub[0] + length * angle.cos(), hub[1] + length * angle.sin()]
            })
            .collect();
        let mut frame = Frame::new(24, 24);
        frame.triangles = (0..9).map(|k| triangle([hub, spokes[k], spokes[(k + 1) % 9]])).collect();
        let picture = draw(&frame, Fill::Exact { subpixel_bits: 8 });
        assert_eq!(picture.coverage.iter().max(), Some(&1));
        assert_eq!(picture.coverage[10 * 24 + 10], 1, "the hub belongs to one of them");
    }
}

#[test]
fn translating_permuting_and_splitting_keep_the_pixels() {
    let mut rng = Pcg64::seed_from_u64(3);
    let screen = (64, 64);
    let mut pixels = 0;
    for _ in 0..300 {
        let [a, b, c]: [[f64; 2]; 3] =
            std::array::from_fn(|_| std::array::from_fn(|_| f64::from(rng.random_range(0..40 * 16)) / 16.0));
        let whole = covered(&triangle([a, b, c]), 8, screen);
        pixels += whole.len();
        for points in [[b, c, a], [c, a, b], [a, c, b], [b, a, c], [c, b, a]] {
            assert_eq!(covered(&triangle(points), 8, screen), whole);
        }
        let moved = covered(&triangle([a, b, c].map(|[x, y]| [x + 17.0, y + 5.0])), 8, screen);
        assert_eq!(moved, whole.iter().map(|(x, y)| (x + 17, y + 5)).collect());
        // The middle of an edge is a sub-pixel again, so both parts have exactly the edges of the whole.
        let middle = [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
        let [one, other] =
            [[a, middle, c], [middle, b, c]].map(|points| covered(&triangle(points), 8, screen));
        assert!(one.is_disjoint(&other));
        assert_eq!(&one | &other, whole);
    }
    assert!(pixels > 10_000);
}

#[test]
fn vertices_snap_to_the_nearest_half_to_even() {
    let cases = [
        (0.5, 0, 0),
        (1.5, 0, 2),
        (-0.5, 0, 0),
        (-1.5, 0, -2),
        (0.125, 2, 0),
        (0.375, 2, 2),
        (-1e6, 8, -256_000_000),
    ];
    for (coordinate, bits, expected) in cases {
        assert_eq!(snap(coordinate, bits), expected, "{coordinate} to {bits} bits");
    }
}
