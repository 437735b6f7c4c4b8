//! A tree of boxes around faces, halved at the median of the longest side.

use super::hit::Ray;
use edgewalk_scene::Mesh;
use glam::DVec3;
use std::ops::Range;

/// Faces a leaf.
const LEAF: usize = 4;

/// Boxes are widened by this part of the mesh's farthest coordinate, so that rounding never misses one.
const SLACK: f64 = 1e-12;

pub(super) struct Tree {
    faces: Vec<u32>,
    nodes: Vec<Node>,
}

struct Node {
    low: DVec3,
    high: DVec3,
    kind: Kind,
}

enum Kind {
    /// Places in `faces`.
    Leaf(Range<usize>),
    /// Places in `nodes`.
    Halves([usize; 2]),
}

impl Tree {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let faces = (0..mesh.faces().len() as u32).collect();
        let mut tree = Self { faces, nodes: Vec::new() };
        let [low, high] = mesh.bounds();
        tree.build(mesh, 0..tree.faces.len(), SLACK * low.abs().max(high.abs()).max_element());
        tree
    }

    /// Adds the node of these faces and all below it; returns its place.
    fn build(&mut self, mesh: &Mesh, range: Range<usize>, slack: f64) -> usize {
        let corners = |face: u32| mesh.corners(&mesh.faces()[face as usize]);
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for corner in self.faces[range.clone()].iter().flat_map(|face| corners(*face)) {
            (low, high) = (low.min(corner), high.max(corner));
        }
        let axis = (high - low).max_position();
        let place = self.nodes.len();
        let kind = Kind::Leaf(range.clone());
        self.nodes.push(Node { low: low - slack, high: high + slack, kind });
        if range.len() > LEAF {
            let half = range.len() / 2;
            let middle = |face: u32| corners(face).into_iter().map(|corner| corner[axis]).sum::<f64>();
            self.faces[range.clone()].select_nth_unstable_by(half, |a, b| middle(*a).total_cmp(&middle(*b)));
            let split = range.start + half;
            let halves =
                [self.build(mesh, range.start..split, slack), self.build(mesh, split..range.end, slack)];
            self.nodes[place].kind = Kind::Halves(halves);
        }
        place
    }

    /// Calls `take` with every face whose box the ray meets, until it returns false.
    pub(super) fn walk(&self, ray: &Ray, mut take: impl FnMut(u32) -> bool) {
        let inverse = ray.way.recip();
        let mut open = vec![0];
        while let Some(place) = open.pop() {
            let node = &self.nodes[place];
            let (a, b) = ((node.low - ray.from) * inverse, (node.high - ray.from) * inverse);
            // A ray within a side of the box gives NaN there; min and max leave NaN out, so the side does not count.
            let enter = (0..3).map(|k| a[k].min(b[k])).fold(0.0, f64::max);
            let leave = (0..3).map(|k| a[k].max(b[k])).fold(f64::INFINITY, f64::min);
            if enter > leave {
                continue;
            }
            match &node.kind {
                Kind::Halves(halves) => open.extend(halves),
                Kind::Leaf(range) => {
                    if !self.faces[range.clone()].iter().all(|face| take(*face)) {
                        return;
                    }
                }
            }
        }
    }
}
