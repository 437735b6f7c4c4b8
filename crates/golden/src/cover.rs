//! Which pixels a triangle covers: three half-planes in integers.
//!
//! ```text
//!        0            weight k of a pixel = twice the area of the triangle made of its centre and the
//!       / \           edge opposite vertex k, positive inside:  w0 + w1 + w2 = twice the whole area
//!      / . \   . pixel centre (i + 1/2, j + 1/2)
//!     1-----2         a centre on an edge is in if the edge is a left or a top one
//! ```
//! That is half-open in both axes: line y belongs to the triangle if y_top <= y + 1/2 < y_bottom, and on it the pixels
//! with x_left <= x + 1/2 < x_right. Two triangles that share an edge cover every pixel along it exactly once.
//!
//! Units: half sub-pixels, so that pixel centres are integers even without sub-pixel bits. Coordinates stay below
//! 2^20 * 2^8 * 2 = 2^29, their differences below 2^30, weights below 2^61.

use crate::fragment::Fragment;
use edgewalk_scene::{ShadeMode, Triangle, Vertex};
use std::ops::Range;

/// Most sub-pixel bits of a vertex.
pub const MAX_SUBPIXEL_BITS: u32 = 8;

/// A coordinate in pixels to the nearest sub-pixel, half to even; the result counts sub-pixels.
pub fn snap(coordinate: f64, subpixel_bits: u32) -> i64 {
    (coordinate * f64::from(1u32 << subpixel_bits)).round_ties_even() as i64
}

/// Calls `draw` for every pixel of `triangle` on a screen of `width` by `height` pixels, line by line.
///
/// Vertices are first snapped to `subpixel_bits`, 0..=[`MAX_SUBPIXEL_BITS`]. A triangle without area has no pixels.
pub fn fragments(
    triangle: &Triangle,
    mode: ShadeMode,
    subpixel_bits: u32,
    (width, height): (u32, u32),
    draw: impl FnMut(&Fragment),
) {
    fragments_of_lines(triangle, mode, subpixel_bits, width, 0..height, draw);
}

/// Like `fragments`, for some lines of the screen.
pub(crate) fn fragments_of_lines(
    triangle: &Triangle,
    mode: ShadeMode,
    subpixel_bits: u32,
    width: u32,
    lines: Range<u32>,
    mut draw: impl FnMut(&Fragment),
) {
    let Some(cover) = Cover::new(triangle, mode, subpixel_bits) else { return };
    for y in cover.lines(lines) {
        for x in cover.span(y, width) {
            draw(&cover.fragment(x, y));
        }
    }
}

/// A snapped triangle that has an area.
pub(crate) struct Cover {
    vertices: [Vertex; 3],
    /// Opposite vertex 0, 1, 2.
    planes: [HalfPlane; 3],
    /// Twice the area, the sum of the weights.
    total: i64,
    /// Lines that may have pixels.
    top: i64,
    bottom: i64,
}

/// The weight of a vertex as a function of the pixel.
struct HalfPlane {
    /// At pixel (0, 0).
    origin: i64,
    /// To the next pixel.
    per_x: i64,
    /// To the next line.
    per_y: i64,
    /// The least weight of a covered pixel: 0 on left and top edges, else 1.
    least: i64,
}

impl Cover {
    /// `None` if the snapped triangle has no area.
    pub(crate) fn new(triangle: &Triangle, mode: ShadeMode, subpixel_bits: u32) -> Option<Self> {
        let points = triangle.0.map(|v| [2 * snap(v.x, subpixel_bits), 2 * snap(v.y, subpixel_bits)]);
        let [a, b, c] = points;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0 {
            return None;
        }
        let half_pixel = 1i64 << subpixel_bits;
        let plane = |from: [i64; 2], to: [i64; 2]| HalfPlane::new(from, to, area.signum(), half_pixel);
        // The first centre at or below y.
        let line = |y: i64| -(half_pixel - y).div_euclid(2 * half_pixel);
        Some(Self {
            vertices: shaded(triangle, mode),
            planes: [plane(b, c), plane(c, a), plane(a, b)],
            total: area.abs(),
            top: line(a[1].min(b[1]).min(c[1])),
            bottom: line(a[1].max(b[1]).max(c[1])),
        })
    }

    fn lines(&self, among: Range<u32>) -> Range<u32> {
        let (first, end) = (i64::from(among.start), i64::from(among.end));
        let within = |line: i64| line.clamp(first, end) as u32;
        within(self.top)..within(self.bottom)
    }

    /// The pixels of a line where all three half-planes hold.
    fn span(&self, y: u32, width: u32) -> Range<u32> {
        let (mut start, mut end) = (0, i64::from(width));
        for plane in &self.planes {
            // The pixels x with spare + x per_x >= 0.
            let spare = plane.origin + i64::from(y) * plane.per_y - plane.least;
            match plane.per_x {
                // A horizontal edge bounds the lines.
                0 => {}
                rise if rise > 0 => start = start.max(-spare.div_euclid(rise)),
                fall => end = end.min(spare.div_euclid(-fall) + 1),
            }
        }
        // Both lie on the screen when the span is not empty.
        if start < end { start as u32..end as u32 } else { 0..0 }
    }

    /// The values at a pixel, covered or not.
    pub(crate) fn fragment(&self, x: u32, y: u32) -> Fragment<'_> {
        let weights = self
            .planes
            .each_ref()
            .map(|plane| plane.origin + i64::from(x) * plane.per_x + i64::from(y) * plane.per_y);
        Fragment { x, y, vertices: &self.vertices, weights, total: self.total }
    }
}

impl HalfPlane {
    /// Beside the edge `from`-`to`; `winding` 1 if the inside has positive cross products, else -1.
    fn new(from: [i64; 2], to: [i64; 2], winding: i64, half_pixel: i64) -> Self {
        let (dx, dy) = (winding * (to[0] - from[0]), winding * (to[1] - from[1]));
        let origin = dx * (half_pixel - from[1]) - dy * (half_pixel - from[0]);
        let (per_x, per_y) = (-dy * 2 * half_pixel, dx * 2 * half_pixel);
        let (left, top) = (per_x > 0, per_x == 0 && per_y > 0);
        Self { origin, per_x, per_y, least: if left || top { 0 } else { 1 } }
    }
}

/// The vertices with the colours that `mode` interpolates.
pub(crate) fn shaded(triangle: &Triangle, mode: ShadeMode) -> [Vertex; 3] {
    let first = triangle.0[0];
    match mode {
        ShadeMode::Gouraud => triangle.0,
        ShadeMode::Flat => triangle.0.map(|v| v.colored_as(&first)),
    }
}
