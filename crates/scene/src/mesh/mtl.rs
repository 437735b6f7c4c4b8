//! Material libraries of Wavefront OBJ: the diffuse colour of each material.

use super::Material;
use crate::error::InputError;
use crate::text::{Place, each_line, rest, words};
use std::collections::HashMap;
use std::io::BufRead;

/// Materials by name.
pub(super) type Library = HashMap<String, Material>;

/// Adds the materials of a library that messages call `file`.
pub(super) fn read(file: &str, input: impl BufRead, library: &mut Library) -> Result<(), InputError> {
    let mut current = None;
    each_line(file, input, |place, line| {
        let mut words = words(line);
        match words.next() {
            Some(b"newmtl") => {
                current = Some(rest(line));
                library.insert(rest(line), Material::DEFAULT);
            }
            Some(b"Kd") => {
                let material = current.as_ref().and_then(|name| library.get_mut(name));
                let Some(material) = material else {
                    return Err(place.fault("Kd", b"no material", "permitted: after `newmtl NAME`").into());
                };
                material.diffuse = color(place, words)?.into();
            }
            _ => {}
        }
        Ok(())
    })?;
    Ok(())
}

fn color<'a>(place: Place, mut words: impl Iterator<Item = &'a [u8]>) -> Result<[f64; 3], InputError> {
    let mut color = [0.0; 3];
    for (key, channel) in ["Kd r", "Kd g", "Kd b"].into_iter().zip(&mut color) {
        *channel = place.number(key, words.next().unwrap_or_default(), "a number", 0.0..=1.0)?;
    }
    Ok(color)
}
