//! What golden allows a machine to show at each pixel of a shaded frame.

use crate::verdict::{in_words, within};
use edgewalk_golden::{PixelBrush, Texel, fragments};
use edgewalk_host::raster::Raster;
use edgewalk_host::shade::{Proof, Textured};
use edgewalk_machine::{NoBound, Plan};
use edgewalk_scene::{Frame, PixelMethod, PixelShading};
use glam::DVec2;
use serde::Serialize;
use std::collections::HashMap;

/// What was found of a picture shaded at each pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Shaded {
    /// Pixels whose colour was compared with the bound of its triangle.
    pub pixels: u64,
    /// Largest error, LSB.
    pub error: f64,
    /// Largest bound of a triangle that is seen, LSB; none where none is proved.
    pub bound: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "in_words")]
    pub no_bound: Option<NoBound>,
    /// Largest error that is allowed of such a triangle, LSB: its bound, and where none is proved that with 1 LSB of the fragment's own
    /// colour.
    #[serde(skip)]
    pub allowed: f64,
    /// The first pixel with that bound: column, line.
    pub bound_at: [usize; 2],
    /// Pixels with a bound above 1 LSB.
    pub bound_above_1: u64,
    /// The largest quotient of a pixel's error and the error that its triangle is allowed.
    pub of_bound: f64,
    /// Pixels where a light is so near to the horizon that it may be above or below, or which lie next to the edge of its cone.
    pub at_horizon: u64,
    /// Of them those that show the other of the two.
    pub other_branch: u64,
    /// Pixels beyond.
    pub beyond: u64,
    /// Largest distance of the machine's colours from Phong shading, LSB: measured, no bound.
    pub from_phong: f64,
    /// Mean distance from Phong shading.
    pub mean_from_phong: f64,
    /// Where a texture is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texels: Option<Looked>,
}

/// What was found of the texels of a picture: each is the one that the triangle's words name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Looked {
    /// Pixels that show a texture.
    pub pixels: u64,
    /// Largest error of a word, texels.
    pub bound: f64,
    /// Pixels with another texel than the one that their place lies in.
    pub differ: u64,
    /// Fragments that lie farther from that texel than the error of the words.
    pub unexplained: u64,
    /// Pixels of another colour because the picture's sides do not divide 2^`texture.bits`.
    pub resampled: u64,
    /// Pixels of triangles whose relief is steeper than the machine's words can say, and lower there: no bound holds them.
    pub flattened: u64,
}

impl Shaded {
    /// As lines of text.
    pub(crate) fn lines(&self) -> String {
        let Shaded { pixels, error, of_bound, at_horizon, other_branch, beyond, .. } = self;
        let bounds = self.bounds();
        let Shaded { from_phong, mean_from_phong, texels, .. } = self;
        let mut t = format!(
            "shaded: {pixels} pixels, largest error {error:.4} LSB from golden, {bounds}, {of_bound:.4} of one reached, {beyond} beyond\n\
             a light at the horizon in {at_horizon} of them, on its other side in {other_branch}; from Phong shading at most {from_phong:.4}, {mean_from_phong:.4} in the mean\n"
        );
        t += &texels.as_ref().map(Looked::lines).unwrap_or_default();
        t
    }

    /// How large the bounds are, and where.
    fn bounds(&self) -> String {
        let ([x, y], above) = (self.bound_at, self.bound_above_1);
        let found = format!("up to {:.4} at pixel {x},{y}, {above} above 1", self.allowed);
        match self.no_bound {
            None => format!("bounds {found}"),
            Some(why) => format!("no bound: {why}; with 1 LSB of the fragment's colour allowed {found}"),
        }
    }

    /// As a line of text about one light of several, each drawn by itself.
    pub(crate) fn line_of_light(&self, number: usize) -> String {
        let (Shaded { pixels, error, beyond, .. }, bounds) = (self, self.bounds());
        format!(
            "light {number} by itself: {pixels} pixels, largest error {error:.4} LSB, {bounds}, {beyond} beyond\n"
        )
    }
}

/// Golden's colours beside those of its picture.
pub(crate) struct Allowed<'a> {
    proof: &'a Proof,
    /// What a pixel may show where that is not golden's colour alone: first that of its own side of the horizon, with the texel that
    /// the words name.
    branches: HashMap<usize, Vec<[f64; 3]>>,
    /// Of Phong shading.
    phong: HashMap<usize, [f64; 3]>,
    /// Pixels of a line.
    width: usize,
    /// The steps of DITHER, one for each picture that is added (bound 18), LSB.
    step: f64,
    found: Shaded,
}

/// How far the colours of each triangle may be from golden's, whatever lies over them: of a frame in layers.
pub(crate) struct Spread {
    /// By triangle, LSB.
    bounds: Vec<f64>,
    /// By pixel and triangle, LSB, where it may have another colour than golden's: beyond the horizon, or at the border of a texel.
    branches: HashMap<(usize, i32), f64>,
}

impl Spread {
    /// Of a frame.
    pub fn new(machine: &Plan, frame: &Frame, shading: &PixelShading, proof: &Proof) -> Self {
        let one = machine.color.max() as f64;
        let mut branches = HashMap::new();
        for (place, triangle) in frame.triangles.iter().enumerate() {
            let Some(brush) = PixelBrush::new(shading, place) else { continue };
            let screen = (frame.width, frame.height);
            fragments(triangle, frame.mode, machine.subpixel_bits, screen, |fragment| {
                let golden = brush.texel(fragment);
                let own = proof.textured[place].as_ref().zip(brush.place(fragment));
                // A texel that the words' errors do not explain is wrong.
                let texel = own.map_or(golden, |(own, at)| {
                    let texel = own.texel([fragment.x, fragment.y]);
                    if own.explains(texel, at) { own.texture.exact(texel) } else { golden }
                });
                let list = brush.branches(fragment, &texel, proof.doubts[place], proof.errors[place].axis);
                if list.len() > 1 || own.is_some() {
                    let exact = brush.color_by(fragment, &golden);
                    let off =
                        |of: [f64; 3]| (0..3).map(|i| (of[i] - exact[i]).abs() * one).fold(0.0, f64::max);
                    let farthest = list.into_iter().map(off).fold(0.0, f64::max);
                    let at = fragment.y as usize * frame.width as usize + fragment.x as usize;
                    branches.insert((at, place as i32), farthest);
                }
            });
        }
        Spread { bounds: proof.bounds.clone(), branches }
    }

    /// Largest error of a colour of this triangle, LSB.
    pub fn bound(&self, id: i32) -> f64 {
        usize::try_from(id).map_or(0.0, |id| self.bounds[id])
    }

    /// How far its colour at this pixel may be from golden's beside that, LSB.
    pub fn at(&self, pixel: usize, id: i32) -> f64 {
        self.branches.get(&(pixel, id)).copied().unwrap_or(0.0)
    }
}

impl<'a> Allowed<'a> {
    /// Of a frame, `golden` its picture.
    pub fn new(
        machine: &Plan,
        frame: &Frame,
        shading: &PixelShading,
        golden: &Raster,
        proof: &'a Proof,
    ) -> Self {
        let exact = PixelShading { method: PixelMethod::Phong, ..shading.clone() };
        let (mut branches, mut phong, mut looked) = (HashMap::new(), HashMap::new(), None);
        for (place, triangle) in frame.triangles.iter().enumerate() {
            let brushes = [shading, &exact].map(|shading| PixelBrush::new(shading, place));
            let [Some(fast), Some(exact)] = brushes else { continue };
            let screen = (frame.width, frame.height);
            fragments(triangle, frame.mode, machine.subpixel_bits, screen, |fragment| {
                let at = fragment.y as usize * frame.width as usize + fragment.x as usize;
                if golden.id[at] == place as i32 {
                    let own = proof.textured[place].as_ref().zip(fast.place(fragment));
                    let texel = match own {
                        None => fast.texel(fragment),
                        Some((own, at)) => {
                            let looked = looked.get_or_insert_with(Looked::default);
                            looked.take(own, [fragment.x, fragment.y], at, fast.texel(fragment))
                        }
                    };
                    let list = fast.branches(fragment, &texel, proof.doubts[place], proof.errors[place].axis);
                    if list.len() > 1 || own.is_some() {
                        branches.insert(at, list);
                    }
                    phong.insert(at, exact.color_by(fragment, &texel));
                }
            });
        }
        let (width, step) = (frame.width as usize, machine.dither_step() * f64::from(proof.pictures));
        Self { proof, branches, phong, width, step, found: Shaded { texels: looked, ..Shaded::default() } }
    }

    /// What pixel `at`, which shows triangle `id`, should be: golden's colour there, or that of the horizon's other side if the
    /// machine shows that.
    pub fn at(&mut self, at: usize, id: i32, golden: [f64; 3], drawn: [f64; 3], one: f64) -> [f64; 3] {
        let off =
            |exact: &[f64; 3]| exact.iter().zip(drawn).map(|(a, b)| (a - b).abs() * one).fold(0.0, f64::max);
        let alone = [golden];
        let list = self.branches.get(&at).map_or(&alone[..], Vec::as_slice);
        // It is never empty.
        let nearest = list.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(golden);
        let bound = usize::try_from(id).map_or(0.0, |id| self.proof.bounds[id] + self.step);
        let (error, found) = (off(&nearest), &mut self.found);
        found.pixels += 1;
        found.error = found.error.max(error);
        if bound > found.allowed {
            (found.allowed, found.bound_at) = (bound, [at % self.width, at / self.width]);
        }
        found.bound_above_1 += u64::from(bound > 1.0);
        found.of_bound = found.of_bound.max(error / bound);
        found.at_horizon += u64::from(list.len() > 1);
        found.other_branch +=
            u64::from(list.len() > 1 && !within(off(&list[0]), bound) && within(error, bound));
        found.beyond += u64::from(!within(error, bound));
        let from_phong = self.phong.get(&at).map_or(0.0, off);
        found.from_phong = found.from_phong.max(from_phong);
        found.mean_from_phong += from_phong;
        nearest
    }

    /// All together.
    pub fn found(self) -> Shaded {
        let (Shaded { pixels, mean_from_phong: sum, allowed, .. }, no_bound) =
            (self.found, self.proof.no_bound);
        let mean_from_phong = if pixels == 0 { 0.0 } else { sum / pixels as f64 };
        Shaded { mean_from_phong, no_bound, bound: no_bound.is_none().then_some(allowed), ..self.found }
    }
}

impl Looked {
    /// As lines of text.
    fn lines(&self) -> String {
        let Looked { pixels, bound, differ, unexplained, resampled, flattened } = self;
        let mut t = format!(
            "texels: {pixels} pixels, {differ} other than golden's, unexplained by places within {bound:.4} texels: {unexplained}; {resampled} another for their picture's sides\n"
        );
        if *flattened > 0 {
            t += &format!(
                "relief: steeper than the machine's words can say in {flattened} pixels, lower there and without a bound\n"
            );
        }
        t
    }

    /// Takes in a pixel that lies at `place` of its texture, `golden` the pictures' texel there; what the pictures have at the texel
    /// that the words name.
    fn take(&mut self, of: &Textured, pixel: [u32; 2], place: DVec2, golden: Texel) -> Texel {
        let texel = of.texel(pixel);
        let (shown, differs) = (of.texture.exact(texel), texel != of.nearest(place));
        self.pixels += 1;
        self.bound = self.bound.max(of.error);
        self.differ += u64::from(differs);
        self.unexplained += u64::from(!of.explains(texel, place));
        self.flattened += u64::from(of.flattened);
        self.resampled += u64::from(!differs && shown != golden);
        shown
    }
}
