//! The half-plane that decides whether a triangle covers a pixel.

use edgewalk_golden::snap;
use edgewalk_scene::Triangle;
use serde::Serialize;

/// Of the three edges of a triangle the one that the centre of a pixel is least inside of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Edge {
    /// Place of the triangle in the input.
    pub triangle: usize,
    /// The vertices that the edge joins, counted from 1.
    pub vertices: [usize; 2],
    /// How far the centre is inside of the edge, pixels; negative outside, 0 on the edge, where the rule decides.
    pub distance: f64,
}

impl Edge {
    /// Of the triangle in this place, its vertices snapped to sub-pixels; none where the triangle has no area.
    #[must_use]
    pub fn nearest(
        place: usize,
        triangle: &Triangle,
        subpixel_bits: u32,
        (x, y): (u32, u32),
    ) -> Option<Edge> {
        // Half sub-pixels, so that centres are whole numbers: below 2^30, products below 2^62.
        let of = |coordinate: f64| 2 * snap(coordinate, subpixel_bits);
        let points = triangle.0.map(|vertex| [of(vertex.x), of(vertex.y)]);
        let centre = [x, y].map(|at| (2 * i64::from(at) + 1) << subpixel_bits);
        let cross = |a: [i64; 2], b: [i64; 2], c: [i64; 2]| {
            i128::from(b[0] - a[0]) * i128::from(c[1] - a[1])
                - i128::from(b[1] - a[1]) * i128::from(c[0] - a[0])
        };
        let area = cross(points[0], points[1], points[2]);
        if area == 0 {
            return None;
        }
        let edges = [[0, 1], [1, 2], [2, 0]].map(|[from, to]| {
            let (a, b) = (points[from], points[to]);
            let length = ((b[0] - a[0]) as f64).hypot((b[1] - a[1]) as f64);
            let inside = (cross(a, b, centre) * area.signum()) as f64;
            let distance = inside / length / f64::from(2u32 << subpixel_bits);
            Edge { triangle: place, vertices: [from + 1, to + 1], distance }
        });
        edges.into_iter().min_by(|a, b| a.distance.total_cmp(&b.distance))
    }
}
