//! Normals: of the faces, and at their corners by averaging the faces around (the slides; the crease of the
//! notes).

mod crowd;

use crate::mesh::Mesh;
use crowd::{CROWDED, Crowd, Member};
use glam::DVec3;
use std::collections::HashMap;

/// How much a face counts in the average at a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Weight {
    /// Each face as much: N_v = sum N_i / |sum N_i| (the slides).
    #[default]
    Plain,
    /// By its area.
    Area,
    /// By its angle at the vertex: however a flat part is cut into faces, the average is the same.
    Angle,
}

impl Weight {
    /// All three, in the order of [`Self::NAMES`].
    pub const ALL: [Self; 3] = [Self::Plain, Self::Area, Self::Angle];
    /// The names in files.
    pub const NAMES: [&'static str; 3] = ["plain", "area", "angle"];
}

/// Where the faces around a vertex stop being one surface: the edge is meant to be seen (the notes).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Crease {
    /// Beyond this angle between the normals of two faces, radians.
    Angle(f64),
    /// Between faces of different smoothing groups, and around each face of group 0.
    Groups,
}

/// Where the normals at the corners of faces come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalRule {
    /// Normals that the file gives stand as they are; only other corners are averaged.
    pub given: bool,
    /// What a face counts.
    pub weight: Weight,
    /// Which faces count.
    pub crease: Crease,
}

impl Default for NormalRule {
    /// Normals of the file, else plain averages of faces within 1 radian.
    fn default() -> Self {
        Self { given: true, weight: Weight::Plain, crease: Crease::Angle(1.0) }
    }
}

/// Unit normal of each face, towards its front; zero for a face without area.
pub(crate) fn face_normals(mesh: &Mesh) -> Vec<DVec3> {
    let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).normalize_or_zero();
    mesh.faces().iter().map(|face| normal(mesh.corners(face))).collect()
}

/// Unit normal at each corner of each face, towards its front.
pub(crate) fn corner_normals(mesh: &Mesh, face_normals: &[DVec3], rule: NormalRule) -> Vec<[DVec3; 3]> {
    let around = FacesAround::new(mesh);
    let member = |face: usize, vertex: u32| Member {
        normal: face_normals[face],
        group: mesh.face_data()[face].group,
        weight: weight(mesh, face, vertex, rule.weight),
    };
    let crowded = (0..mesh.positions().len() as u32).filter(|vertex| around.of(*vertex).len() > CROWDED);
    let crowds: HashMap<u32, Crowd> = crowded
        .map(|vertex| {
            let members = around.of(vertex).iter().map(|face| member(*face as usize, vertex));
            (vertex, Crowd::new(members.collect(), rule.crease))
        })
        .collect();
    let average = |own: usize, vertex: u32| {
        if let Some(crowd) = crowds.get(&vertex) {
            return crowd.sum(member(own, vertex)).try_normalize().unwrap_or(face_normals[own]);
        }
        let belongs = |face: usize| match rule.crease {
            Crease::Angle(angle) => face_normals[face].dot(face_normals[own]) >= angle.cos(),
            Crease::Groups => {
                let [group, other] = [own, face].map(|face| mesh.face_data()[face].group);
                face == own || (group == other && group != 0)
            }
        };
        let faces = around.of(vertex).iter().map(|face| *face as usize).filter(|face| belongs(*face));
        let sum: DVec3 = faces.map(|face| face_normals[face] * weight(mesh, face, vertex, rule.weight)).sum();
        // Faces that fold back on themselves may cancel.
        sum.try_normalize().unwrap_or(face_normals[own])
    };
    let corners = mesh.faces().iter().zip(mesh.face_data()).enumerate();
    corners
        .map(|(index, (face, data))| match data.normals.filter(|_| rule.given) {
            Some(normals) => normals,
            None => face.corners.map(|vertex| average(index, vertex)),
        })
        .collect()
}

/// What a face counts at one of its vertices; only ratios matter.
fn weight(mesh: &Mesh, face: usize, vertex: u32, weight: Weight) -> f64 {
    let face = &mesh.faces()[face];
    let [a, b, c] = mesh.corners(face);
    match weight {
        Weight::Plain => 1.0,
        Weight::Area => (b - a).cross(c - a).length(),
        Weight::Angle => {
            let [at, next, last] = match face.corners.iter().position(|corner| *corner == vertex) {
                Some(1) => [b, c, a],
                Some(2) => [c, a, b],
                _ => [a, b, c],
            };
            // A face without area has no angle, and no normal either.
            let angle = (next - at).angle_between(last - at);
            if angle.is_nan() { 0.0 } else { angle }
        }
    }
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
    use crate::mesh::{Face, FaceData, Material, room, sphere};
    use std::f64::consts::PI;

    fn within(angle: f64) -> NormalRule {
        NormalRule { crease: Crease::Angle(angle), ..NormalRule::default() }
    }

    #[test]
    fn normals_of_a_sphere_are_its_radii() {
        let mesh = sphere(48, 24).unwrap();
        let normals = corner_normals(&mesh, &face_normals(&mesh), within(PI));
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
        let creased = corner_normals(&mesh, &own, within(1.0));
        let smooth = corner_normals(&mesh, &own, within(PI));
        for ((own, creased), smooth) in own.iter().zip(creased).zip(smooth) {
            assert!(creased.iter().all(|normal| normal.distance(*own) < 1e-12));
            assert!(
                smooth.iter().all(|normal| normal.distance(*own) > 0.1),
                "three walls meet at each corner"
            );
        }
    }

    /// A corner of a box: one side is one face there, one is two, and the third, cut unevenly, is two as
    /// well.
    fn uneven_corner(groups: [u32; 5]) -> Mesh {
        let positions = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 4)]
            .map(|(x, y, z)| DVec3::new(x.into(), y.into(), z.into()) + DVec3::new(7.0, -3.0, 2.0));
        // Two faces across z, one across y, two across x of which the second reaches far.
        let corners = [[0, 4, 1], [0, 2, 4], [0, 1, 3], [0, 3, 5], [0, 5, 2]];
        let faces = corners.map(|corners| Face { corners, material: 0 }).to_vec();
        let data = groups.map(|group| FaceData { group, ..FaceData::default() });
        let mesh = Mesh::new("corner", positions.to_vec(), faces, vec![Material::DEFAULT]).unwrap();
        mesh.with_face_data(data.to_vec())
    }

    #[test]
    fn weights_by_hand() {
        let mesh = uneven_corner([0; 5]);
        let own = face_normals(&mesh);
        let at_corner = |weight| corner_normals(&mesh, &own, NormalRule { weight, ..within(PI) })[0][0];
        let expected = |x: f64, y: f64, z: f64| DVec3::new(-x, -y, -z).normalize();
        // Faces: 2 of x = 0, 1 of y = 0, 2 of z = 0. Areas: (1 + 4) / 2, 1 / 2, 1. Angles: a right one each.
        let cases = [
            (Weight::Plain, expected(2.0, 1.0, 2.0)),
            (Weight::Area, expected(2.5, 0.5, 1.0)),
            (Weight::Angle, expected(1.0, 1.0, 1.0)),
        ];
        for (weight, expected) in cases {
            let normal = at_corner(weight);
            assert!(normal.distance(expected) < 1e-12, "{weight:?}: {normal}, not {expected}");
        }
    }

    #[test]
    fn smoothing_groups_part_what_angles_would_join() {
        let mesh = uneven_corner([1, 0, 1, 2, 0]);
        let own = face_normals(&mesh);
        let rule = NormalRule { crease: Crease::Groups, ..NormalRule::default() };
        let at_corner: Vec<DVec3> =
            corner_normals(&mesh, &own, rule).iter().map(|normals| normals[0]).collect();
        let together = DVec3::new(0.0, -1.0, -1.0).normalize();
        let expected = [together, own[1], together, own[3], own[4]];
        for (face, (normal, expected)) in at_corner.iter().zip(expected).enumerate() {
            assert!(normal.distance(expected) < 1e-12, "face {face}: {normal}; group 0 smooths nothing");
        }
    }

    #[test]
    fn normals_of_the_file_stand_unless_they_are_not_wanted() {
        let mesh = uneven_corner([0; 5]);
        let given = FaceData { normals: Some([DVec3::X; 3]), ..FaceData::default() };
        let mesh = mesh.with_face_data(vec![given]);
        let own = face_normals(&mesh);
        let first = |given| corner_normals(&mesh, &own, NormalRule { given, ..within(1.0) })[0][0];
        assert_eq!(first(true), DVec3::X);
        assert!(first(false).distance(own[0]) < 1e-12);
    }
}
