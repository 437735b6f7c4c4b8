//! The frame of a scene with the shading equation at each pixel.

use crate::camera::Camera;
use crate::frame::Frame;
use crate::mesh::Material;
use crate::pixel_shading::{PixelMethod, PixelShading, PixelTriangle, Viewer};
use crate::rules::Blending;
use crate::scene::Scene;
use crate::shading::Specular;
use crate::surface::{Surface, SurfaceVertex};
use crate::texture::Texture;
use crate::vertex::{Triangle, Vertex};
use glam::DVec3;
use std::sync::Arc;

impl Scene {
    /// The frame of a surface of this scene with the equation at each pixel. Highlights are of the form that
    /// N·H gives: for the mirror form that of ch. 7.12. In Phong the viewer is far away, as hardware with
    /// linear products has it. A texture of nearest texels is looked up at each pixel, another colours the
    /// vertices; a relief of nearest texels turns the normal, another is not seen. Nor is a gloss: hardware has k_s and
    /// n of a material in tables.
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
    let plain = Material { texture: None, gloss: None, bump: None, ..*material };
    let brightest = material.diffuse.max_element();
    let color = material.diffuse / brightest;
    let grey = material.ambient.max_element();
    let of_one_color = brightest > 0.0 && (material.ambient - color * grey).abs().max_element() < 1e-12;
    if !of_one_color {
        return (DVec3::ONE, plain);
    }
    let [ambient, diffuse] = [grey, brightest].map(DVec3::splat);
    (color, Material { ambient, diffuse, ..plain })
}

#[cfg(test)]
mod tests {
    use super::*;

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
