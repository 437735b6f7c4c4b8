//! The shadow maps of all lights of a scene: a depth pass each, then the comparison (ch. 7.2, 7.3).
//!
//! ```text
//!   point ──> place in the light's view ──> nearest texel ──> distance(point) <= distance(map) + bias: r_l = 1, else 0
//! ```
//! The bias has two parts, both in the world's unit. A texel holds the depth at its centre, at most half a texel to each
//! side of the point; over that way the plane of the polygon itself changes its distance by half of
//! [`LightView::slope`]. The whole slope leaves as much again for the next polygon of a curved surface. And
//! [`BIAS`] of the size of the mesh covers rounding and the sub-pixels of the map.
//!
//! A map has a second plane, the product of k_t of what transmits light before that texel: r_l of a point that is not hidden. It counts
//! what lies behind a point that transmits light itself, and that point's own face. [`crate::Rays`] is the reference that does neither.

use super::depth_map::DepthMap;
use crate::fill::Fill;
use edgewalk_scene::{LightView, Scene};
use glam::DVec3;

/// The constant part of the bias, as a part of the diagonal of the box around the mesh.
const BIAS: f64 = 1e-4;

/// Maps are drawn with the most sub-pixels there are.
const FILL: Fill = Fill::Exact { subpixel_bits: crate::cover::MAX_SUBPIXEL_BITS };

/// The shadow maps of a scene.
pub struct ShadowMaps {
    /// The views of each light.
    lights: Vec<Vec<(LightView, DepthMap)>>,
    /// Constant part of the bias, units of length.
    bias: f64,
}

impl ShadowMaps {
    /// Draws the maps of every light, `size` by `size` texels each, 1..=[`edgewalk_scene::MAX_SIDE`].
    pub fn draw(scene: &Scene, size: u32) -> Self {
        let [low, high] = scene.mesh.bounds();
        let draw = |view: LightView| {
            let [opaque, panes] = view.triangles(&scene.mesh).map(Vec::into_iter);
            (view, DepthMap::draw(size, FILL, opaque, panes))
        };
        let maps =
            scene.lights.iter().map(|light| light.views([low, high], size).into_iter().map(draw).collect());
        Self { lights: maps.collect(), bias: BIAS * (high - low).length() }
    }

    /// r_l of a light, by its place in the scene, at a point of a polygon with this unit normal: 1 outside the light's maps, 0 behind what hides
    /// the light, else what its texel says is left.
    pub fn transmitted(&self, light: usize, point: DVec3, normal: DVec3) -> f64 {
        let found = self.lights[light].iter().find_map(|(view, map)| Some((view, map, view.place(point)?)));
        let Some((view, map, place)) = found else { return 1.0 };
        let Some(texel) = map.at(place.texel.x, place.texel.y) else { return 1.0 };
        let far = view.distance(texel.depth) + self.bias + view.slope(point, normal);
        if place.distance <= far { texel.left } else { 0.0 }
    }

    /// The view of a light that holds a point, and the bias there, units of length.
    pub fn bias(&self, light: usize, point: DVec3, normal: DVec3) -> Option<(&LightView, f64)> {
        let (view, _) = self.lights[light].iter().find(|(view, _)| view.place(point).is_some())?;
        Some((view, self.bias + view.slope(point, normal)))
    }
}
