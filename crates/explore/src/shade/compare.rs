//! What golden allows a machine to show at each pixel of a shaded frame.

use super::bound::{Looked, Proof, Shaded};
use super::texels::Textured;
use crate::raster::Raster;
use edgewalk_golden::{PixelBrush, Texel, fragments};
use edgewalk_machine::Plan;
use edgewalk_scene::{Frame, PixelMethod, PixelShading};
use glam::DVec2;
use std::collections::HashMap;

/// Golden's colours beside those of its picture.
pub(crate) struct Allowed<'a> {
    proof: &'a Proof,
    /// What a pixel may show where that is not golden's colour alone: first that of its own side of the horizon, with the texel that
    /// the words name.
    branches: HashMap<usize, Vec<[f64; 3]>>,
    /// Of Phong shading.
    phong: HashMap<usize, [f64; 3]>,
    found: Shaded,
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
        Self { proof, branches, phong, found: Shaded { texels: looked, ..Shaded::default() } }
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
        let bound = usize::try_from(id).map_or(0.0, |id| self.proof.bounds[id]);
        let (error, found) = (off(&nearest), &mut self.found);
        found.pixels += 1;
        found.error = found.error.max(error);
        found.bound = found.bound.max(bound);
        found.of_bound = found.of_bound.max(error / bound);
        found.at_horizon += u64::from(list.len() > 1);
        found.other_branch += u64::from(list.len() > 1 && off(&list[0]) > bound && error <= bound);
        found.beyond += u64::from(error.is_nan() || error > bound);
        let from_phong = self.phong.get(&at).map_or(0.0, off);
        found.from_phong = found.from_phong.max(from_phong);
        found.mean_from_phong += from_phong;
        nearest
    }

    /// All together.
    pub fn found(self) -> Shaded {
        let Shaded { pixels, mean_from_phong: sum, .. } = self.found;
        Shaded { mean_from_phong: if pixels == 0 { 0.0 } else { sum / pixels as f64 }, ..self.found }
    }
}

impl Looked {
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
