//! T-joints: vertices in the middle of an edge of a face that does not have them (the slides: usually not allowed).
//!
//! ```text
//!   a ------------- b      the face above has the edge a b and not v: shading breaks along it, and pixels
//!    \  |  \     /         may be missed or drawn twice where v is moved to the sub-pixel grid
//!      -- v ---
//! ```
//! An edge of two faces has no T-joint: both sides have the same vertices. So edges of one face, and their ends, are asked.

use super::Mesh;
use glam::DVec3;
use std::collections::HashMap;

/// A vertex that lies on an edge, and is none of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TJoint {
    /// x, y and z of the vertex.
    pub vertex: [f64; 3],
    /// x, y and z of the edge's ends.
    pub edge: [[f64; 3]; 2],
}

/// Farthest that the vertex lies from the edge, in sizes of the mesh.
const NEAR: f64 = 1e-9;

impl Mesh {
    /// Of each edge that only one face has the vertices in its middle, one for each such vertex, in the order of the faces.
    pub fn t_joints(&self) -> Vec<TJoint> {
        let mut uses: HashMap<[u32; 2], u32> = HashMap::new();
        let sides = |face: &super::Face| {
            let [a, b, c] = face.corners;
            [[a, b], [b, c], [c, a]].map(|[from, to]| [from.min(to), from.max(to)])
        };
        let all = || self.faces.iter().flat_map(sides);
        all().for_each(|edge| *uses.entry(edge).or_default() += 1);
        let edges: Vec<[u32; 2]> = all().filter(|edge| edge[0] != edge[1] && uses[edge] == 1).collect();
        let mut ends: Vec<u32> = edges.iter().flatten().copied().collect();
        ends.sort_unstable();
        ends.dedup();
        let at = |vertex: u32| self.positions[vertex as usize];
        let sorted = [0, 1, 2].map(|axis: usize| {
            let mut ends = ends.clone();
            ends.sort_by(|a, b| at(*a)[axis].total_cmp(&at(*b)[axis]));
            ends
        });
        let [low, high] = self.bounds();
        let near = NEAR * (high - low).max_element();
        let mut found = Vec::new();
        for [a, b] in edges {
            let [from, to] = [at(a), at(b)];
            // Of the vertices beside the edge along each axis the fewest.
            let beside = |axis: usize| {
                let [least, most] = [from[axis].min(to[axis]) - near, from[axis].max(to[axis]) + near];
                let place = |limit: f64| sorted[axis].partition_point(|vertex| at(*vertex)[axis] < limit);
                &sorted[axis][place(least)..place(most)]
            };
            let few = [0, 1, 2].map(beside).into_iter().min_by_key(|of| of.len()).unwrap_or_default();
            let middle =
                few.iter().filter(|vertex| ![a, b].contains(vertex) && is_on(at(**vertex), from, to, near));
            let edge = [from, to].map(|end| end.to_array());
            found.extend(middle.map(|vertex| TJoint { vertex: at(*vertex).to_array(), edge }));
        }
        found
    }
}

/// Whether a place lies on an edge, not at its ends.
fn is_on(place: DVec3, from: DVec3, to: DVec3, near: f64) -> bool {
    let (along, off) = (to - from, place - from);
    let part = off.dot(along) / along.length_squared();
    (0.0..=1.0).contains(&part)
        && off.distance(part * along) <= near
        && place.distance(from) > near
        && place.distance(to) > near
}
