//! The errors of each channel, their bounds, and which outputs wrapped.

use super::order::Over;
use crate::verdict::{ROUNDING, within};
use edgewalk_golden::dither::Dither;
use edgewalk_host::extra::{self, Label, OwnChannel};
use edgewalk_host::polygon::defects;
use edgewalk_host::raster::Raster;
use edgewalk_machine::{Channel, ErrorBudget, NoBound, Plan};
use edgewalk_scene::Frame;
use serde::Serialize;
use serde::ser::{SerializeMap as _, Serializer};

/// Errors found so far. Places are those in the band that is compared.
pub struct Tally {
    /// Depth.
    pub z: Errors,
    /// Colour, the worst of three.
    pub color: Errors,
    /// Channels of the user's own.
    pub extra: Vec<Errors>,
    /// Pixels where any wrapped.
    pub wrapped: u64,
    /// Largest stored colour.
    most: f64,
    /// The cleared colour.
    clear: [f64; 3],
    /// Some pass stores depths without colours.
    depth_alone: bool,
    /// With DITHER.
    pattern: Option<Pattern>,
    /// Colours that DITHER makes of none within the bound at their pixels.
    pub off_pattern: u64,
}

/// Errors of a channel found so far, LSB.
pub struct Errors {
    channel: Channel,
    /// LSB that a 1 of the pictures stands for.
    unit: f64,
    /// Of a colour, LSB: the step by which DITHER rounds it; else 0.
    pub step: f64,
    /// Of the frame's polygons, LSB: how far their planes lie from values along their edges.
    defect: f64,
    budget: Result<ErrorBudget, NoBound>,
    largest: f64,
    sums: Sums,
    /// Of every pixel of the band.
    map: Vec<f64>,
}

/// Values compared so far, and what is kept of them. A picture may have more than memory holds.
struct Sums {
    count: u64,
    /// Of drawn less exact.
    signed: f64,
    magnitude: f64,
    /// The largest magnitudes, among them all that 99 of 100 do not reach.
    top: Vec<f64>,
    /// Of `top`, as many count as 1 of 100 of all the values that there may be.
    room: usize,
}

/// What DITHER may store at a pixel.
struct Pattern {
    dither: Dither,
    width: usize,
    /// Proved bound of a colour before it is rounded to fewer bits, LSB.
    bound: f64,
}

impl Pattern {
    /// None without DITHER, or where no bound is proved.
    fn of(machine: &Plan, defect: f64) -> Option<Pattern> {
        let bound = machine.proved_budget(&machine.channels()[1]).ok()?.after_rounding().to_f64() + defect;
        let dither = Dither { bits: machine.color.bits, left: machine.stored_color().bits };
        machine.dither.rounds().then_some(Pattern { dither, width: machine.width as usize, bound })
    }
}

/// How the errors of a channel are spread over all values compared, LSB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Mean magnitude.
    pub mean: f64,
    /// 99 of 100 values err by no more.
    pub p99: f64,
    /// Mean of drawn less exact.
    pub bias: f64,
}

impl Tally {
    /// Nothing found yet.
    pub fn new(machine: &Plan, frame: &Frame) -> Self {
        let defects = defects(frame, machine);
        let screen = machine.width as usize * machine.height as usize;
        let errors = |place: usize, unit: f64| Errors {
            channel: machine.channels()[place],
            unit,
            defect: defects[place],
            step: if place == 1 { machine.dither_step() } else { 0.0 },
            budget: machine.proved_budget(&machine.channels()[place]),
            largest: 0.0,
            sums: Sums::new(3 * screen),
            map: Vec::new(),
        };
        let of_unit = |place: usize| errors(place, machine.channels()[place].max() as f64);
        Tally {
            z: of_unit(0),
            color: of_unit(1),
            extra: (0..extra::channels(machine).len()).map(|own| errors(extra::BEFORE + own, 1.0)).collect(),
            wrapped: 0,
            most: machine.stored_color().max() as f64,
            clear: frame.clear,
            depth_alone: frame
                .passes()
                .iter()
                .any(|pass| pass.state.stores_depth() && !pass.state.color_write),
            pattern: Pattern::of(machine, defects[1]),
            off_pattern: 0,
        }
    }

    /// The next band, of so many pixels.
    pub fn begin(&mut self, pixels: usize) {
        for errors in [&mut self.z, &mut self.color].into_iter().chain(&mut self.extra) {
            errors.map.clear();
            errors.map.resize(pixels, 0.0);
        }
    }

    /// Pixel `i` shows this triangle; the depth stored there should be `z`.
    pub fn triangle(&mut self, i: usize, z: f64, shown: &Over, drawn: &Raster) {
        let mut wrapped = self.z.add(i, z, drawn.z[i]);
        for (exact, drawn) in shown.rgb.into_iter().zip(drawn.rgb[i]) {
            wrapped |= self.color.add(i, exact, drawn);
        }
        for ((errors, exact), drawn) in self.extra.iter_mut().zip(shown.extra).zip(&drawn.extra) {
            wrapped |= errors.add(i, exact, drawn.at(i));
        }
        self.wrapped += u64::from(wrapped);
    }

    /// Counts the colours of pixel `i`, which is pixel `place` of the screen, that DITHER makes of none within the bound.
    pub fn on_pattern(&mut self, i: usize, place: usize, exact: [f64; 3], drawn: &Raster) {
        let Some(Pattern { dither, width, bound }) = &self.pattern else { return };
        let at = [place % width, place / width].map(|c| c as u32);
        for (exact, drawn) in exact.into_iter().zip(drawn.rgb[i]) {
            let explained =
                dither.explains(dither.nearest(drawn), exact * self.color.unit, bound + ROUNDING, at);
            self.off_pattern += u64::from(!explained);
        }
    }

    /// How far the colour of pixel `i` is from this one, LSB.
    pub fn color_error(&self, exact: [f64; 3], i: usize, drawn: &Raster) -> f64 {
        let off = exact.into_iter().zip(drawn.rgb[i]).map(|(exact, drawn)| (exact - drawn).abs());
        off.fold(0.0, worse) * self.color.unit
    }

    /// Of pixel `i` only the depth counts.
    pub fn depth(&mut self, i: usize, z: f64, drawn: &Raster) {
        self.wrapped += u64::from(self.z.add(i, z, drawn.z[i]));
    }

    /// Whether pixel `i` has the cleared depth, to the nearest LSB the cleared colour, and 0 in the user's own channels.
    pub fn is_background(&self, i: usize, drawn: &Raster) -> bool {
        drawn.z[i] == 1.0 && self.is_clear(i, drawn)
    }

    /// Like `is_background`, of a pixel without a colour in golden's picture. Where depths alone may be stored, the depth is
    /// compared with golden's.
    pub fn is_uncolored(&mut self, i: usize, golden: &Raster, drawn: &Raster) -> bool {
        if !self.depth_alone || golden.coverage[i] == 0 {
            return self.is_background(i, drawn);
        }
        self.depth(i, golden.z[i], drawn);
        self.is_clear(i, drawn)
    }

    fn is_clear(&self, i: usize, drawn: &Raster) -> bool {
        let half = 0.5 + ROUNDING; // the division by 2^b - 1 rounds
        let near = |(exact, drawn): (f64, f64)| (exact - drawn).abs() * self.most <= half;
        let own = drawn.extra.iter().all(|values| values.at(i) == 0.0);
        own && self.clear.into_iter().zip(drawn.rgb[i]).all(near)
    }
}

impl Errors {
    /// Takes in a value that should be `exact`, both as pictures have them; returns whether it wrapped.
    fn add(&mut self, i: usize, exact: f64, drawn: f64) -> bool {
        let signed = (drawn - exact) * self.unit;
        let error = signed.abs();
        self.sums.add(signed);
        self.largest = worse(self.largest, error);
        self.map[i] = worse(self.map[i], error);
        // An output that stayed in its range is nearer to the exact value than half the range, one that wrapped is not.
        error > 0.5 * (self.channel.max() + 1) as f64
    }

    /// Of every pixel of the band.
    pub fn map(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.map)
    }

    /// What was found, with the proved largest error of the output: vertex rounding, all additions, output rounding (bounds 2, 4), and
    /// the step of DITHER (bound 18), and how far polygons are from planes.
    pub fn found(self) -> ChannelError {
        let beside = self.step + self.defect;
        ChannelError {
            bits: self.channel.bits,
            beside,
            error: self.largest,
            spread: self.sums.spread(),
            bound: self.budget.map(|budget| budget.after_rounding().to_f64() + beside).ok(),
            no_bound: self.budget.err().map(|why| why.to_string()),
            bound_for_input: None,
            map: Vec::new(),
        }
    }
}

/// What was found of a channel.
#[derive(Clone, Debug)]
pub struct ChannelError {
    /// Of the output.
    bits: u32,
    /// What is allowed beside the bound of vertices, additions and rounding: the step of DITHER, and how far polygons are from
    /// planes, LSB.
    pub(super) beside: f64,
    /// Largest error, LSB.
    pub error: f64,
    /// How the errors are spread.
    pub spread: Spread,
    /// Proved bound of the error, LSB; none where outputs may wrap.
    pub bound: Option<f64>,
    /// Why there is none.
    pub no_bound: Option<String>,
    /// Proved bound of the error for these triangles, LSB.
    pub bound_for_input: Option<f64>,
    /// Error of every pixel, LSB; empty where it was not kept.
    pub map: Vec<f64>,
}

impl ChannelError {
    /// The bound is not one for all pixels, but as said here.
    pub(super) fn bounded_elsewhere(&mut self, why: &str) {
        (self.bound, self.no_bound) = (None, Some(why.to_owned()));
    }

    /// 1 where the error exceeds its bound, or where none is proved an LSB.
    pub(super) fn beyond(&self) -> u64 {
        beyond(self.error, self.bound_for_input.or(self.bound).unwrap_or(1.0 + self.beside))
    }

    fn line(&self, name: &str) -> String {
        let bound = extra::bound(self.bound, &self.no_bound);
        format!("largest {name:<13} {:.4} LSB of {} bits, {bound}\n", self.error, self.bits)
    }
}

fn beyond(error: f64, allowed: f64) -> u64 {
    u64::from(!within(error, allowed))
}

/// Depth, and colour as the worst of red, green and blue.
#[derive(Clone, Debug)]
pub struct DepthAndColor {
    /// The most additions behind a pixel of these triangles.
    pub additions: Option<u64>,
    /// Depth.
    pub z: ChannelError,
    /// Colour.
    pub color: ChannelError,
}

impl Serialize for DepthAndColor {
    /// Each figure of both, one after the other.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let DepthAndColor { additions, z, color } = self;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("z_error", &z.error)?;
        map.serialize_entry("color_error", &color.error)?;
        map.serialize_entry("z_spread", &z.spread)?;
        map.serialize_entry("color_spread", &color.spread)?;
        map.serialize_entry("z_bound", &z.bound)?;
        map.serialize_entry("color_bound", &color.bound)?;
        map.serialize_entry("additions", additions)?;
        map.serialize_entry("z_bound_for_input", &z.bound_for_input)?;
        map.serialize_entry("color_bound_for_input", &color.bound_for_input)?;
        for (key, why) in [("z_no_bound", &z.no_bound), ("color_no_bound", &color.no_bound)] {
            why.as_ref().map_or(Ok(()), |why| map.serialize_entry(key, why))?;
        }
        map.end()
    }
}

impl DepthAndColor {
    /// As lines of text.
    pub(super) fn lines(&self) -> String {
        let t = self.z.line("z error") + &self.color.line("colour error");
        let Some(additions) = self.additions else { return t };
        let of = |bound: Option<f64>| bound.map_or_else(|| "none".to_owned(), |b| format!("{b:.4}"));
        let [z, color] = [&self.z, &self.color].map(|channel| of(channel.bound_for_input));
        t + &format!("bounds for these triangles, at most {additions} additions: z {z}, colour {color}\n")
    }
}

impl Sums {
    /// Of at most so many values.
    fn new(most: usize) -> Self {
        Sums { count: 0, signed: -0.0, magnitude: -0.0, top: Vec::new(), room: most / 100 + 1 }
    }

    fn add(&mut self, signed: f64) {
        self.count += 1;
        self.signed += signed;
        self.magnitude += signed.abs();
        self.top.push(signed.abs());
        if self.top.len() >= 2 * self.room + 1024 {
            self.top.select_nth_unstable_by(self.room, |a, b| b.total_cmp(a));
            self.top.truncate(self.room);
        }
    }

    fn spread(mut self) -> Spread {
        if self.count == 0 {
            return Spread::default();
        }
        let count = self.count as f64;
        // So many of 100 are larger; that many have been kept, and one more.
        let above = (self.count - (self.count * 99).div_ceil(100)) as usize;
        let (_, p99, _) = self.top.select_nth_unstable_by(above, |a, b| b.total_cmp(a));
        Spread { mean: self.magnitude / count, p99: *p99, bias: self.signed / count }
    }
}

/// What was found of a channel of the user's own.
#[derive(Clone, Debug, Serialize)]
pub struct ExtraError {
    /// Which, and what is proved of it.
    #[serde(flatten)]
    pub channel: OwnChannel,
    /// Largest error, LSB.
    pub error: f64,
    /// How the errors are spread.
    #[serde(flatten)]
    pub spread: Spread,
    /// Proved bound of the error for these triangles, LSB; none where outputs may wrap.
    pub bound_for_input: Option<f64>,
    /// More is wrong, LSB: the bound, and where none is proved the output rounding and half an LSB.
    #[serde(skip)]
    pub allowed: f64,
}

impl ExtraError {
    /// Of a channel after all pixels.
    pub fn of(errors: Errors, machine: &Plan) -> Self {
        let channel = OwnChannel::of(&errors.channel, machine);
        let rounding = if errors.channel.kind.is_rounded() { 0.5 } else { 1.0 };
        let allowed = channel.bound.unwrap_or(rounding + 0.5);
        let ChannelError { error, spread, .. } = errors.found();
        ExtraError { channel, error, spread, bound_for_input: None, allowed }
    }

    /// 1 where the error exceeds what is allowed.
    pub(super) fn beyond(&self) -> u64 {
        beyond(self.error, self.allowed)
    }

    /// As a line of text.
    pub(super) fn line(&self) -> String {
        let (of, Label { name, bits, kind, .. }) = (&self.channel, &self.channel.label);
        let bound = extra::bound(of.bound, &of.no_bound);
        format!("largest {name} error      {:.4} LSB of {bits} bits, {kind}, {bound}\n", self.error)
    }
}

/// The larger of two errors; NaN is the largest.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::Sums;

    /// Beside all values sorted, for every count across the places where the kept ones are cut.
    #[test]
    fn kept_errors_give_the_spread_of_all() {
        let mut state = 1u64;
        let mut all: Vec<f64> = Vec::new();
        let mut sums = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 40) as f64 / 1e6 - 8.0).powi(3)
        };
        for count in [1, 2, 99, 100, 101, 1023, 1024, 5000, 20_000] {
            all.resize_with(count, &mut sums);
            let mut kept = Sums::new(20_000);
            all.iter().for_each(|error| kept.add(*error));
            let found = kept.spread();
            let mut sorted: Vec<f64> = all.iter().map(|error| error.abs()).collect();
            let mean = sorted.iter().sum::<f64>() / count as f64;
            sorted.sort_by(f64::total_cmp);
            assert_eq!(found.p99, sorted[(count * 99).div_ceil(100) - 1], "{count}");
            assert_eq!((found.mean, found.bias), (mean, all.iter().sum::<f64>() / count as f64), "{count}");
        }
    }
}
