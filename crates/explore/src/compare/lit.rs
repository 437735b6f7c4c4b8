//! What SHADOW decided at each pixel: is it what the errors of texel and depth allow?
//!
//! ```text
//!  pixel, exact depth ─ matrix ─> X*, Y*, Z' ─┬─ within E of them ─> texels it may have read ─┐
//!                                             └─ within E of Z' ─> lit, or in shadow, or either ┴─> the decision is one of these
//! ```
//! Of a perspective light E is of the pixel: what four interpolated values may err by, over the weight there. Where that is a texel
//! or more the decision is open, and counted as such.
//! The map is the machine's own. Golden's decision is not asked for that, only counted where it differs.

use crate::light::scale;
use crate::raster::Raster;
use crate::reach::Reach;
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
    /// Those of them in shadow.
    pub shadow: u64,
    /// Those that golden decides otherwise.
    pub differ: u64,
    /// Those for which neither texel nor depth within their bounds gives the decision.
    pub unexplained: u64,
    /// Those for which nothing is proved, as a texel may be off by one or more.
    pub open: u64,
    /// How far a texel may be off, texels: of a perspective light the most of any pixel that is not open.
    pub texel_bound: f64,
    /// How far a depth may be off before it is rounded, LSB of the map; likewise.
    pub depth_bound: f64,
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

/// The light of a frame, and its map on the machine.
pub struct Light<'a> {
    shadow: &'a Shadow,
    words: &'a [u32],
    machine: &'a Plan,
    frame: &'a Frame,
    /// How far an interpolated value may be off before it is rounded, LSB of lx and of lz.
    off: [f64; 2],
    /// The stored depth is that of what is seen.
    has_depth: bool,
    found: Lit,
}

impl<'a> Light<'a> {
    /// `None` without a light.
    pub fn of(
        machine: &'a Plan,
        frame: &'a Frame,
        drawn: &'a Raster,
        reach: Option<&Reach>,
    ) -> Option<Light<'a>> {
        let (shadow, pass) = frame.shadow.as_ref().zip(drawn.lights.first())?;
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
        let has_depth = machine.fill == Fill::Exact && frame.state().stores_depth();
        let [texel_bound, depth_bound] = if machine.shadow.projects() { [0.0; 2] } else { off };
        let found = Lit { texel_bound, depth_bound, ..Lit::default() };
        Some(Light { shadow, words: &pass.words, machine, frame, off, has_depth, found })
    }

    /// Takes in pixel `i`, which shows the same triangle in both pictures; whether the colours are of the same decision.
    pub fn agrees(&mut self, i: usize, golden: &Raster, drawn: &Raster) -> bool {
        let of = |raster: &Raster| raster.lit.as_ref().and_then(|lit| lit.get(i)).map(|lit| *lit == 2);
        let (Some(exact), Some(found)) = (of(golden), of(drawn)) else { return true };
        let may = self.may(i, golden);
        let differs = exact != found;
        self.found.pixels += 1;
        self.found.shadow += u64::from(!found);
        self.found.differ += u64::from(differs);
        self.found.unexplained += u64::from(may.map_or(differs, |may| !may[usize::from(found)]));
        !differs
    }

    /// What was found.
    pub fn found(self) -> Lit {
        self.found
    }

    /// The largest error of a colour, of one that is lit: that of the gate beside it. The share is rounded, and the product.
    pub fn color_bound(&self, lit: f64) -> f64 {
        lit.max(lit * self.shadow.ambient + 1.0)
    }

    /// Whether it may be in shadow, and whether lit.
    fn may(&mut self, i: usize, golden: &Raster) -> Option<[bool; 2]> {
        let width = golden.width as usize;
        if !self.has_depth {
            return None;
        }
        let point = [(i % width) as f64 + 0.5, (i / width) as f64 + 0.5, golden.z[i], 1.0];
        let [x, y, z, q] = self.shadow.matrix.map(|row| (0..4).map(|k| row[k] * point[k]).sum::<f64>());
        let far = f64::from((1u32 << self.machine.shadow.depth_bits) - 1);
        let bias = self.shadow.bias_of(golden.id[i] as usize); // a triangle is there
        let depth = (z / q - bias) * far;
        let [x_bound, y_bound, depth_bound] = match self.bounds([x / q, y / q, depth], q, golden.id[i]) {
            Bounds::Proved(bounds) => bounds,
            Bounds::Behind => return Some([false, true]),
            Bounds::Open => {
                self.found.open += 1;
                return Some([true; 2]);
            }
        };
        let texels = |at: f64, bound: f64| {
            let off = bound + SLACK;
            ((at - off).floor() as i64)..=((at + off).floor() as i64)
        };
        let mut may = [false; 2];
        for ty in texels(y / q, y_bound) {
            for tx in texels(x / q, x_bound) {
                let Some(word) = self.word(tx, ty) else {
                    may[1] = true;
                    continue;
                };
                // lit: the rounded depth is at most the word.
                let edge = f64::from(word) + 0.5 - depth;
                may[1] |= edge > -depth_bound - SLACK;
                may[0] |= edge <= depth_bound + SLACK;
            }
        }
        Some(may)
    }

    /// How far texel and depth of a pixel may be off, given the exact ones, the weight and the triangle.
    fn bounds(&mut self, [x, y, depth]: [f64; 3], q: f64, id: i32) -> Bounds {
        let [texel, lz] = self.off;
        if !self.machine.shadow.projects() {
            return Bounds::Proved([texel, texel, lz]);
        }
        let place = id as usize; // a triangle is there
        let triangle = self.frame.triangles.get(place);
        let scale = triangle.map(|triangle| scale(self.shadow, place, &triangle.0, self.machine));
        let Some(Ok(scale)) = scale else { return Bounds::Open };
        // All four values are rounded to nearest.
        let (off, weight) = (texel + 0.5, q * scale);
        if weight <= -off {
            return Bounds::Behind;
        }
        let share = off / (weight - off);
        let shadow = &self.machine.shadow;
        let quotient = |bits: u32, value: f64| (f64::from(1u32 << bits) + value.abs()) * share;
        let bounds = [
            quotient(shadow.side_bits(), x),
            quotient(shadow.side_bits(), y),
            quotient(shadow.depth_bits, depth),
        ];
        if share < 0.0 || bounds[0].max(bounds[1]) >= 1.0 {
            return if self.far_outside([x, y], &bounds) { Bounds::Behind } else { Bounds::Open };
        }
        self.found.texel_bound = self.found.texel_bound.max(bounds[0].max(bounds[1]));
        self.found.depth_bound = self.found.depth_bound.max(bounds[2]);
        Bounds::Proved(bounds)
    }

    /// However far off, the texel is outside.
    fn far_outside(&self, place: [f64; 2], bounds: &[f64; 3]) -> bool {
        let side = f64::from(self.shadow.size);
        let beyond = |(at, off): (f64, &f64)| *off >= 0.0 && (at + off < 0.0 || at - off >= side);
        place.into_iter().zip(bounds).any(beyond)
    }

    /// The map's word of a texel; `None` outside.
    fn word(&self, tx: i64, ty: i64) -> Option<u32> {
        let side = 0..i64::from(self.shadow.size);
        let there = side.contains(&tx) && side.contains(&ty);
        there.then(|| self.words[(ty << self.machine.shadow.side_bits() | tx) as usize])
    }
}
