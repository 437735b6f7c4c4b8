//! What of shading at each pixel a triangle file cannot say: a frame with it is not written.

use super::shading::{MAX_EXPONENT, MAX_INTENSITY};
use crate::light::Light;
use crate::pixel_shading::{PixelShading, PixelTriangle, Viewer, unit};
use glam::DVec3;
use std::io;
use std::ops::RangeInclusive;

/// All that a file would lose is looked for.
///
/// # Errors
/// Of the kind `Unsupported`: what was found, and what a file may say.
pub(super) fn check(shading: &PixelShading) -> io::Result<()> {
    if let Viewer::At(eye) = shading.viewer {
        return Err(unsaid(format!(
            "the viewer stands at {}; a triangle file has one that is infinitely far away",
            numbers(eye)
        )));
    }
    grey("ambient light", shading.ambient, 0.0..=MAX_INTENSITY)?;
    for light in &shading.lights {
        match light {
            Light::Directional { intensity, .. } => {
                grey("a light's intensity", *intensity, 0.0..=MAX_INTENSITY)?
            }
            Light::Positional { position, .. } | Light::Flood { position, .. } => {
                return Err(unsaid(format!(
                    "a light stands at {}; a triangle file has only lights that are infinitely far away",
                    numbers(*position)
                )));
            }
        }
    }
    if !PixelShading::FORMS.contains(&shading.specular) {
        return Err(unsaid(format!(
            "highlights are of the form {}; a triangle file has {}",
            shading.specular.name(),
            PixelShading::FORM_NAMES.join(" and ")
        )));
    }
    let mut last = None;
    for (place, own) in shading.triangles.iter().enumerate() {
        if last.replace(own.material) != Some(own.material) {
            material(shading, own)?;
        }
        for normal in own.normals {
            if unit(normal) != Some(normal) {
                return Err(unsaid(format!(
                    "triangle {place} has the normal {} of length {}, as a clipped one has; a triangle file has \
                     normals of length 1",
                    numbers(normal),
                    normal.length()
                )));
            }
        }
    }
    Ok(())
}

fn material(shading: &PixelShading, own: &PixelTriangle) -> io::Result<()> {
    let material = &shading.materials[own.material as usize];
    if shading.relief(own).is_some() {
        return Err(unsaid("a material has a relief; a triangle file has none".to_owned()));
    }
    if material.emission != DVec3::ZERO {
        return Err(unsaid(format!(
            "a material has the emission {}; a triangle file has none",
            numbers(material.emission)
        )));
    }
    grey("a material's ambient coefficient", material.ambient, 0.0..=1.0)?;
    grey("a material's diffuse coefficient", material.diffuse, 0.0..=1.0)?;
    grey("a material's specular coefficient", material.specular, 0.0..=1.0)?;
    if material.specular != DVec3::ZERO && !(1.0..=MAX_EXPONENT).contains(&material.exponent) {
        return Err(unsaid(format!(
            "a material's exponent is {}; a triangle file has 1 to {MAX_EXPONENT}",
            material.exponent
        )));
    }
    Ok(())
}

/// A file has one number for red, green and blue.
fn grey(what: &str, color: DVec3, range: RangeInclusive<f64>) -> io::Result<()> {
    if color == DVec3::splat(color.x) && range.contains(&color.x) {
        return Ok(());
    }
    Err(unsaid(format!(
        "{what} is {}; a triangle file has one number for red, green and blue, {} to {}",
        numbers(color),
        range.start(),
        range.end()
    )))
}

fn numbers(vector: DVec3) -> String {
    format!("{} {} {}", vector.x, vector.y, vector.z)
}

fn unsaid(what: String) -> io::Error {
    io::Error::new(io::ErrorKind::Unsupported, what)
}
