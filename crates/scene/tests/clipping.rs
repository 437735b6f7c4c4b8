//! Clipping at the near plane, the far plane and the guard band.
#![allow(clippy::unwrap_used)] // the meshes here are right

use edgewalk_scene::{Camera, Face, Frame, Material, Mesh, Scene, ShadeMode, Triangle, Vertex};
use glam::DVec3;

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
