//! Material libraries of Wavefront OBJ.
//!
//! | line | becomes | permitted |
//! |---|---|---|
//! | `Ke r g b` | emission I_e | 0 and more |
//! | `Ka r g b` | k_a; as `Kd` where it is missing | [0, 1] |
//! | `Kd r g b` | k_d | [0, 1] |
//! | `Ks r g b` | k_s; 0 where it is missing | [0, 1] |
//! | `Ns n` | exponent n | 0 and more |
//! | `d x`, `Tr x` | k_t = 1 - x, k_t = x; the last one counts | [0, 1] |
//! | `map_Kd FILE` | texture | PNG or JPEG beside the library; white if it is not there |
//! | `map_Bump [-bm h] FILE`, `bump` | relief of height h, 1 where it is missing (the format knows no unit) | the same; none if it is not there |
//!
//! Other lines are passed over. Options of maps other than `-bm` are passed over, and the file is then the last word.

use super::Material;
use crate::error::InputError;
use crate::text::{Place, each_line, rest, words};
use crate::texture::Texture;
use glam::DVec3;
use std::collections::HashMap;
use std::io::BufRead;
use std::path::Path;

/// Largest emission and exponent.
const MAX: f64 = 1e6;

/// Materials by name, and the textures they name by their places.
#[derive(Default)]
pub(super) struct Library {
    pub materials: HashMap<String, Material>,
    pub textures: Vec<Texture>,
    /// Places of the textures by the names in the library.
    places: HashMap<String, u32>,
}

/// Adds the materials of the library at `path`.
pub(super) fn read(path: &Path, input: impl BufRead, library: &mut Library) -> Result<(), InputError> {
    let mut current: Option<Current> = None;
    each_line(&path.display().to_string(), input, |place, line| {
        let mut words = words(line);
        let Some(key) = words.next().and_then(|word| std::str::from_utf8(word).ok()) else { return Ok(()) };
        if key == "newmtl" {
            library.finish(current.replace(Current::new(rest(line))));
            return Ok(());
        }
        if !KEYS.contains(&key) {
            return Ok(());
        }
        let Some(current) = &mut current else {
            return Err(place.fault(key, b"no material", "permitted: after `newmtl NAME`").into());
        };
        let material = &mut current.material;
        match key {
            "Ke" => material.emission = color(place, key, words, MAX)?,
            "Ka" => current.ambient = Some(color(place, key, words, 1.0)?),
            "Kd" => material.diffuse = color(place, key, words, 1.0)?,
            "Ks" => material.specular = color(place, key, words, 1.0)?,
            "Ns" => material.exponent = number(place, key, words, MAX)?,
            "d" => material.transmission = 1.0 - number(place, key, words, 1.0)?,
            "Tr" => material.transmission = number(place, key, words, 1.0)?,
            "map_Kd" => material.texture = Some(library.texture(path, &map(place, key, line)?.file)?),
            _ => {
                let map = map(place, key, line)?;
                material.bump = Some(library.texture(path, &map.file)?);
                material.bump_height = map.height;
            }
        }
        Ok(())
    })?;
    library.finish(current);
    Ok(())
}

/// Every word a line of a material may start with that is not passed over.
const KEYS: [&str; 11] = ["Ke", "Ka", "Kd", "Ks", "Ns", "d", "Tr", "map_Kd", "map_Bump", "map_bump", "bump"];

/// A material whose lines are still coming.
struct Current {
    name: String,
    material: Material,
    ambient: Option<DVec3>,
}

impl Current {
    fn new(name: String) -> Self {
        Self { name, material: Material::DEFAULT, ambient: None }
    }
}

impl Library {
    fn finish(&mut self, current: Option<Current>) {
        if let Some(Current { name, material, ambient }) = current {
            let ambient = ambient.unwrap_or(material.diffuse);
            self.materials.insert(name, Material { ambient, ..material });
        }
    }

    /// The place of the texture in a file named in the library at `path`.
    fn texture(&mut self, path: &Path, file: &str) -> Result<u32, InputError> {
        if let Some(place) = self.places.get(file) {
            return Ok(*place);
        }
        let texture = Texture::named(file, &path.with_file_name(file))?;
        let place = self.textures.len() as u32;
        self.textures.push(texture);
        self.places.insert(file.to_owned(), place);
        Ok(place)
    }
}

/// What stands behind `map_Kd` or `map_Bump`.
struct Map {
    file: String,
    height: f64,
}

fn map(place: Place, key: &str, line: &[u8]) -> Result<Map, InputError> {
    let file = rest(line);
    let words: Vec<&[u8]> = words(line).collect();
    if file.is_empty() {
        return Err(place.fault(key, b"", "permitted: the name of a file").into());
    }
    if !file.starts_with('-') {
        return Ok(Map { file, height: 1.0 });
    }
    let height = match words.iter().position(|word| *word == b"-bm") {
        Some(option) => {
            let word = words.get(option + 1).copied().unwrap_or_default();
            place.number("-bm", word, "a number", -MAX..=MAX)?
        }
        None => 1.0,
    };
    let file = words.last().map(|word| String::from_utf8_lossy(word).into_owned());
    Ok(Map { file: file.unwrap_or_default(), height })
}

fn number<'a>(
    place: Place,
    key: &str,
    mut words: impl Iterator<Item = &'a [u8]>,
    max: f64,
) -> Result<f64, InputError> {
    place.number(key, words.next().unwrap_or_default(), "a number", 0.0..=max)
}

fn color<'a>(
    place: Place,
    key: &str,
    mut words: impl Iterator<Item = &'a [u8]>,
    max: f64,
) -> Result<DVec3, InputError> {
    let mut color = [0.0; 3];
    for (channel, value) in ["r", "g", "b"].into_iter().zip(&mut color) {
        let word = words.next().unwrap_or_default();
        *value = place.number(format_args!("{key} {channel}"), word, "a number", 0.0..=max)?;
    }
    Ok(color.into())
}
