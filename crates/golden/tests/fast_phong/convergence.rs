//! Third order: halving a triangle divides the error by about eight, and what breaks that.

use super::cases::{Case, cone, direction, quantile};
use edgewalk_golden::fast_phong::Quadratic;
use glam::DVec2;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const LEVELS: usize = 4;
const TRIANGLES: usize = 400;

/// Normals within a cone of 3 to 17 degrees; unit vectors, or up to a fifth longer and shorter.
fn random_case(random: &mut Pcg64Mcg, unit: bool) -> Case {
    let width = random.random_range(0.05..0.3);
    let stretch = |random: &mut Pcg64Mcg| if unit { 1.0 } else { random.random_range(0.8..1.2) };
    let normals = cone(random, width).map(|normal| normal * stretch(random));
    let points = [DVec2::ZERO, DVec2::new(32.0, 5.0), DVec2::new(11.0, 29.0)];
    Case { points, normals, light: direction(random) }
}

/// Largest errors of a triangle halved 0, 1, ... times.
fn errors(case: Case, fit: impl Fn(&Case) -> Quadratic) -> [f64; LEVELS] {
    let mut pieces = vec![case];
    std::array::from_fn(|_| {
        let error = pieces.iter().map(|piece| piece.error(&fit(piece))).fold(0.0, f64::max);
        pieces = pieces.iter().flat_map(Case::halves).collect();
        error
    })
}

/// The median over random triangles of what each halving divides the error by; prints the quantiles too.
fn ratios(name: &str, unit: bool, fit: impl Fn(&Case) -> Quadratic) -> [f64; LEVELS - 1] {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let levels: Vec<_> = (0..TRIANGLES).map(|_| errors(random_case(&mut random, unit), &fit)).collect();
    std::array::from_fn(|k| {
        let mut ratios: Vec<f64> = levels.iter().map(|error| error[k] / error[k + 1]).collect();
        let [low, median, high] = [0.05, 0.5, 0.95].map(|share| quantile(&mut ratios, share));
        println!("{name}, halving {}: error / {median:.2}, 9 of 10 in {low:.2} to {high:.2}", k + 1);
        median
    })
}

#[test]
fn halving_a_triangle_divides_the_error_by_eight() {
    for unit in [true, false] {
        let lengths = if unit { "unit normals" } else { "normals of any length" };
        for (fit, medians) in [
            ("Taylor", ratios(&format!("Taylor, {lengths}"), unit, Case::taylor)),
            ("six points", ratios(&format!("six points, {lengths}"), unit, Case::six_point)),
        ] {
            // Terms of fourth order count at first, and halve with every halving.
            let near = medians.iter().zip([1.6, 0.8, 0.4]).all(|(ratio, off)| (ratio - 8.0).abs() < off);
            assert!(near, "{fit}, {lengths}: {medians:?}");
        }
    }
}

/// The Taylor series with the T5 that circulates: 3 i g² where 3 c g² is right.
fn misprinted(case: &Case) -> Quadratic {
    let plane = case.plane();
    let (c, i, g) = (case.light.dot(plane.c), plane.c.length_squared(), 2.0 * plane.a.dot(plane.c));
    let mut quadratic = case.taylor();
    quadratic.t[5] += 3.0 * (i - c) * g * g / (8.0 * i * i * i.sqrt());
    quadratic
}

#[test]
fn the_misprinted_coefficient_is_of_second_order_only() {
    let medians = ratios("misprinted T5, normals of any length", false, misprinted);
    assert!(medians[LEVELS - 2] < 5.0, "{medians:?}");
    // With unit normals A·C is itself of second order, and on the first triangle the misprint hides.
    ratios("misprinted T5, unit normals", true, misprinted);
    let mut random = Pcg64Mcg::seed_from_u64(4);
    for unit in [true, false] {
        let mut worse: Vec<f64> = (0..TRIANGLES)
            .map(|_| random_case(&mut random, unit))
            .map(|case| case.error(&misprinted(&case)) / case.error(&case.taylor()))
            .collect();
        let [median, most] = [0.5, 1.0].map(|share| quantile(&mut worse, share));
        println!("misprinted T5, unit normals {unit}: error times {median:.3} (median), {most:.1} (worst)");
        assert!(unit || median > 2.0, "{median}");
    }
}

#[test]
fn the_misprint_scales_with_the_normals() {
    // The cosine does not change when all normals are twice as long, and no right coefficient does.
    let mut random = Pcg64Mcg::seed_from_u64(5);
    for _ in 0..1000 {
        let case = random_case(&mut random, false);
        let twice = Case { normals: case.normals.map(|normal| 2.0 * normal), ..case };
        for (a, b) in case.taylor().t.into_iter().zip(twice.taylor().t) {
            assert!((a - b).abs() < 1e-14, "{case:?}");
        }
        assert!((misprinted(&case).t[5] - misprinted(&twice).t[5]).abs() > 1e-12, "{case:?}");
    }
}

#[test]
fn how_much_better_six_points_are() {
    let mut random = Pcg64Mcg::seed_from_u64(6);
    let mut better: Vec<f64> = (0..4 * TRIANGLES)
        .map(|_| random_case(&mut random, true))
        .map(|case| case.error(&case.taylor()) / case.error(&case.six_point()))
        .collect();
    let [low, median, high] = [0.05, 0.5, 0.95].map(|share| quantile(&mut better, share));
    println!("Taylor's error over that of six points: {median:.2}, 9 of 10 in {low:.2} to {high:.2}");
    assert!(low > 2.0 && median > 3.0, "{low} {median}");
}

#[test]
fn six_points_agree_along_a_shared_edge() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (mut six_point, mut taylor, mut checked) = (0f64, 0f64, 0);
    for _ in 0..TRIANGLES {
        let left = random_case(&mut random, true);
        let [p, q, _] = left.points;
        let fourth = (left.normals[0] + 0.3 * direction(&mut random)).normalize();
        let right = Case {
            points: [q, p, DVec2::new(20.0, -17.0)],
            normals: [left.normals[1], left.normals[0], fourth],
            light: left.light,
        };
        for step in 0..=20 {
            let point = p.lerp(q, f64::from(step) / 20.0);
            let gap = |fit: fn(&Case) -> Quadratic| (fit(&left).at(point) - fit(&right).at(point)).abs();
            six_point = six_point.max(gap(Case::six_point));
            taylor = taylor.max(gap(Case::taylor));
            checked += 1;
        }
    }
    println!(
        "along {checked} points of shared edges: six points differ by {six_point:.1e}, Taylor by {taylor:.4}"
    );
    assert!(six_point < 1e-13 && taylor > 1e-3, "{six_point} {taylor}");
}
