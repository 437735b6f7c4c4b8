//! The built-in scenes: closed where they should be, fronts outside, and frames that keep what the mesh promises.
#![allow(clippy::unwrap_used)] // the names are the list's own

use edgewalk_scene::{Mesh, Scene, ShadeMode};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

const GUARD: f64 = 8191.0;

/// Every directed edge, and how often it occurs.
fn edges(mesh: &Mesh) -> HashMap<[u32; 2], u32> {
    let mut edges = HashMap::new();
    for [a, b, c] in mesh.faces().iter().map(|face| face.corners) {
        for edge in [[a, b], [b, c], [c, a]] {
            *edges.entry(edge).or_insert(0) += 1;
        }
    }
    edges
}

#[test]
fn closed_scenes_have_each_edge_once_in_each_direction() {
    for name in ["sphere", "torus", "torus-knot", "room"] {
        let edges = edges(&Scene::builtin(name).unwrap().mesh);
        for ([from, to], count) in &edges {
            assert_eq!((*count, edges.get(&[*to, *from])), (1, Some(&1)), "{name}");
        }
        assert!(edges.len() > 100, "{name}");
    }
    let open = edges(&Scene::builtin("terrain").unwrap().mesh);
    let border = open.keys().filter(|[from, to]| !open.contains_key(&[*to, *from])).count();
    assert_eq!(border, 4 * 96, "a landscape has a border and no other gap");
}

#[test]
fn fronts_are_outside() {
    // Six times the volume is positive if the fronts are outside.
    let volume = |mesh: &Mesh| -> f64 {
        mesh.faces().iter().map(|face| mesh.corners(face)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    };
    let of = |name: &str| volume(&Scene::builtin(name).unwrap().mesh);
    assert!((4.1..4.19).contains(&of("sphere")), "just below 4/3 pi");
    assert!((3.0..3.16).contains(&of("torus")), "just below 2 pi^2 r^2 = 3.158");
    assert!(of("torus-knot") > 0.0);
    assert!((-8.0..-7.0).contains(&of("room")), "the inside of a cube of 8, less the boxes");
}

#[test]
fn frames_keep_their_ranges_and_are_the_same_each_time() {
    for name in Scene::BUILTIN {
        for mode in ShadeMode::ALL {
            let scene = Scene::builtin(name).unwrap();
            let frame = scene.frame(640, 480, GUARD, mode);
            assert_eq!(frame, Scene::builtin(name).unwrap().frame(640, 480, GUARD, mode));
            assert!(frame.triangles.len() >= 40, "{name}: {}", frame.triangles.len());
            for v in frame.triangles.iter().flat_map(|triangle| triangle.0) {
                assert!(v.x.abs() <= GUARD && v.y.abs() <= GUARD, "{name} {v:?}");
                assert!([v.z, v.r, v.g, v.b].iter().all(|value| (0.0..=1.0).contains(value)), "{name} {v:?}");
            }
        }
    }
}

#[test]
fn the_sphere_wears_its_texture_by_longitude_and_latitude() {
    let mesh = Scene::builtin("sphere").unwrap().mesh;
    let mut checked = 0;
    for (face, data) in mesh.faces().iter().zip(mesh.face_data()) {
        for (position, place) in mesh.corners(face).into_iter().zip(data.texture.unwrap()) {
            let latitude = 1.0 - position.y.clamp(-1.0, 1.0).acos() / PI;
            assert!((place.y - latitude).abs() < 1e-9, "{position} {place}");
            // At a pole every longitude meets.
            if position.y.abs() < 1.0 - 1e-9 {
                let turns = place.x - position.x.atan2(position.z) / TAU;
                assert!((turns - turns.round()).abs() < 1e-9, "{position} {place}");
                checked += 1;
            }
        }
    }
    assert!(checked > 1000);
}

#[test]
fn what_is_in_view_is_not_touched() {
    for name in ["sphere", "torus", "torus-knot"] {
        let scene = Scene::builtin(name).unwrap();
        let frame = scene.frame(640, 480, GUARD, ShadeMode::Gouraud);
        assert_eq!(frame.triangles.len(), scene.mesh.faces().len(), "{name}");
        // One place on the screen for each position, whichever face asks.
        let mut places = HashMap::new();
        for (face, triangle) in scene.mesh.faces().iter().zip(&frame.triangles) {
            for (corner, v) in face.corners.into_iter().zip(triangle.0) {
                assert!((0.0..=640.0).contains(&v.x) && (0.0..=480.0).contains(&v.y), "{name} {v:?}");
                assert_eq!(*places.entry(corner).or_insert([v.x, v.y, v.z]), [v.x, v.y, v.z], "{name}");
            }
        }
    }
}

#[test]
fn land_and_room_reach_beyond_the_screen_and_the_camera() {
    for (name, faces) in [("terrain", 2 * 96 * 96), ("room", 12 * 4)] {
        let scene = Scene::builtin(name).unwrap();
        let frame = scene.frame(640, 480, GUARD, ShadeMode::Gouraud);
        let beyond =
            frame.triangles.iter().flat_map(|triangle| triangle.0).filter(|v| v.x.abs() > 1000.0).count();
        assert_eq!(scene.mesh.faces().len(), faces);
        assert!(beyond > 0, "{name}");
    }
}

#[test]
fn flat_frames_have_one_colour_a_face() {
    let frame = Scene::builtin("sphere").unwrap().frame(640, 480, GUARD, ShadeMode::Flat);
    assert_eq!(frame.mode, ShadeMode::Flat);
    for triangle in &frame.triangles {
        let [a, b, c] = triangle.0.map(|v| [v.r, v.g, v.b]);
        assert!(a == b && b == c);
    }
}

#[test]
fn an_unknown_scene_names_the_nearest() {
    for (name, hint) in [
        ("tours", "did you mean `torus`"),
        ("torus_knot", "did you mean `torus-knot`"),
        ("xyz", "sphere torus"),
    ] {
        let message = Scene::open(name).unwrap_err().to_string();
        assert!(message.contains(name) && message.contains(hint), "{message}");
    }
}
