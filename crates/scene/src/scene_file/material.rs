//! `[[material]]`, and the textures it names.

use super::table::Table;
use crate::error::{InputError, nearest};
use crate::mesh::Material;
use crate::texture::Texture;
use glam::DVec3;

const KEYS: &[&str] =
    &["name", "emission", "ambient", "diffuse", "specular", "exponent", "transmission", "checker", "colors"];

/// Largest exponent of a highlight.
const MAX_EXPONENT: f64 = 1e5;

/// The materials of a file by name, and their textures.
pub(super) struct Materials {
    named: Vec<(String, Material)>,
    pub textures: Vec<Texture>,
}

impl Materials {
    pub fn read(scene: &Table) -> Result<Self, InputError> {
        let mut materials = Self { named: Vec::new(), textures: Vec::new() };
        for table in scene.tables("material", KEYS)? {
            let name = table.required("name", table.text("name")?, "permitted: a text in quotes")?;
            if materials.named.iter().any(|(other, _)| other == name) {
                return Err(table.fault("name", name, "permitted: a name that no other material has"));
            }
            let material = materials.material(&table)?;
            materials.named.push((name.to_owned(), material));
        }
        Ok(materials)
    }

    fn material(&mut self, table: &Table) -> Result<Material, InputError> {
        let diffuse = table.color("diffuse", 1.0)?.unwrap_or(Material::DEFAULT.diffuse);
        Ok(Material {
            emission: table.color("emission", 1e6)?.unwrap_or(DVec3::ZERO),
            ambient: table.color("ambient", 1.0)?.unwrap_or(diffuse),
            diffuse,
            specular: table.color("specular", 1.0)?.unwrap_or(DVec3::ZERO),
            exponent: table.number("exponent", 0.0..=MAX_EXPONENT)?.unwrap_or(1.0),
            transmission: table.number("transmission", 0.0..=1.0)?.unwrap_or(0.0),
            texture: self.texture(table)?,
            bump: None,
            bump_height: 0.0,
        })
    }

    /// A built-in chequer.
    fn texture(&mut self, table: &Table) -> Result<Option<u32>, InputError> {
        let Some(squares) = table.number("checker", 1.0..=65536.0)? else {
            return Ok(None);
        };
        let colors = table.vectors("colors", 1.0)?.unwrap_or(vec![DVec3::ONE, DVec3::splat(0.25)]);
        match <[DVec3; 2]>::try_from(colors) {
            Ok(colors) if colors.iter().all(|color| color.min_element() >= 0.0) => {
                Ok(Some(self.add(Texture::Checker { squares: squares as u32, colors })))
            }
            _ => Err(table.fault("colors", "list", "permitted: two of [r, g, b], each from 0 to 1")),
        }
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
            None => {
                let names: Vec<&str> = self.named.iter().map(|(name, _)| name.as_str()).collect();
                let near = nearest(name, &names).map(|near| format!("; did you mean `{near}`?"));
                let permitted = format!("permitted: {}{}", names.join(" "), near.unwrap_or_default());
                Err(table.fault(key, name, permitted))
            }
        }
    }
}
