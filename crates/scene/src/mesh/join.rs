//! Several meshes as one.

use super::{Face, FaceData, Material, Mesh};
use crate::error::InputError;
use crate::texture::Texture;
use glam::DAffine3;

/// A mesh in its place.
pub(crate) struct Part {
    pub mesh: Mesh,
    /// Transform from the part's space to world space; not singular.
    pub placed: DAffine3,
    /// Of all its faces, instead of its own materials.
    pub material: Option<Material>,
}

impl Mesh {
    /// The parts as one mesh that messages call `name`, in their order. `textures` are those of the materials that are
    /// given for whole parts; those of the parts' own materials follow them.
    ///
    /// # Errors
    /// As [`Mesh::new`].
    pub(crate) fn join(name: &str, parts: Vec<Part>, mut textures: Vec<Texture>) -> Result<Self, InputError> {
        let (mut positions, mut faces, mut materials) = (Vec::new(), Vec::new(), Vec::new());
        let mut face_data = Vec::new();
        for part in parts {
            let first = (positions.len() as u32, materials.len() as u32);
            positions.extend(part.mesh.positions.iter().map(|p| part.placed.transform_point3(*p)));
            let moved = |face: &Face| Face {
                corners: face.corners.map(|corner| first.0 + corner),
                material: first.1 + if part.material.is_some() { 0 } else { face.material },
            };
            faces.extend(part.mesh.faces.iter().map(moved));
            let normals = part.placed.matrix3.inverse().transpose();
            face_data.extend(part.mesh.face_data.iter().map(|data| FaceData {
                normals: data.normals.map(|of| of.map(|n| (normals * n).normalize_or_zero())),
                ..*data
            }));
            match part.material {
                Some(material) => materials.push(material),
                None => {
                    let first = textures.len() as u32;
                    let shifted = |place: Option<u32>| place.map(|place| first + place);
                    materials.extend(part.mesh.materials.iter().map(|material| Material {
                        texture: shifted(material.texture),
                        gloss: shifted(material.gloss),
                        bump: shifted(material.bump),
                        ..*material
                    }));
                    textures.extend(part.mesh.textures);
                }
            }
        }
        Ok(Self::new(name, positions, faces, materials)?.with_face_data(face_data).with_textures(textures))
    }
}
