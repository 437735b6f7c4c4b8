//! Whole scenes with shadows and transparent surfaces.

use edgewalk_golden::{
    Fill, Rays, Shading, ShadowMaps, Visibility, back_to_front, draw, fragments, frame, render,
};
use edgewalk_scene::{Blending, Camera, Face, Frame, Light, Material, Mesh, Scene, ShadeMode};
use glam::DVec3;

const FILL: Fill = Fill::Exact { subpixel_bits: 8 };
const GUARD: f64 = 8191.0;
const SIZE: (u32, u32) = (96, 72);
/// Of every square: what no shadow takes away.
const EMISSION: f64 = 0.05;

/// Squares parallel to the floor, of these heights, half sides and k_t, in the colours of a list that goes round.
fn squares(list: &[(f64, f64, f64)]) -> Mesh {
    let (mut positions, mut faces, mut materials) = (Vec::new(), Vec::new(), Vec::new());
    for (k, (y, half, kt)) in (0..).zip(list) {
        let corner = |x: f64, z: f64| DVec3::new(x * half, *y, z * half);
        positions.extend([corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)]);
        faces.extend(
            [[0, 1, 2], [0, 2, 3]].map(|c: [u32; 3]| Face { corners: c.map(|c| 4 * k + c), material: k }),
        );
        let color = [DVec3::splat(0.8), DVec3::new(0.9, 0.3, 0.2), DVec3::new(0.2, 0.4, 0.9)][k as usize % 3];
        let emission = DVec3::splat(EMISSION);
        materials.push(Material { emission, transmission: *kt, ..Material::matte(color) });
    }
    Mesh::new("squares", positions, faces, materials).expect("a good mesh")
}

/// Seen from high above one side, in light from straight above.
fn scene(list: &[(f64, f64, f64)]) -> Scene {
    let camera = Camera {
        eye: DVec3::new(0.0, 9.0, 5.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        angle: 0.6,
        near: 1.0,
        far: 30.0,
    };
    let lights = vec![Light::Directional { toward: DVec3::Y, intensity: DVec3::splat(0.6) }];
    Scene { camera, lights, ambient: DVec3::splat(0.25), ..Scene::of_mesh(squares(list)) }
}

fn picture(scene: &Scene, shading: Shading, visibility: &Visibility) -> Vec<[f64; 3]> {
    let surface = scene.surface(SIZE.0, SIZE.1, GUARD);
    render(scene, &surface, shading, FILL, visibility).shaded.picture.rgb
}

/// The pixel that shows a point of the world.
fn pixel(scene: &Scene, point: DVec3) -> usize {
    let clip = scene.camera.to_clip(SIZE.0, SIZE.1) * point.extend(1.0);
    let x = (0.5 + 0.5 * clip.x / clip.w) * f64::from(SIZE.0);
    let y = (0.5 - 0.5 * clip.y / clip.w) * f64::from(SIZE.1);
    y as usize * SIZE.0 as usize + x as usize
}

fn far(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
}

/// A small square over the floor, seen aside of its own shadow.
#[test]
fn under_a_pane_the_floor_has_its_part_of_the_light() {
    for kt in [0.0, 0.4] {
        let scene = scene(&[(0.0, 2.0, 0.0), (1.5, 0.5, kt)]);
        let floor = |r: f64| EMISSION + 0.8 * (0.25 + r * 0.6);
        let (hidden, open) = (DVec3::new(0.2, 0.0, 0.3), DVec3::new(1.2, 0.0, 0.3));
        let rays = Visibility::Rays(Rays::new(&scene.mesh));
        let maps = Visibility::Maps(ShadowMaps::draw(&scene, 256));
        for shading in [Shading::Gouraud, Shading::Phong] {
            for (visibility, r) in [(&rays, kt), (&maps, kt), (&Visibility::Full, 1.0)] {
                let rgb = picture(&scene, shading, visibility);
                let at = |point| rgb[pixel(&scene, point)][1];
                assert!(
                    (at(hidden) - floor(r)).abs() < 1e-12,
                    "{shading:?} {kt}: {} {}",
                    at(hidden),
                    floor(r)
                );
                assert!((at(open) - floor(1.0)).abs() < 1e-12, "{shading:?} {kt}");
            }
        }
    }
}

/// With r_l = 1 everywhere, parts that are interpolated apart add up to the colours interpolated together.
#[test]
fn gated_parts_add_up_to_gouraud() {
    let mut scene = scene(&[(0.0, 2.0, 0.0)]);
    scene.lights.push(Light::Directional { toward: DVec3::new(0.6, 0.8, 0.0), intensity: DVec3::splat(0.2) });
    let visibility = Visibility::Rays(Rays::new(&scene.mesh));
    let (apart, together) = (
        picture(&scene, Shading::Gouraud, &visibility),
        picture(&scene, Shading::Gouraud, &Visibility::Full),
    );
    let worst = apart.iter().zip(&together).map(|(a, b)| far(a, b)).fold(0.0, f64::max);
    assert!(worst < 1e-12, "{worst}");
}

/// Each pixel's fragments sorted by depth, each over what is behind it.
fn composed(frame: &Frame) -> Vec<[f64; 3]> {
    let mut at_pixel = vec![Vec::new(); (SIZE.0 * SIZE.1) as usize];
    for triangle in &frame.triangles {
        fragments(triangle, frame.mode, 8, SIZE, |f| {
            at_pixel[(f.y * SIZE.0 + f.x) as usize].push((f.z(), f.rgb(), f.kt()));
        });
    }
    let compose = |mut list: Vec<(f64, [f64; 3], f64)>| {
        list.sort_by(|a, b| b.0.total_cmp(&a.0));
        let over = |back: [f64; 3], (_, front, kt): &(f64, [f64; 3], f64)| {
            std::array::from_fn(|c| front[c] + kt * (back[c] - front[c]))
        };
        list.iter().fold(frame.clear, over)
    };
    at_pixel.into_iter().map(compose).collect()
}

#[test]
fn panes_in_any_list_order_are_the_exact_composition() {
    let panes = [
        (0.0, 2.0, 0.0),
        (0.5, 1.0, 0.6),
        (1.0, 0.9, 0.3),
        (1.5, 1.1, 0.8),
        (2.0, 0.4, 0.0),
        (2.5, 0.7, 0.5),
    ];
    let mut pixels = 0;
    for turn in 0..panes.len() {
        let mut list = panes.to_vec();
        list.rotate_left(turn);
        let scene = scene(&list);
        let surface = scene.surface(SIZE.0, SIZE.1, GUARD);
        for (shading, mode) in [(Shading::Gouraud, ShadeMode::Gouraud), (Shading::Constant, ShadeMode::Flat)]
        {
            let rendered = render(&scene, &surface, shading, FILL, &Visibility::Full);
            assert_eq!(rendered.order.warning(), None);
            let mut sorted = frame(&scene, &surface, shading);
            assert_eq!(sorted.mode, mode);
            let expected = composed(&sorted);
            let order = back_to_front(&sorted.triangles, 8).order;
            sorted.triangles = order.iter().map(|place| sorted.triangles[*place]).collect();
            sorted.blend = Blending::Mix;
            let by_list = draw(&sorted, FILL);
            for (at, rgb) in rendered.shaded.picture.rgb.iter().enumerate() {
                assert!(far(rgb, &expected[at]) < 1e-12, "turn {turn}, {shading:?}, pixel {at}");
                assert!(far(&by_list.rgb[at], &expected[at]) < 1e-12, "turn {turn}, {shading:?}, pixel {at}");
                pixels += 1;
            }
        }
    }
    println!("checked {pixels} pixels, 0 differ by more than 1e-12");
}

/// A hollow sphere of glass: its inner side, then its outer one, over the background.
#[test]
fn a_ball_of_glass_has_two_sides_at_each_pixel() {
    let sphere = Scene::builtin("sphere").expect("a built-in scene");
    let (positions, faces) = (sphere.mesh.positions().to_vec(), sphere.mesh.faces().to_vec());
    let glass = Material { transmission: 0.5, ..Material::matte(DVec3::new(0.3, 0.7, 0.5)) };
    let mesh = Mesh::new("glass", positions, faces, vec![glass]).expect("a good mesh");
    let scene = Scene { mesh, ..sphere };
    let surface = scene.surface(SIZE.0, SIZE.1, GUARD);
    let rendered = render(&scene, &surface, Shading::Gouraud, FILL, &Visibility::Full);
    assert_eq!(rendered.order.warning(), None);
    let expected = composed(&frame(&scene, &surface, Shading::Gouraud));
    let picture = &rendered.shaded.picture;
    let twice = picture.writes.iter().filter(|writes| **writes == 2).count();
    for (rgb, expected) in picture.rgb.iter().zip(&expected) {
        assert!(far(rgb, expected) < 1e-12);
    }
    assert!(twice > 1000 && picture.writes.iter().all(|writes| [0, 2].contains(writes)));
    // The truth is blended too: it is near the picture, and not the colour of one side.
    assert!(rendered.shaded.error().mean < 2.0);
}

#[test]
fn without_glass_the_order_is_the_list() {
    for name in Scene::BUILTIN {
        let scene = Scene::builtin(name).expect("a built-in scene");
        let surface = scene.surface(SIZE.0, SIZE.1, GUARD);
        let order = render(&scene, &surface, Shading::Phong, FILL, &Visibility::Full).order;
        assert_eq!(order.order, (0..surface.triangles.len()).collect::<Vec<_>>());
    }
}
