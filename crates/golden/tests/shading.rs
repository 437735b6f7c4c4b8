//! The shading systems against the equation, the frame, and each other.
#![allow(clippy::unwrap_used)] // built in, or made here and right

use edgewalk_golden::{Fill, NO_TRIANGLE, Shaded, Shading, draw, shade};
use edgewalk_scene::{
    Attenuation, Camera, Face, FaceData, Light, Material, Mesh, Scene, ShadeMode, Specular,
};
use glam::DVec3;

const GUARD: f64 = 8191.0;
const FILL: Fill = Fill::Exact { subpixel_bits: 8 };

fn shaded(scene: &Scene, (width, height): (u32, u32), shading: Shading) -> Shaded {
    shade(scene, &scene.surface(width, height, GUARD), shading, FILL)
}

#[test]
fn gouraud_and_constant_are_the_frames_the_machine_draws() {
    for name in Scene::BUILTIN {
        let scene = Scene::builtin(name).unwrap();
        for (shading, mode) in [(Shading::Gouraud, ShadeMode::Gouraud), (Shading::Constant, ShadeMode::Flat)]
        {
            let frame = scene.frame(160, 120, GUARD, mode);
            assert!(shaded(&scene, (160, 120), shading).picture == draw(&frame, FILL), "{name} {mode:?}");
        }
    }
}

/// A triangle four units before a camera at the origin that looks along -z, facing it; beyond the screen's borders.
fn wall(normals: Option<[DVec3; 3]>, material: Material, lights: Vec<Light>) -> Scene {
    let corners = [(-9.0, -5.0, -4.0), (9.0, -5.0, -4.0), (0.0, 9.0, -4.0)].map(DVec3::from);
    let faces = vec![Face { corners: [0, 1, 2], material: 0 }];
    let mesh = Mesh::new("wall", corners.to_vec(), faces, vec![material]).unwrap();
    let mesh = mesh.with_face_data(vec![FaceData { normals, ..FaceData::default() }]);
    let camera =
        Camera { eye: DVec3::ZERO, target: DVec3::NEG_Z, up: DVec3::Y, angle: 1.0, near: 0.5, far: 9.0 };
    Scene { camera, lights, ..Scene::of_mesh(mesh) }
}

const SHINY: Material =
    Material { specular: DVec3::splat(0.5), exponent: 20.0, ..Material::matte(DVec3::new(0.4, 0.3, 0.2)) };

/// The equation written out once more, for a lamp before the wall.
#[test]
fn phong_of_a_flat_triangle_is_the_equation_at_each_pixel() {
    let lamp = DVec3::new(0.8, 0.6, -2.0);
    let attenuation = Attenuation { constant: 0.5, linear: 0.0, quadratic: 0.1 };
    let light = Light::Positional { position: lamp, intensity: DVec3::splat(0.9), attenuation };
    let (width, height) = (80, 60);
    for specular in Specular::ALL {
        let scene = Scene { specular, ..wall(None, SHINY, vec![light]) };
        let drawn = shaded(&scene, (width, height), Shading::Phong);
        let (mut checked, mut worst) = (0, 0.0f64);
        // The wall is 8 tan(0.5) high where the screen is 60 pixels high.
        let unit = 8.0 * 0.5f64.tan() / f64::from(height);
        for (at, rgb) in drawn.picture.rgb.iter().enumerate() {
            if drawn.picture.id[at] == NO_TRIANGLE {
                continue;
            }
            let (x, y) = ((at % 80) as f64 + 0.5 - 40.0, 30.0 - ((at / 80) as f64 + 0.5));
            let p = DVec3::new(x * unit, y * unit, -4.0);
            let (d, l, v) = (p.distance(lamp), (lamp - p).normalize(), (-p).normalize());
            let h = (l + v).normalize();
            let cosine = match specular {
                Specular::Mirror => DVec3::new(-l.x, -l.y, l.z).dot(v),
                Specular::Halfway => 2.0 * h.z * h.z - 1.0,
                Specular::Blinn => h.z,
            };
            let arriving = 0.9 / (0.5 + 0.1 * d * d);
            let expected = [0.4, 0.3, 0.2]
                .map(|k: f64| k * 0.2 + arriving * (k * l.z + 0.5 * cosine.max(0.0).powi(20)))
                .map(|c| c.min(1.0));
            let error = |(a, b): (&f64, f64)| (a - b).abs();
            worst = rgb.iter().zip(expected).map(error).fold(worst, f64::max);
            checked += 1;
        }
        println!("{specular:?}: {checked} pixels, worst {worst:e}");
        assert!(checked > 4000);
        // Snapping to 1/256 of a pixel moves vertices, and with them the points.
        assert!(worst < 2e-4, "{specular:?}: {worst}");
        assert!(
            drawn.error().max < 1e-9,
            "facing the viewer, straight over the screen is straight in the world"
        );
    }
}

#[test]
fn gouraud_misses_a_highlight_inside_a_triangle() {
    let lamp = Light::Directional { toward: DVec3::Z, intensity: DVec3::ONE };
    // Normals that lean outwards: the middle of the triangle faces lamp and viewer, no vertex does.
    let lean = |x: f64, y: f64| DVec3::new(x, y, 1.5).normalize();
    let normals = [lean(-1.0, -0.6), lean(1.0, -0.6), lean(0.0, 1.0)];
    let scene = wall(Some(normals), SHINY, vec![lamp]);
    let brightest = |shading| {
        let drawn = shaded(&scene, (80, 60), shading);
        (drawn.picture.rgb.iter().map(|c| c[0]).fold(0.0, f64::max), drawn.error())
    };
    let (phong, phong_error) = brightest(Shading::Phong);
    let (gouraud, gouraud_error) = brightest(Shading::Gouraud);
    println!("brightest: phong {phong:.3}, gouraud {gouraud:.3}");
    assert!(phong > 0.95 && gouraud < 0.5);
    assert!(gouraud_error.max > 100.0 && phong_error.max < 1e-9, "{} {}", gouraud_error.max, phong_error.max);
    assert_eq!(gouraud_error.pixels, phong_error.pixels);
}

#[test]
fn each_better_system_is_nearer_to_the_truth() {
    for name in ["sphere", "torus"] {
        let scene = Scene::builtin(name).unwrap();
        let order = [Shading::Constant, Shading::Gouraud, Shading::Phong];
        let errors = order.map(|shading| shaded(&scene, (320, 240), shading).error());
        let means = errors.each_ref().map(|error| error.mean);
        println!("{name}: mean {means:.4?} max {:.3?} LSB", errors.each_ref().map(|error| error.max));
        assert!(means[0] > 4.0 * means[1] && means[1] > 4.0 * means[2], "{name}");
        assert!(errors.iter().all(|error| error.pixels > 10_000));
        let [smallest, largest] = [means[2], errors[2].max];
        assert!(smallest > 0.0 && largest >= smallest, "{name}: screen-linear is not perspective-correct");
    }
}

#[test]
fn constant_takes_the_normal_it_is_told_to() {
    // Own normal towards the viewer, vertex normals all up: with light from above the two colours differ.
    let up = Light::Directional { toward: DVec3::Y, intensity: DVec3::ONE };
    let scene = wall(Some([DVec3::Y; 3]), SHINY, vec![up]);
    let color = |shading| shaded(&scene, (40, 30), shading).picture.rgb[40 * 15 + 20];
    let close = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-12);
    assert!(close(color(Shading::Constant), [0.08, 0.06, 0.04]), "ambient only");
    assert!(close(color(Shading::ConstantAveraged), [0.48, 0.36, 0.24]), "and all of k_d, without highlight");
}

#[test]
fn what_is_seen_from_behind_is_lit_there() {
    let front = Light::Directional { toward: DVec3::Z, intensity: DVec3::ONE };
    let scene = wall(None, SHINY, vec![front]);
    let mut behind = scene.clone();
    behind.camera.eye = DVec3::new(0.0, 0.0, -8.0);
    behind.camera.target = DVec3::ZERO;
    let middle = |scene: &Scene| shaded(scene, (40, 30), Shading::Phong).picture.rgb[40 * 15 + 20];
    assert!(middle(&scene)[0] > 0.5);
    assert!((middle(&behind)[0] - 0.08).abs() < 1e-12, "the light is on the other side");
    behind.lights = vec![Light::Directional { toward: DVec3::NEG_Z, intensity: DVec3::ONE }];
    assert!(middle(&behind)[0] > 0.5);
}
