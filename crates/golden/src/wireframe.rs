//! Wireframe with depth: the edges of triangles and polygons, with or without those that surfaces hide.
//!
//! ```text
//!   surfaces --> depth of the nearest, pushed back by half a pixel of slope --.
//!   edges -----> pixels, depth and colour along the line ----> nearer or equal? ----> picture
//! ```
//! A line's depth is taken where it runs, a surface's at the pixel's centre, half a pixel away at most in x and in y: in a
//! plane with the slopes g_x and g_y the two differ by at most (|g_x| + |g_y|) / 2, and by no more than the surface's own
//! range. Pushed back by the lesser of these, no plane hides the edges that lie in it. What lies behind a surface by less
//! than that shows through. A polygon whose vertices lie in no plane has the slopes of its mean one (Newell's).

use crate::fill::Fill;
use crate::line;
use crate::picture::{Lit, Picture};
use crate::polygon::{self, EdgeTable, Grid};
use edgewalk_scene::{Frame, Line, Polygon, Primitive, ShadeMode, Triangle, Vertex};
use std::collections::HashSet;

/// What becomes of lines behind surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HiddenLines {
    /// Drawn like the others; only lines hide lines.
    Drawn,
    /// Left out.
    Removed,
}

/// Far above the errors of f64 in a depth, far below a step of any depth buffer.
const ROUNDING: f64 = 1e-12;

/// Draws the edges of `frame`, the nearest line at each pixel. Its depth function, blending and shadows play no part.
///
/// In the picture, coverage and writes count the pixels of lines, and depth is theirs.
pub fn wireframe(frame: &Frame, fill: Fill, hidden: HiddenLines) -> Picture {
    let mut picture = Picture::cleared(frame, frame.height as usize);
    let surfaces = match hidden {
        HiddenLines::Drawn => vec![f64::INFINITY; picture.z.len()],
        HiddenLines::Removed => pushed_back(frame, fill),
    };
    for (primitive, id) in frame.primitives().into_iter().zip(0..) {
        let contours = primitive.contours();
        let Some(first) = contours.first().and_then(|contour| contour.first()) else { continue };
        for ends in contours.iter().copied().flat_map(edges) {
            let colored = ends.map(|end| match frame.mode {
                ShadeMode::Gouraud => *end,
                ShadeMode::Flat => end.colored_as(first),
            });
            let line = line::Line::new(&colored, frame.mode, fill.grid());
            line.fragments_of_lines(frame.width, 0..frame.height, |fragment| {
                let at = fragment.y as usize * frame.width as usize + fragment.x as usize;
                picture.coverage[at] += 1;
                let z = fragment.z();
                if z > surfaces[at] || (picture.writes[at] > 0 && z >= picture.z[at]) {
                    return;
                }
                picture.z[at] = z;
                picture.rgb[at] = fragment.rgb();
                picture.writes[at] += 1;
                picture.id[at] = id;
                picture.lit[at] = Lit::Lit;
            });
        }
    }
    picture
}

/// The wireframe as a frame of surfaces and lines, for who draws those: the surfaces, in the colour of the empty screen and pushed
/// back by `step` more, at most to the largest depth; then the edges, each once, nearer than what is there. `step`: one step of the
/// depth buffer, by which what is drawn may be off.
pub fn wireframe_in_lines(frame: &Frame, fill: Fill, hidden: HiddenLines, step: f64) -> Frame {
    let primitives = frame.primitives();
    let mut triangles = Vec::new();
    let mut polygons = Vec::new();
    if hidden == HiddenLines::Removed {
        let [r, g, b] = frame.clear;
        for primitive in &primitives {
            let push = push(&primitive.contours(), fill.grid()) + step;
            let back = |v: &Vertex| Vertex { z: (v.z + push).min(1.0), r, g, b, kt: 0.0, ..*v };
            match primitive {
                Primitive::Triangle(Triangle(vertices)) => {
                    triangles.push(Triangle(vertices.each_ref().map(back)));
                }
                Primitive::Polygon(polygon) => polygons.push(Polygon {
                    contours: polygon.contours.iter().map(|c| c.iter().map(back).collect()).collect(),
                    after: triangles.len(),
                }),
                Primitive::Line(_) => {}
            }
        }
    }
    let after = triangles.len() + polygons.len();
    let (mut lines, mut seen) = (Vec::new(), HashSet::new());
    for primitive in &primitives {
        let contours = primitive.contours();
        let Some(first) = contours.first().and_then(|contour| contour.first()) else { continue };
        for ends in contours.iter().copied().flat_map(edges) {
            let place = |v: &Vertex| [v.x, v.y, v.z].map(f64::to_bits);
            let mut places = ends.map(place);
            places.sort_unstable();
            if seen.insert(places) {
                let colored = |v: &Vertex| match frame.mode {
                    ShadeMode::Gouraud => *v,
                    ShadeMode::Flat => v.colored_as(first),
                };
                lines.push(Line { ends: ends.map(colored), after });
            }
        }
    }
    let Frame { width, height, clear, host, .. } = *frame;
    Frame { clear, triangles, polygons, lines, host, ..Frame::new(width, height) }
}

/// From each vertex of a contour to the next.
fn edges(contour: &[Vertex]) -> impl Iterator<Item = [&Vertex; 2]> {
    contour.iter().zip(contour.iter().cycle().skip(1)).map(|(a, b)| [a, b])
}

/// The depth of the nearest surface at each pixel, each pushed back.
fn pushed_back(frame: &Frame, fill: Fill) -> Vec<f64> {
    let screen = (frame.width, frame.height);
    let mut depth = vec![f64::INFINITY; frame.width as usize * frame.height as usize];
    for primitive in frame.primitives() {
        let push = push(&primitive.contours(), fill.grid());
        let mut plot = |x: u32, y: u32, z: f64| {
            let stored = &mut depth[y as usize * frame.width as usize + x as usize];
            *stored = stored.min(z + push);
        };
        match primitive {
            Primitive::Triangle(triangle) => {
                fill.fragments(triangle, frame.mode, screen, |f| plot(f.x, f.y, f.z()));
            }
            // A line hides nothing but what its pixels do.
            Primitive::Line(_) => {}
            Primitive::Polygon(polygon) => {
                let table = EdgeTable::new(polygon, frame.mode, fill.grid());
                polygon::fragments(&table, screen, |f| plot(f.x, f.y, f.z()));
            }
        }
    }
    depth
}

/// How far a surface is pushed back.
fn push(contours: &[&[Vertex]], grid: Grid) -> f64 {
    let snapped = |v: &Vertex| (grid.place(v).map(|c| grid.pixels(c)), v.z);
    // Newell's normal: twice the areas of the shadows on the three planes.
    let [mut x, mut y, mut z] = [0.0; 3];
    for [([ax, ay], az), ([bx, by], bz)] in contours.iter().copied().flat_map(edges).map(|e| e.map(snapped)) {
        x += (ay - by) * (az + bz);
        y += (az - bz) * (ax + bx);
        z += (ax - bx) * (ay + by);
    }
    let depths = || contours.iter().copied().flatten().map(|v| v.z);
    let range = depths().fold(0.0, f64::max) - depths().fold(1.0, f64::min);
    // Without area the slope is infinite or NaN, and the range remains.
    range.min((x.abs() + y.abs()) / z.abs() / 2.0) + ROUNDING
}
