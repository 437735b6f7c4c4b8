//! glTF 2.0, as text with buffers or in one binary file.
//!
//! Taken: the default scene's triangles (lists, strips, fans) with the transformations of their nodes, base colours.
//! Sparse and compressed accessors are refused.

use super::accessor::{indices, positions};
use super::{Face, Material, Mesh};
use crate::error::{Fault, InputError};
use glam::{DMat4, DVec3, Mat4};
use gltf::buffer::Data;
use gltf::json::Root;
use gltf::mesh::Mode;
use gltf::{Document, Error, Gltf, Node, Primitive};
use std::path::Path;

pub(super) fn read(path: &Path) -> Result<Mesh, InputError> {
    let file = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|source| InputError::Read { file: file.clone(), source })?;
    let Gltf { document, blob } =
        Gltf::from_slice_without_validation(&bytes).map_err(|error| refused(&file, &error))?;
    attributes_exist(&file, document.as_json())?;
    let document = Document::from_json(document.into_json()).map_err(|error| refused(&file, &error))?;
    let buffers =
        gltf::import_buffers(&document, path.parent(), blob).map_err(|error| refused(&file, &error))?;
    let mut build =
        Build { file: &file, buffers: &buffers, positions: vec![], faces: vec![], materials: vec![] };
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
    Mesh::new(&file, build.positions, build.faces, build.materials)
}

/// The format's own validation takes the accessors of attributes for granted.
fn attributes_exist(file: &str, root: &Root) -> Result<(), InputError> {
    let count = root.accessors.len();
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    match primitives.flat_map(|primitive| primitive.attributes.values()).find(|index| index.value() >= count)
    {
        Some(index) => {
            let permitted = format!("permitted: an accessor below {count}");
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
    Fault::new(file, line, key, value, "permitted: glTF 2.0 with all its buffers").into()
}

struct Build<'a> {
    file: &'a str,
    buffers: &'a [Data],
    positions: Vec<DVec3>,
    faces: Vec<Face>,
    materials: Vec<Material>,
}

impl Build<'_> {
    fn primitive(&mut self, key: &str, primitive: &Primitive, to_world: &DMat4) -> Result<(), InputError> {
        let fault =
            |key: &str, value: String, permitted: &str| Fault::new(self.file, None, key, value, permitted);
        let mode = primitive.mode();
        let surface = matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan);
        // Points and lines have no surface; that there are positions has been validated.
        let Some(accessor) = primitive.get(&gltf::Semantic::Positions).filter(|_| surface) else {
            return Ok(());
        };
        let corners = positions(&accessor, self.buffers)
            .map_err(|refusal| fault(&format!("{key} POSITION"), refusal.value, refusal.permitted))?;
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
        let [r, g, b, _] = primitive.material().pbr_metallic_roughness().base_color_factor();
        let diffuse = DVec3::new(r.into(), g.into(), b.into()).clamp(DVec3::ZERO, DVec3::ONE);
        let (first, material) = (self.positions.len() as u32, self.materials.len() as u32);
        self.materials.push(Material::matte(diffuse));
        // A mirror turns the front to the back.
        let mirrored = to_world.determinant() < 0.0;
        self.faces.extend(triangles(mode, &order).map(|[a, b, c]| {
            let [a, b, c] = if mirrored { [a, c, b] } else { [a, b, c] };
            Face { corners: [first + a, first + b, first + c], material }
        }));
        self.positions.extend(corners.iter().map(|corner| to_world.transform_point3(*corner)));
        Ok(())
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
