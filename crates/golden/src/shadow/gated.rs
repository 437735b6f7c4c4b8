//! Gouraud shading with shadows: each light's part by itself.
//!
//! A shadow cannot be interpolated from the vertices: r_l jumps inside a polygon. So what a vertex has without r_l is kept
//! apart, emission and ambient light in one colour and what each light adds in another; all are linear over the screen (ch. 7.8),
//! and at each pixel r_l gates its part before they are added: i = i_a + sum of r_l i_l.

use crate::weights::Weights;
use edgewalk_scene::{Scene, SurfaceTriangle};
use glam::DVec3;

/// The colours of the vertices of a triangle, part by part.
pub struct Gated {
    /// I_e + k_a I_a.
    pub always: [DVec3; 3],
    /// What each light adds while nothing hides it.
    pub lights: Vec<[DVec3; 3]>,
}

impl Gated {
    /// Of a triangle of the scene's surface.
    pub fn new(scene: &Scene, triangle: &SurfaceTriangle) -> Self {
        let terms = triangle.vertices.map(|vertex| {
            let material = scene.mesh.material_at(triangle.face, vertex.texture);
            let point = scene.point(vertex.position, vertex.normal.normalize_or_zero());
            scene.lighting().terms(&material, &point)
        });
        let part =
            |l: usize| terms.each_ref().map(|terms| terms.lights[l].diffuse + terms.lights[l].specular);
        Self {
            always: terms.each_ref().map(|terms| terms.emission + terms.ambient),
            lights: (0..scene.lights.len()).map(part).collect(),
        }
    }

    /// The colour at a pixel, not cut to [0, 1]; `r` holds r_l of each light there.
    pub(crate) fn color(&self, weights: Weights, r: &[f64]) -> DVec3 {
        let lights: DVec3 = self.lights.iter().zip(r).map(|(part, r)| *r * weights.of(*part)).sum();
        weights.of(self.always) + lights
    }
}
