//! Scene files: TOML that says what is drawn, from where, in which light.
//!
//! ```toml
//! ambient = 0.2                  # I_a, a number or [r, g, b]
//! background = [0.08, 0.09, 0.12]
//! specular = "mirror"            # mirror halfway blinn
//!
//! [camera]                       # without it, all is in view
//! eye = [0, 1, 4]
//! target = [0, 0, 0]
//!
//! [[material]]
//! name = "brass"
//! diffuse = [0.7, 0.5, 0.2]
//! specular = 0.6
//! exponent = 40
//!
//! [[object]]
//! mesh = "models/teapot.obj"     # beside this file
//! material = "brass"             # instead of the mesh's own
//! rotate = [0, 30, 0]
//!
//! [[light]]
//! kind = "directional"
//! toward = [-1, 2, 2]
//! intensity = 0.8
//! ```
//! Every key with its range and default: docs/scene_file.md.

mod table;
mod camera;
mod light;
mod material;
mod object;

use crate::camera::Camera;
use crate::error::{Fault, InputError};
use crate::file;
use crate::kind::{self, InputKind};
use crate::mesh::Mesh;
use crate::normals::{Crease, NormalRule, Weight};
use crate::scene::Scene;
use crate::shading::Specular;
use material::Materials;
use std::path::Path;
use table::{Source, Table};
use toml::de::DeTable;

/// Bytes of the longest scene file; meshes are in files of their own.
const MAX_LENGTH: u64 = 16 << 20;

impl Scene {
    /// A built-in scene, a scene file (`.toml`), or a mesh file (see [`Mesh::EXTENSIONS`]) in view.
    ///
    /// # Errors
    /// A name that says none of these, a file that cannot be read, or a fault in it.
    pub fn open(name: &str) -> Result<Self, InputError> {
        let path = Path::new(name);
        match InputKind::of(name) {
            Some(InputKind::Scene) if Self::BUILTIN.contains(&name) => Self::builtin(name),
            Some(InputKind::Scene) => read(path),
            Some(InputKind::Mesh) => Ok(Self::of_mesh(Mesh::read(path)?)),
            Some(InputKind::Triangles) | None => Err(kind::unknown(name)),
        }
    }

    /// The scene that the text of a scene file says; `path` is where it would stand, for messages and for the files that
    /// it names.
    ///
    /// # Errors
    /// A fault in the text or in a file that it names.
    pub fn parse(path: &Path, text: &str) -> Result<Self, InputError> {
        parse(path, text)
    }
}

/// Reads a scene file and the meshes and pictures it names, by their places beside it.
///
/// # Errors
/// A file that cannot be read or is no TOML, a key that there is not, a value that is not permitted, a fault in a mesh.
pub(crate) fn read(path: &Path) -> Result<Scene, InputError> {
    let bytes = file::read(path, MAX_LENGTH)?;
    let text = std::str::from_utf8(&bytes).map_err(|error| {
        let line = bytes[..error.valid_up_to()].iter().filter(|byte| **byte == b'\n').count() + 1;
        let file = path.display().to_string();
        Fault::new(&file, Some(line), "text", "bytes that are no UTF-8", "permitted: TOML in UTF-8")
    })?;
    parse(path, text)
}

/// The same from a text that stands for the file at `path`.
///
/// # Errors
/// As [`read`].
pub(crate) fn parse(path: &Path, text: &str) -> Result<Scene, InputError> {
    let file = path.display().to_string();
    let source = Source { file: &file, text };
    let entries = DeTable::parse(text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        source.fault(
            start,
            "TOML",
            error.message().replace('\n', " "),
            "permitted: key = value and [section]",
        )
    })?;
    const KEYS: &[&str] =
        &["ambient", "background", "specular", "camera", "normals", "material", "object", "light"];
    scene(&Table::new(source, String::new(), 0, entries.get_ref(), KEYS)?, path)
}

fn scene(table: &Table, path: &Path) -> Result<Scene, InputError> {
    let materials = Materials::read(table, path)?;
    let mut parts = Vec::new();
    for object in table.tables("object", object::KEYS)? {
        parts.push(object::read(&object, &materials, path)?);
    }
    if parts.is_empty() {
        return Err(table.fault("object", "none", "permitted: at least one [[object]]"));
    }
    let mesh = Mesh::join(&path.display().to_string(), parts, materials.textures)?;
    let scene = Scene::of_mesh(mesh);
    let around = Camera::around(scene.mesh.positions());
    let camera = match table.table("camera", camera::KEYS)? {
        Some(camera) => camera::read(&camera, around)?,
        None => around,
    };
    let lights = table.tables("light", light::KEYS)?;
    let lights = match &lights[..] {
        [] => scene.lights.clone(),
        lights => lights.iter().map(light::read).collect::<Result<_, _>>()?,
    };
    Ok(Scene {
        camera,
        lights,
        normals: match table.table("normals", &["given", "weight", "crease"])? {
            Some(normals) => normal_rule(&normals)?,
            None => scene.normals,
        },
        ambient: table.color("ambient", 1e6)?.unwrap_or(scene.ambient),
        background: table.color("background", 1.0)?.unwrap_or(scene.background),
        specular: table
            .choice("specular", &Specular::NAMES)?
            .map_or(scene.specular, |place| Specular::ALL[place]),
        ..scene
    })
}

fn normal_rule(table: &Table) -> Result<NormalRule, InputError> {
    let default = NormalRule::default();
    let weight = table.choice("weight", &Weight::NAMES)?.map_or(default.weight, |place| Weight::ALL[place]);
    let crease = match table.number_or("crease", 0.0..=180.0, "groups")? {
        Some(Some(degrees)) => Crease::Angle(degrees.to_radians()),
        Some(None) => Crease::Groups,
        None => default.crease,
    };
    Ok(NormalRule { given: table.flag("given")?.unwrap_or(default.given), weight, crease })
}
