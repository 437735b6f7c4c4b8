//! Closed meshes: every edge is shared by two faces, so with both windings drawn an even number of triangles lies over
//! every pixel. No reference picture is needed to see a gap or a pixel drawn twice.
#![allow(clippy::unwrap_used)] // built in

use edgewalk_golden::{Fill, Picture, draw};
use edgewalk_scene::{Camera, Face, Material, Mesh, Scene, ShadeMode};

const GUARD: f64 = 8191.0;

fn picture(scene: &Scene, (width, height): (u32, u32), subpixel_bits: u32) -> Picture {
    draw(&scene.frame(width, height, GUARD, ShadeMode::Gouraud), Fill::Exact { subpixel_bits })
}

/// Even everywhere; returns the number of covered pixels.
fn assert_even(name: &str, scene: &Scene, screen: (u32, u32), subpixel_bits: u32) -> usize {
    let picture = picture(scene, screen, subpixel_bits);
    for (at, count) in picture.coverage.iter().enumerate() {
        let (x, y) = (at % screen.0 as usize, at / screen.0 as usize);
        assert!(
            count % 2 == 0,
            "{name}: {count} triangles over pixel {x} {y} with {subpixel_bits} sub-pixel bits"
        );
    }
    let covered = picture.coverage.iter().filter(|count| **count > 0).count();
    println!("{name}: {covered} of {} pixels covered, all evenly", picture.coverage.len());
    covered
}

#[test]
fn built_in_scenes_cover_evenly() {
    for name in ["sphere", "torus", "torus-knot"] {
        let scene = Scene::builtin(name).unwrap();
        for (screen, bits) in [((320, 240), 8), ((160, 120), 4), ((61, 97), 0)] {
            let covered = assert_even(name, &scene, screen, bits);
            assert!(covered * 8 > (screen.0 * screen.1) as usize, "{name}: {covered} pixels");
        }
    }
}

#[test]
fn the_room_fills_the_screen() {
    // Walls are cut by the near plane, so nothing need be even, but no line of sight leaves a closed room.
    let picture = picture(&Scene::builtin("room").unwrap(), (320, 240), 8);
    assert!(picture.coverage.iter().all(|count| *count > 0));
    assert!(picture.z.iter().all(|z| *z < 1.0));
}

#[test]
fn a_floor_cut_by_near_plane_and_guard_band_covers_once() {
    let corners =
        [[-900.0, -1.0, 800.0], [900.0, -1.3, 700.0], [800.0, -1.1, -900.0], [-900.0, -1.2, -800.0]];
    let hub = [0.3, -1.0, -2.0];
    let positions = corners.into_iter().chain([hub]).map(Into::into).collect();
    let faces = (0..4).map(|k| Face { corners: [k, (k + 1) % 4, 4], material: 0 }).collect();
    let mesh = Mesh::new("floor", positions, faces, vec![Material::DEFAULT]).unwrap();
    let [eye, target, up] = [[0.0; 3], [0.0, -1.0, -1.0], [0.0, 1.0, 0.0]].map(Into::into);
    // Down at the hub, all four faces in view; the horizon is above the screen.
    let camera = Camera { eye, target, up, angle: 1.2, near: 0.2, far: 500.0 };
    let scene = Scene { camera, ..Scene::of_mesh(mesh) };
    for guard in [700.0, GUARD] {
        let frame = scene.frame(640, 480, guard, ShadeMode::Gouraud);
        assert!(frame.triangles.len() > 4, "something is cut");
        let picture = draw(&frame, Fill::Exact { subpixel_bits: 8 });
        assert!(picture.coverage.iter().all(|count| *count == 1), "guard band {guard}");
    }
}
