//! Bound 10: fast Phong's truncation against its bound, and the steps of the bound's proof one by one.

use edgewalk_numerics::normal_cone::{normal_spread, six_point_error, taylor_error};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

type Vector = [f64; 3];

/// What f64 loses in the comparisons below; errors down to 5e-13 (rho = 1e-4) are of no interest here.
const ROUNDING: f64 = 4e-16;

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn scaled(a: Vector, factor: f64) -> Vector {
    a.map(|part| part * factor)
}

fn unit(a: Vector) -> Vector {
    scaled(a, 1.0 / dot(a, a).sqrt())
}

fn mean(weights: Vector, vectors: &[Vector; 3]) -> Vector {
    std::array::from_fn(|axis| weights.iter().zip(vectors).map(|(w, v)| w * v[axis]).sum())
}

fn direction(random: &mut Pcg64Mcg) -> Vector {
    loop {
        let v: Vector = std::array::from_fn(|_| random.random_range(-1.0..1.0));
        if (0.01..1.0).contains(&dot(v, v)) {
            return unit(v);
        }
    }
}

/// Second-order Taylor polynomial of l·N/|N| about `centre`, at `normal`; by vectors, so without T0 to T5.
fn taylor(light: Vector, centre: Vector, normal: Vector) -> f64 {
    let size = dot(centre, centre).sqrt();
    let e = scaled(centre, 1.0 / size);
    let v: Vector = std::array::from_fn(|axis| (normal[axis] - centre[axis]) / size);
    let (le, lv, ev, vv) = (dot(light, e), dot(light, v), dot(e, v), dot(v, v));
    le + (lv - le * ev) + (le * (3.0 * ev * ev - vv) / 2.0 - lv * ev)
}

/// The quadratic through the values at vertices and midpoints, at barycentric `w`.
fn through_six(cosine: impl Fn(Vector) -> f64, w: Vector) -> f64 {
    (0..3)
        .map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let mut vertex = [0.0; 3];
            vertex[i] = 1.0;
            let mut midpoint = [0.5; 3];
            midpoint[i] = 0.0;
            w[i] * (2.0 * w[i] - 1.0) * cosine(vertex) + 4.0 * w[j] * w[k] * cosine(midpoint)
        })
        .sum()
}

/// Vertex normals in a cone, of any length in every other case, and a light; the cone's width is spread
/// evenly over its logarithm.
fn random_triangle(random: &mut Pcg64Mcg) -> ([Vector; 3], Vector) {
    let axis = direction(random);
    let width = 10f64.powf(random.random_range(-2.5..0.0));
    let any_length = random.random::<bool>();
    let normals = std::array::from_fn(|_| {
        let off = direction(random);
        let size = if any_length { 1.0 + width * random.random_range(-0.5..0.5) } else { 1.0 };
        scaled(unit(std::array::from_fn(|k| axis[k] + width * off[k])), size)
    });
    (normals, direction(random))
}

#[test]
fn bound_10_on_a_hundred_thousand_triangles() {
    const EXPECTED: u32 = 100_000;
    let mut random = Pcg64Mcg::seed_from_u64(10);
    let (mut checked, mut most, mut most_six) = (0, 0f64, 0f64);
    while checked < EXPECTED {
        let (normals, light) = random_triangle(&mut random);
        let spread = normal_spread(&normals);
        if spread >= 1.0 {
            continue;
        }
        let centre = mean([1.0 / 3.0; 3], &normals);
        let cosine = |w: Vector| {
            let normal = mean(w, &normals);
            dot(light, normal) / dot(normal, normal).sqrt()
        };
        let (bound, six_bound) = (taylor_error(spread), six_point_error(spread));
        for i in 0..=6 {
            for j in 0..=6 - i {
                let w = [f64::from(i) / 6.0, f64::from(j) / 6.0, f64::from(6 - i - j) / 6.0];
                let error = (taylor(light, centre, mean(w, &normals)) - cosine(w)).abs() - ROUNDING;
                assert!(error <= bound, "{normals:?} {light:?} at {w:?}: {error} over {bound}");
                let six = (through_six(cosine, w) - cosine(w)).abs() - ROUNDING;
                assert!(six <= six_bound, "{normals:?} {light:?} at {w:?}: {six} over {six_bound}");
                (most, most_six) = (most.max(error / bound), most_six.max(six / six_bound));
            }
        }
        checked += 1;
    }
    println!(
        "bound 10: {checked} / {EXPECTED} triangles; reached: Taylor {most:.4}, six points {most_six:.4}"
    );
    assert!(most > 0.7 && most <= 1.0 && most_six > 0.05, "{most} {most_six}");
}

#[test]
fn bound_10_is_reached_by_a_grazing_light() {
    // Normals to both sides along the light, none along the centre: x/sqrt(1+x²) = x - x³/2 + ...
    for tilt in [0.3, 0.1, 0.03, 0.01] {
        let normals = [[tilt, 0.0, 1.0], [-tilt, 0.0, 1.0], [0.0, 0.0, 1.0]];
        let spread = normal_spread(&normals);
        let cosine = dot([1.0, 0.0, 0.0], unit(normals[0]));
        let share = (tilt - cosine) / taylor_error(spread);
        println!("bound 10: rho {spread:.4}, {share:.4} of the bound");
        assert!(share > 0.9 * (1.0 - tilt) && share < 1.0, "{share}");
    }
}

#[test]
fn half_an_lsb_at_a_half_cone_of_eight_and_a_half_degrees() {
    let lsb = |degrees: f64| 255.0 * taylor_error(degrees.to_radians().tan());
    println!("bound 10 at 8.5 degrees: {:.4} LSB of 8 bits", lsb(8.5));
    assert!((lsb(8.5) - 0.5).abs() < 0.001);
    assert!(lsb(8.49) < 0.5 && lsb(8.51) > 0.5);
}

#[test]
fn spread_is_at_most_the_tangent_of_the_angle_to_the_mean() {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    let (mut checked, mut most) = (0, 0f64);
    for _ in 0..50_000 {
        let axis = direction(&mut random);
        let width = random.random_range(0.01..1.5);
        let normals: [Vector; 3] = std::array::from_fn(|_| {
            let off = direction(&mut random);
            unit(std::array::from_fn(|k| axis[k] + width * off[k]))
        });
        let centre = unit(mean([1.0 / 3.0; 3], &normals));
        let cosine = normals.iter().map(|normal| dot(*normal, centre)).fold(1.0, f64::min);
        if cosine > 0.0 {
            let (spread, tangent) = (normal_spread(&normals), (1.0 - cosine * cosine).sqrt() / cosine);
            assert!(spread <= tangent * (1.0 + 1e-9), "{normals:?}: {spread} over {tangent}");
            most = most.max(spread / tangent);
            checked += 1;
        }
    }
    println!("rho <= tan phi: {checked} cones, {most:.4} of the tangent reached");
    assert!(checked > 40_000 && most > 0.99);
    assert_eq!(normal_spread(&[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0; 3]]), f64::INFINITY);
    assert_eq!(normal_spread(&[[0.0; 3]; 3]), f64::INFINITY, "no direction at all");
    assert_eq!(taylor_error(1.0), f64::INFINITY);
    assert_eq!(taylor_error(f64::NAN), f64::INFINITY);
    assert_eq!(taylor_error(0.0), 0.0);
}

/// |e P_n(x) + w P_{n-1}(x)| for unit vectors e, w with e·w = -x: the size of the series' n-th coefficient.
fn coefficient_size(x: f64, p: f64, before: f64) -> f64 {
    (p * p + before * before - 2.0 * x * p * before).max(0.0).sqrt()
}

#[test]
fn no_coefficient_from_the_third_on_exceeds_a_half() {
    let (mut checked, mut largest) = (0, [0f64; 101]);
    for step in 0..=4000 {
        let x = f64::from(step) / 2000.0 - 1.0;
        let (mut before, mut p) = (1.0, x);
        for n in 2..=100u32 {
            // (n) P_n = (2n-1) x P_{n-1} - (n-1) P_{n-2}
            let k = f64::from(n);
            (before, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k);
            let size = coefficient_size(x, p, before);
            largest[n as usize] = largest[n as usize].max(size);
            checked += 1;
        }
    }
    println!("sup of the coefficients 2 to 6 on {checked} points: {:.4?}", &largest[2..=6]);
    assert!((largest[2] - (1.0f64 / 3.0).sqrt()).abs() < 1e-6 && (largest[3] - 0.5).abs() < 1e-9);
    assert!(largest[3..].windows(2).all(|pair| pair[1] < pair[0]), "they fall with n");
    // The proof's bounds for n = 4 and for n >= 5.
    assert!(largest[4] <= 0.4783 && largest[5] <= 0.4202);
}
