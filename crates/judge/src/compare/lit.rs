//! What SHADOW decided at each pixel: is it what the errors of texel and depth allow?
//!
//! ```text
//!  pixel, exact depth ─ matrix ─> X*, Y*, Z' ─┬─ within E of them ─> texels it may have read ─┐
//!                                             └─ within E of Z' ─> lit, or in shadow, or either ┴─> the decision is one of these
//! ```
//! Of a perspective light E is of the pixel: what four interpolated values may err by, over the weight there. Where that is a texel
//! or more the decision is open, and counted as such.
//! The map is the machine's own. Golden's decision is not asked for that, only counted where it differs. Where the map says more than lit or
//! not, and where layers lie over one another, the texels within reach say what share of its colour a fragment may have: the bound of the
//! colour has them all.

use edgewalk_host::light::{ambient, left_error, scale};
use edgewalk_host::raster::Raster;
use edgewalk_host::reach::Reach;
use edgewalk_machine::{Fill, Plan};
use edgewalk_scene::{Frame, Shadow};
use serde::Serialize;

/// What rounding of f64 may hide, texels and LSB.
const SLACK: f64 = 1e-6;

/// What was found of a picture under a light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Lit {
    /// Pixels whose decision was explained or not: all that show the triangle that golden shows.
    pub pixels: u64,
    /// Compared pixels in shadow.
    pub shadow: u64,
    /// Compared pixels that golden decides otherwise.
    pub differ: u64,
    /// Differing pixels for which neither texel nor depth within their bounds gives the decision.
    pub unexplained: u64,
    /// Pixels for which nothing is proved, as a texel may be off by one or more.
    pub open: u64,
    /// Of a picture whose colours are bounded layer by layer: those where a layer may have one of several shares of its colour, an LSB or
    /// more apart.
    pub loose: u64,
    /// How far a texel may be off, texels: of a perspective light the most of any pixel that is not open.
    pub texel_bound: f64,
    /// How far a depth may be off before it is rounded, LSB of the map; likewise.
    pub depth_bound: f64,
}

impl Lit {
    /// As lines of text.
    pub(super) fn lines(&self) -> String {
        let Lit { pixels, shadow, differ, unexplained, open, loose, texel_bound, depth_bound } = self;
        let mut t = format!(
            "light: {pixels} pixels, {shadow} in shadow, {differ} decided otherwise than golden; {open} of {pixels} open; unexplained by texels within {texel_bound:.4} and depths within {depth_bound:.4} LSB: {unexplained}\n"
        );
        if *loose > 0 {
            t +=
                &format!("    {loose} pixels between texels of several shares: their bounds have them all\n");
        }
        t
    }
}

/// What is proved of texel and depth at a pixel.
enum Bounds {
    /// How far they may be off: columns, lines, LSB.
    Proved([f64; 3]),
    /// Nothing has to be: it lies behind the light, or beside the map, and is lit.
    Behind,
    /// Nothing.
    Open,
}

/// What the machine may make of a fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Whether it may be in shadow, and whether lit.
    pub may: [bool; 2],
    /// The smallest and the largest share of its colour that it may have.
    pub shares: [f64; 2],
    /// Nothing is proved.
    pub open: bool,
}

impl Seen {
    /// All of its colour: no light counts, or it lies behind it.
    pub const LIT: Seen = Seen { may: [false, true], shares: [1.0; 2], open: false };
    /// A fragment that has this share of its colour, as golden shows it.
    pub const fn of_share(share: f64) -> Seen {
        Seen { shares: [share; 2], ..Seen::LIT }
    }

    const OPEN: Seen = Seen { may: [true; 2], shares: [0.0, 1.0], open: true };

    /// Another decision that may be.
    fn and(&mut self, lit: bool, share: f64) {
        let first = self.may == [false; 2];
        self.may[usize::from(lit)] = true;
        let [low, high] = self.shares;
        self.shares = if first { [share; 2] } else { [low.min(share), high.max(share)] };
    }

    /// How far the machine's colour may be from golden's, LSB: its own error before the light and `color`, the largest channel of
    /// golden's there, 0 to 1, of which golden shows this share.
    pub fn front(&self, before: f64, color: f64, share: f64, max: f64) -> f64 {
        let of = |own: f64| before * own + color * (own - share).abs() * max;
        let rounded = if self.shares[0] < 1.0 { 0.5 } else { 0.0 };
        of(self.shares[0]).max(of(self.shares[1])) + rounded
    }
}

/// The lights of a frame, and their maps on the machine.
pub struct Lights<'a> {
    machine: &'a Plan,
    frame: &'a Frame,
    /// By their numbers, from 1.
    words: Vec<&'a [u32]>,
    /// How far an interpolated value may be off before it is rounded, LSB of lx and of lz.
    off: [f64; 2],
    found: Lit,
}

impl<'a> Lights<'a> {
    /// `words`: of the map of each light of the frame.
    pub fn of(
        machine: &'a Plan,
        frame: &'a Frame,
        words: Vec<&'a [u32]>,
        reach: Option<&Reach>,
    ) -> Lights<'a> {
        let bound = |name: &str| {
            let channel = machine.channels().iter().find(|channel| channel.name == name)?;
            let budget = match reach {
                Some(reach) => reach.budget(machine, channel),
                None => machine.proved_budget(channel).ok(),
            };
            budget.map(|budget| budget.before_rounding().to_f64())
        };
        // Where nothing is proved, a texel and an LSB.
        let off = ["lx", "lz"].map(|name| bound(name).unwrap_or(1.0));
        let [texel_bound, depth_bound] = if machine.shadow.projects() { [0.0; 2] } else { off };
        let found = Lit { texel_bound, depth_bound, ..Lit::default() };
        Lights { machine, frame, words, off, found }
    }

    /// Like `of`, of what was drawn; `None` where no light counts.
    pub fn drawn(
        machine: &'a Plan,
        frame: &'a Frame,
        drawn: &'a Raster,
        reach: Option<&Reach>,
    ) -> Option<Lights<'a>> {
        if !is_lit(frame) {
            return None;
        }
        let words: Vec<&[u32]> = drawn.lights.iter().map(|pass| &pass.words[..]).collect();
        (words.len() == frame.shadows.len()).then(|| Lights::of(machine, frame, words, reach))
    }

    /// Takes in pixel `i`, which shows the same triangle in both pictures; whether the colours are of the same decision.
    pub fn agrees(&mut self, i: usize, golden: &Raster, drawn: &Raster) -> bool {
        let (width, state) = (golden.width as usize, self.frame.passes()[0].state);
        let point = [(i % width) as f64 + 0.5, (i / width) as f64 + 0.5, golden.z[i]];
        // The stored depth is that of what is seen, or nothing is known of it.
        let seen = state.stores_depth().then(|| self.seen(point, golden.id[i], state.light));
        self.decided(i, golden, drawn, seen)
    }

    /// Takes in what the machine has decided at pixel `i`, given what it may; whether golden has decided alike.
    pub fn decided(&mut self, i: usize, golden: &Raster, drawn: &Raster, seen: Option<Seen>) -> bool {
        let of = |raster: &Raster| raster.lit.as_ref().and_then(|lit| lit.get(i)).map(|lit| *lit == 2);
        let (Some(exact), Some(found)) = (of(golden), of(drawn)) else { return true };
        let differs = exact != found;
        self.found.pixels += 1;
        self.found.shadow += u64::from(!found);
        self.found.differ += u64::from(differs);
        self.found.open += u64::from(seen.is_some_and(|seen| seen.open));
        self.found.unexplained += u64::from(seen.map_or(differs, |seen| !seen.may[usize::from(found)]));
        !differs
    }

    /// Takes in a pixel one of whose layers may have several shares of its colour.
    pub fn loose(&mut self) {
        self.found.loose += 1;
    }

    /// What was found.
    pub fn found(self) -> Lit {
        self.found
    }

    /// What the light with this number may make of a point (pixels and depth) of the triangle at place `id`.
    pub fn seen(&mut self, [x, y, z]: [f64; 3], id: i32, light: usize) -> Seen {
        let Some(shadow) = self.frame.shadow(light) else { return Seen::LIT };
        if self.machine.fill != Fill::Exact {
            return Seen::OPEN;
        }
        let point = [x, y, z, 1.0];
        let [x, y, z, q] = shadow.matrix.map(|row| (0..4).map(|k| row[k] * point[k]).sum::<f64>());
        let far = f64::from((1u32 << self.machine.shadow.depth_bits) - 1);
        let bias = shadow.bias_of(id as usize); // a triangle is there
        let depth = (z / q - bias) * far;
        let [x_bound, y_bound, depth_bound] = match self.bounds(shadow, [x / q, y / q, depth], q, id) {
            Bounds::Proved(bounds) => bounds,
            Bounds::Behind => return Seen::LIT,
            Bounds::Open => return Seen::OPEN,
        };
        let texels = |at: f64, bound: f64| {
            let off = bound + SLACK;
            ((at - off).floor() as i64)..=((at + off).floor() as i64)
        };
        let dark = ambient(shadow, self.machine) as f64 / self.machine.color.max() as f64;
        let before = depth + 0.5; // rounded below 0: nearer than the map, without a look at it
        let mut seen = Seen { may: [false; 2], shares: [1.0; 2], open: false };
        for ty in texels(y / q, y_bound) {
            for tx in texels(x / q, x_bound) {
                let Some((word, left)) = self.word(light, tx, ty) else {
                    seen.and(true, 1.0);
                    continue;
                };
                if before < depth_bound + SLACK {
                    seen.and(true, 1.0);
                }
                // lit: the rounded depth is at most the word.
                let edge = f64::from(word) + 0.5 - depth;
                if edge > -depth_bound - SLACK && before > -depth_bound - SLACK {
                    seen.and(true, left);
                }
                if edge <= depth_bound + SLACK {
                    seen.and(false, dark);
                }
            }
        }
        seen
    }

    /// How far texel and depth of a pixel may be off, given the exact ones, the weight and the triangle.
    fn bounds(&mut self, shadow: &Shadow, [x, y, depth]: [f64; 3], q: f64, id: i32) -> Bounds {
        let [texel, lz] = self.off;
        if !self.machine.shadow.projects() {
            return Bounds::Proved([texel, texel, lz]);
        }
        let place = id as usize; // a triangle is there
        let triangle = self.frame.triangle_at(place);
        let scale = triangle.map(|triangle| scale(shadow, place, &triangle.0, self.machine));
        let Some(Ok(scale)) = scale else { return Bounds::Open };
        // All four values are rounded to nearest.
        let (off, weight) = (texel + 0.5, q * scale);
        if weight <= -off {
            return Bounds::Behind;
        }
        let share = off / (weight - off);
        let keys = &self.machine.shadow;
        let quotient = |bits: u32, value: f64| (f64::from(1u32 << bits) + value.abs()) * share;
        let bounds =
            [quotient(keys.side_bits(), x), quotient(keys.side_bits(), y), quotient(keys.depth_bits, depth)];
        if share < 0.0 || bounds[0].max(bounds[1]) >= 1.0 {
            return if far_outside(shadow, [x, y], &bounds) { Bounds::Behind } else { Bounds::Open };
        }
        self.found.texel_bound = self.found.texel_bound.max(bounds[0].max(bounds[1]));
        self.found.depth_bound = self.found.depth_bound.max(bounds[2]);
        Bounds::Proved(bounds)
    }

    /// What the light's map says of a texel, its depth and the share of the light before it; `None` outside.
    fn word(&self, light: usize, tx: i64, ty: i64) -> Option<(u32, f64)> {
        let side = 0..i64::from(self.machine.shadow.size);
        if !side.contains(&tx) || !side.contains(&ty) {
            return None;
        }
        let word = *self.words.get(light - 1)?.get((ty << self.machine.shadow.side_bits() | tx) as usize)?;
        let (bits, max) = (self.machine.color.bits, self.machine.color.max() as u32); // b <= 16
        match self.machine.shadow.transmits() {
            true => Some((word >> bits, f64::from(word & max) / f64::from(max))),
            false => Some((word, 1.0)),
        }
    }
}

/// The largest error of a colour behind the gate of the frame's lights, LSB, of one that is lit. The share is rounded, and the product.
pub(crate) fn gated(frame: &Frame, lit: f64) -> f64 {
    let ambient = frame.shadows.iter().map(|shadow| shadow.ambient).fold(0.0, f64::max);
    lit.max(lit * ambient + 1.0)
}

/// The largest error of a colour behind the gate, LSB, of one that errs by at most `bound` with DITHER: its step comes behind the gate.
pub(super) fn behind_gate(machine: &Plan, frame: &Frame, bound: f64) -> f64 {
    let step = machine.dither_step();
    gated(frame, bound - step) + step
}

/// Whether a light of the frame counts.
pub(super) fn is_lit(frame: &Frame) -> bool {
    frame.passes().iter().any(|pass| frame.shadow(pass.state.light).is_some())
}

/// How far the machine's share of a colour of which golden shows this share may be off, LSB of a colour of 1: what is left of the light
/// behind panes is rounded at each of them (bound 15).
pub(super) fn share_error(machine: &Plan, shadow: Option<&Shadow>, share: f64) -> f64 {
    let Some(shadow) = shadow.filter(|_| share < 1.0) else { return 0.0 };
    let panes = shadow.panes.len() as u32; // a file has fewer
    left_error(panes, machine.color.bits, machine.blend.kt_bits, 0.5)
}

/// However far off, the texel is outside.
fn far_outside(shadow: &Shadow, place: [f64; 2], bounds: &[f64; 3]) -> bool {
    let side = f64::from(shadow.size);
    let beyond = |(at, off): (f64, &f64)| *off >= 0.0 && (at + off < 0.0 || at - off >= side);
    place.into_iter().zip(bounds).any(beyond)
}
