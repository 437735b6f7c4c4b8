//! Polygons as triangles, for what draws nothing else: the same pixels, each as often.
//!
//! A constrained Delaunay triangulation of the snapped vertices has every edge of the polygon among its own; of its
//! triangles those are taken that have an odd number of edges on the way out. No vertex is new, so every edge lies where
//! the polygon's does, and the half-open rule gives each pixel to the polygon and to one triangle, or to neither.
//! Where edges cross, the crossing would have to be a vertex, and snapped it would lie elsewhere: refused.
//!
//! Values are the planes of these triangles, not those of an active edge table.

use super::{Polygon, Primitive};
use crate::frame::{Frame, ShadeMode, Triangle, Vertex};
use spade::handles::FixedVertexHandle;
use spade::{
    ConstrainedDelaunayTriangulation, HasPosition, Intersection, LineIntersectionIterator, Point2,
    Triangulation,
};
use std::borrow::Cow;

/// Two edges of a polygon cross, so that triangles between its vertices cannot cover it.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "polygon at vertex {x} {y}: the edge from there crosses another of its edges; permitted, where only triangles \
     can be drawn: edges that do not cross"
)]
pub struct CrossingEdges {
    /// Where one of them begins, pixels.
    pub x: f64,
    /// Likewise.
    pub y: f64,
}

/// A frame's triangles, with more of them for its polygons.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangulated<'a> {
    /// Each polygon replaced by triangles at its place.
    pub triangles: Cow<'a, [Triangle]>,
    /// For each of them the place among the frame's primitives of the one it was or is a part of.
    pub ids: Vec<i32>,
}

impl Frame {
    /// What the frame draws as triangles; the vertices of polygons are snapped to `subpixel_bits` bits (half to even).
    ///
    /// # Errors
    /// A polygon whose snapped edges cross.
    pub fn triangulated(&self, subpixel_bits: u32) -> Result<Triangulated<'_>, CrossingEdges> {
        if self.polygons.is_empty() {
            let ids = (0..).take(self.triangles.len()).collect();
            return Ok(Triangulated { triangles: Cow::Borrowed(&self.triangles), ids });
        }
        let (mut triangles, mut ids) = (Vec::new(), Vec::new());
        for (primitive, id) in self.primitives().into_iter().zip(0..) {
            match primitive {
                Primitive::Triangle(triangle) => triangles.push(*triangle),
                Primitive::Polygon(polygon) => {
                    let first = polygon.contours.first().and_then(|contour| contour.first());
                    let colored = |v: Vertex| match (self.mode, first) {
                        (ShadeMode::Flat, Some(first)) => Vertex { x: v.x, y: v.y, z: v.z, ..*first },
                        _ => v,
                    };
                    let parts = polygon.triangles(subpixel_bits)?;
                    triangles.extend(parts.into_iter().map(|part| Triangle(part.0.map(colored))));
                }
            }
            ids.resize(triangles.len(), id);
        }
        Ok(Triangulated { triangles: Cow::Owned(triangles), ids })
    }
}

impl Polygon {
    /// Triangles between its vertices that cover the same pixels, each as often. Of vertices that snap to one place the
    /// last one's values hold.
    ///
    /// # Errors
    /// Snapped edges cross. That they touch, or lie in one another, is permitted.
    pub fn triangles(&self, subpixel_bits: u32) -> Result<Vec<Triangle>, CrossingEdges> {
        let (mesh, edges) = self.mesh(subpixel_bits)?;
        let inside = inside(&mesh, &edges);
        let faces = mesh.inner_faces().filter(|face| inside[face.fix().index()] == Some(true));
        Ok(faces.map(|face| Triangle(face.vertices().map(|vertex| vertex.data().0))).collect())
    }

    /// The triangulation with the polygon's edges, and these edges.
    fn mesh(&self, subpixel_bits: u32) -> Result<(Mesh, Vec<[FixedVertexHandle; 2]>), CrossingEdges> {
        let mut mesh = Mesh::new();
        let mut edges = Vec::new();
        for contour in &self.contours {
            let corners: Vec<_> =
                // It refuses NaN, and numbers far beyond 2^28 or below 1: none is.
                contour.iter().filter_map(|v| mesh.insert(Corner(*v, on_grid(v, subpixel_bits))).ok()).collect();
            for (i, from) in corners.iter().enumerate() {
                let to = corners[(i + 1) % corners.len()];
                if *from == to {
                    continue;
                }
                if !mesh.can_add_constraint(*from, to) {
                    return Err(CrossingEdges { x: contour[i].x, y: contour[i].y });
                }
                mesh.add_constraint(*from, to);
                edges.push([*from, to]);
            }
        }
        Ok((mesh, edges))
    }
}

type Mesh = ConstrainedDelaunayTriangulation<Corner>;

/// A vertex and its place in sub-pixels.
struct Corner(Vertex, Point2<f64>);

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.1
    }
}

/// The nearest sub-pixel, half to even; whole numbers below 2^28. Adding 0 makes a -0 a 0.
fn on_grid(vertex: &Vertex, subpixel_bits: u32) -> Point2<f64> {
    let [x, y] = [vertex.x, vertex.y].map(|c| (c * f64::from(1u32 << subpixel_bits)).round_ties_even() + 0.0);
    Point2::new(x, y)
}

/// For each face whether it is inside: from the outer face inwards, every edge of the polygon changes sides.
fn inside(mesh: &Mesh, edges: &[[FixedVertexHandle; 2]]) -> Vec<Option<bool>> {
    // Edges of the polygon may lie in one another: what counts is how many lie here.
    let mut odd = vec![false; mesh.num_undirected_edges()];
    for [from, to] in edges {
        for hit in LineIntersectionIterator::new_from_handles(mesh, *from, *to) {
            if let Intersection::EdgeOverlap(edge) = hit {
                odd[edge.as_undirected().fix().index()] ^= true;
            }
        }
    }
    let mut inside = vec![None; mesh.num_all_faces()];
    inside[mesh.outer_face().fix().index()] = Some(false);
    let hull = mesh.convex_hull().flat_map(|edge| [edge, edge.rev()]);
    let mut border: Vec<_> = hull.filter(|edge| edge.is_outer_edge()).collect();
    while let Some(edge) = border.pop() {
        let here = inside[edge.face().fix().index()] == Some(true);
        let next = edge.rev().face();
        let slot = &mut inside[next.fix().index()];
        if slot.is_none() {
            *slot = Some(here ^ odd[edge.as_undirected().fix().index()]);
            border.extend(next.as_inner().into_iter().flat_map(|face| face.adjacent_edges()));
        }
    }
    inside
}
