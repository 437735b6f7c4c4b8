//! A light's z-buffer, drawn as the picture is, and what is left of the light before it.

use crate::fill::Fill;
use edgewalk_scene::{ShadeMode, Triangle};

/// Depths line by line, 1 where nothing is; and shares of the light.
pub(super) struct DepthMap {
    size: u32,
    depth: Vec<f64>,
    /// The product of k_t of what is nearer than the depth; empty where nothing transmits.
    left: Vec<f64>,
}

/// What a texel says.
pub(super) struct Texel {
    /// Depth of what is nearest to the light, of what hides it.
    pub depth: f64,
    /// Share of the light that comes so far.
    pub left: f64,
}

impl DepthMap {
    /// Draws triangles, in texels; the nearest of those that hide the light wins, and of those that transmit it all count that are
    /// nearer: k_t is that of the first vertex.
    pub(super) fn draw(
        size: u32,
        fill: Fill,
        opaque: impl Iterator<Item = Triangle>,
        panes: impl Iterator<Item = Triangle>,
    ) -> Self {
        let side = size as usize;
        let mut depth = vec![1.0; side * side];
        for triangle in opaque {
            fill.fragments(&triangle, ShadeMode::Flat, (size, size), |fragment| {
                let stored = &mut depth[fragment.y as usize * side + fragment.x as usize];
                *stored = fragment.z().min(*stored);
            });
        }
        let mut left = Vec::new();
        for triangle in panes {
            left.resize(side * side, 1.0);
            fill.fragments(&triangle, ShadeMode::Flat, (size, size), |fragment| {
                let at = fragment.y as usize * side + fragment.x as usize;
                if fragment.z() < depth[at] {
                    left[at] *= fragment.kt();
                }
            });
        }
        Self { size, depth, left }
    }

    /// The nearest texel; `None` if x or y lies in none.
    pub(super) fn at(&self, x: f64, y: f64) -> Option<Texel> {
        let side = 0.0..f64::from(self.size);
        // Infinite and NaN are in no range.
        let inside = side.contains(&x) && side.contains(&y);
        let at = y as usize * self.size as usize + x as usize;
        inside.then(|| Texel { depth: self.depth[at], left: self.left.get(at).copied().unwrap_or(1.0) })
    }
}
