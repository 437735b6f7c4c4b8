//! `[[object]]`: a mesh file, a built-in mesh or faces listed in place; scaled, turned and put somewhere.

use super::material::Materials;
use super::table::Table;
use crate::error::InputError;
use crate::file;
use crate::mesh::{self, Face, FaceData, MAX_POSITION, Material, Mesh, Part};
use glam::{DAffine3, DQuat, DVec3, EulerRot};
use std::path::Path;

pub(super) const KEYS: &[&str] = &[
    "mesh",
    "builtin",
    "columns",
    "rows",
    "positions",
    "uv",
    "faces",
    "material",
    "scale",
    "rotate",
    "translate",
];

/// Largest texture coordinate, either way.
const MAX_TEXTURE: f64 = 1e6;

/// Keys of every object.
const COMMON: [&str; 4] = ["material", "scale", "rotate", "translate"];

/// Meshes without a file, and which keys say how fine each is.
const BUILTIN: [(&str, &[&str]); 5] = [
    ("sphere", &["columns", "rows"]),
    ("torus", &["columns", "rows"]),
    ("torus-knot", &["columns", "rows"]),
    ("terrain", &["columns"]),
    ("room", &[]),
];

pub(super) fn read(table: &Table, materials: &Materials, path: &Path) -> Result<Part, InputError> {
    let given = ["mesh", "builtin", "faces"].into_iter().filter(|key| table.has(key)).count();
    if given != 1 {
        let permitted = "permitted: exactly one of mesh, builtin, faces (with positions)";
        return Err(table.fault("mesh", format!("{given} of them"), permitted));
    }
    let only = |own: &[&str], such: &str| table.only(KEYS, &[own, &COMMON].concat(), such);
    let mesh = if let Some(name) = table.file("mesh")? {
        only(&["mesh"], "an object with mesh")?;
        let beside = path.with_file_name(name);
        // What a file names is no pipe.
        file::open(&beside).and_then(|_| Mesh::read(&beside)).map_err(|error| table.of_file("mesh", error))?
    } else if let Some(place) = table.choice("builtin", &BUILTIN.map(|(name, _)| name))? {
        let (name, fineness) = BUILTIN[place];
        only(&[&["builtin"], fineness].concat(), &format!("a {name}"))?;
        built_in(table, place)?
    } else {
        only(&["faces", "positions", "uv"], "an object with faces")?;
        listed(table)?
    };
    Ok(Part { mesh, placed: placed(table)?, material: materials.get(table, "material")? })
}

fn built_in(table: &Table, place: usize) -> Result<Mesh, InputError> {
    let (columns, rows) = [(48, 24), (64, 32), (256, 24), (96, 96), (1, 1)][place];
    let columns = table.count("columns", 3..=2048)?.unwrap_or(columns);
    let rows = table.count("rows", 3..=2048)?.unwrap_or(rows);
    match place {
        0 => mesh::sphere(columns, rows),
        1 => mesh::torus(columns, rows),
        2 => mesh::torus_knot(columns, rows),
        3 => mesh::terrain(columns),
        _ => mesh::room(),
    }
}

/// First scaled, then turned about the fixed z axis, then y, then x, then moved.
fn placed(table: &Table) -> Result<DAffine3, InputError> {
    let scale = table.factors("scale", 1e-6..=1e6)?.unwrap_or(DVec3::ONE);
    let [x, y, z] = table.vector("rotate", 360.0)?.unwrap_or(DVec3::ZERO).to_array().map(f64::to_radians);
    let turn = DQuat::from_euler(EulerRot::ZYXEx, z, y, x);
    let translate = table.vector("translate", MAX_POSITION)?.unwrap_or(DVec3::ZERO);
    Ok(DAffine3::from_scale_rotation_translation(scale, turn, translate))
}

/// Faces of three or more corners, cut into triangles.
fn listed(table: &Table) -> Result<Mesh, InputError> {
    let positions = table.vectors("positions", MAX_POSITION)?;
    let positions = table.required("positions", positions, "permitted: a list of [x, y, z]")?;
    let uv = table.pairs("uv", positions.len(), MAX_TEXTURE)?;
    let (mut faces, mut face_data) = (Vec::new(), Vec::new());
    for corners in table.indices("faces", positions.len())?.unwrap_or_default() {
        if !(3..=mesh::MAX_CORNERS).contains(&corners.len()) {
            let permitted =
                format!("permitted: 3 to {} places a face; cut it into smaller ones", mesh::MAX_CORNERS);
            return Err(table.fault("faces", format!("{} places", corners.len()), permitted));
        }
        let places: Vec<_> = corners.iter().map(|corner| positions[*corner as usize]).collect();
        for (number, part) in mesh::triangles(&places).into_iter().enumerate() {
            let corners = part.map(|k| corners[k]);
            faces.push(Face { corners, material: 0 });
            let texture = uv.as_ref().map(|uv| corners.map(|corner| uv[corner as usize]));
            face_data.push(FaceData { texture, continues: number > 0, ..FaceData::default() });
        }
    }
    if faces.is_empty() {
        return Err(table.fault("faces", "none", "permitted: at least one face"));
    }
    let mesh = Mesh::new("", positions, faces, vec![Material::DEFAULT]).map_err(|error| match error {
        // Where it stands is said by the table.
        InputError::Fault(fault) => table.fault(&fault.key, fault.value, fault.permitted),
        error => error,
    })?;
    Ok(mesh.with_face_data(face_data))
}
