//! A machine's picture against the golden one, pixel by pixel.
//!
//! ```text
//!  golden ─┐                  same triangle, same writes ──> every channel: error, wrapped? ─────┐
//!          ├─> coverage ─> ?                                                                    ├─> Comparison ─> verdict
//!  machine ┘                  another triangle or count ──> is there an order of depths within ─┘
//!                                                           the bound (bound 7) that explains it?
//! ```
//! Errors are against the exact plane through the unquantised vertices, in LSB of the machine's output.

mod counts;
mod channel;
mod order;
mod layers;
mod lit;
#[cfg(test)]
mod tests;

use crate::shaded::{Allowed, Shaded};
use crate::verdict::Verdict;
use channel::Tally;
pub use channel::{ChannelError, DepthAndColor, ExtraError, Spread};
pub use counts::Counts;
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
    /// Pixels compared, and those that are wrong.
    #[serde(flatten)]
    pub counts: Counts,
    /// Errors of depth and colour, with their bounds.
    #[serde(flatten)]
    pub errors: DepthAndColor,
    /// Of a blended picture, whose colours have a bound at each pixel in place of that of `errors`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blended: Option<Blended>,
    /// Of a picture under a light.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lit: Option<Lit>,
    /// Of a picture shaded at each pixel, whose colours have the bound of their triangle in place of that of `errors`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaded: Option<Shaded>,
    /// Channels of the user's own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<ExtraError>,
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
    let mut counts = Counts::new(machine, golden, drawn);
    let mut light = Lights::drawn(machine, frame, drawn, reach);
    let layers = Layers::of(machine, frame, light.as_mut());
    let blended = match &layers {
        Some(layers) => Some(each_layered(&mut counts, &mut tally, layers, frame, golden, light.as_mut())),
        None => {
            each_pixel(
                (machine, frame, golden),
                &mut counts,
                &mut tally,
                reach,
                (light.as_mut(), allowed.as_mut()),
            );
            None
        }
    };
    let shaded = allowed.filter(|_| blended.is_none()).map(Allowed::found);
    counts.wrapped = tally.wrapped;
    let mut errors = DepthAndColor { additions: None, z: tally.z.found(), color: tally.color.found() };
    if let Some(light) = &light {
        errors.color.bound = errors.color.bound.map(|bound| light.color_bound(bound));
    }
    if blended.is_some() {
        errors.color.bounded_elsewhere("each pixel has that of its layers");
    } else if shaded.is_some() {
        errors.color.bounded_elsewhere("each triangle has that of its terms and tables");
    }
    let extra = tally.extra.into_iter().map(|errors| ExtraError::of(errors, machine)).collect();
    Comparison { counts, errors, blended, lit: light.map(Lights::found), shaded, extra }
}

/// Every pixel of a picture without layers: it shows one fragment as it is, or as a light leaves it.
fn each_pixel(
    (machine, frame, golden): (&Plan, &Frame, &Raster),
    c: &mut Counts,
    tally: &mut Tally,
    reach: Option<&Reach>,
    (mut light, mut allowed): (Option<&mut Lights>, Option<&mut Allowed>),
) {
    let drawn = tally.drawn;
    let mut differ = Vec::new();
    for i in 0..golden.coverage.len().min(drawn.coverage.len()) {
        c.covers(golden.coverage[i], drawn.coverage[i]);
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
    // The colour of these hangs on the light, or is not that of a plane; which pixels these are hangs on depths alone.
    let depth_alone = light.is_some() || allowed.is_some();
    let orders = Orders::new(machine, frame, &differ, reach);
    for i in differ {
        let stored = |shown: &Over| if frame.depth_write { shown.z } else { 1.0 };
        match orders.explain(i, drawn.id[i], drawn.writes[i]) {
            Some(shown) => {
                c.order_undecided += 1;
                match shown {
                    Some(shown) if depth_alone => tally.depth(i, stored(&shown)),
                    Some(shown) => tally.triangle(i, stored(&shown), &shown),
                    None => c.background_wrong += u64::from(!tally.is_background(i, frame.clear)),
                }
            }
            None => c.order_wrong += 1,
        }
        c.compared += u64::from(golden.coverage[i] > 0);
    }
}

/// Every pixel where all depth tests are sure: there all layers must be golden's, and the colour within their bound.
fn each_layered(
    c: &mut Counts,
    tally: &mut Tally,
    layers: &Layers,
    frame: &Frame,
    golden: &Raster,
    mut light: Option<&mut Lights>,
) -> Blended {
    let mut found = Blended::default();
    for i in 0..golden.coverage.len().min(tally.drawn.coverage.len()) {
        c.covers(golden.coverage[i], tally.drawn.coverage[i]);
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
    found
}

impl Comparison {
    /// With what is proved for these triangles: there are no more additions behind any of their pixels.
    fn reaching(mut self, machine: &Plan, reach: &Reach) -> Self {
        let channels = machine.channels();
        self.errors.additions = Some(reach.steps.total());
        self.errors.z.bound_for_input = reach.bound(machine, &channels[0]);
        // Under a light the gate's part comes on top of it; what is shaded has its own.
        let color = reach.bound(machine, &channels[1]);
        self.errors.color.bound_for_input = color.filter(|_| self.lit.is_none() && self.shaded.is_none());
        for (own, channel) in self.extra.iter_mut().zip(extra::channels(machine)) {
            own.bound_for_input = reach.bound(machine, channel);
            own.allowed = own.bound_for_input.unwrap_or(own.allowed);
        }
        self
    }

    /// Without the errors of every pixel.
    #[must_use]
    pub fn without_maps(mut self) -> Self {
        self.errors.z.map.clear();
        self.errors.color.map.clear();
        self
    }

    /// Pass only if all of the screen and all that golden covers was compared, every coverage and order agrees, nothing
    /// wrapped, every cycle has its cause, and every error is within its bound; where none is proved, within 1 LSB (of a floor
    /// 1 1/2).
    pub fn verdict(&self) -> Verdict {
        let color = match (self.blended, self.shaded) {
            (Some(blended), _) => blended.beyond,
            (None, Some(shaded)) => shaded.beyond,
            (None, None) => self.errors.color.beyond(),
        };
        let wrong = self.counts.wrong()
            + self.errors.z.beyond()
            + color
            + self.lit.map_or(0, |lit| lit.unexplained)
            + self.shaded.and_then(|shaded| shaded.texels).map_or(0, |texels| texels.unexplained)
            + self.extra.iter().map(ExtraError::beyond).sum::<u64>();
        let Counts { compared, covered, pixels, screen, .. } = self.counts;
        Verdict::of(compared, covered, wrong).and(Verdict::of(pixels, screen, wrong))
    }

    /// As lines of text.
    #[must_use]
    pub fn lines(&self) -> String {
        let mut t = self.counts.lines_of_coverage() + &self.errors.lines();
        t += &self.blended.as_ref().map(Blended::lines).unwrap_or_default();
        t += &self.lit.as_ref().map(Lit::lines).unwrap_or_default();
        t += &self.shaded.as_ref().map(Shaded::lines).unwrap_or_default();
        self.extra.iter().for_each(|own| t += &own.line());
        t + &self.counts.lines_of_order()
    }
}
