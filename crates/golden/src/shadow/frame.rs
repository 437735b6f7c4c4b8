//! The shadows of a frame that is already on the screen.
//!
//! ```text
//! pixel (i, j), depth z          matrix                    X/q, Y/q            floor
//! (i + 1/2, j + 1/2, z, 1) ────────────────> (X, Y, Z, q) ───────────> texels ───────> map ──> Z/q <= map + bias: lit
//! ```
//! The map is drawn as the picture is: same sub-pixels, same coverage. All in f64, without any exact decision: where a point
//! is as deep as the map and the bias together to the last bit, rounding decides.

use super::depth_map::DepthMap;
use crate::fill::Fill;
use edgewalk_scene::{Shadow, Triangle, Vertex};

/// The depth map of a light.
pub(crate) struct ShadowMap<'a> {
    shadow: &'a Shadow,
    map: DepthMap,
}

impl<'a> ShadowMap<'a> {
    /// Draws the triangles that the light sees, the nearest wins.
    pub(crate) fn draw(shadow: &'a Shadow, fill: Fill) -> Self {
        let vertex = |[x, y, z]: [f64; 3]| Vertex { x, y, z, ..Vertex::default() };
        let triangles = shadow.triangles.iter().map(|corners| Triangle(corners.map(vertex)));
        Self { shadow, map: DepthMap::draw(shadow.size, fill, triangles) }
    }

    /// Whether the light reaches the point at this pixel and depth of the triangle or polygon at this place: it is outside the map,
    /// or not behind what the map holds.
    pub(crate) fn lit(&self, x: u32, y: u32, z: f64, place: usize) -> bool {
        let point = [f64::from(x) + 0.5, f64::from(y) + 0.5, z, 1.0];
        let [x, y, depth, q] = self.shadow.matrix.map(|row| (0..4).map(|k| row[k] * point[k]).sum::<f64>());
        // Behind the light, q < 0, points would come back mirrored.
        let stored = if q > 0.0 { self.map.at(x / q, y / q) } else { None };
        stored.is_none_or(|stored| depth / q <= stored + self.shadow.bias_of(place))
    }

    /// What the colour of a point in shadow is multiplied by.
    pub(crate) fn ambient(&self) -> f64 {
        self.shadow.ambient
    }
}
