//! Depth and colour of each fragment against the plane in exact rationals.
#![allow(clippy::unwrap_used)] // finite numbers have rationals

use edgewalk_golden::{Fill, Fragment, NO_TRIANGLE, draw, fragments, snap};
use edgewalk_scene::{Frame, MAX_EXTRA, MAX_EXTRA_VALUE, ShadeMode, Triangle, Vertex};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

type Attribute = fn(&Vertex) -> f64;

fn rational(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap()
}

/// A 7.7 and A 7.8 as they stand: the plane with the normal (r2 - r1) x (r3 - r1) at a pixel centre.
fn plane(triangle: &Triangle, bits: u32, at: (u32, u32), attribute: impl Fn(&Vertex) -> f64) -> BigRational {
    let unit = f64::from(1u32 << bits);
    let [p1, p2, p3] = triangle.0.each_ref().map(|v| {
        let snapped = |c: f64| rational(snap(c, bits) as f64 / unit);
        [snapped(v.x), snapped(v.y), rational(attribute(v))]
    });
    let minus = |p: &[BigRational; 3], q: &[BigRational; 3]| [0, 1, 2].map(|k| &p[k] - &q[k]);
    let (a, b) = (minus(&p2, &p1), minus(&p3, &p1));
    let normal = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i]);
    let c = &normal[0] * &p1[0] + &normal[1] * &p1[1] + &normal[2] * &p1[2];
    let [x, y] = [at.0, at.1].map(|pixel| rational(f64::from(pixel) + 0.5));
    (c - &normal[0] * x - &normal[1] * y) / &normal[2]
}

fn random_triangle(rng: &mut Pcg64, reach: f64, sliver: bool) -> Triangle {
    let mut triangle = Triangle(std::array::from_fn(|_| {
        let [z, r, g, b, kt] = std::array::from_fn(|_| rng.random_range(0.0..=1.0));
        let [x, y] = std::array::from_fn(|_| 20.0 + rng.random_range(-reach..reach));
        Vertex { x, y, z, r, g, b, kt, ..Vertex::default() }
    }));
    if sliver {
        let [a, b, c] = &mut triangle.0;
        let t = rng.random_range(0.0..1.0);
        c.x = a.x + t * (b.x - a.x) + rng.random_range(-0.01..0.01);
        c.y = a.y + t * (b.y - a.y) + rng.random_range(-0.01..0.01);
    }
    triangle
}

#[test]
fn each_value_is_within_the_stated_uncertainty_of_the_plane() {
    let mut rng = Pcg64::seed_from_u64(4);
    let (mut checked, mut worst) = (0, 0.0f64);
    for k in 0..600 {
        let reach = [10.0, 100.0, 9e5][k % 3];
        let triangle = random_triangle(&mut rng, reach, k % 2 == 0);
        let mut shown = 0;
        fragments(&triangle, ShadeMode::Gouraud, 8, (40, 40), |f| {
            shown += 1;
            if shown % 16 != 1 {
                return; // rationals are slow, and neighbours are alike
            }
            let [r, g, b] = f.rgb();
            let attributes: [(f64, Attribute); 5] =
                [(f.z(), |v| v.z), (r, |v| v.r), (g, |v| v.g), (b, |v| v.b), (f.kt(), |v| v.kt)];
            for (value, attribute) in attributes {
                let exact = plane(&triangle, 8, (f.x, f.y), attribute);
                assert_eq!(f.exact(attribute), exact);
                let error = ((rational(value) - &exact) / &exact).abs().to_f64().unwrap();
                worst = worst.max(error / Fragment::UNCERTAINTY);
                checked += 1;
            }
        });
    }
    println!("{checked} values, worst relative error {worst:.3} of the bound");
    assert!(checked > 10_000);
    assert!(worst <= 1.0);
    assert!(worst > 0.1, "a bound so far from the truth hides faults");
}

#[test]
fn values_never_leave_the_range_of_the_vertices() {
    let mut rng = Pcg64::seed_from_u64(5);
    let mut checked = 0;
    for k in 0..2000 {
        let mut triangle = random_triangle(&mut rng, 30.0, k % 2 == 0);
        let high = rng.random_range(0.0..=1.0);
        for (v, z) in triangle.0.iter_mut().zip([high, high, high * (1.0 - 1e-16)]) {
            (v.z, v.r, v.g) = (z, 1.0, 0.1);
        }
        fragments(&triangle, ShadeMode::Gouraud, 8, (40, 40), |f| {
            assert!(f.z() <= high && f.z() >= high * (1.0 - 1e-16));
            assert_eq!(f.rgb()[..2], [1.0, 0.1], "equal at the vertices, equal everywhere");
            checked += 1;
        });
    }
    assert!(checked > 10_000);
}

#[test]
fn flat_takes_colour_from_the_first_vertex_and_depth_from_all() {
    let triangle = random_triangle(&mut Pcg64::seed_from_u64(6), 15.0, false);
    let first = triangle.0[0];
    let mut depths = Vec::new();
    fragments(&triangle, ShadeMode::Flat, 8, (40, 40), |f| {
        assert_eq!((f.rgb(), f.kt()), ([first.r, first.g, first.b], first.kt));
        assert_eq!(f.exact(|v| v.z), plane(&triangle, 8, (f.x, f.y), |v| v.z));
        depths.push(f.z());
    });
    depths.dedup();
    assert!(depths.len() > 5, "depth is linear in flat mode too");
}

#[test]
fn zero_and_the_least_numbers_are_exact() {
    let least = f64::from_bits(1);
    let at = |x: f64, y: f64, z: f64| Vertex { x, y, z, ..Vertex::default() };
    let triangle = Triangle([at(0.0, 0.0, 0.0), at(4.0, 0.0, least), at(0.0, 4.0, 1.0)]);
    let mut checked = 0;
    fragments(&triangle, ShadeMode::Gouraud, 0, (4, 4), |f| {
        assert_eq!(f.exact(|v| v.z), plane(&triangle, 0, (f.x, f.y), |v| v.z));
        assert!(!f.exact(|v| v.z).is_zero());
        checked += 1;
    });
    assert_eq!(checked, 6);
}

/// The plane of a value of the user's own is exact to a few roundings of the largest magnitude at the vertices.
#[test]
fn own_values_are_the_plane_through_the_vertices_in_both_modes() {
    let mut rng = Pcg64::seed_from_u64(7);
    let (mut checked, mut negative, mut worst) = (0, 0, 0.0f64);
    for k in 0..200 {
        let mut triangle = random_triangle(&mut rng, [10.0, 100.0][k % 2], k % 3 == 0);
        let limit = [1.0, 127.0, 2047.0, MAX_EXTRA_VALUE][k % 4];
        for v in &mut triangle.0 {
            v.extra = std::array::from_fn(|_| rng.random_range(-limit..=limit));
        }
        let mode = ShadeMode::ALL[k % 2];
        fragments(&triangle, mode, 8, (40, 40), |f| {
            if (f.x + f.y) % 7 != 0 {
                return; // rationals are slow
            }
            for channel in 0..MAX_EXTRA {
                let exact = plane(&triangle, 8, (f.x, f.y), |v| v.extra[channel]);
                let largest = triangle.0.iter().map(|v| v.extra[channel].abs()).fold(0.0, f64::max);
                let error = (rational(f.extra(channel)) - &exact).abs().to_f64().unwrap();
                worst = worst.max(error / largest / Fragment::UNCERTAINTY);
                negative += u32::from(f.extra(channel) < 0.0);
                checked += 1;
            }
        });
    }
    println!("{checked} values, {negative} of them negative, worst error {worst:.3} of the bound");
    assert!(checked > 5_000 && negative > 2_000);
    assert!(worst <= 1.0 && worst > 0.05, "{worst}");
}

#[test]
fn a_picture_holds_the_own_values_of_what_was_drawn_last_and_0_elsewhere() {
    let at = |x, y, z, extra: [f64; 2]| Vertex {
        x,
        y,
        z,
        extra: [extra[0], extra[1], 0.0, 0.0],
        ..Vertex::default()
    };
    let flat =
        |z: f64, extra| Triangle([(0.0, 0.0), (8.0, 0.0), (0.0, 8.0)].map(|(x, y)| at(x, y, z, extra)));
    let mut frame = Frame::new(8, 8);
    frame.extra = 2;
    frame.triangles = vec![flat(0.5, [-3.0, 4.0]), flat(0.25, [-1.5, 2.0]), flat(0.75, [9.0, 9.0])];
    let picture = draw(&frame, Fill::Exact { subpixel_bits: 8 });
    assert_eq!(picture.extra.len(), 2);
    let mut drawn = 0;
    for (at, id) in picture.id.iter().enumerate() {
        let expected = if *id == NO_TRIANGLE { [0.0, 0.0] } else { [-1.5, 2.0] };
        assert_eq!([picture.extra[0][at], picture.extra[1][at]], expected);
        drawn += i32::from(*id == 1);
    }
    assert_eq!(drawn, 28);
    // Without depth writes a fragment that passes still leaves its own values.
    frame.depth_write = false;
    assert_eq!(draw(&frame, Fill::Textbook).extra[0][9], 9.0);
}
