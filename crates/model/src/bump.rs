//! BUMP: turns the normal of a fragment by the slopes of a relief.
//!
//! ```text
//!  frag ─┬─ B_u, B_v ───> [K1] products ─> [K2] cosines ─> [K3] N·N ─> bumped
//!        └─ c, α, β of each cosine ─┘        └────────fast Phong─────────┘
//! ```
//! Formats: slopes of ξ bits, 2^(ξ-1) for 1; cosines in the unit of their terms, of fast Phong with φ bits below an entry of
//! SHADE's tables.
//!
//! Timing: a fragment taken in cycle n is offered in n + 2, with NORMAL behind (stage K3) in n + 3; one a clock. All stages move
//! together.
//!
//! Rules: `docs/machine.md`, section 16. Not modelled: what each stage holds; cosines are found on the way in.

mod view;

use crate::Events;
use crate::lit::{Cosines, Given, Lit};
use crate::ports::{Pins, Ported, Shown};
use crate::stages::Stages;
use edgewalk_machine::Plan;

/// A sum that BUMP makes.
#[derive(Clone, Copy, Debug)]
struct Sum {
    /// Place among the terms, and of α and β, or of the first of three squares.
    term: usize,
    turns: usize,
    /// Bits that are given.
    bits: u32,
}

/// State of BUMP.
#[derive(Clone, Debug)]
pub struct Bump<const C: usize> {
    slope_bits: u32,
    /// φ.
    fraction: u32,
    normalises: bool,
    cosines: Vec<Sum>,
    /// N·N.
    square: Option<Sum>,
    /// K1 and K2, and K3 before NORMAL.
    stages: Stages<Lit<C>>,
}

impl<const C: usize> Bump<C> {
    /// An empty unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let (shade, terms) = (&plan.shade, plan.terms());
        let count = 2 * shade.lights as usize;
        let bits = |term: usize| terms[term].bits - shade.cosine_fraction();
        let first = plan.cosine_terms();
        let cosine = |term: usize| Sum { term, turns: first + 2 * term, bits: bits(term) };
        let square = Sum { term: count, turns: first + 2 * count, bits: 18 };
        Bump {
            slope_bits: shade.slope_bits,
            fraction: shade.cosine_fraction(),
            normalises: shade.normalises(),
            cosines: (0..count).map(cosine).collect(),
            square: shade.normalises().then_some(square),
            stages: Stages::new(if shade.normalises() { 3 } else { 2 }),
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.stages.clear();
    }

    /// A fragment is in a stage.
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.stages.held() > 0
    }

    /// The fragment offered on, with its cosines.
    #[must_use]
    pub fn bumped(&self) -> Option<&Lit<C>> {
        self.stages.last()
    }

    /// A fragment can be taken: all stages move on.
    #[must_use]
    pub fn frag_ready(&self, bumped_ready: bool) -> bool {
        self.bumped().is_none() || bumped_ready
    }

    /// Clock edge. Beside the fragment are the outputs of its terms, and its slopes.
    pub fn step(&mut self, frag: Option<Given<C>>, bumped_ready: bool, events: &mut Events) {
        if !self.frag_ready(bumped_ready) {
            events.bump.bump_stall += 1;
            return;
        }
        let turned = |given: Given<C>| Lit { frag: *given.frag, cosines: self.turned(given.cosines, events) };
        let entering = frag.map(turned);
        self.stages.shift(entering);
    }

    /// What NORMAL or SHADE takes.
    fn turned(&self, terms: &Cosines, events: &mut Events) -> Cosines {
        let [bu, bv] = terms.slopes.map(i64::from);
        let term = |place: usize| i64::from(terms.terms[place]);
        let lowest = -1i64 << (self.slope_bits - 1);
        events.bump.slope_lowest += u64::from(bu == lowest) + u64::from(bv == lowest);
        let mut turned = Cosines { material: terms.material, gloss: terms.gloss, ..Cosines::default() };
        let half = if self.normalises { 1 << (self.slope_bits - 2) } else { 0 };
        for Sum { term: place, turns, bits } in &self.cosines {
            let turn = bu * term(*turns) + bv * term(turns + 1);
            events.bump.slope_up += u64::from(turn > 0);
            events.bump.slope_down += u64::from(turn < 0);
            let sum = (term(*place) << (self.slope_bits - 1)) + turn + half;
            let (cosine, cut) = cut(sum >> (self.slope_bits - 1 + self.fraction), *bits);
            events.bump.bump_cut += u64::from(cut);
            turned.terms[*place] = cosine;
        }
        if let Some(Sum { term: place, turns, bits }) = self.square {
            let squares = bu * bu * term(turns) + bu * bv * term(turns + 1) + bv * bv * term(turns + 2);
            let one = 2 * self.slope_bits - 2;
            let (square, cut) = cut(((term(place) << one) + squares) >> one, bits);
            events.bump.square_cut += u64::from(cut);
            turned.terms[place] = square;
        }
        turned
    }
}

/// A number cut to so many bits, and whether it was.
fn cut(number: i64, bits: u32) -> (i32, bool) {
    let end = 1i64 << (bits - 1);
    let within = number.clamp(-end, end - 1);
    (within as i32, within != number) // at most 20 bits
}

impl<const C: usize> Ported<C> for Bump<C> {
    type Takes = Lit<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.frag_ready(pins.next));
        out.gives(self.bumped());
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        self.step(pins.token.map(Lit::given), pins.next, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
