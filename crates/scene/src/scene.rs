//! A scene: mesh, camera and lights; and its picture as screen-space triangles.

use crate::camera::Camera;
use crate::clip::{ClipVertex, Viewport, clip};
use crate::error::{Fault, InputError, nearest};
use crate::frame::{Frame, ShadeMode};
use crate::light::DirectionalLight;
use crate::mesh::{self, Mesh};
use crate::normals::{corner_normals, face_normals};
use crate::shade::diffuse;
use glam::DVec3;
use std::path::Path;

/// What is to be drawn, in world space.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The surfaces.
    pub mesh: Mesh,
    /// Largest angle between the normals of neighbouring faces that look like one surface, radians.
    pub crease: f64,
    /// Where it is seen from.
    pub camera: Camera,
    /// Intensity I_a of ambient light for red, green, blue (A 7.1).
    pub ambient: DVec3,
    /// The other lights.
    pub lights: Vec<DirectionalLight>,
    /// Colour where nothing is, [0, 1] each.
    pub background: DVec3,
}

impl Scene {
    /// The names of the built-in scenes.
    pub const BUILTIN: [&'static str; 5] = ["sphere", "torus", "torus-knot", "terrain", "room"];

    /// A built-in scene.
    ///
    /// # Errors
    /// No scene has this name.
    pub fn builtin(name: &str) -> Result<Self, InputError> {
        match name {
            "sphere" => Ok(Self::of_mesh(mesh::sphere(48, 24)?)),
            "torus" => Ok(Self::of_mesh(mesh::torus(64, 32)?)),
            "torus-knot" => Ok(Self::of_mesh(mesh::torus_knot(256, 24)?)),
            "terrain" => Ok(Self { camera: over_the_land(), ..Self::of_mesh(mesh::terrain(96)?) }),
            "room" => Ok(Self {
                camera: inside_the_room(),
                lights: vec![light([0.6, 0.6, 0.5], 0.5), light([-0.6, 0.6, 0.5], 0.5)],
                ..Self::of_mesh(mesh::room()?)
            }),
            _ => {
                let permitted = format!("permitted: {}", Self::BUILTIN.join(" "));
                let mut fault = Fault::new("built-in scenes", None, "name", name, permitted);
                fault.nearest = nearest(name, &Self::BUILTIN);
                Err(fault.into())
            }
        }
    }

    /// A built-in scene, or a mesh file (see [`Mesh::EXTENSIONS`]) in view: what is not a name of the former but ends
    /// like a file or is one.
    ///
    /// # Errors
    /// Neither a name nor a readable file, or a fault in the file.
    pub fn open(name: &str) -> Result<Self, InputError> {
        let path = Path::new(name);
        if !Self::BUILTIN.contains(&name) && (path.extension().is_some() || path.exists()) {
            return Ok(Self::of_mesh(Mesh::read(path)?));
        }
        Self::builtin(name)
    }

    /// A mesh in the middle of the picture, lit from above on the left.
    pub fn of_mesh(mesh: Mesh) -> Self {
        Self {
            camera: Camera::around(mesh.positions()),
            mesh,
            crease: 1.0,
            ambient: DVec3::splat(0.2),
            lights: vec![light([-0.45, 0.8, 0.75], 0.85)],
            background: DVec3::new(0.08, 0.09, 0.12),
        }
    }

    /// The triangles on a screen of `width` by `height` pixels, at most `guard` pixels from its corner in x and y, in
    /// the order of the mesh. Colours are those of the vertices by averaged normals, or in flat mode those of the faces
    /// by their own (A 7.4).
    pub fn frame(&self, width: u32, height: u32, guard: f64, mode: ShadeMode) -> Frame {
        let viewport = Viewport { width, height, guard };
        let to_clip = self.camera.to_clip(width, height);
        let positions: Vec<_> = self.mesh.positions().iter().map(|p| to_clip * p.extend(1.0)).collect();
        let own = face_normals(&self.mesh);
        let normals = match mode {
            ShadeMode::Gouraud => corner_normals(&self.mesh, &own, self.crease),
            ShadeMode::Flat => own.iter().map(|normal| [*normal; 3]).collect(),
        };
        let mut frame = Frame { mode, clear: self.background.to_array(), ..Frame::new(width, height) };
        for (face, normals) in self.mesh.faces().iter().zip(normals) {
            let material = &self.mesh.materials()[face.material as usize];
            let corner = |k: usize| ClipVertex {
                position: positions[face.corners[k] as usize],
                color: diffuse(material, normals[k], self.ambient, &self.lights),
            };
            clip([corner(0), corner(1), corner(2)], &viewport, &mut frame.triangles);
        }
        frame
    }
}

/// White light from a direction.
fn light(toward: [f64; 3], intensity: f64) -> DirectionalLight {
    DirectionalLight { toward: DVec3::from(toward).normalize(), intensity: DVec3::splat(intensity) }
}

/// Low over the land: its border is partly off the screen.
fn over_the_land() -> Camera {
    let eye = DVec3::new(0.15, 0.6, 1.35);
    Camera { eye, target: DVec3::new(0.0, -0.1, 0.1), up: DVec3::Y, angle: 0.9, near: 0.1, far: 4.0 }
}

/// Near one wall, looking at the opposite one: walls reach behind the camera.
fn inside_the_room() -> Camera {
    let eye = DVec3::new(0.35, 0.25, 0.95);
    Camera { eye, target: DVec3::new(-0.05, -0.35, -0.5), up: DVec3::Y, angle: 1.1, near: 0.05, far: 4.0 }
}
