//! Normals: of the faces, and at their corners by averaging the faces around (seed B; the crease of seed C).

use crate::mesh::Mesh;
use glam::DVec3;

/// Unit normal of each face, towards its front; zero for a face without area.
pub(crate) fn face_normals(mesh: &Mesh) -> Vec<DVec3> {
    let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).normalize_or_zero();
    mesh.faces().iter().map(|face| normal(mesh.corners(face))).collect()
}

/// Unit normal at each corner of each face: N_v = sum N_i / |sum N_i| over the faces around the vertex whose normals lie
/// within `crease` radians of this face's. Beyond it the edge is meant to be seen.
pub(crate) fn corner_normals(mesh: &Mesh, face_normals: &[DVec3], crease: f64) -> Vec<[DVec3; 3]> {
    let around = FacesAround::new(mesh);
    let least = crease.cos();
    let corner = |own: DVec3, vertex: u32| {
        let faces = around.of(vertex).iter().map(|face| face_normals[*face as usize]);
        let sum: DVec3 = faces.filter(|normal| normal.dot(own) >= least).sum();
        // Faces that fold back on themselves may cancel.
        sum.try_normalize().unwrap_or(own)
    };
    let faces = mesh.faces().iter().zip(face_normals);
    faces.map(|(face, own)| face.corners.map(|vertex| corner(*own, vertex))).collect()
}

/// The faces around each vertex.
struct FacesAround {
    /// Where each vertex's faces start in `faces`; one more entry ends the last.
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl FacesAround {
    fn new(mesh: &Mesh) -> Self {
        let mut starts = vec![0; mesh.positions().len() + 1];
        for corner in mesh.faces().iter().flat_map(|face| face.corners) {
            starts[corner as usize + 1] += 1;
        }
        for vertex in 1..starts.len() {
            starts[vertex] += starts[vertex - 1];
        }
        let mut next = starts.clone();
        let mut faces = vec![0; 3 * mesh.faces().len()];
        for (index, face) in (0..).zip(mesh.faces()) {
            for corner in face.corners {
                let slot = &mut next[corner as usize];
                faces[*slot as usize] = index;
                *slot += 1;
            }
        }
        Self { starts, faces }
    }

    fn of(&self, vertex: u32) -> &[u32] {
        let [from, to] = [self.starts[vertex as usize], self.starts[vertex as usize + 1]];
        &self.faces[from as usize..to as usize]
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // the meshes are built in
mod tests {
    use super::*;
    use crate::mesh::{room, sphere};
    use std::f64::consts::PI;

    #[test]
    fn normals_of_a_sphere_are_its_radii() {
        let mesh = sphere(48, 24).unwrap();
        let normals = corner_normals(&mesh, &face_normals(&mesh), PI);
        for (face, normals) in mesh.faces().iter().zip(normals) {
            for (position, normal) in mesh.corners(face).into_iter().zip(normals) {
                assert!((normal.length() - 1.0).abs() < 1e-12);
                assert!(normal.dot(position) > 0.998, "{normal} at {position}");
            }
        }
    }

    #[test]
    fn a_crease_keeps_the_walls_of_a_room_apart() {
        let mesh = room().unwrap();
        let own = face_normals(&mesh);
        let creased = corner_normals(&mesh, &own, 1.0);
        let smooth = corner_normals(&mesh, &own, PI);
        for ((own, creased), smooth) in own.iter().zip(creased).zip(smooth) {
            assert!(creased.iter().all(|normal| normal.distance(*own) < 1e-12));
            assert!(
                smooth.iter().all(|normal| normal.distance(*own) > 0.1),
                "three walls meet at each corner"
            );
        }
    }
}
