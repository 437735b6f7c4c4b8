//! The walk: only additions, two a pixel for a quadratic, and the same as the closed form.

use super::cases::{Case, cone, direction};
use edgewalk_golden::fast_phong::{Differences, Directional, FastPhong, Fit, PowerTable, Walk, quadratics};
use edgewalk_golden::fragments;
use edgewalk_scene::{Material, ShadeMode, Specular, SurfaceTriangle, SurfaceVertex, Vertex};
use glam::{DVec2, DVec3};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::cell::Cell;
use std::ops::{AddAssign, SubAssign};

/// A number that counts what is added to it.
#[derive(Clone, Copy)]
struct Counted<'a>(f64, &'a Cell<u32>);

impl AddAssign for Counted<'_> {
    fn add_assign(&mut self, other: Self) {
        self.1.set(self.1.get() + 1);
        self.0 += other.0;
    }
}

impl SubAssign for Counted<'_> {
    fn sub_assign(&mut self, other: Self) {
        *self += Counted(-other.0, other.1);
    }
}

fn counted<'a>(from: Differences<f64>, additions: &'a Cell<u32>) -> Differences<Counted<'a>> {
    let number = |value| Counted(value, additions);
    Differences {
        value: number(from.value),
        right: number(from.right),
        down: number(from.down),
        right_right: number(from.right_right),
        right_down: number(from.right_down),
        down_down: number(from.down_down),
    }
}

fn centre(x: u32, y: u32) -> DVec2 {
    DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
}

fn surface_triangle(points: [DVec2; 3], normals: [DVec3; 3]) -> SurfaceTriangle {
    let vertex = |k: usize| SurfaceVertex {
        screen: Vertex { x: points[k].x, y: points[k].y, ..Vertex::default() },
        inverse_w: 1.0,
        position: DVec3::new(points[k].x, -points[k].y, 0.0) / 100.0,
        normal: normals[k],
        texture: DVec2::ZERO,
    };
    SurfaceTriangle { vertices: [vertex(0), vertex(1), vertex(2)], face: 0, own_normal: DVec3::Z }
}

const EYE: DVec3 = DVec3::new(0.2, 0.1, 4.0);

#[test]
fn five_additions_and_one_table_read_a_pixel() {
    let normals = [DVec3::new(0.1, 0.0, 1.0), DVec3::new(-0.1, 0.1, 1.0), DVec3::new(0.0, -0.2, 1.0)];
    let triangle = surface_triangle(
        [DVec2::ZERO, DVec2::new(90.0, 3.0), DVec2::new(1.0, 90.0)],
        normals.map(DVec3::normalize),
    );
    let light = Directional { toward: DVec3::new(0.3, 0.2, 0.9).normalize(), intensity: DVec3::splat(0.8) };
    let material = Material {
        emission: DVec3::splat(0.03),
        ambient: DVec3::splat(0.4),
        specular: DVec3::splat(0.5),
        exponent: 12.0,
        ..Material::matte(DVec3::splat(0.6))
    };
    let ambient = DVec3::splat(0.2);
    let powers = PowerTable::new(4096, Specular::Blinn, material.exponent);
    let (y, first, pixels) = (20, 1, 60);

    // One wavelength: k_d I_l goes into the quadratic, and all that does not depend on N·L into the table.
    let [mut diffuse, halfway] = quadratics(&triangle, 8, Fit::Taylor, light.toward, EYE).unwrap();
    diffuse.t = diffuse.t.map(|t| t * material.diffuse.x * light.intensity.x);
    let (additions, reads) = (Cell::new(0), Cell::new(0));
    let table = |index: f64| {
        reads.set(reads.get() + 1);
        let base = material.emission.x + material.ambient.x * ambient.x;
        Counted(base + light.intensity.x * material.specular.x * powers.read(index), &additions)
    };
    let [mut diffuse, mut halfway] = [diffuse, halfway]
        .map(|quadratic| Walk::new(counted(quadratic.differences(centre(first, y)), &additions), (first, y)));
    let mut reference = FastPhong::new(&triangle, 8, Fit::Taylor, &[light], EYE, (first, y));
    for x in first..first + pixels {
        let before = (additions.get(), reads.get());
        diffuse.step(x, y);
        halfway.step(x, y);
        let mut intensity = diffuse.value();
        intensity += table(halfway.value().0);
        let spent = (additions.get() - before.0, reads.get() - before.1);
        // The first pixel of the span is where the walk starts.
        assert_eq!(spent, if x == first { (1, 1) } else { (5, 1) }, "column {x}");
        reference.step(x, y);
        let color = reference.color(&material, ambient, &powers).x;
        assert!((intensity.0 - color).abs() < 1e-12, "column {x}: {} {color}", intensity.0);
    }
    println!("{pixels} pixels: {} additions, {} table reads", additions.get(), reads.get());
    assert_eq!((additions.get(), reads.get()), (5 * pixels - 4, pixels));
}

#[test]
fn a_line_costs_three_additions_and_three_for_each_column_aside() {
    let quadratic = Case {
        points: [DVec2::ZERO, DVec2::new(9.0, 2.0), DVec2::new(4.0, 8.0)],
        normals: [DVec3::Z, DVec3::X, DVec3::Y],
        light: DVec3::Y,
    }
    .taylor();
    let additions = Cell::new(0);
    let mut walk = Walk::new(counted(quadratic.differences(centre(7, 3)), &additions), (7, 3));
    let mut checked = 0;
    for (x, y, expected) in [
        (7, 3, 0),
        (8, 3, 2),
        (11, 3, 6),
        (7, 4, 3),
        (9, 4, 4),
        (5, 5, 3 + 2 * 3),
        (5, 5, 0),
        (10, 6, 3 + 5 * 3),
        (10, 9, 3 * 3),
        (9, 9, 3), // textbook fill draws the line of the knee twice
    ] {
        let before = additions.get();
        walk.step(x, y);
        assert_eq!(additions.get() - before, expected, "to {x} {y}");
        let value = walk.value().0;
        assert!((value - quadratic.at(centre(x, y))).abs() < 1e-12, "at {x} {y}: {value}");
        checked += 1;
    }
    println!("{checked} steps");
}

#[test]
fn large_triangles_drift_by_rounding_only() {
    let mut random = Pcg64Mcg::seed_from_u64(9);
    let (mut drift, mut checked) = (0f64, 0);
    for points in [
        [DVec2::new(3.3, 2.1), DVec2::new(1275.0, 400.7), DVec2::new(200.9, 955.5)],
        [DVec2::new(1270.3, 2.1), DVec2::new(1277.9, 955.0), DVec2::new(2.5, 480.25)],
    ] {
        let triangle = surface_triangle(points, cone(&mut random, 0.5));
        let light = Directional { toward: direction(&mut random), intensity: DVec3::ONE };
        for fit in [Fit::Taylor, Fit::SixPoint] {
            let [diffuse, _] = quadratics(&triangle, 8, fit, light.toward, EYE).unwrap();
            let mut walk = None;
            fragments(&triangle.on_screen(), ShadeMode::Gouraud, 8, (1280, 960), |fragment| {
                let (x, y) = (fragment.x, fragment.y);
                let start = || Walk::new(diffuse.differences(centre(x, y)), (x, y));
                let walk = walk.get_or_insert_with(start);
                walk.step(x, y);
                drift = drift.max((walk.value() - diffuse.at(centre(x, y))).abs());
                checked += 1;
            });
        }
    }
    println!("{checked} pixels, largest difference from the closed form {drift:.1e}");
    assert!(checked > 1_000_000 && drift < 1e-10, "{drift}");
}

#[test]
fn only_directional_light() {
    use edgewalk_scene::{Attenuation, Light};
    let sun = Light::Directional { toward: DVec3::Y, intensity: DVec3::ONE };
    let lamp =
        Light::Positional { position: DVec3::Y, intensity: DVec3::ONE, attenuation: Attenuation::NONE };
    assert_eq!(Directional::all(&[sun, sun]).map(|lights| lights.len()), Ok(2));
    assert_eq!(Directional::all(&[sun, lamp, lamp]), Err(1));
}

#[test]
fn no_area_and_cancelling_normals_are_dark() {
    let flat = surface_triangle([DVec2::ZERO, DVec2::ONE, DVec2::splat(2.0)], [DVec3::Z; 3]);
    assert_eq!(quadratics(&flat, 8, Fit::Taylor, DVec3::Z, EYE), None);
    assert_eq!(quadratics(&flat, 8, Fit::SixPoint, DVec3::Z, EYE), None);
    let tips = [DVec3::X, DVec3::NEG_X, DVec3::ZERO];
    let cancelling = surface_triangle([DVec2::ZERO, DVec2::X, DVec2::Y], tips);
    let [diffuse, _] = quadratics(&cancelling, 8, Fit::Taylor, DVec3::Z, EYE).unwrap();
    assert_eq!(diffuse.t, [0.0; 6]);
}
