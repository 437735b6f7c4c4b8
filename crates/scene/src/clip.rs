//! Clipping in clip space, and the way from there to the screen.
//!
//! ```text
//!    guard band  +------------------------+    Only what lies beyond the near plane, the far plane or the guard band
//!                |      screen            |    is clipped. What is partly off the screen but inside the guard band goes
//!                |     +--------+         |    on untouched: cutting there would move edges that are seen.
//!                |     |        |         |
//!                +-----+--------+---------+
//! ```
//! A triangle that is inside everywhere keeps its vertices bit for bit. An edge is cut from its inner end,
//! whichever triangle asks, so that triangles which share it share the new vertex.

use crate::surface::SurfaceVertex;
use crate::vertex::Vertex;
use glam::{DVec2, DVec3, DVec4};

/// The part of the screen plane that the machine's coordinates reach.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Viewport {
    /// Visible pixels.
    pub width: u32,
    pub height: u32,
    /// Largest |x| and |y|, pixels.
    pub guard: f64,
}

/// A vertex in clip space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClipVertex {
    pub position: DVec4,
    /// Cut to [0, 1].
    pub color: DVec3,
    pub transmission: f64,
    /// In world space.
    pub world: DVec3,
    /// In world space.
    pub normal: DVec3,
    pub texture: DVec2,
}

impl ClipVertex {
    /// A vertex of which only the place matters.
    pub(crate) fn bare(position: DVec4) -> Self {
        let (world, normal, color, texture) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, DVec2::ZERO);
        Self { position, color, transmission: 0.0, world, normal, texture }
    }
}

impl Viewport {
    /// Near, far, left, right, top, bottom: what is inside has no negative product with any.
    fn planes(&self) -> [DVec4; 6] {
        let (half_width, half_height) = (f64::from(self.width) / 2.0, f64::from(self.height) / 2.0);
        [
            DVec4::Z,
            DVec4::new(0.0, 0.0, -1.0, 1.0),
            DVec4::new(half_width, 0.0, 0.0, self.guard + half_width),
            DVec4::new(-half_width, 0.0, 0.0, self.guard - half_width),
            DVec4::new(0.0, -half_height, 0.0, self.guard + half_height),
            DVec4::new(0.0, half_height, 0.0, self.guard - half_height),
        ]
    }

    /// To pixels, y down.
    fn project(&self, vertex: &ClipVertex) -> SurfaceVertex {
        let DVec4 { x, y, z, w } = vertex.position;
        let [r, g, b] = vertex.color.to_array();
        // What was cut at a plane lies on it up to rounding.
        let within = |pixels: f64| pixels.clamp(-self.guard, self.guard);
        let screen = Vertex {
            x: within((0.5 + 0.5 * x / w) * f64::from(self.width)),
            y: within((0.5 - 0.5 * y / w) * f64::from(self.height)),
            z: (z / w).clamp(0.0, 1.0),
            r,
            g,
            b,
            kt: vertex.transmission,
            ..Vertex::default()
        };
        let ClipVertex { world, normal, texture, .. } = *vertex;
        SurfaceVertex { screen, inverse_w: 1.0 / w, position: world, normal, texture }
    }
}

/// Calls `keep` with the triangles of what is left, a fan. Cuts one plane after the other (Sutherland and
/// Hodgman).
pub(crate) fn clip(triangle: [ClipVertex; 3], viewport: &Viewport, mut keep: impl FnMut([SurfaceVertex; 3])) {
    let mut polygon = triangle.to_vec();
    for plane in viewport.planes() {
        if polygon.iter().any(|vertex| vertex.position.dot(plane) < 0.0) {
            polygon = cut(&polygon, plane);
        }
    }
    // Beyond the near plane w is at least its distance, so projecting divides by no zero.
    let screen: Vec<SurfaceVertex> = polygon.iter().map(|vertex| viewport.project(vertex)).collect();
    if let [first, rest @ ..] = &screen[..] {
        rest.windows(2).for_each(|pair| keep([*first, pair[0], pair[1]]));
    }
}

/// The part of a convex polygon with non-negative products.
fn cut(polygon: &[ClipVertex], plane: DVec4) -> Vec<ClipVertex> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (index, end) in polygon.iter().enumerate() {
        let start = &polygon[(index + polygon.len() - 1) % polygon.len()];
        match [start, end].map(|vertex| vertex.position.dot(plane) >= 0.0) {
            [true, true] => kept.push(*end),
            [true, false] => kept.push(crossing(start, end, plane)),
            [false, true] => kept.extend([crossing(end, start, plane), *end]),
            [false, false] => {}
        }
    }
    kept
}

/// Where the edge from a vertex inside to one outside meets the plane.
fn crossing(inside: &ClipVertex, outside: &ClipVertex, plane: DVec4) -> ClipVertex {
    let (from, to) = (inside.position.dot(plane), outside.position.dot(plane));
    let t = from / (from - to);
    ClipVertex {
        position: inside.position.lerp(outside.position, t),
        color: inside.color.lerp(outside.color, t).clamp(DVec3::ZERO, DVec3::ONE),
        transmission: inside.transmission,
        world: inside.world.lerp(outside.world, t),
        normal: inside.normal.lerp(outside.normal, t),
        texture: inside.texture.lerp(outside.texture, t),
    }
}
