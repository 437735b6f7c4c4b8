//! Polygons as triangles, for what draws nothing else: the same pixels, each as often.
//!
//! They have the snapped vertices of the polygon and no other, so every edge of the polygon is one of theirs,
//! and the half-open rule gives each pixel to the polygon and to one triangle, or to neither. Where edges
//! cross, the crossing would have to be a vertex, and snapped it would lie elsewhere: refused.
//!
//! Values are the planes of these triangles, not those of an active edge table.

use super::Primitive;
use super::cut::cut;
use crate::frame::{Frame, Polygon};
use crate::rules::ShadeMode;
use crate::vertex::{Triangle, Vertex};
use std::borrow::Cow;

/// Two edges of a polygon cross, so that triangles between its vertices cannot cover it.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "polygon at vertex {x} {y}: the edge from there crosses another of its edges; permitted, where only triangles \
     can be drawn: edges that do not cross; cut the polygon there, or draw it by a machine with POLY, as --set polygon.edges=64 has"
)]
pub struct CrossingEdges {
    /// Where one of them begins, pixels.
    pub x: f64,
    /// Likewise.
    pub y: f64,
}

/// A frame's triangles, with more of them for its polygons; without its lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangulated<'a> {
    /// Each polygon replaced by triangles at its place.
    pub triangles: Cow<'a, [Triangle]>,
    /// For each of them the place among the frame's primitives of the one it was or is a part of.
    pub ids: Vec<i32>,
}

impl Frame {
    /// What the frame draws as triangles; the vertices of polygons are snapped to `subpixel_bits` bits (half
    /// to even).
    ///
    /// # Errors
    /// A polygon whose snapped edges cross.
    pub fn triangulated(&self, subpixel_bits: u32) -> Result<Triangulated<'_>, CrossingEdges> {
        if self.polygons.is_empty() && self.lines.is_empty() {
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
                        (ShadeMode::Flat, Some(first)) => v.colored_as(first),
                        _ => v,
                    };
                    let parts = polygon.triangles(subpixel_bits)?;
                    triangles.extend(parts.into_iter().map(|part| Triangle(part.0.map(colored))));
                }
                // It stays a line.
                Primitive::Line(_) => {}
            }
            ids.resize(triangles.len(), id);
        }
        Ok(Triangulated { triangles: Cow::Owned(triangles), ids })
    }
}

impl Polygon {
    /// Triangles between its vertices that cover the same pixels, each as often. Of vertices that snap to one
    /// place the last one's values hold.
    ///
    /// # Errors
    /// Snapped edges cross. That they touch, or lie in one another, is permitted.
    pub fn triangles(&self, subpixel_bits: u32) -> Result<Vec<Triangle>, CrossingEdges> {
        let snapped = |contour: &Vec<Vertex>| contour.iter().map(|v| on_grid(v, subpixel_bits)).collect();
        let contours: Vec<Vec<_>> = self.contours.iter().map(snapped).collect();
        let vertices: Vec<&Vertex> = self.contours.iter().flatten().collect();
        let crossing = |vertex: usize| CrossingEdges { x: vertices[vertex].x, y: vertices[vertex].y };
        let parts = cut(&contours).map_err(crossing)?;
        Ok(parts.into_iter().map(|part| Triangle(part.map(|vertex| *vertices[vertex]))).collect())
    }
}

/// The nearest sub-pixel, half to even; whole numbers below 2^28. Adding 0 makes a -0 a 0.
fn on_grid(vertex: &Vertex, subpixel_bits: u32) -> [f64; 2] {
    [vertex.x, vertex.y].map(|c| (c * f64::from(1u32 << subpixel_bits)).round_ties_even() + 0.0)
}
