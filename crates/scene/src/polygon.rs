//! Polygons on the screen, and where they stand among the triangles of a frame.

mod cut;
mod triangles;

pub(crate) use cut::cut;
pub use triangles::{CrossingEdges, Triangulated};

use crate::frame::{Frame, Triangle, Vertex};

/// Most vertices of a contour.
pub const MAX_CONTOUR: usize = 65536;

/// A polygon on the screen: convex, concave, with holes or crossing itself; inside is what an odd number of edges lies
/// to the left of (seed B, odd-even rule).
///
/// Its values run linearly along the edges, then linearly along a line between two edges (seed B: l_a, l_b, l_p). Only
/// in a triangle, or where the vertices' values lie in one plane, is that the plane; elsewhere it depends on how the
/// polygon is turned.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// Closed lines of 3..=[`MAX_CONTOUR`] vertices; the last vertex is joined to the first. In flat mode the first
    /// vertex of the first contour colours the whole.
    pub contours: Vec<Vec<Vertex>>,
    /// How many triangles of the frame are drawn before it.
    pub after: usize,
}

/// What a frame draws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive<'a> {
    /// One of [`Frame::triangles`].
    Triangle(&'a Triangle),
    /// One of [`Frame::polygons`].
    Polygon(&'a Polygon),
}

impl<'a> Primitive<'a> {
    /// The closed lines around it.
    pub fn contours(self) -> Vec<&'a [Vertex]> {
        match self {
            Self::Triangle(triangle) => vec![&triangle.0],
            Self::Polygon(polygon) => polygon.contours.iter().map(Vec::as_slice).collect(),
        }
    }
}

impl Frame {
    /// Triangles and polygons in the order in which they are drawn. The place in this list is what a picture calls the
    /// id: without polygons, the place in [`Frame::triangles`].
    pub fn primitives(&self) -> Vec<Primitive<'_>> {
        let mut list = Vec::with_capacity(self.triangles.len() + self.polygons.len());
        let mut drawn = 0;
        for polygon in &self.polygons {
            let after = polygon.after.clamp(drawn, self.triangles.len());
            list.extend(self.triangles[drawn..after].iter().map(Primitive::Triangle));
            list.push(Primitive::Polygon(polygon));
            drawn = after;
        }
        list.extend(self.triangles[drawn..].iter().map(Primitive::Triangle));
        list
    }
}
