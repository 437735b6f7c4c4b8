//! A light's depth map and the comparison with it (A 7.2, 7.3), for frames that are already on the screen.
//!
//! ```text
//! pixel (i, j), depth z          matrix                    X/q, Y/q            floor
//! (i + 1/2, j + 1/2, z, 1) ────────────────> (X, Y, Z, q) ───────────> texels ───────> map ──> Z/q <= map + bias: lit
//! ```
//! The map is drawn as the picture is: same sub-pixels, same coverage. All in f64, without any exact decision: where a point
//! is as deep as the map and the bias together to the last bit, rounding decides.

use crate::fill::Fill;
use edgewalk_scene::{ShadeMode, Shadow, Triangle, Vertex};

/// The depth map of a light.
pub(crate) struct ShadowMap<'a> {
    shadow: &'a Shadow,
    /// Line by line; 1 where nothing is.
    depth: Vec<f64>,
}

impl<'a> ShadowMap<'a> {
    /// Draws the triangles that the light sees, the nearest wins.
    pub(crate) fn draw(shadow: &'a Shadow, fill: Fill) -> Self {
        let size = shadow.size as usize;
        let mut depth = vec![1.0; size * size];
        for corners in &shadow.triangles {
            let triangle = Triangle(corners.map(|[x, y, z]| Vertex { x, y, z, ..Vertex::default() }));
            fill.fragments(&triangle, ShadeMode::Flat, (shadow.size, shadow.size), |fragment| {
                let stored = &mut depth[fragment.y as usize * size + fragment.x as usize];
                *stored = fragment.z().min(*stored);
            });
        }
        Self { shadow, depth }
    }

    /// Whether the light reaches the point at this pixel and depth: it is outside the map, or not behind what the map holds.
    pub(crate) fn lit(&self, x: u32, y: u32, z: f64) -> bool {
        let point = [f64::from(x) + 0.5, f64::from(y) + 0.5, z, 1.0];
        let [x, y, depth, q] = self.shadow.matrix.map(|row| (0..4).map(|k| row[k] * point[k]).sum::<f64>());
        let (x, y, depth) = (x / q, y / q, depth / q);
        let side = f64::from(self.shadow.size);
        // Where q is 0, x and y are infinite or NaN, and in no range.
        if !(0.0..side).contains(&x) || !(0.0..side).contains(&y) {
            return true;
        }
        let stored = self.depth[y as usize * self.shadow.size as usize + x as usize];
        depth <= stored + self.shadow.bias
    }

    /// What the colour of a point in shadow is multiplied by.
    pub(crate) fn ambient(&self) -> f64 {
        self.shadow.ambient
    }
}
