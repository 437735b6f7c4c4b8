//! The shading equation at a point: ambient and diffuse terms.

use crate::light::DirectionalLight;
use crate::mesh::Material;
use glam::DVec3;

/// I = k_a I_a + sum over the lights of I_l k_d max(N L, 0) (A 7.6), cut to [0, 1]; `normal` is a unit vector.
pub(crate) fn diffuse(
    material: &Material,
    normal: DVec3,
    ambient: DVec3,
    lights: &[DirectionalLight],
) -> DVec3 {
    let direct: DVec3 = lights.iter().map(|light| light.intensity * normal.dot(light.toward).max(0.0)).sum();
    (material.diffuse * (ambient + direct)).clamp(DVec3::ZERO, DVec3::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lambert_by_the_cosine_and_no_light_from_behind() {
        let material = Material { diffuse: DVec3::new(0.5, 1.0, 0.0) };
        let light = DirectionalLight { toward: DVec3::Y, intensity: DVec3::splat(0.8) };
        let ambient = DVec3::splat(0.1);
        let at = |normal| diffuse(&material, normal, ambient, &[light]);
        assert!(at(DVec3::Y).distance(DVec3::new(0.45, 0.9, 0.0)) < 1e-15);
        assert!(at(DVec3::new(0.0, 0.5, 0.75f64.sqrt())).distance(DVec3::new(0.25, 0.5, 0.0)) < 1e-15);
        assert_eq!(at(DVec3::NEG_Y), DVec3::new(0.05, 0.1, 0.0));
        assert_eq!(diffuse(&material, DVec3::Y, DVec3::splat(5.0), &[]), DVec3::new(1.0, 1.0, 0.0));
    }
}
