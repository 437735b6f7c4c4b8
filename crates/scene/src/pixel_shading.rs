//! A frame whose colours come from the shading equation at each pixel (ch. 7.11, 7.12): what it needs beside the triangles.
//!
//! ```text
//!   normals, positions at the vertices ──linear over the screen──> N, to length 1 ──> the equation ──> colour
//!   r g b at the vertices ──────────────linear over the screen──> c, which k_a and k_d are multiplied with
//!   u v at the vertices ────────────────linear over the screen──> the nearest texel, which c is multiplied with, and the slopes
//!                                                                 of the relief there, which turn N
//! ```
//! Triangle files have viewer and lights infinitely far away; a scene's frame has its own.

use crate::camera::Camera;
use crate::frame::{Frame, Triangle, Vertex};
use crate::light::Light;
use crate::mesh::Material;
use crate::pass::Blending;
use crate::scene::Scene;
use crate::shading::{Lighting, Point, Specular};
use crate::surface::{Surface, SurfaceVertex};
use crate::texture::{Image, Texture};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// How the cosines of a pixel are come by.
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
    /// T_u and T_v: where its relief has the slopes B_u and B_v a normal grows by N x (B_u T_u + B_v T_v); 0 without one.
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

    /// The equation at a point of a triangle where the surface has the colour c; `normal` of any length. Cut to [0, 1].
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

impl Scene {
    /// The frame of a surface of this scene with the equation at each pixel. Highlights are of the form that N·H gives: for the
    /// mirror form that of ch. 7.12. In Phong the viewer is far away, as hardware with linear products has it. A texture of nearest
    /// texels is looked up at each pixel, another colours the vertices; a relief of nearest texels turns the normal, another is not
    /// seen.
    pub fn pixel_frame(&self, surface: &Surface, method: PixelMethod) -> Frame {
        let Camera { eye, target, .. } = self.camera;
        let viewer = match method {
            PixelMethod::FastPhong => Viewer::At(eye),
            PixelMethod::Phong => Viewer::Toward((eye - target).normalize_or_zero()),
        };
        let mut textures = Vec::new();
        let places: Vec<Option<u32>> = self
            .mesh
            .textures()
            .iter()
            .map(|picture| match picture {
                Texture::Texels(image) => {
                    textures.push(Arc::clone(image));
                    Some(textures.len() as u32 - 1)
                }
                _ => None,
            })
            .collect();
        let texels =
            |place: Option<u32>| place.and_then(|place| places.get(place as usize).copied().flatten());
        let plain: Vec<(DVec3, Material)> = self
            .mesh
            .materials()
            .iter()
            .map(|material| {
                let (color, grey) = in_grey(material);
                let bump = texels(material.bump).filter(|_| material.bump_height != 0.0);
                (color, Material { texture: texels(material.texture), bump, ..grey })
            })
            .collect();
        let corner = |face: u32, vertex: &SurfaceVertex| {
            let place = self.mesh.faces()[face as usize].material as usize;
            if plain[place].1.texture.is_some() {
                let [r, g, b] = plain[place].0.to_array();
                return Vertex { r, g, b, ..vertex.screen };
            }
            // What the texture multiplies white with.
            let tint = self.mesh.material_at(face, vertex.texture).diffuse;
            let texture = tint / self.mesh.materials()[place].diffuse;
            let [r, g, b] =
                (plain[place].0 * DVec3::select(texture.is_finite_mask(), texture, DVec3::ONE)).to_array();
            Vertex { r, g, b, ..vertex.screen }
        };
        let turns = |face: u32| {
            let place = self.mesh.faces()[face as usize].material as usize;
            let height = self.mesh.materials()[place].bump_height;
            if plain[place].1.bump.is_some() { self.mesh.turns(face, height) } else { [DVec3::ZERO; 2] }
        };
        let triangles = surface.triangles.iter();
        let own = triangles.clone().map(|triangle| PixelTriangle {
            normals: triangle.vertices.map(|vertex| vertex.normal),
            positions: triangle.vertices.map(|vertex| vertex.position),
            texture: triangle.vertices.map(|vertex| vertex.texture),
            turns: turns(triangle.face),
            material: self.mesh.faces()[triangle.face as usize].material,
        });
        let shading = PixelShading {
            method,
            viewer,
            ambient: self.ambient,
            lights: self.lights.clone(),
            specular: if self.specular == Specular::Mirror { Specular::Halfway } else { self.specular },
            triangles: own.collect(),
            materials: plain.iter().map(|(_, material)| *material).collect(),
            textures,
        };
        let triangles: Vec<Triangle> = triangles
            .map(|triangle| Triangle(triangle.vertices.map(|vertex| corner(triangle.face, &vertex))))
            .collect();
        let clear = triangles.iter().flat_map(|triangle| triangle.0).any(|vertex| vertex.kt > 0.0);
        Frame {
            clear: self.background.to_array(),
            blend: if clear { Blending::Mix } else { Blending::Off },
            triangles,
            shading: Some(shading),
            ..Frame::new(surface.width, surface.height)
        }
    }
}

/// The colour c of a material and the material without it: k_d in grey, where k_a and I_e allow it.
fn in_grey(material: &Material) -> (DVec3, Material) {
    let brightest = material.diffuse.max_element();
    let color = material.diffuse / brightest;
    let grey = material.ambient.max_element();
    let of_one_color = brightest > 0.0 && (material.ambient - color * grey).abs().max_element() < 1e-12;
    if !of_one_color {
        return (DVec3::ONE, Material { texture: None, bump: None, ..*material });
    }
    let [ambient, diffuse] = [grey, brightest].map(DVec3::splat);
    (color, Material { ambient, diffuse, texture: None, bump: None, ..*material })
}

/// A vector in its direction of length 1; one that has it already comes back as it is, so that files are read back bit for
/// bit. `None` of a vector without a direction, or so short or long that its square is no number of full accuracy.
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

    /// What is not mixed is not sorted either, and a pane would hide what is behind it.
    #[test]
    fn a_frame_is_mixed_where_something_of_it_transmits_light() {
        let frame = |transmission: f64| {
            let text = format!(
                "[[material]]\nname = \"m\"\ndiffuse = 0.5\ntransmission = {transmission}\n\
                 [[object]]\nbuiltin = \"sphere\"\n\
                 [[object]]\npositions = [[0, 0, 2], [1, 0, 2], [1, 1, 2]]\nfaces = [[0, 1, 2]]\n\
                 material = \"m\"\n"
            );
            let scene = Scene::parse(std::path::Path::new("a.toml"), &text).expect("a scene");
            PixelMethod::ALL.map(|method| scene.pixel_frame(&scene.surface(64, 64, 8191.0), method).blend)
        };
        assert_eq!([frame(0.5), frame(0.0)], [[Blending::Mix; 2], [Blending::Off; 2]]);
    }
}
