//! glTF 2.0, as text with buffers or in one binary file.
//!
//! Taken: the default scene's triangles (lists, strips, fans) with the transformations of their nodes, normals, the
//! texture coordinates that the material asks for, and materials (see [`pbr`](super::pbr)). Sparse and compressed
//! accessors are refused. Colours of vertices, skins, morph targets, cameras and lights are passed over.

use super::accessor::{Refusal, indices, places, vectors};
use super::pbr::Materials;
use super::resource::{MAX_BYTES, buffers};
use super::{Face, FaceData, Mesh};
use crate::error::{Fault, InputError};
use crate::file;
use glam::{DMat3, DMat4, DVec2, DVec3, Mat4};
use gltf::json::Root;
use gltf::mesh::Mode;
use gltf::{Accessor, Document, Error, Gltf, Node, Primitive, Semantic};
use std::path::Path;

pub(super) fn read(path: &Path) -> Result<Mesh, InputError> {
    let file = path.display().to_string();
    let bytes = file::read(path, MAX_BYTES)?;
    let Gltf { document, blob } =
        Gltf::from_slice_without_validation(&bytes).map_err(|error| refused(&file, &error))?;
    let root = document.as_json();
    version(&file, root)?;
    attributes_exist(&file, root)?;
    let document = Document::from_json(document.into_json()).map_err(|error| refused(&file, &error))?;
    let buffers = buffers(path, &document, blob.as_deref())?;
    let mut build = Build {
        file: &file,
        buffers: &buffers,
        positions: vec![],
        faces: vec![],
        face_data: vec![],
        materials: Materials::new(path, &document, &buffers),
    };
    let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) else {
        return Err(Fault::new(&file, None, "scenes", "none", "permitted: at least one scene").into());
    };
    let mut placed = vec![false; document.nodes().count()];
    let mut waiting: Vec<(Node, DMat4)> = scene.nodes().map(|node| (node, DMat4::IDENTITY)).collect();
    while let Some((node, parent)) = waiting.pop() {
        if std::mem::replace(&mut placed[node.index()], true) {
            let key = format!("node {}", node.index());
            return Err(Fault::new(&file, None, key, "two parents", "permitted: a tree of nodes").into());
        }
        let to_world = parent * Mat4::from_cols_array_2d(&node.transform().matrix()).as_dmat4();
        for (index, primitive) in node.mesh().iter().flat_map(|mesh| mesh.primitives().enumerate()) {
            let key = format!("node {} primitive {index}", node.index());
            build.primitive(&key, &primitive, &to_world)?;
        }
        waiting.extend(node.children().map(|child| (child, to_world)));
    }
    let mesh = Mesh::new(&file, build.positions, build.faces, build.materials.list)?;
    Ok(mesh.with_face_data(build.face_data).with_textures(build.materials.textures))
}

/// The file is of version 2, and asks for no more than 2.0.
fn version(file: &str, root: &Root) -> Result<(), InputError> {
    let asset = &root.asset;
    let major = asset.version.split('.').next();
    let (key, value) = match &asset.min_version {
        Some(least) if least != "2.0" => ("asset.minVersion", least),
        _ if major != Some("2") => ("asset.version", &asset.version),
        _ => return Ok(()),
    };
    let permitted = "permitted: 2.0; export the mesh as glTF 2.0";
    Err(Fault::new(file, None, key, value, permitted).into())
}

/// The format's own validation takes the accessors of attributes for granted.
fn attributes_exist(file: &str, root: &Root) -> Result<(), InputError> {
    let count = root.accessors.len();
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    match primitives.flat_map(|primitive| primitive.attributes.values()).find(|index| index.value() >= count)
    {
        Some(index) => {
            let permitted = match count {
                0 => "permitted: none, as the file has no accessor".to_owned(),
                _ => format!("permitted: an accessor from 0 to {}", count - 1),
            };
            Err(Fault::new(file, None, "attribute of a primitive", index.value(), permitted).into())
        }
        None => Ok(()),
    }
}

/// What the reader of the format says.
fn refused(file: &str, error: &Error) -> InputError {
    let (line, key, value) = match error {
        Error::Deserialize(json) => (Some(json.line()), "JSON", json.to_string()),
        Error::Validation(faults) => match faults.first() {
            Some((path, fault)) => (None, path.as_str(), fault.to_string()),
            None => (None, "glTF", error.to_string()),
        },
        _ => (None, "glTF", error.to_string()),
    };
    Fault::new(file, line, key, value, "permitted: glTF 2.0").into()
}

struct Build<'a> {
    file: &'a str,
    buffers: &'a [Vec<u8>],
    positions: Vec<DVec3>,
    faces: Vec<Face>,
    face_data: Vec<FaceData>,
    materials: Materials<'a>,
}

impl Build<'_> {
    fn primitive(&mut self, key: &str, primitive: &Primitive, to_world: &DMat4) -> Result<(), InputError> {
        let fault =
            |key: &str, value: String, permitted: &str| Fault::new(self.file, None, key, value, permitted);
        let mode = primitive.mode();
        let surface = matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan);
        // Points and lines have no surface; that there are positions has been validated.
        let Some(accessor) = primitive.get(&Semantic::Positions).filter(|_| surface) else {
            return Ok(());
        };
        let corners = vectors(&accessor, self.buffers)
            .map_err(|refusal| fault(&format!("{key} POSITION"), refusal.value, refusal.permitted))?;
        let normals = self.optional(key, primitive, &Semantic::Normals, corners.len(), vectors)?;
        let set = self.materials.coordinates(&primitive.material())?;
        let texture = self.optional(key, primitive, &Semantic::TexCoords(set), corners.len(), places)?;
        if set > 0 && texture.is_empty() {
            let permitted = "permitted: a set of texture coordinates that the primitive has";
            return Err(fault(&format!("{key} texCoord"), set.to_string(), permitted).into());
        }
        let order = match primitive.indices() {
            Some(accessor) => indices(&accessor, self.buffers)
                .map_err(|refusal| fault(&format!("{key} indices"), refusal.value, refusal.permitted))?,
            None => (0..corners.len() as u32).collect(),
        };
        if let Some(bad) = order.iter().find(|index| **index as usize >= corners.len()) {
            let permitted = format!("permitted: an index below {}", corners.len());
            return Err(fault(&format!("{key} indices"), bad.to_string(), &permitted).into());
        }
        if mode == Mode::Triangles && order.len() % 3 != 0 {
            let found = format!("{} corners", order.len());
            return Err(fault(key, found, "permitted: three for each triangle").into());
        }
        let (first, material) = (self.positions.len() as u32, self.materials.place(&primitive.material())?);
        // A mirror turns the front to the back.
        let mirrored = to_world.determinant() < 0.0;
        // Normals stay at right angles to the surface.
        let to_normal = DMat3::from_mat4(*to_world).inverse().transpose();
        let normal = |corner: u32| Some((to_normal * *normals.get(corner as usize)?).normalize_or_zero());
        for [a, b, c] in triangles(mode, &order) {
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            self.faces.push(Face { corners: corners.map(|corner| first + corner), material });
            let normals = corners.map(|corner| normal(corner).unwrap_or_default());
            let texture =
                corners.map(|corner| texture.get(corner as usize).filter(|place| place.is_finite()));
            self.face_data.push(FaceData {
                // A normal without direction is none.
                normals: (!normals.contains(&DVec3::ZERO)).then_some(normals),
                texture: match texture {
                    [Some(a), Some(b), Some(c)] => {
                        Some([a, b, c].map(|place| DVec2::new(place.x, 1.0 - place.y)))
                    }
                    _ => None,
                },
                ..FaceData::default()
            });
        }
        self.positions.extend(corners.iter().map(|corner| to_world.transform_point3(*corner)));
        Ok(())
    }

    /// An attribute of each of `count` vertices; none if the primitive lacks it.
    fn optional<T>(
        &self,
        key: &str,
        primitive: &Primitive,
        semantic: &Semantic,
        count: usize,
        read: impl Fn(&Accessor, &[Vec<u8>]) -> Result<Vec<T>, Refusal>,
    ) -> Result<Vec<T>, InputError> {
        let Some(accessor) = primitive.get(semantic) else { return Ok(Vec::new()) };
        let fault = |value: String, permitted: &str| {
            Fault::new(self.file, None, format!("{key} {}", semantic.to_string()), value, permitted)
        };
        match read(&accessor, self.buffers) {
            Ok(values) if values.len() == count => Ok(values),
            Ok(values) => {
                let permitted = format!("permitted: {count}, one for each position");
                Err(fault(values.len().to_string(), &permitted).into())
            }
            Err(refusal) => Err(fault(refusal.value, refusal.permitted).into()),
        }
    }
}

/// The triangles of a list, strip or fan, all with their fronts the same way.
fn triangles(mode: Mode, order: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let count = if mode == Mode::Triangles { order.len() / 3 } else { order.len().saturating_sub(2) };
    (0..count).map(move |k| match mode {
        Mode::TriangleStrip if k % 2 == 1 => [order[k + 1], order[k], order[k + 2]],
        Mode::TriangleStrip => [order[k], order[k + 1], order[k + 2]],
        Mode::TriangleFan => [order[0], order[k + 1], order[k + 2]],
        _ => [order[3 * k], order[3 * k + 1], order[3 * k + 2]],
    })
}
