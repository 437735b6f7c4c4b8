//! The shadows of a frame that is already on the screen.
//!
//! ```text
//! pixel (i, j), depth z          matrix                    X/q, Y/q            floor
//! (i + 1/2, j + 1/2, z, 1) ────────────────> (X, Y, Z, q) ───────────> texels ───────> map ──> Z/q <= map + bias: lit
//! ```
//! The share of a colour: AMBIENT in shadow; AMBIENT + (1 - AMBIENT) * the product of k_t of the panes before the texel's depth if it is lit.
//!
//! The map is drawn as the picture is: same sub-pixels, same coverage. All in f64, without any exact decision: where a point
//! is as deep as the map and the bias together to the last bit, rounding decides.

use super::depth_map::DepthMap;
use crate::fill::Fill;
use crate::picture::Lit;
use edgewalk_scene::{Shadow, Triangle, Vertex};

/// The depth map of a light.
pub(crate) struct ShadowMap<'a> {
    shadow: &'a Shadow,
    map: DepthMap,
}

impl<'a> ShadowMap<'a> {
    /// Draws what the light sees.
    pub(crate) fn draw(shadow: &'a Shadow, fill: Fill) -> Self {
        let triangle = |corners: [[f64; 3]; 3], kt: f64| {
            Triangle(corners.map(|[x, y, z]| Vertex { x, y, z, kt, ..Vertex::default() }))
        };
        let opaque = shadow.triangles.iter().map(|corners| triangle(*corners, 0.0));
        let panes = shadow.panes.iter().map(|pane| triangle(pane.corners, pane.kt));
        Self { shadow, map: DepthMap::draw(shadow.size, fill, opaque, panes) }
    }

    /// What the light does to the point at this pixel and depth of the triangle or polygon at this place, and the share of its colour: it
    /// is lit if it is outside the map, or not behind what the map holds.
    pub(crate) fn share(&self, x: u32, y: u32, z: f64, place: usize) -> (Lit, f64) {
        let point = [f64::from(x) + 0.5, f64::from(y) + 0.5, z, 1.0];
        let [x, y, depth, q] = self.shadow.matrix.map(|row| (0..4).map(|k| row[k] * point[k]).sum::<f64>());
        // Behind the light, q < 0, points would come back mirrored.
        let stored = if q > 0.0 { self.map.at(x / q, y / q) } else { None };
        let ambient = self.shadow.ambient;
        match stored {
            None => (Lit::Lit, 1.0),
            // Nearer than the map begins: before all panes.
            Some(_) if depth / q < self.shadow.bias_of(place) => (Lit::Lit, 1.0),
            Some(texel) if depth / q <= texel.depth + self.shadow.bias_of(place) => {
                (Lit::Lit, ambient + (1.0 - ambient) * texel.left)
            }
            Some(_) => (Lit::Shadow, ambient),
        }
    }
}
