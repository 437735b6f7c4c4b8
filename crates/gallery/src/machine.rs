//! What a machine with TERM and SHADE, of textures TEXEL, of reliefs BUMP, of a light at a point LAMP, makes of an exhibit's scene, beside golden's fast Phong, or
//! Phong, of the same triangles.

use crate::exhibit::{GUARD, HEIGHT, View, WIDTH, figure};
use anyhow::{Result, anyhow};
use edgewalk_host::draw::{draw_frame, golden};
use edgewalk_host::port::to_port;
use edgewalk_judge::compare::compare_shaded;
use edgewalk_judge::shaded::Shaded;
use edgewalk_machine::Machine;
use edgewalk_model::Waits;
use edgewalk_scene::{Light, PixelMethod, Scene};

/// Error shown as white, LSB.
const WHITE: f64 = 4.0;

/// The machine's picture and how far it is off.
pub(crate) struct Beside {
    method: PixelMethod,
    golden: Vec<[f64; 3]>,
    machine: Vec<[f64; 3]>,
    map: Vec<f64>,
    shaded: Shaded,
}

impl Beside {
    /// Draws the scene with tables of 1024 entries; with TEXEL where it has nearest texels, with BUMP where one is a relief, with
    /// LAMP where Phong has a light at a point.
    ///
    /// # Errors
    /// What of the scene such a machine cannot take.
    pub(crate) fn of(scene: &Scene, method: PixelMethod) -> Result<Beside> {
        let mut keys = Machine { width: WIDTH, height: HEIGHT, ..Machine::default() };
        let lights = scene.lights.len().to_string();
        let frame = scene.pixel_frame(&scene.surface(WIDTH, HEIGHT, GUARD), method);
        let textured = frame.shading.as_ref().is_some_and(|shading| !shading.textures.is_empty());
        let texture: &[(&str, &str)] =
            if textured { &[("shade.colour", "multiply"), ("texture.kind", "nearest")] } else { &[] };
        let bumped =
            frame.shading.as_ref().is_some_and(|of| of.materials.iter().any(|one| one.bump.is_some()));
        let relief: &[(&str, &str)] = if bumped { &[("texture.bump", "yes")] } else { &[] };
        let at_a_point = |light: &Light| !matches!(light, Light::Directional { .. });
        let positional = method == PixelMethod::Phong && scene.lights.iter().any(at_a_point);
        let light: &[(&str, &str)] = if positional { &[("shade.light", "positional")] } else { &[] };
        for (key, value) in [
            ("shade.kind", method.name()),
            ("shade.table_bits", "10"),
            ("shade.gloss_bits", "8"),
            ("shade.lights", &lights),
        ]
        .iter()
        .chain(texture)
        .chain(relief)
        .chain(light)
        {
            keys.set(key, value)?;
        }
        let plan = keys.plan()?;
        let port = to_port(&frame, &plan)?;
        let golden = golden(&frame, &plan);
        let drawn = draw_frame(&plan, &port, Waits::Never)?.raster(&plan);
        let proof = port.shade.as_ref().map(|feed| &feed.proof);
        let found = compare_shaded(&plan, &frame, &golden, &drawn, None, proof);
        let shaded = found.shaded.ok_or_else(|| anyhow!("a frame without normals"))?;
        Ok(Beside { method, golden: golden.rgb, machine: drawn.rgb, map: found.errors.color.map, shaded })
    }

    /// Pixels whose colour another scene's golden picture has by more than 1/2 LSB otherwise, and by how much the farthest, LSB.
    pub(crate) fn change(&self, other: &Beside) -> (usize, f64) {
        let off =
            |(a, b): (&[f64; 3], &[f64; 3])| 255.0 * (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
        let all: Vec<f64> = self.golden.iter().zip(&other.golden).map(off).collect();
        (all.iter().filter(|off| **off > 0.5).count(), all.into_iter().fold(0.0, f64::max))
    }

    /// The figures of the exhibit's own.
    pub(crate) fn figures(&self) -> Vec<(String, String)> {
        let Shaded { error, allowed: bound, from_phong, mean_from_phong, texels, .. } = self.shaded;
        let (who, what) = match self.method {
            PixelMethod::FastPhong => ("machine", "fast Phong"),
            PixelMethod::Phong => ("machine, Phong", "Phong"),
        };
        let mut figures = vec![
            figure(format!("{who}: largest error against {what} in f64, LSB"), error, 2),
            figure(format!("{who}: proved bound of that, LSB"), bound, 2),
        ];
        if self.method == PixelMethod::FastPhong {
            figures.push(figure("machine: largest difference from Phong, LSB", from_phong, 2));
            figures.push(figure("machine: mean difference from Phong, LSB", mean_from_phong, 3));
        }
        if let Some(texels) = texels {
            figures.extend([
                figure(format!("{who}: pixels that look up a texel"), texels.pixels as f64, 0),
                figure(format!("{who}: of them another texel than golden's"), texels.differ as f64, 0),
                figure(format!("{who}: not explained by the error of u and v"), texels.unexplained as f64, 0),
            ]);
        }
        figures
    }

    /// Pictures of both, for an exhibit.
    pub(crate) fn views(self) -> Vec<View> {
        let ([drawn, golden, error], what) = match self.method {
            PixelMethod::FastPhong => (["machine", "machine-golden", "machine-error"], "fast Phong"),
            PixelMethod::Phong => (["phong", "phong-golden", "phong-error"], "Phong"),
        };
        vec![
            View::colors(drawn, "The machine: terms and tables", self.machine),
            View::colors(golden, format!("Golden beside it: {what} in f64"), self.golden),
            View::error(error, format!("Its error, white at {WHITE} LSB"), &self.map, WHITE),
        ]
    }
}
