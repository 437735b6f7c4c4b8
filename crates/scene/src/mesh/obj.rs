//! Wavefront OBJ.
//!
//! Taken: positions, polygons (cut into fans from their first corner), materials. Objects and groups become one mesh;
//! texture coordinates and normals are passed over. Of a
//! material library that is not there, every material is the default. Read by hand, as every fault must name its line and value.

use super::mtl::{self, Library};
use super::{Face, MAX_POSITION, Material, Mesh};
use crate::error::InputError;
use crate::text::{Place, each_line, rest, words};
use glam::DVec3;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

pub(super) fn read(path: &Path) -> Result<Mesh, InputError> {
    let file = path.display().to_string();
    let opened = File::open(path).map_err(|source| InputError::Read { file: file.clone(), source })?;
    let mut obj = Obj { materials: vec![Material::DEFAULT], ..Obj::default() };
    each_line(&file, BufReader::new(opened), |place, line| obj.line(path, place, line))?;
    Mesh::new(&file, obj.positions, obj.faces, obj.materials)
}

#[derive(Default)]
struct Obj {
    positions: Vec<DVec3>,
    faces: Vec<Face>,
    /// The first is the default, the others as they were called for.
    materials: Vec<Material>,
    library: Library,
    /// Of the faces to come.
    material: u32,
}

impl Obj {
    fn line(&mut self, path: &Path, place: Place, line: &[u8]) -> Result<(), InputError> {
        let mut words = words(line);
        match words.next() {
            Some(b"v") => self.position(place, words),
            Some(b"f") => self.polygon(place, words),
            Some(b"mtllib") => {
                let library = path.with_file_name(rest(line));
                match File::open(&library) {
                    Ok(opened) => {
                        mtl::read(&library.display().to_string(), BufReader::new(opened), &mut self.library)
                    }
                    Err(_) => Ok(()), // its materials stay the default
                }
            }
            Some(b"usemtl") => {
                let material = self.library.get(&rest(line)).unwrap_or(&Material::DEFAULT);
                self.material = self.materials.len() as u32;
                self.materials.push(*material);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn position<'a>(
        &mut self,
        place: Place,
        mut words: impl Iterator<Item = &'a [u8]>,
    ) -> Result<(), InputError> {
        let mut position = [0.0; 3];
        for (axis, coordinate) in ["v x", "v y", "v z"].into_iter().zip(&mut position) {
            let word = words.next().unwrap_or_default();
            *coordinate = place.number(axis, word, "a number", -MAX_POSITION..=MAX_POSITION)?;
        }
        self.positions.push(position.into());
        Ok(())
    }

    fn polygon<'a>(&mut self, place: Place, words: impl Iterator<Item = &'a [u8]>) -> Result<(), InputError> {
        let corners = words.map(|word| self.corner(place, word)).collect::<Result<Vec<_>, _>>()?;
        if corners.len() < 3 {
            let found = format!("{} corners", corners.len());
            return Err(place.fault("f", found.as_bytes(), "permitted: at least 3 corners").into());
        }
        for pair in corners[1..].windows(2) {
            self.faces.push(Face { corners: [corners[0], pair[0], pair[1]], material: self.material });
        }
        Ok(())
    }

    /// `position`, `position/texture`, `position//normal` or `position/texture/normal`; positions are counted from 1, or
    /// from the last one with -1.
    fn corner(&self, place: Place, word: &[u8]) -> Result<u32, InputError> {
        let position = word.split(|byte| *byte == b'/').next().unwrap_or_default();
        let index = std::str::from_utf8(position).ok().and_then(|text| text.parse::<i64>().ok());
        let count = self.positions.len() as i64;
        match index {
            Some(index) if (1..=count).contains(&index) => Ok((index - 1) as u32),
            Some(index) if (-count..=-1).contains(&index) => Ok((count + index) as u32),
            _ => {
                let permitted = format!("permitted: 1 to {count} or -{count} to -1, the positions so far");
                Err(place.fault("f corner", word, permitted).into())
            }
        }
    }
}
