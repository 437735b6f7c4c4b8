//! T-joints of meshes.

use edgewalk_scene::{Face, Material, Mesh, Scene};
use glam::DVec3;

fn mesh(positions: &[DVec3], faces: &[[u32; 3]]) -> Mesh {
    let faces = faces.iter().map(|corners| Face { corners: *corners, material: 0 }).collect();
    Mesh::new("mesh", positions.to_vec(), faces, vec![Material::DEFAULT]).unwrap()
}

#[test]
fn built_in_meshes_have_no_t_joint() {
    for name in Scene::BUILTIN {
        let mesh = Scene::builtin(name).unwrap().mesh;
        assert_eq!(mesh.t_joints().len(), 0, "{name}");
    }
}

/// Triangles on their own; of some an edge is cut at random places, and so many vertices more are on it.
#[test]
fn each_vertex_on_an_edge_is_found_once() {
    let (mut state, mut checked) = (4u64, 0);
    // A linear congruential sequence: the crate has no other.
    let mut random = |low: f64, high: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (state >> 11) as f64 / (1u64 << 53) as f64
    };
    for _ in 0..300 {
        let mut positions: Vec<DVec3> =
            (0..9).map(|_| DVec3::from([(); 3].map(|()| random(-5.0, 5.0)))).collect();
        let mut faces = vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]];
        let mut cuts: Vec<f64> = (0..random(0.0, 4.0) as u32).map(|_| random(0.1, 0.9)).collect();
        cuts.sort_by(f64::total_cmp);
        let (from, to) = (positions[0], positions[1]);
        let beyond = from + to - positions[2];
        let mut before = 0;
        positions.push(beyond);
        for cut in &cuts {
            positions.push(from.lerp(to, *cut));
            let place = positions.len() as u32 - 1;
            faces.push([before, place, 9]);
            before = place;
        }
        faces.push([before, 1, 9]);
        let joints = mesh(&positions, &faces).t_joints();
        let ends = [from, to].map(|end| end.to_array());
        assert!(joints.iter().all(|joint| joint.edge == ends || joint.edge == [ends[1], ends[0]]));
        let found: Vec<f64> =
            joints.iter().map(|joint| DVec3::from(joint.vertex).distance(from) / to.distance(from)).collect();
        assert_eq!(found.len(), cuts.len(), "{cuts:?} {found:?}");
        assert!(cuts.iter().all(|cut| found.iter().any(|at| (at - cut).abs() < 1e-9)), "{cuts:?} {found:?}");
        checked += cuts.len();
    }
    println!("checked {checked} T-joints");
    assert!(checked > 200);
}

#[test]
fn a_vertex_beside_an_edge_or_at_its_end_is_none() {
    let [a, b, c] = [DVec3::ZERO, DVec3::X * 4.0, DVec3::new(1.0, 3.0, 0.0)];
    for beside in [DVec3::new(2.0, -0.01, 0.0), DVec3::new(2.0, 0.0, 0.01), DVec3::new(4.01, 0.0, 0.0), a, b]
    {
        let positions = [a, b, c, beside, DVec3::new(1.0, -3.0, 0.0), DVec3::new(3.0, -3.0, 0.0)];
        assert_eq!(mesh(&positions, &[[0, 1, 2], [3, 4, 5]]).t_joints().len(), 0, "{beside}");
    }
}

/// Two faces share an edge, and the corner of a third touches its middle: between the two there is no crack.
#[test]
fn an_edge_of_two_faces_has_none() {
    let [a, b, c] = [DVec3::ZERO, DVec3::X * 4.0, DVec3::new(1.0, 3.0, 0.0)];
    let positions =
        [a, b, c, DVec3::new(1.0, -3.0, 0.0), DVec3::X, DVec3::new(1.0, 0.0, 3.0), DVec3::new(2.0, 0.0, 3.0)];
    let faces = [[0, 1, 2], [1, 0, 3], [4, 5, 6]];
    assert_eq!(mesh(&positions, &faces).t_joints().len(), 0);
    assert_eq!(mesh(&positions, &[faces[0], faces[2]]).t_joints().len(), 1);
}
