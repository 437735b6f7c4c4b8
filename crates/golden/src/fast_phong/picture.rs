//! A scene by fast Phong, beside the Phong shading that it approximates and beside the truth.

use crate::cover::fragments;
use crate::fast_phong::table::PowerTable;
use crate::fast_phong::triangle::{Directional, FastPhong, Fit};
use crate::fill::Fill;
use crate::incremental::Incremental;
use crate::render::shade as shade_by;
use crate::shading::{Shaded, Shading, ShadingError};
use crate::weights::Weights;
use edgewalk_scene::{Scene, ShadeMode, Surface};
use glam::{DVec2, DVec3};

/// What fast Phong may choose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// Where the quadratics come from.
    pub fit: Fit,
    /// Entries of the table of powers.
    pub table_size: usize,
    /// Vertices are snapped to this many sub-pixel bits, 0..=8; the fill is the exact one.
    pub subpixel_bits: u32,
}

/// A picture by fast Phong, and what it stands for.
#[derive(Debug, Clone, PartialEq)]
pub struct FastShaded {
    /// Beside the truth, which is perspective-correct and has the scene's own form of highlights.
    pub shaded: Shaded,
    /// The colours of Phong shading (ch. 7.12), N and the world position linear over the screen; with highlights of the
    /// form that the table has.
    pub phong: Vec<[f64; 3]>,
}

impl FastShaded {
    /// How far it is from Phong shading: the quadratics, the table, and how H is taken.
    pub fn error_to_phong(&self) -> ShadingError {
        Shaded { picture: self.shaded.picture.clone(), truth: self.phong.clone() }.error()
    }
}

/// Draws a scene under `lights`, those of the scene. `surface` is the scene's own on this screen.
///
/// A texture modulates k_d and k_a as in Phong shading; a relief turns the normal to first order.
pub fn shade(scene: &Scene, surface: &Surface, lights: &[Directional], settings: Settings) -> FastShaded {
    let Settings { fit, table_size, subpixel_bits } = settings;
    let by_phong = |scene: &Scene| shade_by(scene, surface, Shading::Phong, Fill::Exact { subpixel_bits });
    let mut shaded = by_phong(scene);
    let specular = PowerTable::tabulated(scene.specular);
    let phong = if specular == scene.specular {
        shaded.picture.rgb.clone()
    } else {
        by_phong(&Scene { specular, ..scene.clone() }).picture.rgb
    };
    let picture = &mut shaded.picture;
    let table = |exponent| PowerTable::new(table_size, scene.specular, exponent);
    let tables: Vec<_> = scene.mesh.materials().iter().map(|material| table(material.exponent)).collect();
    let screen = (surface.width, surface.height);
    for (triangle, id) in surface.triangles.iter().zip(0..) {
        let table = &tables[scene.mesh.faces()[triangle.face as usize].material as usize];
        let normals = triangle.vertices.map(|vertex| vertex.normal);
        let mut texture = Incremental::new(triangle.vertices.map(|vertex| vertex.texture.to_array()));
        let mut walk = None;
        fragments(&triangle.on_screen(), ShadeMode::Gouraud, subpixel_bits, screen, |fragment| {
            let (x, y) = (fragment.x, fragment.y);
            let start = || FastPhong::new(triangle, subpixel_bits, fit, lights, scene.camera.eye, (x, y));
            // Additions go on under what hides the triangle.
            let walk = walk.get_or_insert_with(start);
            walk.step(x, y);
            let texture = DVec2::from(*texture.step(fragment));
            let at = y as usize * surface.width as usize + x as usize;
            if picture.id[at] == id {
                let material = scene.mesh.material_at(triangle.face, texture);
                let turn = scene.mesh.turn(triangle.face, texture, Weights::linear(fragment).of(normals));
                let color = walk.turned(turn, &material, scene.ambient, table);
                picture.rgb[at] = color.clamp(DVec3::ZERO, DVec3::ONE).to_array();
            }
        });
    }
    FastShaded { shaded, phong }
}
