//! TEXEL: multiplies the colour of a fragment by that of the nearest texel.
//!
//! ```text
//!  frag ─┬─> xrd (material, v, u)           xdata ──┐
//!        └─> queue ─> head ─ r g b ─────────────────┴─> product ─> textured
//! ```
//! Formats: u and v the texel, the low τ bits of their outputs; the word three colours of b bits, with BUMP two slopes of ξ
//! bits below them.
//!
//! Timing: a fragment taken in cycle n is offered when its texel is there, from n + latency on. One a clock.
//!
//! Rules: `docs/machine.md`, section 14. Not modelled: bilinear filtering.

mod view;

use crate::Events;
use crate::fifo::Fifo;
use crate::lit::{Given, Lit};
use crate::ports::{Pins, Ported, Shown};
use crate::tokens::sign_extend;
use crate::word_memory::Ask;
use crate::word_memory::WordIn;
use edgewalk_machine::Plan;

/// State of TEXEL.
#[derive(Clone, Debug)]
pub struct Texel<const C: usize> {
    color_bits: u32,
    /// ξ; 0 without BUMP.
    slope_bits: u32,
    /// τ.
    side_bits: u32,
    /// Place of u among the terms; v is behind it, and they are the last.
    place: usize,
    places: usize,
    /// Fragments that wait for their texels.
    queue: Fifo<Lit<C>, 16>,
}

impl<const C: usize> Texel<C> {
    /// An empty unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        Texel {
            color_bits: plan.color.bits,
            slope_bits: if plan.shade.bumps() { plan.shade.slope_bits } else { 0 },
            side_bits: plan.shade.texture_bits,
            place: plan.terms().len().saturating_sub(2),
            places: plan.shade.texel_queue as usize,
            queue: Fifo::default(),
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.queue.clear();
    }

    /// A fragment waits here.
    #[must_use]
    pub fn occupied(&self) -> bool {
        !self.queue.is_empty()
    }

    /// The queue is full.
    #[must_use]
    pub fn full(&self) -> bool {
        self.queue.len() == self.places
    }

    /// Address of the texel of the fragment that is offered.
    #[must_use]
    pub fn read(&self, frag: Option<Given<C>>) -> Option<u32> {
        let cosines = frag?.cosines;
        let texel = |place: usize| cosines.terms[place] as u32 & ((1 << self.side_bits) - 1);
        let (u, v) = (texel(self.place), texel(self.place + 1));
        (!self.full()).then_some((cosines.material << self.side_bits | v) << self.side_bits | u)
    }

    /// A fragment can be taken. `textures`: the ports of the memory.
    #[must_use]
    pub fn frag_ready(&self, textures: &WordIn) -> bool {
        !self.full() && textures.ready
    }

    /// Whether a fragment is offered on.
    #[inline]
    #[must_use]
    pub fn offers(&self, textures: &WordIn) -> bool {
        !self.queue.is_empty() && textures.word.is_some()
    }

    /// Makes the fragment offered on, with the outputs of the terms before u and v, and with BUMP the slopes. False: none is.
    #[inline]
    pub fn textured(&self, textures: &WordIn, lit: &mut Lit<C>) -> bool {
        let (Some(word), false) = (textures.word, self.queue.is_empty()) else { return false };
        let b = self.color_bits;
        *lit = *self.queue.head();
        let colours = word >> (2 * self.slope_bits);
        for (color, place) in lit.frag.values[1..=3].iter_mut().zip([2, 1, 0]) {
            let part = (colours >> (place * b)) as u64 & ((1 << b) - 1);
            let product = u64::from(*color) * part + (1 << (b - 1));
            *color = ((product + (product >> b)) >> b) as u32; // at most b bits
        }
        lit.cosines.terms[self.place] = 0;
        lit.cosines.terms[self.place + 1] = 0;
        if self.slope_bits > 0 {
            let slope = |low: u32| sign_extend((word >> low) as i32, self.slope_bits);
            lit.cosines.slopes = [slope(self.slope_bits), slope(0)];
        }
        true
    }

    /// A texel can be taken.
    #[must_use]
    pub fn xdata_ready(&self, textured_ready: bool) -> bool {
        !self.queue.is_empty() && textured_ready
    }

    /// Clock edge. `taken`: the fragment that is offered on is taken.
    pub fn step(&mut self, frag: Option<Given<C>>, textures: &WordIn, taken: bool, events: &mut Events) {
        let pushed = frag.filter(|_| self.frag_ready(textures));
        if frag.is_some() {
            events.texel.texel_queue_full += u64::from(self.full());
            events.texel.texel_read_stall += u64::from(!self.full() && !textures.ready);
        }
        events.texel.texel_data_wait += u64::from(!self.queue.is_empty() && textures.word.is_none());
        if taken {
            self.queue.pop();
        }
        if let Some(given) = pushed {
            events.texel.texel_read += 1;
            self.queue.push(given.lit());
        }
    }
}

impl<const C: usize> Ported<C> for Texel<C> {
    type Takes = Lit<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.frag_ready(&pins.word));
        let mut lit = Lit::default();
        let textured = self.textured(&pins.word, &mut lit);
        out.gives(textured.then_some(&lit));
        out.asks(Ask { addr: self.read(pins.token.map(Lit::given)), take: self.xdata_ready(pins.next) });
        out.status("texel_full", self.full());
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        let taken = pins.next && self.offers(&pins.word);
        self.step(pins.token.map(Lit::given), &pins.word, taken, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
