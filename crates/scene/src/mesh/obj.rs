//! Wavefront OBJ.
//!
//! Taken: positions, polygons (cut into triangles), texture coordinates, normals, smoothing groups and
//! materials. Objects and groups become one mesh. A line that ends in a backslash goes on in the next one. Of a material library that is not there, every material is the default.
//! Read by hand, as every fault must name its line and value.

use super::mtl::{self, Library};
use super::{Face, FaceData, MAX_CORNERS, MAX_POSITION, Material, Mesh, triangles};
use crate::error::InputError;
use crate::file;
use crate::text::{Place, each_line, rest, words};
use glam::{DVec2, DVec3};
use std::io::BufReader;
use std::path::Path;

pub(super) fn read(path: &Path) -> Result<Mesh, InputError> {
    let name = path.display().to_string();
    let opened = file::open_input(path)?;
    let mut obj = Obj { materials: vec![Material::DEFAULT], ..Obj::default() };
    each_line(&name, BufReader::new(opened), |place, line| obj.line(path, place, line))?;
    let mesh = Mesh::new(&name, obj.positions, obj.faces, obj.materials)?;
    Ok(mesh.with_face_data(obj.face_data).with_textures(obj.library.textures))
}

#[derive(Default)]
struct Obj {
    positions: Vec<DVec3>,
    texture: Vec<DVec2>,
    /// Unit vectors; zero where the file gives none that has a direction.
    normals: Vec<DVec3>,
    faces: Vec<Face>,
    /// Of each face.
    face_data: Vec<FaceData>,
    /// The first is the default, the others as they were called for.
    materials: Vec<Material>,
    library: Library,
    /// Of the faces to come.
    material: u32,
    /// Of the faces to come.
    group: u32,
}

/// Places in the lists of positions, texture coordinates and normals.
struct Corner {
    position: u32,
    texture: Option<u32>,
    normal: Option<u32>,
}

impl Obj {
    fn line(&mut self, path: &Path, place: Place, line: &[u8]) -> Result<(), InputError> {
        let mut words = words(line);
        match words.next() {
            Some(b"v") => {
                let keys = ["v x", "v y", "v z"];
                self.positions.push(numbers(place, keys, words, MAX_POSITION)?.into());
                Ok(())
            }
            Some(b"vt") => {
                // A picture of one dimension has no v.
                let words = words.chain([&b"0"[..]]);
                self.texture.push(numbers(place, ["vt u", "vt v"], words, MAX_TEXTURE)?.into());
                Ok(())
            }
            Some(b"vn") => {
                let normal = numbers(place, ["vn x", "vn y", "vn z"], words, MAX_POSITION)?;
                self.normals.push(DVec3::from(normal).normalize_or_zero());
                Ok(())
            }
            Some(b"f") => self.polygon(place, words),
            Some(b"s") => {
                self.group = match words.next() {
                    Some(b"off") => 0,
                    word => {
                        place.number("s", word.unwrap_or_default(), "`off` or an integer", 0..=u32::MAX)?
                    }
                };
                Ok(())
            }
            Some(b"mtllib") => {
                let name = rest(line);
                if name.is_empty() {
                    return Err(place.fault("mtllib", b"", "permitted: the name of a file").into());
                }
                let library = path.with_file_name(name);
                match file::open_if_there(&library)? {
                    Some(opened) => mtl::read(&library, BufReader::new(opened), &mut self.library),
                    None => Ok(()), // its materials stay the default
                }
            }
            Some(b"usemtl") => {
                let material = self.library.materials.get(&rest(line)).copied();
                self.material = self.materials.len() as u32;
                self.materials.push(material.unwrap_or(Material::DEFAULT));
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn polygon<'a>(&mut self, place: Place, words: impl Iterator<Item = &'a [u8]>) -> Result<(), InputError> {
        let corners = words.map(|word| self.corner(place, word)).collect::<Result<Vec<_>, _>>()?;
        if !(3..=MAX_CORNERS).contains(&corners.len()) {
            let found = format!("{} corners", corners.len());
            let permitted = format!("permitted: 3 to {MAX_CORNERS} corners; cut the face into smaller ones");
            return Err(place.fault("f", found.as_bytes(), permitted).into());
        }
        let positions: Vec<_> = corners.iter().map(|c| self.positions[c.position as usize]).collect();
        for (number, part) in triangles(&positions).into_iter().enumerate() {
            let corners = part.map(|k| &corners[k]);
            self.faces.push(Face { corners: corners.map(|corner| corner.position), material: self.material });
            let texture = corners.map(|corner| corner.texture.map(|place| self.texture[place as usize]));
            let normals = corners.map(|corner| corner.normal.map(|place| self.normals[place as usize]));
            self.face_data.push(FaceData {
                texture: all(texture),
                normals: all(normals).filter(|normals| !normals.contains(&DVec3::ZERO)),
                group: self.group,
                continues: number > 0,
            });
        }
        Ok(())
    }

    /// `position`, `position/texture`, `position//normal` or `position/texture/normal`.
    fn corner(&self, place: Place, word: &[u8]) -> Result<Corner, InputError> {
        let mut parts = word.split(|byte| *byte == b'/');
        let position = parts.next().unwrap_or_default();
        let mut optional = |what: &str, count: usize| match parts.next() {
            None | Some(b"") => Ok(None),
            Some(part) => index(place, word, part, what, count).map(Some),
        };
        let texture = optional("texture coordinates", self.texture.len())?;
        let normal = optional("normals", self.normals.len())?;
        Ok(Corner {
            position: index(place, word, position, "positions", self.positions.len())?,
            texture,
            normal,
        })
    }
}

/// Largest texture coordinate, either way.
const MAX_TEXTURE: f64 = 1e6;

/// Counted from 1, or from the last one with -1.
fn index(place: Place, word: &[u8], part: &[u8], what: &str, count: usize) -> Result<u32, InputError> {
    let index = std::str::from_utf8(part).ok().and_then(|text| text.parse::<i64>().ok());
    let count = count as i64;
    match index {
        Some(index) if (1..=count).contains(&index) => Ok((index - 1) as u32),
        Some(index) if (-count..=-1).contains(&index) => Ok((count + index) as u32),
        _ => {
            let permitted = match count {
                0 => format!("permitted: none, as no {what} come before this line"),
                _ => format!("permitted: 1 to {count} or -{count} to -1, the {what} so far"),
            };
            Err(place.fault("f corner", word, permitted).into())
        }
    }
}

/// Exactly N numbers, each at most `max` either way; what follows is passed over.
fn numbers<'a, const N: usize>(
    place: Place,
    keys: [&str; N],
    mut words: impl Iterator<Item = &'a [u8]>,
    max: f64,
) -> Result<[f64; N], InputError> {
    let mut numbers = [0.0; N];
    for (key, number) in keys.into_iter().zip(&mut numbers) {
        *number = place.number(key, words.next().unwrap_or_default(), "a number", -max..=max)?;
    }
    Ok(numbers)
}

/// All three, or none.
fn all<T: Copy>(corners: [Option<T>; 3]) -> Option<[T; 3]> {
    match corners {
        [Some(a), Some(b), Some(c)] => Some([a, b, c]),
        _ => None,
    }
}
