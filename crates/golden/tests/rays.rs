//! r_l by rays against every face one by one, and through transparent faces.

use edgewalk_golden::Rays;
use edgewalk_scene::{Attenuation, Face, Light, Material, Mesh, Scene};
use glam::DVec3;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A triangle by two edges and a corner (Moeller and Trumbore): the distance along a unit vector.
fn crossing([a, b, c]: [DVec3; 3], from: DVec3, way: DVec3) -> Option<f64> {
    let (u, v) = (b - a, c - a);
    let h = way.cross(v);
    let volume = u.dot(h);
    let s = from - a;
    let (x, y) = (s.dot(h) / volume, way.dot(s.cross(u)) / volume);
    (x >= 0.0 && y >= 0.0 && x + y <= 1.0).then(|| v.dot(s.cross(u)) / volume)
}

#[test]
fn the_tree_finds_what_all_faces_one_by_one_give() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (mut rays, mut hidden) = (0, 0);
    for name in Scene::BUILTIN {
        let mut scene = Scene::builtin(name).expect("a built-in scene");
        let [low, high] = scene.mesh.bounds();
        let mut within = || low + (high - low) * DVec3::from(random.random::<[f64; 3]>());
        scene.lights = vec![
            Light::Directional { toward: DVec3::new(0.3, 0.9, 0.2).normalize(), intensity: DVec3::ONE },
            Light::Positional { position: within(), intensity: DVec3::ONE, attenuation: Attenuation::NONE },
        ];
        let tree = Rays::new(&scene.mesh);
        for light in &scene.lights {
            for _ in 0..150 {
                let point = within();
                let toward = light.incident(point).toward;
                let reach = match light {
                    Light::Directional { .. } => f64::INFINITY,
                    Light::Positional { position, .. } | Light::Flood { position, .. } => {
                        position.distance(point)
                    }
                };
                let faces = scene.mesh.faces().iter();
                let nearest = faces
                    .filter_map(|face| crossing(scene.mesh.corners(face), point, toward))
                    .filter(|distance| *distance > 0.0 && *distance < reach)
                    .fold(f64::INFINITY, f64::min);
                let found = tree.nearest_opaque(light, point, u32::MAX).unwrap_or(f64::INFINITY);
                assert!(
                    found == nearest || (found - nearest).abs() < 1e-9,
                    "{name} {point}: {found} {nearest}"
                );
                rays += 1;
                hidden += u32::from(nearest.is_finite());
            }
        }
    }
    println!("checked {rays} rays, {hidden} hidden, 0 differ");
    assert!(rays == 1500 && hidden > 300 && hidden < 1400);
}

/// Panes one above the other, y = 0, 1, 2, ..., of these k_t.
fn panes(transmissions: &[f64]) -> Mesh {
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for (k, y) in (0..transmissions.len() as u32).zip(0..) {
        let corner = |x: f64, z: f64| DVec3::new(x, f64::from(y), z);
        positions.extend([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]);
        faces.extend(
            [[0, 1, 2], [0, 2, 3]].map(|c: [u32; 3]| Face { corners: c.map(|c| 4 * k + c), material: k }),
        );
    }
    let materials =
        transmissions.iter().map(|kt| Material { transmission: *kt, ..Material::DEFAULT }).collect();
    Mesh::new("panes", positions, faces, materials).expect("a good mesh")
}

#[test]
fn a_product_of_the_coefficients_on_the_way_and_no_others() {
    let mesh = panes(&[0.0, 0.5, 0.25, 0.8]);
    let rays = Rays::new(&mesh);
    let sun = Light::Directional { toward: DVec3::Y, intensity: DVec3::ONE };
    let lamp = |y: f64| Light::Positional {
        position: DVec3::new(0.0, y, 0.0),
        intensity: DVec3::ONE,
        attenuation: Attenuation::NONE,
    };
    // On the diagonal of every pane, where two faces meet, and beside it.
    for place in [DVec3::ZERO, DVec3::new(0.5, 0.0, 0.5), DVec3::new(0.3, 0.0, -0.6)] {
        let r = |light: &Light, y: f64, own: u32| rays.transmitted(light, place + DVec3::Y * y, own);
        assert_eq!(r(&sun, 0.0, 0), 0.5 * 0.25 * 0.8, "{place}");
        assert_eq!(r(&sun, 1.0, 2), 0.25 * 0.8);
        assert_eq!(r(&sun, 3.0, 6), 1.0, "nothing above");
        assert_eq!(r(&sun, -1.0, u32::MAX), 0.0, "an opaque pane");
    }
    let straight = |y: f64, own: u32| rays.transmitted(&lamp(y), DVec3::ZERO, own);
    assert_eq!([straight(0.5, 0), straight(1.5, 0), straight(9.0, 0)], [1.0, 0.5, 0.5 * 0.25 * 0.8]);
}
