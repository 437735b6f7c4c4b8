//! What is drawn, on the screen, with everything the shading of a pixel needs.

use crate::vertex::{Triangle, Vertex};
use glam::{DVec2, DVec3};

/// A vertex of what is left after clipping.
///
/// `position`, `normal` and `texture` are linear in the world, so over the screen each of them times
/// `inverse_w` is linear, and so is `inverse_w` itself. Interpolating them straight over the screen, as the
/// hardware does, is the approximation of ch. 7.12.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceVertex {
    /// Pixels and depth; the colour is that of the shading equation here, [0, 1] each, and k_t the
    /// material's.
    pub screen: Vertex,
    /// 1/w, w the distance from the viewer along the line of sight; positive.
    pub inverse_w: f64,
    /// In world space.
    pub position: DVec3,
    /// In world space, on the side that is seen; a unit vector unless the vertex comes from a cut.
    pub normal: DVec3,
    /// u to the right, v up; zero where the mesh has none.
    pub texture: DVec2,
}

/// A triangle of what is left after clipping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceTriangle {
    /// In the order of the face they come from.
    pub vertices: [SurfaceVertex; 3],
    /// Place of that face in the mesh.
    pub face: u32,
    /// Unit normal of the polygon itself, on the side that is seen; zero for a face without area.
    pub own_normal: DVec3,
}

/// A scene on a screen; triangle k is triangle k of the scene's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Pixels a line.
    pub width: u32,
    /// Lines.
    pub height: u32,
    /// In the order of the mesh.
    pub triangles: Vec<SurfaceTriangle>,
}

impl SurfaceTriangle {
    /// Average of the vertex normals, a unit vector: the normal of the real surface over the polygon as ch.
    /// 7.6 estimates it. The polygon's own where they cancel.
    pub fn averaged_normal(&self) -> DVec3 {
        let sum: DVec3 = self.vertices.iter().map(|vertex| vertex.normal).sum();
        sum.try_normalize().unwrap_or(self.own_normal)
    }

    /// On the screen, with the colours of the vertices.
    pub fn on_screen(&self) -> Triangle {
        Triangle(self.vertices.map(|vertex| vertex.screen))
    }

    /// On the screen, in one colour, which is cut to [0, 1].
    pub fn in_color(&self, color: DVec3) -> Triangle {
        let [r, g, b] = color.clamp(DVec3::ZERO, DVec3::ONE).to_array();
        Triangle(self.vertices.map(|vertex| Vertex { r, g, b, ..vertex.screen }))
    }
}
