//! A picture in passes, one for each light, beside golden's: each pass by itself, and the picture as the sum of all.

use crate::compare::{Comparison, compare};
use crate::verdict::{Verdict, within};
use anyhow::{Result, anyhow};
use edgewalk_host::draw;
use edgewalk_host::lights::{are_added, frames, in_passes, sum};
use edgewalk_host::port::of_port;
use edgewalk_host::raster::Raster;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use edgewalk_scene::{Scene, Surface};
use serde::Serialize;
use std::fmt::Write as _;

/// The scene on the machine without its netlist: the picture of all passes, golden's, and what was found.
///
/// # Errors
/// What of the scene the machine cannot take.
pub fn beside_golden(scene: &Scene, surface: &Surface, machine: &Plan) -> Result<(Raster, Raster, Passes)> {
    let frames = frames(scene, surface, machine)?;
    let golden: Vec<Raster> = frames.iter().map(|frame| draw::golden(frame, machine)).collect();
    let drawn = frames.iter().map(|frame| draw::fast(frame, machine, Waits::Never));
    let drawn = drawn.collect::<Result<Vec<_>>>()?;
    let beside = frames.iter().zip(&golden).zip(&drawn);
    let parts = beside.map(|((frame, golden), drawn)| compare(machine, frame, golden, drawn)).collect();
    let no_frame = || anyhow!("no frame");
    let together = match are_added(&frames) {
        true => sum(&drawn).ok_or_else(no_frame)?,
        false => {
            let port = in_passes(&frames, machine)?;
            of_port(draw::draw_frame(machine, &port, Waits::Never)?.raster(machine), &port)
        }
    };
    let passes =
        Passes { by_host: are_added(&frames), ..Passes::of(parts, machine, (&golden, &drawn), &together) };
    let exact = sum(&golden).ok_or_else(no_frame)?;
    Ok((together, exact, passes))
}

/// What was found of the passes, each by itself and together.
#[derive(Clone, Debug, Serialize)]
pub struct Passes {
    /// The ambient one, then a light each.
    pub parts: Vec<Comparison>,
    /// Pixels of the picture of all passes that were compared with the sum of the parts.
    pub added: u64,
    /// Passes whose colour, depth or triangle differs.
    pub wrong: u64,
    /// Largest colour error of the picture, of the pixels where golden decides alike for every light, LSB.
    pub color_error: f64,
    /// How many these are.
    pub alike: u64,
    /// The host has added the parts: see [`edgewalk_host::lights::are_added`].
    pub by_host: bool,
}

impl Passes {
    /// `golden`, `drawn`: the parts; `together`: the picture of all passes.
    #[must_use]
    pub fn of(
        parts: Vec<Comparison>,
        machine: &Plan,
        (golden, drawn): (&[Raster], &[Raster]),
        together: &Raster,
    ) -> Passes {
        let mut found = Passes { parts, added: 0, wrong: 0, color_error: 0.0, alike: 0, by_host: false };
        let (Some(exact), Some(whole)) = (sum(golden), sum(drawn)) else { return found };
        let max = machine.color.max() as f64;
        let lsb = |color: [f64; 3]| color.map(|channel| (channel * max).round() as u64);
        let lit = |raster: &Raster, i: usize| raster.lit.as_ref().and_then(|lit| lit.get(i).copied());
        for i in 0..together.rgb.len().min(whole.rgb.len()) {
            found.added += 1;
            let same = lsb(together.rgb[i]) == lsb(whole.rgb[i])
                && together.z[i] == whole.z[i]
                && together.id[i] == whole.id[i];
            found.wrong += u64::from(!same);
            let alike = golden.iter().zip(drawn).all(|(a, b)| a.id[i] == b.id[i] && lit(a, i) == lit(b, i));
            if alike && whole.id[i] >= 0 {
                found.alike += 1;
                for channel in 0..3 {
                    let error = (together.rgb[i][channel] - exact.rgb[i][channel]).abs() * max;
                    found.color_error = found.color_error.max(error);
                }
            }
        }
        found
    }

    /// What the picture's colours may err by, LSB: every pass as much as one.
    #[must_use]
    pub fn color_bound(&self) -> Option<f64> {
        let bounds = self.parts.iter().map(|part| &part.errors.color);
        bounds.map(|color| color.bound_for_input.or(color.bound)).sum()
    }

    /// Pass only if every part passes, and all of the screen is their sum within the parts' bounds.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let screen = self.parts.first().map_or(0, |part| part.counts.screen);
        let beyond = self.color_bound().is_some_and(|bound| !within(self.color_error, bound));
        let whole = Verdict::of(self.added, screen, self.wrong + u64::from(beyond));
        self.parts.iter().map(Comparison::verdict).fold(whole, Verdict::and)
    }

    /// As lines of text.
    #[must_use]
    pub fn lines(&self) -> String {
        let mut t = String::new();
        for (place, part) in self.parts.iter().enumerate() {
            let name = if place == 0 { "ambient".to_owned() } else { format!("light {place}") };
            _ = write!(
                t,
                "{name}: coverage mismatches {} of {}, largest errors z {:.4}, colour {:.4} LSB",
                part.counts.coverage_mismatches,
                part.counts.pixels,
                part.errors.z.error,
                part.errors.color.error
            );
            if let Some(lit) = &part.lit {
                _ = write!(
                    t,
                    "; {} of {} pixels in shadow, {} decided otherwise than golden, {} open, {} unexplained",
                    lit.shadow, lit.pixels, lit.differ, lit.open, lit.unexplained
                );
            }
            if let Some(blended) = &part.blended {
                _ = write!(
                    t,
                    "; {} pixels of up to {} layers within {}, {:.4} of one reached, {} beyond",
                    blended.pixels,
                    blended.layers,
                    if blended.no_bound.is_none() {
                        "their bounds"
                    } else {
                        "1 LSB a fragment: none has a bound"
                    },
                    blended.of_bound,
                    blended.beyond
                );
            }
            t.push('\n');
        }
        if self.by_host {
            _ = writeln!(
                t,
                "the parts, each with a bound at each pixel, added by the host: {} pixels; largest colour error {:.4} LSB over {} decided alike",
                self.added, self.color_error, self.alike
            );
            return t;
        }
        let bound = self.color_bound().map_or_else(|| "none".to_owned(), |bound| format!("{bound:.4}"));
        _ = writeln!(
            t,
            "passes together: {} pixels, {} not the sum of the parts; largest colour error {:.4} of {bound} LSB over {} pixels decided alike",
            self.added, self.wrong, self.color_error, self.alike
        );
        t
    }
}
