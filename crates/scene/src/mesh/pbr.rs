//! Materials of glTF, which are metallic and rough, as coefficients of the shading equation.
//!
//! | glTF | here |
//! |---|---|
//! | base colour c | k_d = k_a = c |
//! | metallic m, roughness r | k_s = (0.04 + (c - 0.04) m) (1 - r), n = 2 / max(r, 0.1)⁴ - 2, at least 1 |
//! | emissive factor | I_e |
//! | alpha, where the mode is `BLEND` | k_t = 1 - alpha |
//! | base colour texture | texture: PNG or JPEG in a buffer, in a `data:` URI or beside the file; white if it is not there |
//!
//! A rule of thumb, not physics: what is rough stays matte in its colour, what is smooth shines, metals in their colour.
//! n is the usual one for the half-vector form.

use super::Material;
use super::resource::Uri;
use crate::error::{Fault, InputError};
use crate::texture::Texture;
use glam::DVec3;
use gltf::Document;
use gltf::material::AlphaMode;
use std::collections::HashMap;
use std::io::Cursor;
use std::path::Path;

/// The materials of a file as far as its faces have called for them.
pub(super) struct Materials<'a> {
    pub list: Vec<Material>,
    pub textures: Vec<Texture>,
    path: &'a Path,
    document: &'a Document,
    buffers: &'a [Vec<u8>],
    /// Places in `list` by the number in the file; the default one has none.
    places: HashMap<Option<usize>, u32>,
    /// Places in `textures` by the number of the image.
    images: HashMap<usize, u32>,
}

impl<'a> Materials<'a> {
    /// Of the document at `path`.
    pub fn new(path: &'a Path, document: &'a Document, buffers: &'a [Vec<u8>]) -> Self {
        let (places, images) = (HashMap::new(), HashMap::new());
        Self { list: Vec::new(), textures: Vec::new(), path, document, buffers, places, images }
    }

    /// The set of texture coordinates that a material's picture lies over.
    pub fn coordinates(&self, material: &gltf::Material) -> Result<u32, InputError> {
        let Some(info) = material.pbr_metallic_roughness().base_color_texture() else { return Ok(0) };
        if info.texture_transform().is_some() {
            let key = match material.index() {
                Some(index) => format!("material {index} baseColorTexture"),
                None => "baseColorTexture".to_owned(),
            };
            let permitted =
                "permitted: texture coordinates as the vertices have them; apply the transform to them";
            return Err(self.fault(key, "KHR_texture_transform", permitted));
        }
        Ok(info.tex_coord())
    }

    fn fault(&self, key: String, value: &str, permitted: &str) -> InputError {
        Fault::new(&self.path.display().to_string(), None, key, value, permitted).into()
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
        let key = format!("image {}", image.index());
        let name = format!("{}: {key}", self.path.display());
        // The reader's own `source` panics where a view has no mimeType, or nothing says where the picture is.
        let said = &self.document.as_json().images[image.index()];
        let view = said.buffer_view.and_then(|view| self.document.views().nth(view.value()));
        let texture = match (&said.uri, view) {
            (Some(uri), _) => match Uri::of(uri) {
                Ok(Uri::Data(bytes)) => Texture::decode(&name, Cursor::new(bytes))?,
                Ok(Uri::Beside(beside)) => Texture::named(&beside, &self.path.with_file_name(&beside))?,
                Err(permitted) => return Err(self.fault(key, uri, permitted)),
            },
            (None, Some(view)) => {
                let end = view.offset().checked_add(view.length());
                let buffer = self.buffers.get(view.buffer().index());
                let bytes = end.and_then(|end| buffer?.get(view.offset()..end));
                let permitted = "permitted: all within its buffer";
                let bytes = bytes.ok_or_else(|| self.fault(key, "buffer view", permitted))?;
                Texture::decode(&name, Cursor::new(bytes))?
            }
            (None, None) => {
                return Err(self.fault(
                    key,
                    "no source",
                    "permitted: `uri` or `bufferView` of a PNG or JPEG",
                ));
            }
        };
        self.textures.push(texture);
        let place = self.textures.len() as u32 - 1;
        self.images.insert(image.index(), place);
        Ok(place)
    }
}
