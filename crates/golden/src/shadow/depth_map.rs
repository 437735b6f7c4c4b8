//! A light's z-buffer, drawn as the picture is.

use crate::fill::Fill;
use edgewalk_scene::{ShadeMode, Triangle};

/// Depths line by line, 1 where nothing is.
pub(super) struct DepthMap {
    size: u32,
    depth: Vec<f64>,
}

impl DepthMap {
    /// Draws triangles, in texels; the nearest wins.
    pub(super) fn draw(size: u32, fill: Fill, triangles: impl Iterator<Item = Triangle>) -> Self {
        let side = size as usize;
        let mut depth = vec![1.0; side * side];
        for triangle in triangles {
            fill.fragments(&triangle, ShadeMode::Flat, (size, size), |fragment| {
                let stored = &mut depth[fragment.y as usize * side + fragment.x as usize];
                *stored = fragment.z().min(*stored);
            });
        }
        Self { size, depth }
    }

    /// The depth of the nearest texel; `None` if x or y lies in none.
    pub(super) fn at(&self, x: f64, y: f64) -> Option<f64> {
        let side = 0.0..f64::from(self.size);
        // Infinite and NaN are in no range.
        let inside = side.contains(&x) && side.contains(&y);
        inside.then(|| self.depth[y as usize * self.size as usize + x as usize])
    }
}
