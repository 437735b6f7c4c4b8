//! Whole pictures by fast Phong.

use edgewalk_golden::fast_phong::{Directional, FastShaded, Fit, Settings, shade};
use edgewalk_golden::{Fill, Shading};
use edgewalk_numerics::normal_cone::{normal_spread, six_point_error, taylor_error};
use edgewalk_scene::{Material, Mesh, Scene, Specular, Surface};
use glam::DVec3;

const SHINY: Material =
    Material { specular: DVec3::splat(0.5), exponent: 20.0, ..Material::matte(DVec3::splat(0.4)) };
const FITS: [Fit; 2] = [Fit::Taylor, Fit::SixPoint];

/// A built-in scene of one material.
fn scene(name: &str, material: Material) -> Scene {
    let scene = Scene::builtin(name).unwrap();
    let faces = scene.mesh.faces().iter().map(|face| edgewalk_scene::Face { material: 0, ..*face });
    let mesh = Mesh::new(name, scene.mesh.positions().to_vec(), faces.collect(), vec![material]).unwrap();
    Scene { mesh, specular: Specular::Blinn, ..scene }
}

fn surface(scene: &Scene) -> Surface {
    scene.surface(320, 240, 8191.0)
}

fn drawn(scene: &Scene, fit: Fit, table_size: usize) -> FastShaded {
    let lights = Directional::all(&scene.lights).unwrap();
    shade(scene, &surface(scene), &lights, Settings { fit, table_size, subpixel_bits: 8 })
}

/// Without highlights the difference from Phong shading is that of the quadratics alone.
#[test]
fn matte_pictures_are_under_bound_10_of_their_triangles_at_every_pixel() {
    let mut checked = 0;
    for name in Scene::BUILTIN {
        let scene = scene(name, Material::matte(DVec3::splat(0.8)));
        let spread: Vec<f64> = surface(&scene)
            .triangles
            .iter()
            .map(|triangle| normal_spread(&triangle.vertices.map(|vertex| vertex.normal.to_array())))
            .collect();
        for fit in FITS {
            let drawn = drawn(&scene, fit, 2);
            let error = drawn.error_to_phong();
            let picture = &drawn.shaded.picture;
            let intensity: f64 = Directional::all(&scene.lights).unwrap().iter().map(|l| l.intensity.x).sum();
            let mut widest = 0f64;
            for (at, id) in picture.id.iter().enumerate() {
                let Ok(id) = usize::try_from(*id) else { continue };
                let bound_10 =
                    if fit == Fit::Taylor { taylor_error(spread[id]) } else { six_point_error(spread[id]) };
                let bound = 255.0 * 0.8 * intensity * bound_10 + 1e-9;
                assert!(error.map[at] <= bound, "{name} {fit:?} pixel {at}: {} over {bound}", error.map[at]);
                widest = widest.max(spread[id]);
                checked += 1;
            }
            println!("{name} {fit:?}: worst {:.4}, mean {:.5} LSB, rho {widest:.3}", error.max, error.mean);
        }
    }
    println!("{checked} pixels under their bound");
    assert!(checked > 200_000);
}

#[test]
fn highlights_by_table_size_and_by_fit() {
    for name in ["sphere", "torus"] {
        let scene = scene(name, SHINY);
        let mut means = Vec::new();
        let fill = Fill::Exact { subpixel_bits: 8 };
        let phong = edgewalk_golden::shade(&scene, &surface(&scene), Shading::Phong, fill).error();
        println!("{name}: Phong from the truth worst {:.3} mean {:.4} LSB", phong.max, phong.mean);
        for fit in FITS {
            for size in [256, 4096, 1 << 20] {
                let drawn = drawn(&scene, fit, size);
                let (phong, truth) = (drawn.error_to_phong(), drawn.shaded.error());
                println!(
                    "{name} {fit:?}, {size} entries: from Phong worst {:.3} mean {:.4}, from the truth {:.3} {:.4} LSB",
                    phong.max, phong.mean, truth.max, truth.mean
                );
                assert!(phong.pixels > 10_000);
                means.push(phong.mean);
            }
        }
        let [taylor_small, taylor, taylor_large, small, six_point, large] = means[..] else { panic!() };
        assert!(taylor_small > taylor && taylor >= taylor_large && small > six_point && six_point > large);
        // The series takes one H a triangle, the six points follow it.
        assert!(taylor_large > 2.0 * large, "{name}: {means:?}");
    }
}

#[test]
fn the_phong_beside_it_is_phong_shading() {
    let scene = scene("torus", Material::matte(DVec3::splat(0.8)));
    let drawn = drawn(&scene, Fit::SixPoint, 2);
    let fill = Fill::Exact { subpixel_bits: 8 };
    let phong = edgewalk_golden::shade(&scene, &surface(&scene), Shading::Phong, fill);
    assert!(drawn.phong == phong.picture.rgb && drawn.shaded.truth == phong.truth);
    assert!(drawn.shaded.picture.id == phong.picture.id && drawn.shaded.picture.z == phong.picture.z);
}

#[test]
fn the_phong_beside_it_has_the_highlights_of_the_table() {
    let mirror = Scene { specular: Specular::Mirror, ..scene("sphere", SHINY) };
    let halfway = Scene { specular: Specular::Halfway, ..mirror.clone() };
    let [mirror, halfway] = [mirror, halfway].map(|scene| drawn(&scene, Fit::SixPoint, 4096));
    assert!(mirror.phong == halfway.phong && mirror.shaded.picture == halfway.shaded.picture);
    let (form, rest) = (mirror.shaded.error().max, halfway.shaded.error().max);
    println!("from the truth with mirror highlights {form:.3}, with those of ch. 7.12 {rest:.3} LSB");
    assert!(form > 2.0 * rest);
}

/// A relief of small slopes: what first order leaves out is |turn|²/2 of each cosine, and the quadratics' own error.
#[test]
fn a_relief_counts_to_first_order() {
    let text = include_str!("../../../../docs/scenes/texture-and-relief.toml");
    let read = |height: &str| {
        let text = text.replace("bump_height = 0.05", &format!("bump_height = {height}"));
        let scene = Scene::parse(std::path::Path::new("relief.toml"), &text).unwrap();
        assert!(scene.mesh.materials().iter().any(|material| material.bump.is_some()));
        let lights = Directional::all(&scene.lights).unwrap();
        let settings = Settings { fit: Fit::SixPoint, table_size: 1 << 20, subpixel_bits: 8 };
        let surface = surface(&scene);
        (shade(&scene, &surface, &lights, settings), surface, scene)
    };
    let (flat, ..) = read("0");
    let mut left_out = Vec::new();
    for height in ["0.0005", "0.001", "0.002"] {
        let (drawn, ..) = read(height);
        let relief: f64 = drawn
            .shaded
            .picture
            .rgb
            .iter()
            .zip(&flat.shaded.picture.rgb)
            .map(|(a, b)| (a[0] - b[0]).abs())
            .sum();
        let rest: f64 =
            drawn.phong.iter().zip(&drawn.shaded.picture.rgb).map(|(a, b)| (a[0] - b[0]).abs()).sum::<f64>();
        let base: f64 =
            flat.phong.iter().zip(&flat.shaded.picture.rgb).map(|(a, b)| (a[0] - b[0]).abs()).sum();
        println!("height {height}: the relief changes {relief:.3}, of which {:.4} are left out", rest - base);
        assert!(rest - base < 0.12 * relief, "{rest} {base} {relief}");
        left_out.push(rest - base);
    }
    let growth = [left_out[1] / left_out[0], left_out[2] / left_out[1]];
    assert!(growth.iter().all(|growth| (3.0..5.5).contains(growth)), "of second order: {left_out:?}");
}
