//! Materials of glTF, which are metallic and rough, as coefficients of the shading equation.
//!
//! | glTF | here |
//! |---|---|
//! | base colour c | k_d = k_a = c |
//! | metallic m, roughness r | k_s = (0.04 + (c - 0.04) m) (1 - r), n = 2 / max(r, 0.1)⁴ - 2, at least 1 |
//! | emissive factor | I_e |
//! | alpha, where the mode is `BLEND` | k_t = 1 - alpha |
//! | base colour texture | texture: PNG or JPEG in a buffer or beside the file; white if it is not there or a `data:` URI |
//!
//! A rule of thumb, not physics: what is rough stays matte in its colour, what is smooth shines, metals in their colour.
//! n is the usual one for the half-vector form.

use super::Material;
use crate::error::{Fault, InputError};
use crate::texture::Texture;
use glam::DVec3;
use gltf::buffer::Data;
use gltf::image::Source;
use gltf::material::AlphaMode;
use std::collections::HashMap;
use std::io::Cursor;
use std::path::Path;

/// The materials of a file as far as its faces have called for them.
pub(super) struct Materials<'a> {
    pub list: Vec<Material>,
    pub textures: Vec<Texture>,
    file: &'a str,
    path: &'a Path,
    buffers: &'a [Data],
    /// Places in `list` by the number in the file; the default one has none.
    places: HashMap<Option<usize>, u32>,
    /// Places in `textures` by the number of the image.
    images: HashMap<usize, u32>,
}

impl<'a> Materials<'a> {
    /// Of the file at `path`, which messages call `file`.
    pub fn new(file: &'a str, path: &'a Path, buffers: &'a [Data]) -> Self {
        let (places, images) = (HashMap::new(), HashMap::new());
        Self { list: Vec::new(), textures: Vec::new(), file, path, buffers, places, images }
    }

    /// The place of a material in the list.
    pub fn place(&mut self, material: &gltf::Material) -> Result<u32, InputError> {
        if let Some(place) = self.places.get(&material.index()) {
            return Ok(*place);
        }
        let pbr = material.pbr_metallic_roughness();
        let [r, g, b, alpha] = pbr.base_color_factor().map(|value| f64::from(value).clamp(0.0, 1.0));
        let base = DVec3::new(r, g, b);
        let metallic = f64::from(pbr.metallic_factor()).clamp(0.0, 1.0);
        let roughness = f64::from(pbr.roughness_factor()).clamp(0.0, 1.0);
        let image = pbr.base_color_texture().map(|info| self.image(&info.texture().source()));
        self.list.push(Material {
            emission: DVec3::from(material.emissive_factor().map(f64::from)).max(DVec3::ZERO),
            specular: DVec3::splat(0.04).lerp(base, metallic) * (1.0 - roughness),
            exponent: (2.0 / roughness.max(0.1).powi(4) - 2.0).max(1.0),
            transmission: if material.alpha_mode() == AlphaMode::Blend { 1.0 - alpha } else { 0.0 },
            texture: image.transpose()?,
            ..Material::matte(base)
        });
        let place = self.list.len() as u32 - 1;
        self.places.insert(material.index(), place);
        Ok(place)
    }

    fn image(&mut self, image: &gltf::Image) -> Result<u32, InputError> {
        if let Some(place) = self.images.get(&image.index()) {
            return Ok(*place);
        }
        let texture = match image.source() {
            Source::Uri { uri, .. } if uri.starts_with("data:") => {
                Texture::Absent(format!("image {}", image.index()))
            }
            Source::Uri { uri, .. } => {
                let beside = self.path.with_file_name(uri);
                if beside.is_file() { Texture::read(&beside)? } else { Texture::Absent(uri.to_owned()) }
            }
            Source::View { view, .. } => {
                let end = view.offset().checked_add(view.length());
                let buffer = self.buffers.get(view.buffer().index());
                let bytes = end.and_then(|end| buffer?.get(view.offset()..end)).ok_or_else(|| {
                    let key = format!("image {}", image.index());
                    Fault::new(self.file, None, key, "buffer view", "permitted: all within its buffer")
                })?;
                Texture::decode(self.file, Cursor::new(bytes))?
            }
        };
        self.textures.push(texture);
        let place = self.textures.len() as u32 - 1;
        self.images.insert(image.index(), place);
        Ok(place)
    }
}
