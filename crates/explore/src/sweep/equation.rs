//! How far a picture is from the shading equation at each pixel: the scene's own, which is the same for every way of shading,
//! and the form of it that SHADE draws.

use edgewalk_golden::{Rays, Shading, Visibility};
use edgewalk_host::input::Input;
use edgewalk_host::raster::{Raster, golden_fill};
use edgewalk_machine::Plan;
use edgewalk_scene::{Camera, PixelMethod, Scene, Specular, Surface};
use serde::Serialize;

/// How many times as far away as the camera a viewer stands who is far away: directions differ by a 10^9th.
const FAR: f64 = 1e9;

/// The equation at each pixel of a scene, from golden in f64: the normal is linear over the surface in the world.
pub struct Equation {
    /// Pixels that show a triangle.
    shown: Vec<bool>,
    /// Colours in 0 to 1.
    rgb: Vec<[f64; 3]>,
}

/// The distance of a picture from the equation, on the way: its lines come from the top.
pub struct Measure<'e> {
    equation: &'e Equation,
    /// Pixels seen.
    seen: usize,
    pixels: u64,
    largest: f64,
    sum: f64,
}

/// The distance of a picture from the equation, LSB of 8 bits; at each pixel that of its worst colour.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Distance {
    /// Pixels that show a triangle: only these are compared.
    pub pixels: u64,
    /// The largest.
    pub largest: f64,
    /// The mean.
    pub mean: f64,
}

impl Equation {
    /// On the machine's screen; none of a triangle file, which has no surface.
    #[must_use]
    pub fn of(input: &Input, machine: &Plan) -> Option<Equation> {
        let (scene, surface) = input.surface(machine)?;
        Some(Equation::at_pixels(scene, &surface, machine, &Visibility::Full))
    }

    /// In the form that SHADE draws: mirror highlights are those of ch. 7.12, and Phong sees them from far away. None of a
    /// triangle file.
    #[must_use]
    pub fn of_shade(input: &Input, machine: &Plan, method: PixelMethod) -> Option<Equation> {
        let (scene, surface) = input.surface(machine)?;
        let Camera { eye, target, .. } = scene.camera;
        let eye = match method {
            PixelMethod::FastPhong => eye,
            PixelMethod::Phong => target + FAR * (eye - target),
        };
        let specular = if scene.specular == Specular::Mirror { Specular::Halfway } else { scene.specular };
        // The surface has its places on the screen: the camera counts for highlights alone.
        let form = Scene { camera: Camera { eye, ..scene.camera }, specular, ..scene.clone() };
        Some(Equation::at_pixels(&form, &surface, machine, &Visibility::Full))
    }

    /// With the shadows that rays find; none of a triangle file.
    #[must_use]
    pub fn with_shadows(input: &Input, machine: &Plan) -> Option<Equation> {
        let (scene, surface) = input.surface(machine)?;
        let rays = Visibility::Rays(Rays::new(&scene.mesh));
        Some(Equation::at_pixels(scene, &surface, machine, &rays))
    }

    fn at_pixels(scene: &Scene, surface: &Surface, machine: &Plan, visibility: &Visibility) -> Equation {
        // Which triangle a pixel shows is the same in all of golden's ways of shading.
        let fill = golden_fill(machine);
        let shaded = edgewalk_golden::render(scene, surface, Shading::Gouraud, fill, visibility).shaded;
        Equation { shown: shaded.picture.id.iter().map(|id| *id >= 0).collect(), rgb: shaded.truth }
    }

    /// Begins to measure a picture.
    #[must_use]
    pub fn measure(&self) -> Measure<'_> {
        Measure { equation: self, seen: 0, pixels: 0, largest: 0.0, sum: 0.0 }
    }
}

impl Measure<'_> {
    /// Measures the next lines.
    pub fn add(&mut self, drawn: &Raster) {
        let Equation { shown, rgb } = self.equation;
        let equation = shown.iter().zip(rgb).skip(self.seen);
        self.seen += drawn.rgb.len();
        for ((_, exact), drawn) in equation.zip(&drawn.rgb).filter(|((shown, _), _)| **shown) {
            let worst = exact.iter().zip(drawn).map(|(a, b)| 255.0 * (a - b).abs()).fold(0.0, f64::max);
            self.pixels += 1;
            self.largest = self.largest.max(worst);
            self.sum += worst;
        }
    }

    /// The distance of all lines.
    #[must_use]
    pub fn distance(self) -> Distance {
        let Measure { pixels, largest, sum, .. } = self;
        Distance { pixels, largest, mean: if pixels == 0 { 0.0 } else { sum / pixels as f64 } }
    }
}
