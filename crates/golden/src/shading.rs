//! The shading systems of ch. 7.4 to 7.6, each beside the truth, so that its error is a number and a picture.
//!
//! ```text
//!  scene --> surface --> colours of the vertices --> draw --> id of the triangle seen at each pixel
//!                                                      |                 |
//!                            constant, Gouraud: rgb <--+                 +--> Phong: N, position, u v by addition,
//!                                                                        |           the equation at each pixel
//!                                                                        +--> truth: the same, perspective-correct
//! ```
//! The truth is the full equation with the normal that interpolates the vertex normals over the surface in the world:
//! what Phong shading approximates over the screen.

use crate::fragment::Fragment;
use crate::picture::Picture;
use crate::transparency::is_transparent;
use crate::weights::Weights;
use edgewalk_scene::{Blending, Frame, Scene, ShadeMode, Surface, SurfaceTriangle, SurfaceVertex};
use glam::{DVec2, DVec3};

/// Shading method: the way to the colour of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Shading {
    /// One colour a polygon, by its own normal (ch. 7.6).
    Constant,
    /// One colour a polygon, by the average of its vertex normals (ch. 7.6).
    ConstantAveraged,
    /// Colours of the vertices, linear over the screen (ch. 7.8).
    Gouraud,
    /// Normal and world position linear over the screen, the equation at each pixel (ch. 7.11, 7.12).
    Phong,
}

/// A picture, and what it should be.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaded {
    /// By the system; colours are cut to [0, 1].
    pub picture: Picture,
    /// The colours of the truth, cut to [0, 1]; where no triangle is, those of the picture.
    pub truth: Vec<[f64; 3]>,
}

/// The triangles with the colours that constant and Gouraud shading give them; for Phong those of Gouraud, of which only
/// the depths count.
pub fn frame(scene: &Scene, surface: &Surface, shading: Shading) -> Frame {
    let one_color =
        |triangle: &SurfaceTriangle, normal| triangle.in_color(scene.constant_color(triangle.face, normal));
    let on_screen = |triangle: &SurfaceTriangle| match shading {
        Shading::Constant => one_color(triangle, triangle.own_normal),
        Shading::ConstantAveraged => one_color(triangle, triangle.averaged_normal()),
        Shading::Gouraud | Shading::Phong => triangle.on_screen(),
    };
    let mode = match shading {
        Shading::Constant | Shading::ConstantAveraged => ShadeMode::Flat,
        Shading::Gouraud | Shading::Phong => ShadeMode::Gouraud,
    };
    let triangles: Vec<_> = surface.triangles.iter().map(on_screen).collect();
    Frame {
        mode,
        clear: scene.background.to_array(),
        blend: if triangles.iter().any(is_transparent) { Blending::Mix } else { Blending::Off },
        triangles,
        ..Frame::new(surface.width, surface.height)
    }
}

/// What the equation needs at a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Attributes {
    pub(crate) normal: DVec3,
    pub(crate) position: DVec3,
    pub(crate) texture: DVec2,
}

/// The attributes in a row, as eight adders have them.
pub(crate) fn packed(vertex: SurfaceVertex) -> [f64; 8] {
    let SurfaceVertex { normal: n, position: p, texture: t, .. } = vertex;
    [n.x, n.y, n.z, p.x, p.y, p.z, t.x, t.y]
}

impl Attributes {
    pub(crate) fn unpacked(&[nx, ny, nz, px, py, pz, u, v]: &[f64; 8]) -> Self {
        Self { normal: DVec3::new(nx, ny, nz), position: DVec3::new(px, py, pz), texture: DVec2::new(u, v) }
    }
}

/// The attributes where the ray through the pixel meets the triangle.
pub(crate) fn on_surface(fragment: &Fragment, triangle: &SurfaceTriangle) -> Attributes {
    let weights = Weights::perspective(fragment, triangle);
    Attributes {
        normal: weights.of(triangle.vertices.map(|vertex| vertex.normal)),
        position: weights.of(triangle.vertices.map(|vertex| vertex.position)),
        texture: weights.of(triangle.vertices.map(|vertex| vertex.texture)),
    }
}

/// The full equation (ch. 7.12) at a pixel, the normal brought back to length 1 and turned by the relief, if there is one;
/// `r` holds r_l of each light.
pub(crate) fn color(scene: &Scene, triangle: &SurfaceTriangle, at: &Attributes, r: &[f64]) -> [f64; 3] {
    let material = scene.mesh.material_at(triangle.face, at.texture);
    let smooth = at.normal.normalize_or_zero();
    let normal = scene.mesh.bumped_normal(triangle.face, at.texture, smooth);
    let point = scene.point(at.position, normal);
    let sum = scene.lighting().terms(&material, &point).total(|l| r[l]);
    sum.clamp(DVec3::ZERO, DVec3::ONE).to_array()
}

/// How far a picture is from the truth, in LSB of 8 bits; at each pixel that of its worst colour.
#[derive(Debug, Clone, PartialEq)]
pub struct ShadingError {
    /// Pixels that show a triangle: only they are compared.
    pub pixels: u64,
    /// Largest of them.
    pub max: f64,
    /// Mean over them.
    pub mean: f64,
    /// Of every pixel, 0 where no triangle is.
    pub map: Vec<f64>,
}

impl Shaded {
    /// The error of the system.
    pub fn error(&self) -> ShadingError {
        let worst = |(a, b): (&[f64; 3], &[f64; 3])| {
            255.0 * (0..3).map(|channel| (a[channel] - b[channel]).abs()).fold(0.0, f64::max)
        };
        let map: Vec<f64> = self.picture.rgb.iter().zip(&self.truth).map(worst).collect();
        let pixels = self.picture.id.iter().filter(|id| **id >= 0).count() as u64;
        let max = map.iter().copied().fold(0.0, f64::max);
        let mean = if pixels == 0 { 0.0 } else { map.iter().sum::<f64>() / pixels as f64 };
        ShadingError { pixels, max, mean, map }
    }
}
