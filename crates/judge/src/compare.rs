//! A machine's picture against the golden one, pixel by pixel.
//!
//! ```text
//!  golden ─┐                  same triangle, same writes ──> every channel: error, wrapped? ─────┐
//!          ├─> coverage ─> ?                                                                    ├─> Comparison ─> verdict
//!  machine ┘                  another triangle or count ──> is there an order of depths within ─┘
//!                                                           the bound (bound 7) that explains it?
//! ```
//! Errors are against the exact plane through the unquantised vertices, in LSB of the machine's output.

mod channel;
mod order;
mod layers;
mod lit;
#[cfg(test)]
mod tests;

use crate::shaded::{Allowed, Shaded};
use crate::verdict::Verdict;
use channel::Tally;
pub use channel::{ExtraError, Spread};
use edgewalk_host::extra;
use edgewalk_host::raster::Raster;
use edgewalk_host::reach::Reach;
use edgewalk_host::shade::Proof;
use edgewalk_machine::Plan;
use edgewalk_scene::Frame;
use layers::Layers;
pub use layers::{Blended, Errors};
pub use lit::{Lights, Lit, Seen};
use order::{Orders, Over};
use serde::Serialize;

/// What the comparison found.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// Pixels whose coverage was compared.
    pub pixels: u64,
    /// Pixels of the machine's screen.
    pub screen: u64,
    /// Pixels where another number of triangles covers.
    pub coverage_mismatches: u64,
    /// Pixels that golden covers.
    pub covered: u64,
    /// Those of them whose triangle, number of writes, depth, colour and values of the user's own were compared.
    pub compared: u64,
    /// Pixels that show another triangle, or were written another number of times, as two depths there are too near for the
    /// bound to tell their order (bound 7).
    pub order_undecided: u64,
    /// Pixels where no such order explains it.
    pub order_wrong: u64,
    /// Pixels that show no triangle, and not the cleared depth, colour and values of the user's own either.
    pub background_wrong: u64,
    /// Pixels of which a value left its range and wrapped.
    pub wrapped: u64,
    /// Cycles of the machine without a cause, or with two.
    pub cycles_unexplained: u64,
    /// Largest depth error, LSB.
    pub z_error: f64,
    /// Largest colour error, LSB.
    pub color_error: f64,
    /// How the depth errors are spread.
    pub z_spread: Spread,
    /// How the errors of red, green and blue are spread.
    pub color_spread: Spread,
    /// Proved bound of the depth error, LSB; none where depths may wrap.
    pub z_bound: Option<f64>,
    /// Proved bound of the colour error, LSB; none where colours may wrap.
    pub color_bound: Option<f64>,
    /// The most additions behind a pixel of these triangles.
    pub additions: Option<u64>,
    /// Proved bound of the depth error for these triangles, LSB.
    pub z_bound_for_input: Option<f64>,
    /// Proved bound of the colour error for these triangles, LSB.
    pub color_bound_for_input: Option<f64>,
    /// Why there is none of the depth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_no_bound: Option<String>,
    /// Why there is none of the colour.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color_no_bound: Option<String>,
    /// Of a blended picture, whose colours have a bound at each pixel in place of `color_bound`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blended: Option<Blended>,
    /// Of a picture under a light.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lit: Option<Lit>,
    /// Of a picture shaded at each pixel, whose colours have the bound of their triangle in place of `color_bound`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaded: Option<Shaded>,
    /// Channels of the user's own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<ExtraError>,
    /// Depth error of every pixel, LSB.
    #[serde(skip)]
    pub z_map: Vec<f64>,
    /// Largest colour error of every pixel, LSB.
    #[serde(skip)]
    pub color_map: Vec<f64>,
}

/// Compares the pictures of `frame`, which has triangles only, with what is proved of the machine alone.
#[must_use]
pub fn compare(machine: &Plan, frame: &Frame, golden: &Raster, drawn: &Raster) -> Comparison {
    compare_for(machine, frame, golden, drawn, None)
}

/// The same with what is proved for these triangles, where it is known how far they reach.
#[must_use]
pub fn compare_for(
    machine: &Plan,
    frame: &Frame,
    golden: &Raster,
    drawn: &Raster,
    reach: Option<&Reach>,
) -> Comparison {
    compare_shaded(machine, frame, golden, drawn, reach, None)
}

/// The same of a frame that is shaded at each pixel, with what is proved of its colours.
#[must_use]
pub fn compare_shaded(
    machine: &Plan,
    frame: &Frame,
    golden: &Raster,
    drawn: &Raster,
    reach: Option<&Reach>,
    proof: Option<&Proof>,
) -> Comparison {
    let allowed = frame.shading.as_ref().zip(proof);
    let allowed = allowed.map(|(shading, proof)| Allowed::new(machine, frame, shading, golden, proof));
    let c = compared(machine, frame, golden, drawn, reach, allowed);
    match reach {
        Some(reach) => c.reaching(machine, reach),
        None => c,
    }
}

fn compared(
    machine: &Plan,
    frame: &Frame,
    golden: &Raster,
    drawn: &Raster,
    reach: Option<&Reach>,
    mut allowed: Option<Allowed>,
) -> Comparison {
    let mut tally = Tally::new(machine, golden, drawn);
    let mut c = Comparison {
        pixels: 0,
        screen: u64::from(machine.width) * u64::from(machine.height),
        coverage_mismatches: 0,
        covered: golden.coverage.iter().map(|count| u64::from(*count > 0)).sum(),
        compared: 0,
        order_undecided: 0,
        order_wrong: 0,
        background_wrong: 0,
        wrapped: 0,
        cycles_unexplained: drawn.cycles.as_ref().map_or(0, |cycles| cycles.unexplained()),
        z_error: 0.0,
        color_error: 0.0,
        z_spread: Spread::default(),
        color_spread: Spread::default(),
        additions: None,
        z_bound_for_input: None,
        color_bound_for_input: None,
        z_bound: tally.z.bound(),
        color_bound: tally.color.bound(),
        z_no_bound: tally.z.no_bound(),
        color_no_bound: tally.color.no_bound(),
        blended: None,
        lit: None,
        shaded: None,
        extra: Vec::new(),
        z_map: Vec::new(),
        color_map: Vec::new(),
    };
    let mut light = Lights::drawn(machine, frame, drawn, reach);
    if let Some(layers) = Layers::of(machine, frame, light.as_mut()) {
        blended(&mut c, &mut tally, &layers, frame, golden, light.as_mut());
        c.lit = light.map(Lights::found);
        return finished(c, tally, machine);
    }
    let mut differ = Vec::new();
    for i in 0..golden.coverage.len().min(drawn.coverage.len()) {
        c.pixels += 1;
        c.coverage_mismatches += u64::from(golden.coverage[i] != drawn.coverage[i]);
        if (golden.id[i], golden.writes[i]) != (drawn.id[i], drawn.writes[i]) {
            differ.push(i);
            continue;
        }
        if golden.id[i] >= 0 {
            let agrees = light.as_mut().is_none_or(|light| light.agrees(i, golden, drawn));
            let mut over = Over::golden(golden, i);
            if let Some(allowed) = &mut allowed {
                let one = machine.color.max() as f64;
                over.rgb = allowed.at(i, golden.id[i], golden.rgb[i], drawn.rgb[i], one);
            }
            if agrees {
                tally.triangle(i, golden.z[i], &over);
            } else {
                tally.depth(i, golden.z[i]); // the colour is another
            }
        } else {
            c.background_wrong += u64::from(!tally.is_background(i, frame.clear));
        }
        c.compared += u64::from(golden.coverage[i] > 0);
    }
    let orders = Orders::new(machine, frame, &differ, reach);
    for i in differ {
        match orders.explain(i, drawn.id[i], drawn.writes[i]) {
            Some(shown) => {
                c.order_undecided += 1;
                match shown {
                    // Its colour hangs on the light, or is not that of a plane; which pixels these are hangs on depths alone.
                    Some(shown) if light.is_some() || allowed.is_some() => {
                        tally.depth(i, if frame.depth_write { shown.z } else { 1.0 })
                    }
                    Some(shown) => tally.triangle(i, if frame.depth_write { shown.z } else { 1.0 }, &shown),
                    None => c.background_wrong += u64::from(!tally.is_background(i, frame.clear)),
                }
            }
            None => c.order_wrong += 1,
        }
        c.compared += u64::from(golden.coverage[i] > 0);
    }
    if let Some(allowed) = allowed {
        c.shaded = Some(allowed.found());
        c.color_bound = None;
        c.color_no_bound = Some("each triangle has that of its terms and tables".to_owned());
    }
    c = finished(c, tally, machine);
    if let Some(light) = light {
        c.color_bound = c.color_bound.map(|bound| light.color_bound(bound));
        c.lit = Some(light.found());
    }
    c
}

/// Every pixel where all depth tests are sure: there all layers must be golden's, and the colour within their bound.
fn blended(
    c: &mut Comparison,
    tally: &mut Tally,
    layers: &Layers,
    frame: &Frame,
    golden: &Raster,
    mut light: Option<&mut Lights>,
) {
    let mut found = Blended::default();
    for i in 0..golden.coverage.len().min(tally.drawn.coverage.len()) {
        c.pixels += 1;
        c.coverage_mismatches += u64::from(golden.coverage[i] != tally.drawn.coverage[i]);
        c.compared += u64::from(golden.coverage[i] > 0);
        if layers.open[i] {
            c.order_undecided += 1;
        } else if (golden.id[i], golden.writes[i]) != (tally.drawn.id[i], tally.drawn.writes[i]) {
            c.order_wrong += 1;
        } else if golden.id[i] >= 0 {
            let alike = light.as_mut().is_none_or(|light| {
                if layers.loose[i] {
                    light.loose();
                }
                light.decided(i, golden, tally.drawn, Some(layers.last[i])) && !layers.loose[i]
            });
            if alike {
                tally.triangle(i, golden.z[i], &Over::golden(golden, i));
            } else {
                tally.depth(i, golden.z[i]); // the colour may be another
            }
            let error = tally.color_error(golden.rgb[i], i);
            found.pixels += 1;
            found.layers = found.layers.max(layers.stored[i]);
            found.bound = found.bound.max(layers.bound[i]);
            found.of_bound = found.of_bound.max(error / layers.bound[i]);
            found.beyond += u64::from(error.is_nan() || error > layers.bound[i] + 1e-9);
        } else if golden.z[i] == 1.0 {
            c.background_wrong += u64::from(!tally.is_background(i, frame.clear));
        } else {
            c.background_wrong += u64::from(!tally.depth_only(i, golden.z[i], frame.clear));
        }
    }
    c.blended = Some(found);
    c.color_bound = None;
    c.color_no_bound = Some("each pixel has that of its layers".to_owned());
}

/// The same with what all pixels together come to.
fn finished(mut c: Comparison, tally: Tally, machine: &Plan) -> Comparison {
    c.wrapped = tally.wrapped;
    c.extra = tally.extra.into_iter().map(|errors| ExtraError::of(errors, machine)).collect();
    (c.z_error, c.z_spread, c.z_map) = tally.z.found();
    (c.color_error, c.color_spread, c.color_map) = tally.color.found();
    c
}

impl Comparison {
    /// With what is proved for these triangles: there are no more additions behind any of their pixels.
    fn reaching(mut self, machine: &Plan, reach: &Reach) -> Self {
        let channels = machine.channels();
        self.additions = Some(reach.steps.total());
        self.z_bound_for_input = reach.bound(machine, &channels[0]);
        // Under a light the gate's part comes on top of it; what is shaded has its own.
        let color = reach.bound(machine, &channels[1]);
        self.color_bound_for_input = color.filter(|_| self.lit.is_none() && self.shaded.is_none());
        for (own, channel) in self.extra.iter_mut().zip(extra::channels(machine)) {
            own.bound_for_input = reach.bound(machine, channel);
            own.allowed = own.bound_for_input.unwrap_or(own.allowed);
        }
        self
    }

    /// Without the errors of every pixel.
    #[must_use]
    pub fn without_maps(self) -> Self {
        Comparison { z_map: Vec::new(), color_map: Vec::new(), ..self }
    }

    /// Pass only if all of the screen and all that golden covers was compared, every coverage and order agrees, nothing
    /// wrapped, every cycle has its cause, and every error is within its bound; where none is proved, within 1 LSB (of a floor
    /// 1 1/2).
    pub fn verdict(&self) -> Verdict {
        let beyond = |error: f64, bound: Option<f64>| {
            let allowed = bound.unwrap_or(1.0);
            u64::from(error.is_nan() || error > allowed)
        };
        let wrong = self.coverage_mismatches
            + self.order_wrong
            + self.background_wrong
            + self.wrapped
            + self.cycles_unexplained
            + beyond(self.z_error, self.z_bound_for_input.or(self.z_bound))
            + match (self.blended, self.shaded) {
                (Some(blended), _) => blended.beyond,
                (None, Some(shaded)) => shaded.beyond,
                (None, None) => beyond(self.color_error, self.color_bound_for_input.or(self.color_bound)),
            }
            + self.lit.map_or(0, |lit| lit.unexplained)
            + self.shaded.and_then(|shaded| shaded.texels).map_or(0, |texels| texels.unexplained)
            + self.extra.iter().map(|own| beyond(own.error, Some(own.allowed))).sum::<u64>();
        Verdict::of(self.compared, self.covered, wrong).and(Verdict::of(self.pixels, self.screen, wrong))
    }
}
