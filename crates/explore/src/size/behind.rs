//! What a value errs by behind its interpolator: at a light's gate, in DITHER, and in a polygon beside its plane.

use edgewalk_host::polygon::defects;
use edgewalk_machine::{COLOURS, Gate, NoBound, Plan, gated};
use edgewalk_scene::{Blending, Frame};

/// Of a stored value of a frame, or of every frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Behind {
    /// The largest share of its colour that a point in shadow keeps; none without such a gate.
    share: Option<f64>,
    /// The step of DITHER (bound 18) and the defect of polygons (bound 19), LSB.
    beside: f64,
}

impl Behind {
    /// Of every triangle.
    pub fn of_any(machine: &Plan, place: usize) -> Result<Behind, String> {
        match machine.proved_output(place) {
            Err(why @ (NoBound::Shaded | NoBound::Bilinear | NoBound::Layered { .. })) => {
                Err(why.to_string())
            }
            // `size` looks for other word lengths then. A triangle has no defect.
            _ => Ok(Behind::at(machine, place, Some(1.0), 0.0)),
        }
    }

    /// Of these triangles and polygons.
    pub fn of_frame(machine: &Plan, frame: &Frame, place: usize) -> Result<Behind, String> {
        let passes = frame.passes();
        let lights = || passes.iter().filter_map(|pass| frame.shadow(pass.state.light));
        let mixes = passes.iter().any(|pass| pass.state.blend != Blending::Off) && !machine.dither.drops();
        let color = COLOURS.contains(&place);
        let layered = color && (mixes || machine.shadow.transmits() && lights().next().is_some());
        if color && (frame.shading.is_some() || layered || machine.polygon.is_bilinear()) {
            return Behind::of_any(machine, place);
        }
        let share = lights().map(|shadow| shadow.ambient).reduce(f64::max);
        let defect = defects(frame, machine).get(place).copied().unwrap_or(0.0);
        Ok(Behind::at(machine, place, share, defect))
    }

    fn at(machine: &Plan, place: usize, share: Option<f64>, defect: f64) -> Behind {
        if !COLOURS.contains(&place) {
            return Behind { share: None, beside: defect };
        }
        let scales = machine.shadow.is_there() && machine.shadow.gate == Gate::Scale;
        Behind { share: share.filter(|_| scales), beside: defect + machine.dither_step() }
    }

    /// The bound of the stored value, LSB, where that of the output before is `own`.
    pub fn stored(self, own: f64) -> f64 {
        gated(own, self.share) + self.beside
    }

    /// What is left of the error for the output before, LSB.
    pub fn left(self, error: f64) -> Result<f64, String> {
        let error = error - self.beside;
        let left = match self.share {
            Some(share) if share > 0.0 => error.min((error - 1.0) / share),
            Some(_) if error < 1.0 => error - 1.0,
            _ => error,
        };
        if left > 0.5 {
            return Ok(left);
        }
        let least = self.stored(0.5);
        Err(format!(
            "the roundings of the output and of the units behind it may err by {least} LSB already; allow more with --error"
        ))
    }
}
