//! Polygons and lines among the triangles of a frame, and triangles in place of polygons.

mod cut;
mod triangles;

pub(crate) use cut::cut;
pub use triangles::{CrossingEdges, Triangulated};

use crate::frame::{Frame, Line, Polygon};
use crate::vertex::{Triangle, Vertex};

/// What a frame draws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive<'a> {
    /// One of [`Frame::triangles`].
    Triangle(&'a Triangle),
    /// One of [`Frame::polygons`].
    Polygon(&'a Polygon),
    /// One of [`Frame::lines`].
    Line(&'a Line),
}

impl<'a> Primitive<'a> {
    /// The closed lines around it; of a line itself.
    pub fn contours(self) -> Vec<&'a [Vertex]> {
        match self {
            Self::Triangle(triangle) => vec![&triangle.0],
            Self::Polygon(polygon) => polygon.contours.iter().map(Vec::as_slice).collect(),
            Self::Line(line) => vec![&line.ends],
        }
    }
}

impl Frame {
    /// Triangles, polygons and lines in the order in which they are drawn. The place in this list is what a
    /// picture calls the id: without polygons and lines, the place in [`Frame::triangles`].
    pub fn primitives(&self) -> Vec<Primitive<'_>> {
        let surfaces = self.surfaces();
        if self.lines.is_empty() {
            return surfaces;
        }
        let (mut list, mut drawn) = (Vec::with_capacity(self.drawn()), 0);
        for line in &self.lines {
            let after = line.after.clamp(drawn, surfaces.len());
            list.extend_from_slice(&surfaces[drawn..after]);
            list.push(Primitive::Line(line));
            drawn = after;
        }
        list.extend_from_slice(&surfaces[drawn..]);
        list
    }

    /// The triangle at this place of the list; none where another thing or nothing is.
    pub fn triangle_at(&self, place: usize) -> Option<&Triangle> {
        let before_lines = self.lines.first().is_none_or(|line| place < line.after);
        if self.polygons.is_empty() && before_lines {
            return self.triangles.get(place);
        }
        match self.primitives().get(place)? {
            Primitive::Triangle(triangle) => Some(triangle),
            Primitive::Polygon(_) | Primitive::Line(_) => None,
        }
    }

    /// The same without lines.
    fn surfaces(&self) -> Vec<Primitive<'_>> {
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
