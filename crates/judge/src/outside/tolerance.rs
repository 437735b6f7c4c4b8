//! How far another rasterizer may be from the reference.

use crate::compare::{Apart, gated};
use crate::verdict::in_words;
use edgewalk_host::polygon::defects;
use edgewalk_machine::{Channel, NoBound, Plan};
use edgewalk_scene::Frame;
use serde::Serialize;

/// Largest permitted errors.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Tolerance {
    /// Of depth, LSB.
    pub z: f64,
    /// Of a colour, LSB.
    pub color: f64,
    /// Why no bound of a depth is proved: 1 LSB stands in its place.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "in_words")]
    pub z_no_bound: Option<NoBound>,
    /// Why no bound of a colour is proved: 1 LSB stands in the place of that of a fragment's colour, or of its k_t.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "in_words")]
    pub color_no_bound: Option<NoBound>,
    /// An LSB of depth, in 0 to 1.
    #[serde(skip)]
    pub z_lsb: f64,
    /// An LSB of a colour, in 0 to 1.
    #[serde(skip)]
    pub color_lsb: f64,
    /// Bits of a depth.
    pub z_bits: u32,
    /// Bits of a colour.
    pub color_bits: u32,
    /// The largest tolerance of a pixel's colour in a blended frame, LSB; none without layers, or with a tolerance of the user.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layers: Option<f64>,
    /// What DITHER and the file of the picture may add to the bound of a blended pixel, LSB.
    #[serde(skip)]
    pub(super) step: f64,
    /// The user gave the tolerance of colours, or another format than the machine's: it holds at each pixel.
    #[serde(skip)]
    pub is_asked_for: bool,
}

/// What the user asks of the tolerance.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked {
    /// Bits of a value.
    pub bits: Option<u32>,
    /// LSB.
    pub lsb: Option<f64>,
}

impl Tolerance {
    /// The proved bound of the machine's outputs where nothing else is asked for: of vertices, additions and rounding, of the frame's
    /// polygons (bounds 19 and 20), of the gate of its lights, and of DITHER (bound 18). Where sums may wrap, 1 LSB is in the place of
    /// the first. Values with another number of bits have 1 LSB of these.
    #[must_use]
    pub fn of(machine: &Plan, frame: &Frame, z: Asked, color: Asked) -> Self {
        let (channels, defects) = (machine.channels(), defects(frame, machine));
        let budget = |place: usize| machine.proved_budget(&channels[place]);
        let proved = |place: usize| {
            budget(place).map_or(1.0, |budget| budget.after_rounding().to_f64()) + defects[place]
        };
        let is_gated = frame.passes().iter().any(|pass| frame.shadow(pass.state.light).is_some());
        let step = machine.dither_step();
        let of_color = if is_gated { gated(frame, proved(1)) } else { proved(1) } + step;
        let of = |asked: Asked, channel: &Channel, bound: f64| {
            let bits = asked.bits.unwrap_or(channel.bits);
            let bound = if bits == channel.bits { bound } else { 1.0 };
            (asked.lsb.unwrap_or(bound), 1.0 / ((1u64 << bits) - 1) as f64, bits)
        };
        let is_asked_for = |asked: Asked, place: usize| {
            asked.lsb.is_some() || asked.bits.is_some_and(|bits| bits != channels[place].bits)
        };
        let no_bound = |asked, place| budget(place).err().filter(|_| !is_asked_for(asked, place));
        let [z_no_bound, color_no_bound] = [no_bound(z, 0), no_bound(color, 1)];
        let is_asked_for = is_asked_for(color, 1);
        let (z, z_lsb, z_bits) = of(z, &channels[0], proved(0));
        let (color, color_lsb, color_bits) = of(color, &channels[1], of_color);
        Tolerance {
            z,
            color,
            z_no_bound,
            color_no_bound,
            z_lsb,
            color_lsb,
            z_bits,
            color_bits,
            layers: None,
            step,
            is_asked_for,
        }
    }

    /// The same formats; every value must be equal.
    #[must_use]
    pub fn exact(self) -> Self {
        let (z_no_bound, color_no_bound) = (None, None);
        Tolerance { z: 0.0, color: 0.0, z_no_bound, color_no_bound, is_asked_for: true, ..self }
    }

    /// With the rounding of a file whose colours have a step of their own; a tolerance that the user gave holds as it is.
    pub(super) fn of_file(self, color_step: f64) -> Self {
        let rounding = color_step / 2.0 / self.color_lsb;
        Tolerance { color: self.color + rounding, step: self.step + rounding, ..self }
    }

    /// Depths so near to one another may come out in any order, in 0 to 1: each errs by the tolerance, and both are rounded.
    pub(super) fn tie(&self) -> f64 {
        (2.0 * self.z + 1.0) * self.z_lsb
    }

    /// Likewise in the depth tests of a frame of several layers; the cleared depth has no error.
    pub(super) fn apart(&self) -> Apart {
        Apart { triangles: self.tie(), cleared: (self.z + 0.5) * self.z_lsb }
    }
}
