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
use crate::verdict::{Verdict, within};
use channel::Tally;
pub use channel::{ChannelError, DepthAndColor, ExtraError, Spread};
pub use counts::Counts;
use edgewalk_host::extra;
use edgewalk_host::raster::{Cycles, Raster, golden_drawing};
use edgewalk_host::reach::Reach;
use edgewalk_host::shade::Proof;
use edgewalk_machine::Plan;
use edgewalk_scene::{Blending, Frame};
pub(crate) use layers::Layers;
pub use layers::{Blended, Errors};
pub(crate) use lit::gated;
pub use lit::{Lights, Lit, Seen};
use lit::{behind_gate, is_lit};
use order::Orders;
pub(crate) use order::{Apart, Over, all_over};
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

/// Compares the pictures of `frame`, whose polygons POLY draws, with what is proved of the machine alone.
#[must_use]
pub fn compare(machine: &Plan, frame: &Frame, golden: &Raster, drawn: &Raster) -> Comparison {
    compare_for(machine, frame, golden, drawn, None)
}

/// Like `compare`, with what is proved for these triangles, where it is known how far they reach.
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

/// Like `compare_for`, of a frame that is shaded at each pixel, with what is proved of its colours.
#[must_use]
pub fn compare_shaded(
    machine: &Plan,
    frame: &Frame,
    golden: &Raster,
    drawn: &Raster,
    reach: Option<&Reach>,
    proof: Option<&Proof>,
) -> Comparison {
    let c = compared(machine, frame, golden, drawn, reach, proof);
    match reach {
        Some(reach) => c.reaching(machine, frame, reach),
        None => c,
    }
}

/// The bounds of depth and of colour that [`Comparison`] will have for the triangles of `frame`, LSB; none where none is proved.
#[must_use]
pub fn bounds_for_input(machine: &Plan, frame: &Frame, reach: &Reach) -> [Option<f64>; 2] {
    let Tally { z, color, .. } = Tally::new(machine, frame);
    for_input(machine, frame, reach, [z.found().beside, color.found().beside])
}

/// Bounds of depth and of colour, LSB: that of the additions plus `beside`, which holds the errors of other units. The colour bound
/// of a lit frame has the error of the gate. Of layers, and where SHADE makes the colours, it is none: each pixel has its own.
fn for_input(machine: &Plan, frame: &Frame, reach: &Reach, beside: [f64; 2]) -> [Option<f64>; 2] {
    let [z, color] =
        [0, 1].map(|place| Some(reach.bound(machine, &machine.channels()[place])? + beside[place]));
    let lit = is_lit(frame);
    let color = color.filter(|_| frame.shading.is_none() && !Layers::lie_in(machine, frame, lit));
    [z, if lit { color.map(|bound| behind_gate(machine, frame, bound)) } else { color }]
}

fn compared(
    machine: &Plan,
    frame: &Frame,
    golden: &Raster,
    drawn: &Raster,
    reach: Option<&Reach>,
    proof: Option<&Proof>,
) -> Comparison {
    let mut light = Lights::drawn(machine, frame, drawn, reach);
    let drawing = golden_drawing(frame, machine);
    if let Some(layers) = Layers::of(machine, frame, &drawing, light.as_mut(), proof, reach) {
        let mut tally = Tally::new(machine, frame);
        let mut counts = Counts::new(machine, drawn.cycles.as_ref());
        let found = blended(&mut counts, &mut tally, &layers, (golden, drawn), light.as_mut());
        let maps = [tally.z.map(), tally.color.map()];
        let mut c = Comparison::of(machine, counts, tally);
        c.errors.color.bounded_elsewhere("each pixel has that of its layers");
        return Comparison { blended: Some(found), lit: light.map(Lights::found), ..c }.with_maps(maps);
    }
    let allowed = frame.shading.as_ref().zip(proof);
    let allowed = allowed.map(|(shading, proof)| Allowed::new(machine, frame, shading, golden, proof));
    let mut bands = Bands { light, allowed, ..Bands::new(machine, frame, drawn.cycles.as_ref(), reach) };
    let maps = bands.add(golden, drawn);
    bands.ended().with_maps(maps)
}

/// Two pictures compared from the top, a band of lines at a time: neither need be in memory as a whole.
pub struct Bands<'a> {
    machine: &'a Plan,
    frame: &'a Frame,
    reach: Option<&'a Reach>,
    counts: Counts,
    tally: Tally,
    /// Of a picture that is one band.
    light: Option<Lights<'a>>,
    /// Likewise.
    allowed: Option<Allowed<'a>>,
}

impl<'a> Bands<'a> {
    /// Whether the comparison of a frame can go by bands: where it is blended, lit or shaded at each pixel it needs the whole picture.
    #[must_use]
    pub fn suit(frame: &Frame) -> bool {
        let plain = frame.shadows.is_empty() && frame.shading.is_none();
        plain && matches!(&frame.passes()[..], [pass] if pass.state.blend == Blending::Off)
    }

    /// Nothing compared yet of a frame that [suits](Bands::suit) and its picture, which took the machine so many cycles.
    #[must_use]
    pub fn new(
        machine: &'a Plan,
        frame: &'a Frame,
        cycles: Option<&Cycles>,
        reach: Option<&'a Reach>,
    ) -> Self {
        let (counts, tally) = (Counts::new(machine, cycles), Tally::new(machine, frame));
        Bands { machine, frame, reach, counts, tally, light: None, allowed: None }
    }

    /// Compares the next lines; gives the errors of depth and of colour of each of their pixels, LSB.
    pub fn add(&mut self, golden: &Raster, drawn: &Raster) -> [Vec<f64>; 2] {
        let Bands { machine, frame, reach, counts: c, tally, light, allowed } = self;
        let first = c.pixels as usize;
        tally.begin(golden.coverage.len());
        c.covered += golden.coverage.iter().map(|count| u64::from(*count > 0)).sum::<u64>();
        let mut differ = Vec::new();
        for i in 0..golden.coverage.len().min(drawn.coverage.len()) {
            c.covers(golden.coverage[i], drawn.coverage[i]);
            let writes_agree = drawn.written_once || golden.writes[i] == drawn.writes[i];
            if golden.id[i] != drawn.id[i] || !writes_agree {
                differ.push(first + i);
                continue;
            }
            if golden.id[i] >= 0 {
                let agrees = light.as_mut().is_none_or(|light| light.agrees(i, golden, drawn));
                let mut over = Over::golden(golden, i);
                if let Some(allowed) = allowed {
                    let one = machine.color.max() as f64;
                    over.rgb = allowed.at(i, golden.id[i], golden.rgb[i], drawn.rgb[i], one);
                }
                if agrees {
                    tally.triangle(i, golden.z[i], &over, drawn);
                    if light.is_none() && allowed.is_none() {
                        tally.on_pattern(i, first + i, over.rgb, drawn);
                    }
                } else {
                    tally.depth(i, golden.z[i], drawn); // the colour is another
                }
            } else {
                c.background_wrong += u64::from(!tally.is_uncolored(i, golden, drawn));
            }
            c.compared += u64::from(golden.coverage[i] > 0);
        }
        // The colour of these hangs on the light, or is not that of a plane; which pixels these are hangs on depths alone.
        let depth_alone = light.is_some() || allowed.is_some();
        let stored = |shown: &Over| if frame.depth_write { shown.z } else { 1.0 };
        let orders = Orders::new(machine, frame, &differ, *reach);
        for pixel in differ {
            let i = pixel - first;
            match orders.explain(pixel, drawn.id[i], drawn.writes[i]) {
                Some(shown) => {
                    c.order_undecided += 1;
                    match shown {
                        Some(shown) if depth_alone => tally.depth(i, stored(&shown), drawn),
                        Some(shown) => tally.triangle(i, stored(&shown), &shown, drawn),
                        None => c.background_wrong += u64::from(!tally.is_background(i, drawn)),
                    }
                }
                None => c.order_wrong += 1,
            }
            c.compared += u64::from(golden.coverage[i] > 0);
        }
        [tally.z.map(), tally.color.map()]
    }

    /// What all lines together come to, without the errors of every pixel.
    #[must_use]
    pub fn found(self) -> Comparison {
        let (machine, frame, reach) = (self.machine, self.frame, self.reach);
        let c = self.ended();
        match reach {
            Some(reach) => c.reaching(machine, frame, reach),
            None => c,
        }
    }

    fn ended(self) -> Comparison {
        let Bands { machine, frame, counts, tally, light, allowed, .. } = self;
        let mut c = Comparison::of(machine, counts, tally);
        if let Some(allowed) = allowed {
            c.shaded = Some(allowed.found());
            c.errors.color.bounded_elsewhere("each triangle has that of its terms and tables");
        }
        if let Some(light) = light {
            c.errors.color.bound = c.errors.color.bound.map(|bound| behind_gate(machine, frame, bound));
            c.lit = Some(light.found());
        }
        c
    }
}

/// Every pixel where all depth tests are sure: there all layers must be golden's, and the colour within their bound.
fn blended(
    c: &mut Counts,
    tally: &mut Tally,
    layers: &Layers,
    (golden, drawn): (&Raster, &Raster),
    mut light: Option<&mut Lights>,
) -> Blended {
    let mut found = Blended { no_bound: layers.no_bound, ..Blended::default() };
    tally.begin(golden.coverage.len());
    c.covered = golden.coverage.iter().map(|count| u64::from(*count > 0)).sum();
    for i in 0..golden.coverage.len().min(drawn.coverage.len()) {
        c.covers(golden.coverage[i], drawn.coverage[i]);
        c.compared += u64::from(golden.coverage[i] > 0 && !layers.open[i]);
        if layers.open[i] {
            c.order_undecided += 1;
        } else if (golden.id[i], golden.writes[i]) != (drawn.id[i], drawn.writes[i]) {
            c.order_wrong += 1;
        } else if golden.id[i] >= 0 {
            let alike = light.as_mut().is_none_or(|light| {
                if layers.loose[i] {
                    light.loose();
                }
                light.decided(i, golden, drawn, Some(layers.last[i])) && !layers.loose[i]
            });
            if alike && !layers.branches[i] {
                tally.triangle(i, golden.z[i], &Over::golden(golden, i), drawn);
            } else {
                tally.depth(i, golden.z[i], drawn); // the colour may be another
            }
            let error = tally.color_error(golden.rgb[i], i, drawn);
            found.pixels += 1;
            found.layers = found.layers.max(layers.stored[i]);
            let bound = layers.bound[i] + tally.color.step;
            found.allowed = found.allowed.max(bound);
            found.of_bound = found.of_bound.max(error / bound);
            found.beyond += u64::from(!within(error, bound));
        } else {
            c.background_wrong += u64::from(!tally.is_uncolored(i, golden, drawn));
        }
    }
    found.bound = found.no_bound.is_none().then_some(found.allowed);
    found
}

impl Comparison {
    /// What all pixels together come to.
    fn of(machine: &Plan, counts: Counts, tally: Tally) -> Self {
        let off_pattern = machine.dither.rounds().then_some(tally.off_pattern);
        Comparison {
            counts: Counts { wrapped: tally.wrapped, off_pattern, ..counts },
            errors: DepthAndColor { additions: None, z: tally.z.found(), color: tally.color.found() },
            blended: None,
            lit: None,
            shaded: None,
            extra: tally.extra.into_iter().map(|errors| ExtraError::of(errors, machine)).collect(),
        }
    }

    /// With the errors of depth and colour of every pixel.
    fn with_maps(mut self, maps: [Vec<f64>; 2]) -> Self {
        [self.errors.z.map, self.errors.color.map] = maps;
        self
    }

    /// With what is proved for these triangles: there are no more additions behind any of their pixels.
    fn reaching(mut self, machine: &Plan, frame: &Frame, reach: &Reach) -> Self {
        self.errors.additions = Some(reach.steps.total());
        let beside = [self.errors.z.beside, self.errors.color.beside];
        [self.errors.z.bound_for_input, self.errors.color.bound_for_input] =
            for_input(machine, frame, reach, beside);
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
    /// 1 1/2). Of layers the pixels with an open depth test are left out; where no other is covered, nothing was compared.
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
        let Counts { compared, covered, pixels, screen, order_undecided, .. } = self.counts;
        let open = self.blended.map_or(0, |_| order_undecided);
        if wrong == 0 && open > 0 && open == covered {
            return Verdict::Open;
        }
        Verdict::of(compared, covered.saturating_sub(open), wrong).and(Verdict::of(pixels, screen, wrong))
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
