//! Polygons among the triangles of a frame, and in place of them.

mod cut;
mod triangles;

pub(crate) use cut::cut;
pub use triangles::{CrossingEdges, Triangulated};

use crate::frame::{Frame, Polygon};
use crate::vertex::{Triangle, Vertex};

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
    /// Triangles and polygons in the order in which they are drawn. The place in this list is what a picture
    /// calls the id: without polygons, the place in [`Frame::triangles`].
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
