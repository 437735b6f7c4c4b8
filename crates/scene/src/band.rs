//! Triangles of outside programs that reach beyond the machine's guard band: the host leaves them out, or
//! cuts them at its border.
//!
//! ```text
//!  guard band  +-------------------+        wholly off the screen: left out, wherever it lies
//!              |   +--------+      |        inside the band: untouched, cutting would move edges that are seen
//!              |   | screen |   ___|__..    crossing its border: cut there, the pieces drawn in its place
//!              |   +--------+      |
//!              +-------------------+
//! ```
//! Of an edge that two triangles share both get the same new vertex, so no gap opens and no pixel is drawn
//! twice. The edges of the pieces are rounded to sub-pixels at the border: seen on the screen they move by at
//! most half a sub-pixel.

use crate::frame::Frame;
use crate::host::Host;
use crate::rules::ShadeMode;
use crate::vertex::{Triangle, Vertex};
use std::borrow::Cow;

impl Host {
    /// What of this triangle of the frame a machine is sent whose guard band ends at ±`limit` pixels.
    pub fn in_band<'a>(&mut self, triangle: &'a Triangle, frame: &Frame, limit: f64) -> Cow<'a, [Triangle]> {
        if fits(triangle, limit) {
            return Cow::Borrowed(std::slice::from_ref(triangle));
        }
        if off_screen(triangle, frame.width, frame.height) {
            self.off_screen += 1;
            return Cow::Owned(Vec::new());
        }
        let vertices = match frame.mode {
            ShadeMode::Gouraud => triangle.0,
            // Of a piece the first vertex may be another.
            ShadeMode::Flat => triangle.0.map(|v| v.colored_as(&triangle.0[0])),
        };
        let pieces = cut(&vertices, limit);
        self.clipped += 1;
        self.pieces += pieces.len() as u64;
        Cow::Owned(pieces)
    }
}

/// Whether it lies in the band.
#[must_use]
pub fn fits(triangle: &Triangle, limit: f64) -> bool {
    triangle.0.iter().all(|v| v.x.abs() <= limit && v.y.abs() <= limit)
}

/// A pixel beside the screen counts as on it: a vertex may be rounded by half of one.
fn off_screen(Triangle(vertices): &Triangle, width: u32, height: u32) -> bool {
    let beside = |of: fn(&Vertex) -> f64, side: u32| {
        vertices.iter().all(|v| of(v) < -1.0) || vertices.iter().all(|v| of(v) > f64::from(side) + 1.0)
    };
    beside(|v| v.x, width) || beside(|v| v.y, height)
}

/// The part in the band, a fan.
fn cut(triangle: &[Vertex; 3], limit: f64) -> Vec<Triangle> {
    match &contour_in_band(triangle, limit)[..] {
        [first, rest @ ..] => rest.windows(2).map(|pair| Triangle([*first, pair[0], pair[1]])).collect(),
        [] => Vec::new(),
    }
}

/// The part of a contour in the band that ends at ±`limit` pixels, cut at one side after the other (Sutherland and
/// Hodgman). Of a contour that is not convex it may run back along the border: by the odd-even rule that draws nothing.
#[must_use]
pub fn contour_in_band(contour: &[Vertex], limit: f64) -> Vec<Vertex> {
    let sides: [(fn(&mut Vertex) -> &mut f64, f64); 4] =
        [(|v| &mut v.x, limit), (|v| &mut v.x, -limit), (|v| &mut v.y, limit), (|v| &mut v.y, -limit)];
    let mut polygon = contour.to_vec();
    for (coordinate, side) in sides {
        let inside = |v: &Vertex| *coordinate(&mut { *v }) * side.signum() <= limit;
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (index, end) in polygon.iter().enumerate() {
            let start = &polygon[(index + polygon.len() - 1) % polygon.len()];
            if inside(start) != inside(end) {
                let (from, to) = if inside(start) { (start, end) } else { (end, start) };
                let [a, b] = [from, to].map(|v| *coordinate(&mut { *v }));
                let mut vertex = between(from, to, (side - a) / (b - a));
                *coordinate(&mut vertex) = side;
                kept.push(vertex);
            }
            if inside(end) {
                kept.push(*end);
            }
        }
        polygon = kept;
    }
    polygon
}

/// The point at t on the way from one vertex to the other, all its values linear; never outside of what the
/// two have.
fn between(from: &Vertex, to: &Vertex, t: f64) -> Vertex {
    let mix = |a: f64, b: f64| (a + (b - a) * t).clamp(a.min(b), a.max(b));
    Vertex {
        x: mix(from.x, to.x),
        y: mix(from.y, to.y),
        z: mix(from.z, to.z),
        r: mix(from.r, to.r),
        g: mix(from.g, to.g),
        b: mix(from.b, to.b),
        kt: mix(from.kt, to.kt),
        extra: std::array::from_fn(|i| mix(from.extra[i], to.extra[i])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: f64 = 255.0;

    fn triangle(corners: [[f64; 3]; 3]) -> Triangle {
        Triangle(corners.map(|[x, y, z]| Vertex { x, y, z, r: z, kt: 0.5, ..Vertex::default() }))
    }

    fn sent(triangle: &Triangle) -> (Vec<Triangle>, Host) {
        let mut host = Host::default();
        let pieces = host.in_band(triangle, &Frame::new(64, 48), LIMIT).into_owned();
        (pieces, host)
    }

    /// Twice the area, with its sign.
    fn area(Triangle([a, b, c]): &Triangle) -> f64 {
        (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
    }

    #[test]
    fn what_fits_is_untouched_and_what_is_off_the_screen_left_out() {
        let inside = triangle([[-255.0, 0.0, 0.0], [255.0, 3.0, 1.0], [0.0, 255.0, 0.5]]);
        assert_eq!(sent(&inside), (vec![inside], Host::default()));
        for far in [
            triangle([[-1e6, 0.0, 0.0], [-2.0, 10.0, 1.0], [-5.0, 1e6, 0.5]]),
            triangle([[66.0, 0.0, 0.0], [1e5, 10.0, 1.0], [70.0, 1e3, 0.5]]),
            triangle([[0.0, -900.0, 0.0], [1e5, -2.0, 1.0], [70.0, -3.0, 0.5]]),
            triangle([[0.0, 49.5, 0.0], [1e5, 90.0, 1.0], [70.0, 999.0, 0.5]]),
        ] {
            assert_eq!(sent(&far), (vec![], Host { off_screen: 1, ..Host::default() }));
        }
    }

    #[test]
    fn pieces_keep_plane_winding_and_the_shared_edge() {
        let [a, b, c, d] =
            [[-900.0, -300.0, 0.0], [1000.0, 203.0, 1.0], [30.0, 800.0, 0.25], [700.0, -900.0, 0.5]];
        let (left, right) = (triangle([a, b, c]), triangle([b, a, d]));
        let mut seen = [Vec::new(), Vec::new()];
        for (triangle, seen) in [&left, &right].into_iter().zip(&mut seen) {
            let (pieces, host) = sent(triangle);
            assert_eq!((host.clipped, host.pieces), (1, pieces.len() as u64));
            assert!(!pieces.is_empty());
            let Triangle([p, q, r]) = triangle;
            for piece in &pieces {
                assert!(area(piece) * area(triangle) >= 0.0 && fits(piece, LIMIT));
                for v in &piece.0 {
                    // Of the plane through the three: z by the three areas.
                    let part = |s: &Vertex, t: &Vertex| area(&Triangle([*v, *s, *t])) / area(triangle);
                    let z = part(q, r) * p.z + part(r, p) * q.z + part(p, q) * r.z;
                    assert!((v.z - z).abs() < 1e-12 && v.r == v.z && v.kt == 0.5);
                    seen.push((v.x.to_bits(), v.y.to_bits(), v.z.to_bits()));
                }
            }
        }
        let shared =
            seen[0].iter().filter(|v| seen[1].contains(v)).collect::<std::collections::BTreeSet<_>>();
        assert_eq!(shared.len(), 2, "both ends of the shared edge, bit for bit");
    }

    #[test]
    fn the_band_is_covered_once() {
        // Around the whole band: the pieces are the band.
        let (pieces, _) = sent(&triangle([[-9e3, -9e3, 0.0], [9e3, -9e3, 0.5], [0.0, 9e5, 1.0]]));
        let sum: f64 = pieces.iter().map(area).sum();
        assert!((sum - 2.0 * (2.0 * LIMIT).powi(2)).abs() < 1e-6, "{sum}");
    }

    #[test]
    fn pieces_of_a_flat_triangle_have_the_colour_of_its_first_vertex_and_values_of_their_own() {
        let vertex = |x: f64, y: f64, part: f64| {
            let [r, g, b, kt] = [0.1, 0.2, 0.3, 0.4].map(|own| own + part);
            Vertex { x, y, z: part, r, g, b, kt, extra: [10.0 * part, 20.0 * part, 0.0, 0.0] }
        };
        // The first one is cut off.
        let whole = Triangle([vertex(-900.0, 0.0, 0.5), vertex(60.0, 0.0, 0.0), vertex(0.0, 40.0, 0.25)]);
        let flat = Frame { mode: ShadeMode::Flat, ..Frame::new(64, 48) };
        let pieces = Host::default().in_band(&whole, &flat, LIMIT).into_owned();
        assert_eq!(pieces.len(), 2);
        let mut depths = Vec::new();
        for v in pieces.iter().flat_map(|piece| piece.0) {
            assert_eq!([v.r, v.g, v.b, v.kt], [0.6, 0.7, 0.8, 0.9]);
            assert!(v.extra == [10.0 * v.z, 20.0 * v.z, 0.0, 0.0], "{v:?}");
            depths.push(v.z);
        }
        assert!(depths.contains(&0.0) && depths.contains(&0.25) && !depths.contains(&0.5), "{depths:?}");
    }
}
