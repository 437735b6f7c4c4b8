//! The shading equation at a pixel of a scene, term by term.

use edgewalk_golden::{Fragment, Rays, ShadowMaps, Weights};
use edgewalk_scene::{Light, Scene, SurfaceTriangle};
use serde::Serialize;

/// A point of a surface in its light.
#[derive(Debug, Serialize)]
pub struct LitPoint {
    /// World space.
    pub position: [f64; 3],
    /// Unit vector on the side that is seen.
    pub normal: [f64; 3],
    /// I_e.
    pub emission: [f64; 3],
    /// k_a I_a.
    pub ambient: [f64; 3],
    /// In the order of the scene.
    pub lights: Vec<LightPart>,
    /// The sum with no light hidden, not cut to [0, 1].
    pub total: [f64; 3],
}

/// What one light does there.
#[derive(Debug, Serialize)]
pub struct LightPart {
    /// `directional`, `positional` or `flood`.
    pub kind: &'static str,
    /// I_l k_d N L.
    pub diffuse: [f64; 3],
    /// I_l k_s cos^n.
    pub specular: [f64; 3],
    /// r_l by the shadow map.
    pub r_map: f64,
    /// r_l by a ray: the product of k_t on its way.
    pub r_ray: f64,
}

/// The terms where the ray through a pixel meets a triangle of the scene.
pub fn lit_point(
    scene: &Scene,
    triangle: &SurfaceTriangle,
    fragment: &Fragment,
    maps: &ShadowMaps,
) -> LitPoint {
    let weights = Weights::perspective(fragment, triangle);
    let texture = weights.of(triangle.vertices.map(|vertex| vertex.texture));
    let position = weights.of(triangle.vertices.map(|vertex| vertex.position));
    let smooth = weights.of(triangle.vertices.map(|vertex| vertex.normal)).normalize_or_zero();
    let normal = scene.mesh.bumped_normal(triangle.face, texture, smooth);
    let material = scene.mesh.material_at(triangle.face, texture);
    let terms = scene.lighting().terms(&material, &scene.point(position, normal));
    let rays = Rays::new(&scene.mesh);
    let part = |(place, light): (usize, &Light)| LightPart {
        kind: match light {
            Light::Directional { .. } => "directional",
            Light::Positional { .. } => "positional",
            Light::Flood { .. } => "flood",
        },
        diffuse: terms.lights[place].diffuse.to_array(),
        specular: terms.lights[place].specular.to_array(),
        r_map: maps.transmitted(place, position, triangle.own_normal),
        r_ray: rays.transmitted(light, position, triangle.face),
    };
    LitPoint {
        position: position.to_array(),
        normal: normal.to_array(),
        emission: terms.emission.to_array(),
        ambient: terms.ambient.to_array(),
        lights: scene.lights.iter().enumerate().map(part).collect(),
        total: terms.total(|_| 1.0).to_array(),
    }
}
