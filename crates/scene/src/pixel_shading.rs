//! A frame whose colours come from the shading equation at each pixel (ch. 7.11, 7.12): what it needs beside
//! the triangles.
//!
//! ```text
//!   normals, positions at the vertices ──linear over the screen──> N, to length 1 ──> the equation ──> colour
//!   r g b at the vertices ──────────────linear over the screen──> c, which k_a and k_d are multiplied with
//!   u v at the vertices ────────────────linear over the screen──> the nearest texel, which c is multiplied with, and the slopes
//!                                                                 of the relief there, which turn N
//! ```
//! Triangle files have viewer and lights infinitely far away; a scene's frame has its own.

use crate::light::Light;
use crate::mesh::Material;
use crate::shading::{Lighting, Point, Specular};
use crate::texture::Image;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Method of the cosines of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PixelMethod {
    /// N is brought to length 1 at each pixel (ch. 7.11).
    Phong,
    /// N·L and N·H are quadratics over the triangle (end of ch. 7.6).
    FastPhong,
}

impl PixelMethod {
    /// Both, in the order of [`Self::NAMES`].
    pub const ALL: [Self; 2] = [Self::Phong, Self::FastPhong];
    /// The names in files and on the command line.
    pub const NAMES: [&'static str; 2] = ["phong", "fast-phong"];

    /// The name in files and on the command line.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// Where a frame is seen from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Viewer {
    /// Infinitely far away; a unit vector to there.
    Toward(DVec3),
    /// At a point of the world.
    At(DVec3),
}

/// What the equation needs of a triangle beside its vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelTriangle {
    /// At the vertices, of length 1 or, of a mean, less.
    pub normals: [DVec3; 3],
    /// The vertices in the world; 0 where nothing depends on them.
    pub positions: [DVec3; 3],
    /// Texture coordinates at the vertices, u to the right and v up; 0 where there are none.
    pub texture: [DVec2; 3],
    /// T_u and T_v: where its relief has the slopes B_u and B_v a normal grows by N x (B_u T_u + B_v T_v); 0
    /// without one.
    pub turns: [DVec3; 2],
    /// Place among the materials.
    pub material: u32,
}

/// The shading of a frame at each pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct PixelShading {
    /// How.
    pub method: PixelMethod,
    /// V.
    pub viewer: Viewer,
    /// I_a.
    pub ambient: DVec3,
    /// The other lights.
    pub lights: Vec<Light>,
    /// `Halfway` or `Blinn`: what N·H alone gives.
    pub specular: Specular,
    /// What their textures and reliefs are, is said here.
    pub materials: Vec<Material>,
    /// What the materials name by its place: colours, or a relief's heights.
    pub textures: Vec<Arc<Image>>,
    /// As many as the frame has triangles, in their order.
    pub triangles: Vec<PixelTriangle>,
}

impl PixelShading {
    /// The forms of the specular part that it may have, in the order of their names.
    pub const FORMS: [Specular; 2] = [Specular::Halfway, Specular::Blinn];
    /// The names of these in files.
    pub const FORM_NAMES: [&'static str; 2] = ["halfway", "blinn"];

    /// V at a point.
    pub fn viewer_at(&self, position: DVec3) -> DVec3 {
        match self.viewer {
            Viewer::Toward(toward) => toward,
            Viewer::At(eye) => (eye - position).normalize_or_zero(),
        }
    }

    /// The equation at a point of a triangle where the surface has the colour c; `normal` of any length. Cut
    /// to [0, 1].
    pub fn color(&self, triangle: &PixelTriangle, position: DVec3, normal: DVec3, surface: DVec3) -> DVec3 {
        let material = self.material(triangle, surface);
        let lighting = Lighting { ambient: self.ambient, lights: &self.lights, specular: self.specular };
        let viewer = self.viewer_at(position);
        let point = Point { position, normal: normal.normalize_or_zero(), viewer };
        lighting.shade(&material, &point).clamp(DVec3::ZERO, DVec3::ONE)
    }

    /// A triangle's material where the surface has the colour c.
    pub fn material(&self, triangle: &PixelTriangle, surface: DVec3) -> Material {
        let material = self.materials[triangle.material as usize];
        Material { ambient: material.ambient * surface, diffuse: material.diffuse * surface, ..material }
    }

    /// The picture that colours a triangle.
    pub fn texture(&self, triangle: &PixelTriangle) -> Option<&Arc<Image>> {
        self.materials[triangle.material as usize].texture.and_then(|place| self.textures.get(place as usize))
    }

    /// The relief that turns a triangle's normals.
    pub fn relief(&self, triangle: &PixelTriangle) -> Option<&Arc<Image>> {
        self.materials[triangle.material as usize].bump.and_then(|place| self.textures.get(place as usize))
    }

    /// Only the triangles at these places, in this order.
    #[must_use]
    pub fn picked(self, places: impl IntoIterator<Item = usize>) -> Self {
        let triangles = places.into_iter().map(|place| self.triangles[place]).collect();
        Self { triangles, ..self }
    }
}

/// A vector in its direction of length 1; one that has it already comes back as it is, so that files are read
/// back bit for bit. `None` of a vector without a direction, or so short or long that its square is no number
/// of full accuracy.
pub(crate) fn unit(vector: DVec3) -> Option<DVec3> {
    let length = vector.length();
    if (length - 1.0).abs() <= 4.0 * f64::EPSILON {
        return Some(vector);
    }
    (1e-100..=1e100).contains(&length).then(|| vector / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_vector_stays_what_it_is() {
        let mut checked = 0;
        for k in 0..1000 {
            let k = f64::from(k);
            let vector = DVec3::new((0.1 + k).sin(), 0.3 * (k * 7.0).cos(), 1e-3 * k - 0.5);
            let once = unit(vector).expect("no length 0 among them");
            assert_eq!(unit(once), Some(once));
            checked += 1;
        }
        assert_eq!((checked, unit(DVec3::ZERO)), (1000, None));
    }
}
