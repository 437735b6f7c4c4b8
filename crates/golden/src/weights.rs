//! What the three vertices weigh at a pixel, for any attribute: over the screen, or over the surface.
//!
//! ```text
//!   linear       b_k = w_k / sum w                          as incremental hardware interpolates
//!   perspective  b_k / W_k over their sum, W_k the depth    the truth for what is linear in the world
//! ```

use crate::fragment::Fragment;
use edgewalk_scene::SurfaceTriangle;
use std::ops::{Add, Mul};

/// The weight of each vertex; they add up to 1, and inside the triangle none is negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights(pub [f64; 3]);

impl Weights {
    /// Linear over the screen.
    pub fn linear(fragment: &Fragment) -> Self {
        Self(fragment.weights.map(|weight| weight as f64 / fragment.total as f64))
    }

    /// Linear over the surface in the world: exact under perspective. The fragment is one of
    /// [`SurfaceTriangle::on_screen`].
    pub fn perspective(fragment: &Fragment, triangle: &SurfaceTriangle) -> Self {
        let over_w = |k: usize| fragment.weights[k] as f64 * triangle.vertices[k].inverse_w;
        let [a, b, c] = [over_w(0), over_w(1), over_w(2)];
        Self([a, b, c].map(|part| part / (a + b + c)))
    }

    /// The value at the pixel of an attribute with these values at the vertices.
    pub fn of<T: Add<Output = T> + Mul<f64, Output = T>>(self, [a, b, c]: [T; 3]) -> T {
        let [u, v, w] = self.0;
        a * u + b * v + c * w
    }
}
