//! `[[material]]`, and the textures it names.

use super::table::Table;
use crate::error::InputError;
use crate::mesh::Material;
use crate::texture::{MAX_TEXTURE_SIDE, Texture, WAVE_TEXELS};
use edgewalk_nearest::nearest;
use glam::DVec3;
use std::path::Path;

const KEYS: &[&str] = &[
    "name",
    "emission",
    "ambient",
    "diffuse",
    "specular",
    "exponent",
    "transmission",
    "coefficients",
    "texture",
    "texels",
    "checker",
    "colors",
    "gloss",
    "gloss_checker",
    "bump",
    "waves",
    "bump_height",
];

/// Place of `plain` among the values of `coefficients`: those of ch. 7.4.
const PLAIN: usize = 1;

/// Place of `nearest` among the values of `texels`.
const NEAREST: usize = 1;

/// Keys of pictures.
const PICTURES: [&str; 5] = ["texture", "checker", "gloss", "bump", "waves"];

/// Largest exponent of a highlight.
const MAX_EXPONENT: f64 = 1e5;

/// Largest height of a relief.
const MAX_HEIGHT: f64 = 1e6;

/// The materials of a file by name, and their textures.
pub(super) struct Materials {
    named: Vec<(String, Material)>,
    pub textures: Vec<Texture>,
}

impl Materials {
    /// The materials of the file at `path`; pictures are beside it.
    pub fn read(scene: &Table, path: &Path) -> Result<Self, InputError> {
        let mut materials = Self { named: Vec::new(), textures: Vec::new() };
        for table in scene.tables("material", KEYS)? {
            let name = table.required("name", table.text("name")?, "permitted: a text in quotes")?;
            if materials.named.iter().any(|(other, _)| other == name) {
                return Err(table.fault("name", name, "permitted: a name that no other material has"));
            }
            let material = materials.material(&table, path)?;
            materials.named.push((name.to_owned(), material));
        }
        Ok(materials)
    }

    fn material(&mut self, table: &Table, path: &Path) -> Result<Material, InputError> {
        table.beside("texels", &PICTURES, ", a picture of texels")?;
        table.beside("colors", &["checker"], "")?;
        table.beside("bump_height", &["bump", "waves"], "")?;
        let diffuse = table.color("diffuse", 1.0)?.unwrap_or(Material::DEFAULT.diffuse);
        let material = Material {
            emission: table.color("emission", 1e6)?.unwrap_or(DVec3::ZERO),
            ambient: table.color("ambient", 1.0)?.unwrap_or(diffuse),
            diffuse,
            specular: table.color("specular", 1.0)?.unwrap_or(DVec3::ZERO),
            exponent: table.number("exponent", 0.0..=MAX_EXPONENT)?.unwrap_or(1.0),
            transmission: table.number("transmission", 0.0..=1.0)?.unwrap_or(0.0),
            texture: self.texture(table, path)?,
            gloss: self.gloss(table, path)?,
            bump: self.relief(table, path)?,
            bump_height: table.number("bump_height", -MAX_HEIGHT..=MAX_HEIGHT)?.unwrap_or(0.05),
        };
        if table.choice("coefficients", &["corrected", "plain"])? != Some(PLAIN) {
            return Ok(material);
        }
        material.corrected().ok_or_else(|| {
            let permitted = "permitted with plain coefficients: k_a, k_d and k_s at most 1 - transmission";
            table.fault("transmission", material.transmission, permitted)
        })
    }

    /// A picture, or the built-in chequer.
    fn texture(&mut self, table: &Table, path: &Path) -> Result<Option<u32>, InputError> {
        if let Some(picture) = self.picture(table, path, ["texture", "checker"])? {
            return Ok(Some(picture));
        }
        let Some(squares) = table.count("checker", 1..=65536)? else { return Ok(None) };
        let texels = texels(table)?;
        if texels.is_some() && squares > MAX_TEXTURE_SIDE {
            let permitted =
                format!("permitted beside `texels`: at most {MAX_TEXTURE_SIDE}, a texel a square");
            return Err(table.fault("checker", squares, permitted));
        }
        let colors = table.vectors("colors", 1.0)?.unwrap_or(vec![DVec3::ONE, DVec3::splat(0.25)]);
        match <[DVec3; 2]>::try_from(colors) {
            Ok(colors) if colors.iter().all(|color| color.min_element() >= 0.0) => {
                let checker = Texture::Checker { squares, colors };
                Ok(Some(self.add(if texels == Some(NEAREST) { checker.nearest() } else { checker })))
            }
            _ => Err(table.fault("colors", "list", "permitted: two of [r, g, b], each from 0 to 1")),
        }
    }

    /// A picture of k_s and n, or a built-in chequer of full and a quarter gloss.
    fn gloss(&mut self, table: &Table, path: &Path) -> Result<Option<u32>, InputError> {
        if let Some(picture) = self.picture(table, path, ["gloss", "gloss_checker"])? {
            return Ok(Some(picture));
        }
        let Some(squares) = table.count("gloss_checker", 1..=65536)? else { return Ok(None) };
        let colors = [DVec3::ONE, DVec3::splat(0.25)];
        Ok(Some(self.add(Texture::Checker { squares, colors })))
    }

    /// A picture of heights, or the built-in waves.
    fn relief(&mut self, table: &Table, path: &Path) -> Result<Option<u32>, InputError> {
        if let Some(picture) = self.picture(table, path, ["bump", "waves"])? {
            return Ok(Some(picture));
        }
        let Some(count) = table.count("waves", 1..=65536)? else { return Ok(None) };
        let (texels, most) = (texels(table)?, MAX_TEXTURE_SIDE / WAVE_TEXELS);
        if texels.is_some() && count > most {
            let permitted = format!("permitted beside `texels`: at most {most}, {WAVE_TEXELS} texels a wave");
            return Err(table.fault("waves", count, permitted));
        }
        let waves = Texture::Waves { count };
        Ok(Some(self.add(if texels == Some(NEAREST) { waves.nearest() } else { waves })))
    }

    /// The picture of the file that the first key names, read as `texels` says; the second key, of what is built in, must
    /// not stand beside it.
    fn picture(
        &mut self,
        table: &Table,
        path: &Path,
        [key, built_in]: [&'static str; 2],
    ) -> Result<Option<u32>, InputError> {
        if table.has(key) && table.has(built_in) {
            return Err(table.fault(built_in, "both", format!("permitted: one of {key}, {built_in}")));
        }
        let Some(name) = table.file(key)? else { return Ok(None) };
        let picture = Texture::read(&path.with_file_name(name)).map_err(|error| table.of_file(key, error))?;
        Ok(Some(self.add(if texels(table)? == Some(NEAREST) { picture.nearest() } else { picture })))
    }

    fn add(&mut self, texture: Texture) -> u32 {
        self.textures.push(texture);
        (self.textures.len() - 1) as u32
    }

    /// The material that a table names.
    pub fn get(&self, table: &Table, key: &str) -> Result<Option<Material>, InputError> {
        let Some(name) = table.text(key)? else { return Ok(None) };
        match self.named.iter().find(|(other, _)| other == name) {
            Some((_, material)) => Ok(Some(*material)),
            None if self.named.is_empty() => {
                let permitted = "no [[material]] is declared; declare one of this name, or leave the key out";
                Err(table.fault(key, name, permitted))
            }
            None => {
                let names: Vec<&str> = self.named.iter().map(|(name, _)| name.as_str()).collect();
                let near =
                    nearest(name, names.iter().copied()).map(|near| format!("; did you mean `{near}`?"));
                let permitted = format!("permitted: {}{}", names.join(" "), near.unwrap_or_default());
                Err(table.fault(key, name, permitted))
            }
        }
    }
}

/// How the pictures of a material are read.
fn texels(table: &Table) -> Result<Option<usize>, InputError> {
    table.choice("texels", &["bilinear", "nearest"])
}
