//! Triangle meshes in world space: built in, or read from a file.

mod material;
mod face_data;
mod face;
mod bump;
mod surface;
mod knot;
mod terrain;
mod room;
mod mtl;
mod obj;
mod resource;
mod accessor;
mod pbr;
mod gltf;
mod join;
mod t_joints;

use crate::error::{Fault, InputError};
use crate::texture::Texture;
use edgewalk_nearest::nearest;
use glam::{DVec2, DVec3};
use std::collections::HashMap;
use std::path::Path;

pub use face_data::FaceData;
pub use material::Material;
pub use t_joints::TJoint;

pub(crate) use face::{MAX_CORNERS, triangles};
pub(crate) use join::Part;
pub(crate) use knot::torus_knot;
pub(crate) use room::room;
pub(crate) use surface::{sphere, torus};
pub(crate) use terrain::terrain;

/// Largest coordinate in a mesh file, either way.
pub(crate) const MAX_POSITION: f64 = 1e12;

/// Least size of a mesh compared with its distance from the origin: below it, rounding would be all that is
/// seen.
const LEAST_SIZE: f64 = 1e-9;

/// A triangle of a mesh; its front is where its corners run counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Face {
    /// Places in the list of positions.
    pub corners: [u32; 3],
    /// Place in the list of materials.
    pub material: u32,
}

/// A checked mesh: at least one face, every index valid, every coordinate within ±10^12, no position listed
/// twice.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    positions: Vec<DVec3>,
    faces: Vec<Face>,
    materials: Vec<Material>,
    face_data: Vec<FaceData>,
    textures: Vec<Texture>,
}

impl Mesh {
    /// The kinds of file that [`Mesh::read`] takes, by the ends of their names.
    pub const EXTENSIONS: [&'static str; 3] = ["obj", "gltf", "glb"];

    /// Checks the parts of a mesh that messages call `name`, and makes equal positions one.
    ///
    /// # Errors
    /// No face, an index beyond its list, a coordinate beyond ±10^12, or all positions practically in one
    /// place.
    pub fn new(
        name: &str,
        positions: Vec<DVec3>,
        mut faces: Vec<Face>,
        materials: Vec<Material>,
    ) -> Result<Self, InputError> {
        let fault =
            |key: &str, value: String, permitted: String| Fault::new(name, None, key, value, permitted);
        if faces.is_empty() {
            return Err(fault("faces", "0 triangles".into(), "permitted: at least one".into()).into());
        }
        // NaN is not below anything.
        let far = |position: &&DVec3| !position.to_array().iter().all(|c| c.abs() <= MAX_POSITION);
        if let Some(bad) = positions.iter().find(far) {
            let permitted = format!("permitted: numbers from -{MAX_POSITION} to {MAX_POSITION}");
            return Err(fault("position", bad.to_string(), permitted).into());
        }
        let beyond = |face: &Face| {
            let corner = face.corners.into_iter().find(|corner| *corner as usize >= positions.len());
            corner.map(|corner| ("corner", corner, positions.len())).or_else(|| {
                let known = (face.material as usize) < materials.len();
                (!known).then_some(("material", face.material, materials.len()))
            })
        };
        if let Some((key, index, count)) = faces.iter().find_map(beyond) {
            let permitted = match count {
                0 => "permitted: none, as the list is empty".to_owned(),
                _ => format!("permitted: an index from 0 to {}", count - 1),
            };
            return Err(fault(key, index.to_string(), permitted).into());
        }
        let mut welded = Vec::new();
        let mut places = HashMap::new();
        for corner in faces.iter_mut().flat_map(|face| &mut face.corners) {
            // Adding 0 makes a -0 a 0.
            let position = positions[*corner as usize] + DVec3::ZERO;
            *corner = *places.entry(position.to_array().map(f64::to_bits)).or_insert_with(|| {
                welded.push(position);
                (welded.len() - 1) as u32
            });
        }
        let face_data = vec![FaceData::default(); faces.len()];
        let mesh = Self { positions: welded, faces, materials, face_data, textures: Vec::new() };
        let [low, high] = mesh.bounds();
        let (size, reach) = ((high - low).max_element(), low.abs().max(high.abs()).max_element());
        if size < reach * LEAST_SIZE || size < f64::from(f32::MIN_POSITIVE) {
            let permitted = format!("permitted: at least {LEAST_SIZE} of the distance from the origin");
            return Err(fault("size", size.to_string(), permitted).into());
        }
        Ok(mesh)
    }

    /// Reads an OBJ or glTF file, by the end of its name.
    ///
    /// # Errors
    /// Another end of the name, a file that cannot be read, or a fault in it.
    pub fn read(path: &Path) -> Result<Self, InputError> {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match extension.as_str() {
            "obj" => obj::read(path),
            "gltf" | "glb" => gltf::read(path),
            _ => {
                let file = path.display().to_string();
                let permitted = format!("permitted: {}", Self::EXTENSIONS.join(" "));
                let mut fault = Fault::new(&file, None, "kind of mesh file", &extension, permitted);
                fault.nearest = nearest(&extension, Self::EXTENSIONS);
                Err(fault.into())
            }
        }
    }

    /// Corners of the faces; no two are equal.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The triangles.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// What the faces are made of.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Like `materials`, with what a file says of the faces beyond their corners: an entry a face, in their order;
    /// what is missing at the end is unsaid.
    pub fn with_face_data(mut self, mut face_data: Vec<FaceData>) -> Self {
        face_data.resize(self.faces.len(), FaceData::default());
        self.face_data = face_data;
        self
    }

    /// Like `with_face_data`, with the textures its materials name by their places in the list; one beyond it is no
    /// texture.
    pub fn with_textures(mut self, textures: Vec<Texture>) -> Self {
        self.textures = textures;
        self
    }

    /// What is said of each face beyond its corners.
    pub fn face_data(&self) -> &[FaceData] {
        &self.face_data
    }

    /// For each face the number of the polygon that it is a part of: files have faces of many corners, which are kept as
    /// triangles that follow each other.
    pub fn polygons(&self) -> Vec<u32> {
        let begins = self.face_data.iter().map(|data| u32::from(!data.continues));
        begins
            .scan(0, |number, begins| {
                *number += begins;
                Some(*number)
            })
            .collect()
    }

    /// The textures.
    pub fn textures(&self) -> &[Texture] {
        &self.textures
    }

    /// The material of a face, by its place, at texture coordinates: its texture multiplies k_d and k_a, its gloss
    /// k_s and n (end of chapter 7).
    pub fn material_at(&self, face: u32, texture: DVec2) -> Material {
        let material = self.materials[self.faces[face as usize].material as usize];
        let color = |place: Option<u32>| {
            let image = place.and_then(|place| self.textures.get(place as usize));
            image.map_or(DVec3::ONE, |image| image.at(texture))
        };
        let (surface, gloss) = (color(material.texture), color(material.gloss));
        Material {
            diffuse: material.diffuse * surface,
            ambient: material.ambient * surface,
            specular: material.specular * gloss,
            exponent: material.exponent * gloss.element_sum() / 3.0,
            ..material
        }
    }

    /// The corners of a face.
    pub fn corners(&self, face: &Face) -> [DVec3; 3] {
        face.corners.map(|corner| self.positions[corner as usize])
    }

    /// The least and the greatest coordinates.
    pub fn bounds(&self) -> [DVec3; 2] {
        let first = self.positions[0];
        self.positions.iter().fold([first; 2], |[low, high], p| [low.min(*p), high.max(*p)])
    }
}
