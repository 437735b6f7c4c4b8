//! Several lights at a point: LAMP takes one, so the machine draws a picture for each, and the host adds them.
//!
//! ```text
//!  frame ─┬─ light 1, and what no light makes ─> picture ─┐
//!         └─ light l alone ────────────────────> picture ─┴─> sum, cut to 1, beside golden's picture under all of them
//! ```
//! No part of the light is below 0, so it is all the same whether the parts are cut to 1 before they are added and cut: the sum errs by no more
//! than all parts together.

use super::bound::Proof;
use super::lights::one_kind;
use crate::advice::OR_GOLDEN;
use anyhow::{Result, anyhow};
use edgewalk_machine::Plan;
use edgewalk_scene::{Blending, Frame, Material, PixelShading};
use glam::DVec3;

/// The frame for each of its lights, where the machine takes one and the frame has more; the first is also what no light makes.
///
/// # Errors
/// A frame that is blended, or drawn in passes: what lies behind would be added before it is mixed.
pub fn apart(frame: &Frame, machine: &Plan) -> Result<Option<Vec<Frame>>> {
    let shading = match &frame.shading {
        Some(shading) if machine.shade.is_positional() && shading.lights.len() > 1 => shading,
        _ => return Ok(None),
    };
    one_kind(shading, machine)?;
    if frame.blend != Blending::Off || frame.passes().len() > 1 {
        return Err(anyhow!(
            "{} lights: the machine draws a picture for each, and a surface is seen through; take one light, or kt = 0{OR_GOLDEN}",
            shading.lights.len()
        ));
    }
    let dark = |material: &Material| Material { emission: DVec3::ZERO, ..*material };
    let part = |(place, light)| {
        let mut part = PixelShading { lights: vec![light], ..shading.clone() };
        let mut clear = frame.clear;
        if place > 0 {
            part.ambient = DVec3::ZERO;
            part.materials = part.materials.iter().map(dark).collect();
            clear = [0.0; 3];
        }
        Frame { shading: Some(part), clear, ..frame.clone() }
    };
    Ok(Some(shading.lights.iter().copied().enumerate().map(part).collect()))
}

impl Proof {
    /// What is proved of the sum of two pictures of the same triangles: bounds and steps of DITHER add up, and both doubt.
    #[must_use]
    pub fn and(mut self, other: Proof) -> Proof {
        self.pictures += other.pictures;
        self.bounds.iter_mut().zip(other.bounds).for_each(|(own, other)| *own += other);
        self.doubts.iter_mut().zip(other.doubts).for_each(|(own, other)| *own = own.max(other));
        for (own, other) in self.errors.iter_mut().zip(other.errors) {
            own.axis = own.axis.max(other.axis);
            own.highlight.extend(other.highlight);
        }
        self
    }
}
