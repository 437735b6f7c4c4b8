//! What blending may err by at each pixel: the running bound (bound 11) beside golden's own layers.
//!
//! A colour of a blended picture hangs on every fragment under it. So where a single depth test at a pixel is open
//! (bound 7), any of two colours may come of it, and the pixel counts as undecided.

use super::lit::{Lights, Seen, share_error};
use super::order::apart;
use crate::shaded::Spread;
use crate::verdict::in_words;
use edgewalk_golden::{Drawing, Step};
use edgewalk_host::polygon::defects;
use edgewalk_host::reach::Reach;
use edgewalk_host::shade::Proof;
use edgewalk_machine::{NoBound, Plan};
use edgewalk_numerics::blend_error_of_golden;
use edgewalk_scene::{Blending, Frame};
use serde::Serialize;

/// Every pixel of a frame that is blended, or drawn in several passes.
pub struct Layers {
    /// Largest error of the colour that is allowed, LSB: its bound, if one is proved.
    pub bound: Vec<f64>,
    /// Why none is proved of any layer.
    pub no_bound: Option<NoBound>,
    /// A depth test there is open.
    pub open: Vec<bool>,
    /// Colours stored there.
    pub stored: Vec<u32>,
    /// What the machine may have decided of the last of them.
    pub last: Vec<Seen>,
    /// One of them may have several shares of its colour, an LSB or more apart.
    pub loose: Vec<bool>,
    /// One of them may have one of several colours of SHADE, an LSB or more apart.
    pub branches: Vec<bool>,
}

/// What was found of such a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Blended {
    /// Pixels whose colour was compared with the bound of its layers.
    pub pixels: u64,
    /// Most colours stored at one of them.
    pub layers: u32,
    /// The largest bound of one of them, LSB; none where none is proved.
    pub bound: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "in_words")]
    pub no_bound: Option<NoBound>,
    /// The largest error that is allowed at one of them, LSB: its bound, and where none is proved that with 1 LSB a fragment.
    #[serde(skip)]
    pub allowed: f64,
    /// The largest quotient of a pixel's error and the error that is allowed there.
    pub of_bound: f64,
    /// Pixels beyond.
    pub beyond: u64,
}

impl Blended {
    /// As a line of text.
    pub(super) fn lines(&self) -> String {
        let Blended { pixels, layers, no_bound, allowed, of_bound, beyond, .. } = self;
        let bound = match no_bound {
            None => format!("running bound up to {allowed:.4} LSB"),
            Some(why) => {
                format!("no bound: {why}; with 1 LSB a fragment up to {allowed:.4} LSB are allowed")
            }
        };
        format!(
            "blended: {pixels} pixels, up to {layers} layers, {bound}, {of_bound:.4} of it reached, {beyond} beyond\n"
        )
    }
}

impl Layers {
    /// `None` where every pixel shows one fragment as it is, or as a light leaves it or takes it away. `lights`: of the frame, if any counts;
    /// without them golden's shares of the colours are the only right ones. `proof`: of the colours of a frame that is shaded at each
    /// pixel. `drawing`: golden's of the frame.
    pub fn of(
        machine: &Plan,
        frame: &Frame,
        drawing: &Drawing,
        mut lights: Option<&mut Lights>,
        proof: Option<&Proof>,
        reach: Option<&Reach>,
    ) -> Option<Layers> {
        if !Layers::lie_in(machine, frame, lights.is_some()) {
            return None;
        }
        let pixels = frame.width as usize * frame.height as usize;
        let (apart, errors) = (apart(machine, frame, reach), Errors::of(machine, frame, proof));
        let mut layers = Layers {
            no_bound: errors.no_bound,
            bound: vec![0.5; pixels], // the cleared colour is rounded
            open: vec![false; pixels],
            stored: vec![0; pixels],
            last: vec![Seen::LIT; pixels],
            loose: vec![false; pixels],
            branches: vec![false; pixels],
        };
        let width = frame.width as usize;
        drawing.watched(0..frame.height, |step| match step {
            Step::Tested { at, id, stored, gap } => {
                layers.open[at] |= apart.is_some_and(|apart| apart.leaves_open(frame, id, stored, gap));
            }
            Step::Stored { at, id, z, own, light, share, kt, back, blend, .. } => {
                layers.stored[at] += 1;
                let point = [(at % width) as f64 + 0.5, (at / width) as f64 + 0.5, z];
                let front = own.map(|channel| channel * share);
                let (seen, rounded) = match &mut lights {
                    Some(lights) => (lights.seen(point, id, light), 0.0),
                    // Nothing is known of the map: what golden decides is right.
                    None => (Seen::of_share(share), share_error(machine, frame.shadow(light), share)),
                };
                let error = errors.front((at, id), own, share, &seen) + rounded;
                layers.last[at] = seen;
                layers.branches[at] |= errors.spread(at, id) > 1.0;
                layers.loose[at] |= (seen.shares[1] - seen.shares[0]) * errors.max > 1.0;
                layers.bound[at] = errors.behind(layers.bound[at], error, front, kt, back, blend);
            }
        });
        Some(layers)
    }

    /// Whether a pixel of the frame may show several fragments, each with a part of its colour. `lit`: under a light that counts.
    pub fn lie_in(machine: &Plan, frame: &Frame, lit: bool) -> bool {
        let passes = frame.passes();
        let shares = lit && machine.shadow.transmits();
        let mixes = passes[0].state.blend != Blending::Off && !machine.dither.drops();
        passes.len() > 1 || mixes || shares
    }
}

/// What of a machine counts for the bound.
pub struct Errors {
    /// LSB of 1.
    max: f64,
    /// Of a fragment's colour before SHADE, LSB.
    front: f64,
    /// Of colours that are made at each pixel.
    shaded: Option<Spread>,
    /// Of k_t.
    kt: f64,
    /// Why none of the layers has a bound: an LSB is in the place of the colour's error, or of that of k_t.
    pub no_bound: Option<NoBound>,
}

impl Errors {
    /// The errors of this machine on this frame. `proof` holds the proved bounds of the colours that SHADE makes.
    pub fn of(machine: &Plan, frame: &Frame, proof: Option<&Proof>) -> Errors {
        let defects = defects(frame, machine);
        let budget = |place: usize| machine.proved_budget(&machine.channels()[place]);
        // Where none is proved an LSB is allowed, as elsewhere.
        let error = |place: usize| {
            budget(place).map_or(1.0, |budget| budget.after_rounding().to_f64()) + defects[place]
        };
        let one = f64::from(1u32 << machine.blend.kt_bits);
        let kt = machine.channel_place("kt");
        let shaded = frame.shading.as_ref().zip(proof);
        let shaded = shaded.map(|(shading, proof)| Spread::new(machine, frame, shading, proof));
        let mixes = frame.passes().iter().any(|pass| pass.state.blend == Blending::Mix);
        let of_color = match shaded.is_some() {
            true => proof.and_then(|proof| proof.no_bound),
            false => budget(1).err(),
        };
        let no_bound = of_color.or_else(|| budget(kt.filter(|_| mixes)?).err());
        let kt = kt.map_or(0.5, error) / one;
        Errors { max: machine.color.max() as f64, front: error(1), shaded, kt, no_bound }
    }

    /// How far the colours that SHADE may give this triangle at a pixel are from golden's, LSB, errors apart.
    fn spread(&self, at: usize, id: i32) -> f64 {
        self.shaded.as_ref().map_or(0.0, |shaded| shaded.at(at, id))
    }

    /// Error of the fragment of a triangle at a pixel, LSB: of this colour, 0 to 1, of which golden shows this share.
    pub fn front(&self, (at, id): (usize, i32), own: [f64; 3], share: f64, seen: &Seen) -> f64 {
        let before = self.shaded.as_ref().map_or(self.front, |shaded| shaded.bound(id) + shaded.at(at, id));
        seen.front(before, own.into_iter().fold(0.0, f64::max), share, self.max)
    }

    /// The error of a pixel behind one more layer, LSB, whose own is `error`; colours in 0 to 1.
    pub fn behind(
        &self,
        before: f64,
        error: f64,
        front: [f64; 3],
        kt: f64,
        back: [f64; 3],
        blend: Blending,
    ) -> f64 {
        match blend {
            Blending::Off => error,
            Blending::Add => before + error,
            Blending::Mix => {
                let far = (0..3).map(|i| (front[i] - back[i]).abs() * self.max).fold(0.0, f64::max);
                blend_error_of_golden(before, error, far, kt, self.kt)
            }
        }
    }
}
