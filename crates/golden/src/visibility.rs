//! Where r_l of the shading equation comes from.

use crate::ray::Rays;
use crate::shadow::ShadowMaps;
use edgewalk_scene::{Scene, SurfaceTriangle};
use glam::DVec3;

/// Methods for r_l (ch. 7.2).
pub enum Visibility<'a> {
    /// r_l = 1: no light casts shadows.
    Full,
    /// By the lights' maps: 0, or the product of k_t of what transmits light before the texel.
    Maps(ShadowMaps),
    /// By rays: the product of k_t of the faces on the way.
    Rays(Rays<'a>),
}

impl Visibility<'_> {
    /// r_l of each light at a point of a triangle.
    pub(crate) fn factors(&self, scene: &Scene, point: DVec3, triangle: &SurfaceTriangle) -> Vec<f64> {
        let lights = scene.lights.iter().enumerate();
        let factor = |(l, light)| match self {
            Self::Full => 1.0,
            Self::Maps(maps) => maps.transmitted(l, point, triangle.own_normal),
            Self::Rays(rays) => rays.transmitted(light, point, triangle.face),
        };
        lights.map(factor).collect()
    }
}
