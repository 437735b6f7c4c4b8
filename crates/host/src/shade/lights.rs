//! The lights of a frame as the machine takes them, and a triangle's six cosines of each.

use super::lamp::Point;
use crate::advice::OR_GOLDEN;
use anyhow::{Result, anyhow};
use edgewalk_machine::Plan;
use edgewalk_scene::{Attenuation, Light, PixelShading, PixelTriangle, Viewer};
use glam::DVec3;

/// A light whose intensity is the same everywhere, or one at a point for LAMP.
#[derive(Clone, Debug)]
pub struct Lamp {
    /// Where it is.
    light: Light,
    /// I_l; of one for LAMP where it is brightest.
    pub intensity: DVec3,
    /// With LAMP.
    pub point: Option<Point>,
}

/// Whether a light is far away.
fn is_far(light: &Light) -> bool {
    matches!(light, Light::Directional { .. })
}

/// Accepts the lights of a frame for a machine with `shade.kind = phong`: all far away, or all at a point.
///
/// # Errors
/// Both kinds: the first light of each.
pub fn one_kind(shading: &PixelShading, machine: &Plan) -> Result<()> {
    let place = |far: bool| shading.lights.iter().position(|light| is_far(light) == far);
    match (place(true), place(false)) {
        (Some(far), Some(near)) if machine.shade.normalises() => Err(anyhow!(
            "light {} is a directional light and light {} stands at a point: no machine with shade.kind = phong draws both kinds \
             in one picture; take lights of one kind{OR_GOLDEN}",
            far + 1,
            near + 1
        )),
        _ => Ok(()),
    }
}

/// A cosine at the vertices, and in the middles of the edges opposite them.
pub type Nodes = [[f64; 3]; 2];

impl Lamp {
    /// The lights of the frame.
    ///
    /// # Errors
    /// Lights of a kind that the machine does not draw, or more than it has terms for. A light that weakens with distance or direction: a
    /// table holds its intensity.
    pub fn all(shading: &PixelShading, machine: &Plan) -> Result<Vec<Lamp>> {
        one_kind(shading, machine)?;
        let far_away = machine.shade.normalises() && !machine.shade.is_positional();
        if let Some(place) = shading.lights.iter().position(|light| far_away && !is_far(light)) {
            return Err(anyhow!(
                "light {}: with shade.kind = phong N·L is linear, so every light is directional; add --set shade.light=positional{OR_GOLDEN}",
                place + 1
            ));
        }
        let (given, most) = (shading.lights.len(), machine.shade.lights as usize);
        if given > most {
            let remedy = if machine.shade.is_positional() {
                "permitted: 1; render and explain draw one after the other"
            } else {
                "permitted: 1 or 2, as shade.lights says; leave lights out"
            };
            return Err(anyhow!("{given} lights: the machine has terms for {most}; {remedy}{OR_GOLDEN}"));
        }
        if machine.shade.normalises() && matches!(shading.viewer, Viewer::At(_)) {
            return Err(anyhow!(
                "a viewer at a point: with shade.kind = phong N·H is linear, so the viewer is far away; take shade.kind = fast-phong"
            ));
        }
        let lamp = |(place, light): (usize, &Light)| match *light {
            _ if machine.shade.is_positional() => {
                let point = Point::of(light, shading)?;
                let intensity = light.intensity() * point.full;
                Ok(Lamp { light: *light, intensity, point: Some(point) })
            }
            Light::Directional { intensity, .. } => Ok(Lamp { light: *light, intensity, point: None }),
            Light::Positional { intensity, attenuation: Attenuation::NONE, .. } => {
                Ok(Lamp { light: *light, intensity, point: None })
            }
            Light::Positional { .. } | Light::Flood { .. } => Err(anyhow!(
                "light {}: its intensity is not the same everywhere, and the machine's tables hold one; take a directional \
                 light or a positional one that does not weaken{OR_GOLDEN}",
                place + 1
            )),
        };
        shading.lights.iter().enumerate().map(lamp).collect()
    }

    /// L and H at a point; of a directional light and a viewer far away both are the same everywhere.
    pub fn directions(&self, position: DVec3, shading: &PixelShading) -> [DVec3; 2] {
        let toward = self.light.incident(position).toward;
        [toward, (toward + shading.viewer_at(position)).normalize_or_zero()]
    }

    /// N·L and N·H of a triangle.
    pub fn cosines(&self, triangle: &PixelTriangle, shading: &PixelShading) -> [Nodes; 2] {
        let PixelTriangle { normals, positions, .. } = triangle;
        let at = |normal: DVec3, position: DVec3| {
            let normal = normal.normalize_or_zero();
            self.directions(position, shading).map(|direction| normal.dot(direction))
        };
        let mut nodes = [[[0.0; 3]; 2]; 2];
        for k in 0..3 {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            let vertex = at(normals[k], positions[k]);
            let middle = at((normals[next] + normals[last]) / 2.0, (positions[next] + positions[last]) / 2.0);
            for cosine in 0..2 {
                nodes[cosine][0][k] = vertex[cosine];
                nodes[cosine][1][k] = middle[cosine];
            }
        }
        nodes
    }
}
