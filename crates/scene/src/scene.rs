//! A scene: mesh, camera and lights; and its picture as screen-space triangles.

use crate::camera::Camera;
use crate::clip::{ClipVertex, Viewport, clip};
use crate::error::InputError;
use crate::frame::Frame;
use crate::kind::{BUILTIN, unknown};
use crate::light::Light;
use crate::mesh::{self, Mesh};
use crate::normals::{NormalRule, corner_normals, face_normals};
use crate::rules::ShadeMode;
use crate::shading::{Lighting, Point, Specular};
use crate::surface::{Surface, SurfaceTriangle};
use glam::{DVec2, DVec3};

/// What is to be drawn, in world space.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The surfaces.
    pub mesh: Mesh,
    /// Normals at the corners of its faces.
    pub normals: NormalRule,
    /// Where it is seen from.
    pub camera: Camera,
    /// Intensity I_a of ambient light for red, green, blue (ch. 7.1).
    pub ambient: DVec3,
    /// The other lights.
    pub lights: Vec<Light>,
    /// Form of the specular part.
    pub specular: Specular,
    /// Colour where nothing is, [0, 1] each.
    pub background: DVec3,
}

impl Scene {
    /// The names of the built-in scenes.
    pub const BUILTIN: [&'static str; 5] = BUILTIN;

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
            _ => Err(unknown(name)),
        }
    }

    /// A mesh in the middle of the picture, lit from above on the left.
    pub fn of_mesh(mesh: Mesh) -> Self {
        Self {
            camera: Camera::around(mesh.positions()),
            mesh,
            normals: NormalRule::default(),
            ambient: DVec3::splat(0.2),
            lights: vec![light([-0.45, 0.8, 0.75], 0.85)],
            specular: Specular::default(),
            background: DVec3::new(0.08, 0.09, 0.12),
        }
    }

    /// All its light.
    pub fn lighting(&self) -> Lighting<'_> {
        Lighting { ambient: self.ambient, lights: &self.lights, specular: self.specular }
    }

    /// A point of a surface as the viewer sees it; `normal` is a unit vector on the side that is seen.
    pub fn point(&self, position: DVec3, normal: DVec3) -> Point {
        Point { position, normal, viewer: (self.camera.eye - position).normalize_or_zero() }
    }

    /// The triangles on a screen of `width` by `height` pixels, at most `guard` pixels from its corner in x
    /// and y, in the order of the mesh. Normals are on the side that is seen; the colours of the vertices are
    /// those of the shading equation there (ch. 7.5, step 3 of the slides), taken before clipping.
    pub fn surface(&self, width: u32, height: u32, guard: f64) -> Surface {
        let viewport = Viewport { width, height, guard };
        let to_clip = self.camera.to_clip(width, height);
        let places: Vec<_> = self.mesh.positions().iter().map(|p| to_clip * p.extend(1.0)).collect();
        let own = face_normals(&self.mesh);
        let normals = corner_normals(&self.mesh, &own, self.normals);
        let mut triangles = Vec::with_capacity(self.mesh.faces().len());
        for (index, (face, place)) in self.mesh.faces().iter().zip(0..).enumerate() {
            let positions = self.mesh.corners(face);
            let seen_from_behind = own[index].dot(self.camera.eye - positions[0]) < 0.0;
            let side = if seen_from_behind { -1.0 } else { 1.0 };
            let texture = self.mesh.face_data()[index].texture.unwrap_or([DVec2::ZERO; 3]);
            let corner = |k: usize| {
                let (world, normal) = (positions[k], side * normals[index][k]);
                let material = self.mesh.material_at(place, texture[k]);
                let color = self.lighting().shade(&material, &self.point(world, normal));
                ClipVertex {
                    position: places[face.corners[k] as usize],
                    color: color.clamp(DVec3::ZERO, DVec3::ONE),
                    transmission: material.transmission,
                    world,
                    normal,
                    texture: texture[k],
                }
            };
            clip([corner(0), corner(1), corner(2)], &viewport, |vertices| {
                triangles.push(SurfaceTriangle { vertices, face: place, own_normal: side * own[index] });
            });
        }
        Surface { width, height, triangles }
    }

    /// The colour of constant shading (ch. 7.6) of a face with this normal on the side that is seen, by the
    /// light and the texture in its middle; not cut to [0, 1].
    pub fn constant_color(&self, face: u32, normal: DVec3) -> DVec3 {
        let [a, b, c] = self.mesh.corners(&self.mesh.faces()[face as usize]);
        let texture = self.mesh.face_data()[face as usize].texture;
        let texture = texture.map_or(DVec2::ZERO, |[a, b, c]| (a + b + c) / 3.0);
        self.lighting().constant(&self.mesh.material_at(face, texture), (a + b + c) / 3.0, normal)
    }

    /// The triangles of [`Scene::surface`] as the machine takes them: with the colours of the vertices, or in
    /// flat mode each in the colour of constant shading by its own normal.
    pub fn frame(&self, width: u32, height: u32, guard: f64, mode: ShadeMode) -> Frame {
        let surface = self.surface(width, height, guard);
        let mut frame = Frame { mode, clear: self.background.to_array(), ..Frame::new(width, height) };
        let on_screen = |triangle: &SurfaceTriangle| match mode {
            ShadeMode::Gouraud => triangle.on_screen(),
            ShadeMode::Flat => triangle.in_color(self.constant_color(triangle.face, triangle.own_normal)),
        };
        frame.triangles = surface.triangles.iter().map(on_screen).collect();
        frame
    }
}

/// White light from a direction.
fn light(toward: [f64; 3], intensity: f64) -> Light {
    Light::Directional { toward: DVec3::from(toward).normalize(), intensity: DVec3::splat(intensity) }
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
