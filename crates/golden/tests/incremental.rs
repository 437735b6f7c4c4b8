//! Attributes by addition against the plane, the formulae of the slides, and the worked example of the notes.
#![allow(clippy::unwrap_used)] // what is looked for is there

use edgewalk_golden::{Fragment, Half, Incremental, Weights, fragments, half_triangles};
use edgewalk_scene::{ShadeMode, Triangle, Vertex};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

fn triangle(corners: [[f64; 2]; 3]) -> Triangle {
    Triangle(corners.map(|[x, y]| Vertex { x, y, ..Vertex::default() }))
}

fn random(rng: &mut Pcg64) -> (Triangle, [[f64; 2]; 3]) {
    let corners = std::array::from_fn(|_| std::array::from_fn(|_| rng.random_range(-20.0..140.0f64).round()));
    (triangle(corners), std::array::from_fn(|_| std::array::from_fn(|_| rng.random_range(-1.0..1.0))))
}

/// No more than some hundred roundings of values up to 1, times the steepness of slivers.
#[test]
fn additions_stay_on_the_plane_in_both_fills() {
    let mut rng = Pcg64::seed_from_u64(7);
    let (mut checked, mut worst) = (0, 0.0f64);
    for _ in 0..300 {
        let (triangle, values) = random(&mut rng);
        let mut check = |stepped: &[f64; 2], f: &Fragment| {
            let weights = Weights::linear(f);
            for (k, value) in stepped.iter().enumerate() {
                worst = worst.max((value - weights.of(values.map(|v| v[k]))).abs());
            }
            checked += 1;
        };
        let screen = (128, 128);
        let mut exact = Incremental::new(values);
        fragments(&triangle, ShadeMode::Gouraud, 8, screen, |f| check(exact.step(f), f));
        let mut textbook = Incremental::new(values);
        half_triangles(&triangle, ShadeMode::Gouraud, screen, |_, f| check(textbook.step(f), f));
    }
    println!("{checked} fragments, worst {worst:e}");
    assert!(checked > 100_000);
    assert!(worst < 1e-12);
    assert!(worst > 0.0, "additions that never round were not additions");
}

/// S15: l_a and l_b along the edges, l_p along the scan line, as the slides has them.
#[test]
fn bilinear_formulae_of_the_lecture_are_the_plane() {
    let mut rng = Pcg64::seed_from_u64(8);
    let (mut checked, mut worst) = (0, 0.0f64);
    for _ in 0..300 {
        let (triangle, values) = random(&mut rng);
        let mut corners: Vec<[f64; 3]> =
            triangle.0.iter().zip(values).map(|(v, [l, _])| [v.x, v.y, l]).collect();
        corners.sort_by(|a, b| a[1].total_cmp(&b[1]));
        fragments(&triangle, ShadeMode::Gouraud, 8, (128, 128), |f| {
            let (x_p, y_s) = (f64::from(f.x) + 0.5, f64::from(f.y) + 0.5);
            // Point 1 is the one both edges that are cut share: the lower or the upper end.
            let (one, other) = if y_s < corners[1][1] { (0, 2) } else { (2, 0) };
            let ([x1, y1, l1], [x2, y2, l2], [x3, y3, l3]) = (corners[one], corners[1], corners[other]);
            let along = |v1: f64, v: f64, y: f64| v1 * (y_s - y) / (y1 - y) + v * (y1 - y_s) / (y1 - y);
            let (x_a, l_a) = (along(x1, x2, y2), along(l1, l2, y2));
            let (x_b, l_b) = (along(x1, x3, y3), along(l1, l3, y3));
            let l_p = l_a * (x_b - x_p) / (x_b - x_a) + l_b * (x_p - x_a) / (x_b - x_a);
            worst = worst.max((l_p - Weights::linear(f).of(values.map(|v| v[0]))).abs());
            checked += 1;
        });
    }
    println!("{checked} fragments, worst {worst:e}");
    assert!(checked > 100_000 && worst < 1e-10);
}

/// Intensities 0.9, 0.2, 0.3 at y = 10, 20, 30; on line 15 the edges are at x = 10.5 and x = 20.
const EXAMPLE: [[f64; 2]; 3] = [[16.0, 10.0], [5.0, 20.0], [32.0, 30.0]];
const INTENSITIES: [[f64; 1]; 3] = [[0.9], [0.2], [0.3]];

/// The value at the left edge of each line, and all values of line 15, as the listing of ch. 7.10 steps them.
fn walk(corners: [[f64; 2]; 3], half: Half) -> (Vec<f64>, Vec<f64>) {
    let mut stepped = Incremental::new(INTENSITIES);
    let (mut starts, mut line_15, mut last_line) = (Vec::new(), Vec::new(), None);
    half_triangles(&triangle(corners), ShadeMode::Gouraud, (64, 64), |drawn, f| {
        let [value] = *stepped.step(f);
        if drawn == half && last_line.replace(f.y) != Some(f.y) {
            starts.push(value);
        }
        if drawn == half && f.y == 15 {
            line_15.push(value);
        }
    });
    (starts, line_15)
}

/// The notes. Its last sentence has the line end "with the value 0.15": a misprint for 0.75. It counts 20 - 10.5 = 9.5
/// pixels as 10 steps, hence its 0.02; the plane rises by 0.2 / 9.5 a pixel.
#[test]
fn worked_example_of_seed_c() {
    let near =
        |value: f64, expected: f64| assert!((value - expected).abs() < 1e-12, "{value}, not {expected}");
    let steps = |starts: &[f64], expected: f64| {
        assert_eq!(starts.len(), 11);
        starts.windows(2).for_each(|pair| near(pair[1] - pair[0], expected));
    };
    let (p1_p2, line_15) = walk(EXAMPLE, Half::First);
    steps(&p1_p2, -0.07);
    steps(&walk(EXAMPLE, Half::Second).0, 0.01);
    // The mirror image has the long edge on the left.
    let mirrored = EXAMPLE.map(|[x, y]| [40.0 - x, y]);
    steps(&walk(mirrored, Half::First).0, -0.03);

    near(line_15[0], 0.55);
    near(walk(mirrored, Half::First).1[0], 0.75);
    assert_eq!(line_15.len(), 10, "pixels 11 to 20");
    let per_pixel = line_15[1] - line_15[0];
    near(line_15[0] + 9.5 * per_pixel, 0.75);
    near(per_pixel * 9.5 / 10.0, 0.02);
    near(0.55 + 10.0 * 0.02, 0.75);
}
