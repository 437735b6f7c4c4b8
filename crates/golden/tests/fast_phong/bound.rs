//! The error at every pixel against bound 10.

use super::cases::{Case, cone, direction};
use edgewalk_golden::fast_phong::{Quadratic, Walk};
use edgewalk_golden::{Weights, fragments};
use edgewalk_numerics::normal_cone::{six_point_error, taylor_error};
use edgewalk_scene::{ShadeMode, Triangle, Vertex};
use glam::{DVec2, DVec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SUBPIXEL_BITS: u32 = 8;
const SCREEN: (u32, u32) = (24, 24);

/// On a grid of 1/256 pixel, cones from 1/10 of a degree to 60, lengths of the normals alike or not.
fn random_case(random: &mut Pcg64Mcg) -> Case {
    let mut snapped = |most: i32| f64::from(random.random_range(0..=most * 256)) / 256.0;
    let corner = DVec2::new(snapped(16), snapped(16));
    let points = [corner, corner + DVec2::new(snapped(8), snapped(8)), DVec2::new(snapped(24), snapped(24))];
    let width = 10f64.powf(random.random_range(-2.75..0.0));
    let mut normals = cone(random, width);
    if random.random() {
        normals = normals.map(|n| n * (1.0 + width * random.random_range(-0.5..0.5)));
    }
    Case { points, normals, light: direction(random) }
}

/// What f64 loses: every value of the walk is a sum of terms no larger than these, a few hundred roundings each.
fn rounding(quadratic: &Quadratic) -> f64 {
    let [t0, t1, t2, t3, t4, t5] = quadratic.t.map(f64::abs);
    let reach = f64::from(SCREEN.0);
    500.0 * f64::EPSILON * (((t5 + t4 + t3) * reach + t2 + t1) * reach + t0)
}

#[test]
fn a_hundred_thousand_triangles_stay_under_bound_10_at_every_pixel() {
    const EXPECTED: u32 = 100_000;
    let mut random = Pcg64Mcg::seed_from_u64(2);
    let (mut checked, mut slivers, mut pixels) = (0, 0, 0u64);
    let mut reached = [0f64; 2];
    while checked < EXPECTED {
        let case = random_case(&mut random);
        let spread = case.spread();
        let [a, b, c] = case.points;
        if spread >= 1.0 || (b - a).perp_dot(c - a) == 0.0 {
            continue;
        }
        let fits = [(case.taylor(), taylor_error(spread)), (case.six_point(), six_point_error(spread))];
        // In slivers the coefficients are so large that f64 rounds by more than what is looked for.
        if fits.iter().any(|(quadratic, bound)| rounding(quadratic) > bound / 100.0) {
            slivers += 1;
            continue;
        }
        let triangle = Triangle(case.points.map(|p| Vertex { x: p.x, y: p.y, ..Vertex::default() }));
        let mut walks: Option<[Walk<f64>; 2]> = None;
        fragments(&triangle, ShadeMode::Gouraud, SUBPIXEL_BITS, SCREEN, |fragment| {
            let (x, y) = (fragment.x, fragment.y);
            let start = |(quadratic, _): (Quadratic, f64)| {
                let centre = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                Walk::new(quadratic.differences(centre), (x, y))
            };
            let walks = walks.get_or_insert_with(|| fits.map(start));
            let truth = case.truth(DVec3::from_array(Weights::linear(fragment).0));
            for ((walk, (quadratic, bound)), reached) in walks.iter_mut().zip(&fits).zip(&mut reached) {
                walk.step(x, y);
                let error = (walk.value() - truth).abs();
                assert!(error <= bound + rounding(quadratic), "{case:?} at {x} {y}: {error} over {bound}");
                *reached = reached.max((error - rounding(quadratic)) / bound);
            }
            pixels += 1;
        });
        checked += u32::from(walks.is_some());
    }
    let [taylor, six_point] = reached;
    println!("bound 10: {checked} / {EXPECTED} triangles, {pixels} pixels each by Taylor and six points");
    println!(
        "reached: {taylor:.4} of bound 10 by Taylor, {six_point:.4} of 8/3 of bound 10; {slivers} slivers left out"
    );
    assert!(taylor > 0.5 && slivers < EXPECTED / 10, "{taylor}, {slivers} slivers");
}

/// Three unit normals whose mean is along `axis` and of which the farthest are `cone` radians from it: two at the rim
/// and one opposite, `third` radians from the axis; from three in a plane (0) to a regular tripod (`cone`).
fn tripod(axis: DVec3, cone: f64, third: f64) -> [DVec3; 3] {
    let (u, v) = axis.any_orthonormal_pair();
    let along = third.sin() / (2.0 * cone.sin());
    let across = (1.0 - along * along).sqrt();
    let rim = |side: f64| axis * cone.cos() + cone.sin() * (along * u + side * across * v);
    [rim(1.0), rim(-1.0), axis * third.cos() - u * third.sin()]
}

/// The table of `docs/fast_phong.md`.
#[test]
fn errors_by_half_cone() {
    let mut random = Pcg64Mcg::seed_from_u64(85);
    let points = [DVec2::ZERO, DVec2::new(9.0, 2.0), DVec2::new(4.0, 8.0)];
    println!("half-cone, degrees    bound 10   Taylor   six points     LSB of 8 bits, worst of 10000");
    for degrees in [1.0, 2.0, 4.0, 6.0, 8.5, 12.0, 17.0, 25.0, 35.0f64] {
        let cone = degrees.to_radians();
        let bound_10 = 255.0 * taylor_error(cone.tan());
        let (mut taylor, mut six_point) = (0f64, 0f64);
        for _ in 0..10_000 {
            let axis = direction(&mut random);
            let normals = tripod(axis, cone, cone * random.random_range(0.0..=1.0));
            // Light from the side is the worst for the series.
            let light = (direction(&mut random).reject_from(axis).normalize()
                + axis * random.random_range(-0.5..0.5))
            .normalize();
            let case = Case { points, normals, light };
            assert!((case.plane().c.normalize().dot(axis) - 1.0).abs() < 1e-12);
            taylor = taylor.max(255.0 * case.error(&case.taylor()));
            six_point = six_point.max(255.0 * case.error(&case.six_point()));
        }
        println!("{degrees:>18.1} {bound_10:>8.4} {taylor:>8.4} {six_point:>8.4}");
        assert!(
            taylor <= bound_10 && six_point <= 8.0 / 3.0 * bound_10,
            "{degrees} degrees: {taylor} {six_point}"
        );
        // Light in the direction of one normal's tilt: the polynomial has tan, the truth sin.
        assert!(taylor > 0.98 * 255.0 * (cone.tan() - cone.sin()), "{degrees} degrees: {taylor}");
    }
}
