//! One page about a shading system: what was drawn, and how far it is from the truth; as text and as JSON.

use crate::fast_phong::FastPhongReport;
use crate::input::Source;
use edgewalk_golden::{Order, ShadingError};
use edgewalk_scene::{Scene, Surface, Texture};
use serde::Serialize;
use std::fmt::Write as _;

/// Everything the page says.
#[derive(Debug, Serialize)]
pub struct ShadingReport {
    input: String,
    shading: String,
    specular: &'static str,
    width: u32,
    height: u32,
    faces: usize,
    triangles: usize,
    lights: usize,
    materials: usize,
    /// Named by the materials and not there.
    missing_textures: Vec<String>,
    /// Triangles that were blended, from back to front.
    transparent: usize,
    /// Why the blended picture may be wrong.
    warning: Option<String>,
    /// Pixels that show a triangle.
    pixels: u64,
    /// LSB of 8 bits.
    largest_error: f64,
    /// LSB of 8 bits.
    mean_error: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    fast_phong: Option<FastPhongReport>,
}

impl ShadingReport {
    /// Of a picture of `surface`.
    pub fn new(source: &Source, scene: &Scene, surface: &Surface, error: &ShadingError) -> Self {
        let absent = |texture: &Texture| match texture {
            Texture::Absent(name) => Some(name.clone()),
            _ => None,
        };
        Self {
            input: source.input.clone(),
            shading: source.shading().name(),
            specular: scene.specular.name(),
            width: surface.width,
            height: surface.height,
            faces: scene.mesh.faces().len(),
            triangles: surface.triangles.len(),
            lights: scene.lights.len(),
            materials: scene.mesh.materials().len(),
            missing_textures: scene.mesh.textures().iter().filter_map(absent).collect(),
            transparent: 0,
            warning: None,
            pixels: error.pixels,
            largest_error: error.max,
            mean_error: error.mean,
            fast_phong: None,
        }
    }

    /// Like `new`, with what is to be said of transparent triangles.
    pub fn blended(self, order: &Order) -> Self {
        Self { transparent: order.transparent, warning: order.warning(), ..self }
    }

    /// Like `blended`, with what is to be said of fast Phong.
    pub fn with(self, fast_phong: FastPhongReport) -> Self {
        Self { fast_phong: Some(fast_phong), ..self }
    }

    /// As a page of text.
    pub fn text(&self) -> String {
        let mut t = String::new();
        let _ = writeln!(
            t,
            "{}: {} faces, {} triangles on {}x{}, {} lights, {} materials",
            self.input, self.faces, self.triangles, self.width, self.height, self.lights, self.materials
        );
        for name in &self.missing_textures {
            let _ = writeln!(t, "texture {name} is not there: white");
        }
        if self.transparent > 0 {
            let _ = writeln!(t, "{} transparent triangles, blended from back to front", self.transparent);
        }
        if let Some(warning) = &self.warning {
            let _ = writeln!(t, "warning: {warning}");
        }
        let _ = writeln!(
            t,
            "{} beside the equation at each of {} pixels, highlights {}",
            self.shading, self.pixels, self.specular
        );
        let _ = writeln!(t, "largest error {:.4} LSB of 8 bits", self.largest_error);
        let _ = writeln!(t, "mean error    {:.4} LSB of 8 bits", self.mean_error);
        if let Some(fast_phong) = &self.fast_phong {
            t += &fast_phong.text();
        }
        t
    }
}
