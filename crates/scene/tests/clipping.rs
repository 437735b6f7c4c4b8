//! Clipping at the near plane, the far plane and the guard band.
#![allow(clippy::unwrap_used)] // the meshes here are right

use edgewalk_scene::{
    Camera, Face, FaceData, Frame, Light, Material, Mesh, Scene, ShadeMode, Triangle, Vertex,
};
use glam::{DMat3, DVec2, DVec3};

/// A camera at the origin looking along -z.
fn scene(positions: Vec<DVec3>, corners: &[[u32; 3]]) -> Scene {
    let faces = corners.iter().map(|corners| Face { corners: *corners, material: 0 }).collect();
    let mesh = Mesh::new("test", positions, faces, vec![Material::DEFAULT]).unwrap();
    let camera =
        Camera { eye: DVec3::ZERO, target: DVec3::NEG_Z, up: DVec3::Y, angle: 1.2, near: 0.1, far: 100.0 };
    Scene { camera, ..Scene::of_mesh(mesh) }
}

fn frame(scene: &Scene) -> Frame {
    scene.frame(200, 100, 1000.0, ShadeMode::Gouraud)
}

fn places(triangle: &Triangle) -> [[f64; 3]; 3] {
    triangle.0.map(|Vertex { x, y, z, .. }| [x, y, z])
}

/// Twice the area, positive if clockwise on the screen.
fn area(triangle: &Triangle) -> f64 {
    let [a, b, c] = places(triangle);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[test]
fn a_floor_from_behind_the_camera_to_the_horizon() {
    // Corners far behind, far beyond, far to both sides: near, far, left and right planes cut.
    let [left, right] = [-5000.0, 5000.0];
    let floor =
        [(left, 500.0), (right, 500.0), (right, -500.0), (left, -500.0)].map(|(x, z)| DVec3::new(x, -1.0, z));
    let scene = scene(floor.to_vec(), &[[0, 1, 2], [0, 2, 3]]);
    let frame = frame(&scene);
    assert!(frame.triangles.len() > 2);
    let mut depths = Vec::new();
    for triangle in &frame.triangles {
        for [x, y, z] in places(triangle) {
            assert!(x.abs() <= 1000.0 && y.abs() <= 1000.0 && (0.0..=1.0).contains(&z));
            depths.push(z);
        }
        assert!(area(triangle) <= 0.0, "the winding survives");
    }
    // A depth of d pictures the floor 50 / tan 0.6 / d pixels below the middle.
    let horizon = frame.triangles.iter().flat_map(places).map(|[_, y, _]| y).fold(f64::MAX, f64::min);
    let scale = 50.0 / 0.6f64.tan();
    assert!((horizon - (50.0 + scale / 100.0)).abs() < 1e-6, "{horizon}");
    assert!(depths.iter().any(|z| (z - 1.0).abs() < 1e-9));
    // Both triangles together are a rectangle without gap or overlap: its area is that of its outline.
    let total: f64 = frame.triangles.iter().map(|triangle| -area(triangle) / 2.0).sum();
    assert!((total - 2000.0 * scale * (10.0 - 0.01)).abs() < 1e-3, "{total}");
}

#[test]
fn a_cut_shared_edge_gets_one_new_vertex() {
    // The edge 0-2 runs through the near plane, 1 and 3 lie on either side of it.
    let corners = [(0.1, 0.2, -5.0), (-3.0, 0.1, -4.0), (-0.3, -0.1, 2.0), (3.0, 0.3, -4.0)];
    let scene = scene(corners.map(DVec3::from).to_vec(), &[[0, 1, 2], [0, 2, 3]]);
    let frame = frame(&scene);
    let on_edge = |triangles: &[Triangle]| {
        let mut found: Vec<[u64; 3]> =
            triangles.iter().flat_map(places).map(|place| place.map(f64::to_bits)).collect();
        found.sort_unstable();
        found.dedup();
        found
    };
    let half = frame.triangles.len() / 2;
    let [first, second] = [&frame.triangles[..half], &frame.triangles[half..]].map(on_edge);
    let shared = first.iter().filter(|place| second.contains(place)).count();
    assert_eq!(shared, 2, "vertex 0 and the cut");
}

#[test]
fn what_is_outside_one_plane_is_gone() {
    let outside = [
        [(0.0, 0.0, 1.0), (1.0, 0.0, 2.0), (0.0, 1.0, 1.5)], // behind
        [(0.0, 0.0, -101.0), (1.0, 0.0, -150.0), (0.0, 1.0, -101.0)], // beyond
        [(90.0, 0.0, -1.0), (95.0, 0.0, -1.0), (90.0, 1.0, -1.0)], // right of the guard band
        [(0.0, 90.0, -1.0), (1.0, 90.0, -1.0), (0.0, 95.0, -1.0)], // above it
    ];
    for corners in outside {
        let scene = scene(corners.map(DVec3::from).to_vec(), &[[0, 1, 2]]);
        assert!(frame(&scene).triangles.is_empty(), "{corners:?}");
    }
}

#[test]
fn off_the_screen_but_in_the_guard_band_is_kept_whole() {
    let corners = [(-4.0, 0.0, -1.0), (4.0, 0.5, -1.0), (0.0, -5.0, -1.0)];
    let scene = scene(corners.map(DVec3::from).to_vec(), &[[0, 1, 2]]);
    assert_eq!(frame(&scene).triangles.len(), 1);
}

/// A cut vertex is a mean of the corners in the world, and everything it carries is the same mean.
#[test]
fn a_cut_vertex_carries_the_mean_of_the_corners() {
    let whole = [(0.3, -0.5, -8.0), (-6.0, 2.0, -3.0), (2.5, 4.0, 6.0)].map(DVec3::from);
    let given = [(0.0, 0.6, 0.8), (0.6, 0.0, 0.8), (-0.48, 0.6, 0.64)].map(DVec3::from);
    let places = [(0.0, 0.0), (3.0, 0.25), (-1.0, 2.0)].map(DVec2::from);
    let mut scene = scene(whole.to_vec(), &[[0, 1, 2]]);
    let data = FaceData { normals: Some(given), texture: Some(places), ..FaceData::default() };
    scene.mesh = scene.mesh.with_face_data(vec![data]);
    let toward = DVec3::new(-0.8, -0.1, -0.6).normalize();
    scene.lights = vec![Light::Directional { toward, intensity: DVec3::splat(0.7) }];
    // Narrow enough that the guard band cuts too.
    let surface = scene.surface(200, 100, 260.0);
    assert!(surface.triangles.len() > 1);
    // The normals are on the side that is seen, the colours those of the corners.
    let front = (whole[1] - whole[0]).cross(whole[2] - whole[0]);
    let side = if front.dot(-whole[0]) < 0.0 { -1.0 } else { 1.0 };
    let colors = [0, 1, 2].map(|k| {
        let color = scene.lighting().shade(&Material::DEFAULT, &scene.point(whole[k], side * given[k]));
        color.clamp(DVec3::ZERO, DVec3::ONE)
    });
    assert!(colors[0].distance(colors[1]) > 0.05 && colors[1].distance(colors[2]) > 0.05, "{colors:?}");
    let mut cut = 0;
    for vertex in surface.triangles.iter().flat_map(|triangle| triangle.vertices) {
        // The corners are independent vectors, so their weights at a point are one solution.
        let weights = DMat3::from_cols(whole[0], whole[1], whole[2]).inverse() * vertex.position;
        assert!((weights.element_sum() - 1.0).abs() < 1e-12 && weights.min_element() > -1e-12);
        let mean = |of: [DVec3; 3]| of[0] * weights.x + of[1] * weights.y + of[2] * weights.z;
        let screen = vertex.screen;
        let seen = scene.camera.to_clip(200, 100) * vertex.position.extend(1.0);
        let there = DVec2::new(100.0 + 100.0 * seen.x / seen.w, 50.0 - 50.0 * seen.y / seen.w);
        assert!(there.distance(DVec2::new(screen.x, screen.y)) < 1e-9, "the world's place is the screen's");
        assert!(
            (1.0 / vertex.inverse_w - seen.w).abs() < 1e-12 && (screen.z - seen.z / seen.w).abs() < 1e-12
        );
        assert!(vertex.normal.distance(side * mean(given)) < 1e-12, "normal {}", vertex.normal);
        let texture = mean(places.map(|place| place.extend(0.0))).truncate();
        assert!(vertex.texture.distance(texture) < 1e-12, "texture {}", vertex.texture);
        let color = DVec3::new(screen.r, screen.g, screen.b);
        assert!(color.distance(mean(colors)) < 1e-12, "colour {color}");
        cut += i32::from(weights.max_element() < 1.0 - 1e-9);
    }
    assert!(cut > 4, "{cut}");
}
