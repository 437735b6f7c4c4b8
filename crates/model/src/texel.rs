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
use crate::shade::Cosines;
use crate::tokens::{Fragment, sign_extend};
use edgewalk_machine::Plan;

/// The unit's inputs of a cycle, but for the fragment and whether its own is taken.
#[derive(Clone, Copy, Debug, Default)]
pub struct TexelInputs {
    /// The memory of the textures takes a read.
    pub xrd_ready: bool,
    /// The oldest read's word.
    pub xdata: Option<u128>,
}

/// A fragment that waits for its texel.
#[derive(Clone, Copy, Debug)]
struct Entry<const C: usize> {
    fragment: Fragment<C>,
    terms: Cosines,
}

impl<const C: usize> Default for Entry<C> {
    fn default() -> Self {
        Entry { fragment: Fragment::default(), terms: Cosines::default() }
    }
}

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
    queue: Fifo<Entry<C>, 16>,
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
    pub fn read(&self, frag: Option<&Fragment<C>>, terms: &Cosines) -> Option<u32> {
        frag?;
        let texel = |place: usize| terms.terms[place] as u32 & ((1 << self.side_bits) - 1);
        let (u, v) = (texel(self.place), texel(self.place + 1));
        (!self.full()).then_some((terms.material << self.side_bits | v) << self.side_bits | u)
    }

    /// A fragment can be taken.
    #[must_use]
    pub fn frag_ready(&self, inputs: &TexelInputs) -> bool {
        !self.full() && inputs.xrd_ready
    }

    /// The fragment offered on, with the outputs of the terms before u and v, and with BUMP the slopes.
    #[must_use]
    pub fn textured(&self, inputs: &TexelInputs) -> Option<(Fragment<C>, Cosines)> {
        let head = (!self.queue.is_empty()).then(|| *self.queue.head())?;
        let (word, b) = (inputs.xdata?, self.color_bits);
        let Entry { mut fragment, mut terms } = head;
        let colours = word >> (2 * self.slope_bits);
        for (color, place) in fragment.values[1..=3].iter_mut().zip([2, 1, 0]) {
            let part = (colours >> (place * b)) as u64 & ((1 << b) - 1);
            let product = u64::from(*color) * part + (1 << (b - 1));
            *color = ((product + (product >> b)) >> b) as u32; // at most b bits
        }
        terms.terms[self.place] = 0;
        terms.terms[self.place + 1] = 0;
        if self.slope_bits > 0 {
            let slope = |low: u32| sign_extend((word >> low) as i32, self.slope_bits);
            terms.slopes = [slope(self.slope_bits), slope(0)];
        }
        Some((fragment, terms))
    }

    /// A texel can be taken.
    #[must_use]
    pub fn xdata_ready(&self, textured_ready: bool) -> bool {
        !self.queue.is_empty() && textured_ready
    }

    /// Clock edge. `taken`: the fragment that is offered on is taken.
    pub fn step(
        &mut self,
        frag: Option<&Fragment<C>>,
        terms: &Cosines,
        inputs: &TexelInputs,
        taken: bool,
        events: &mut Events,
    ) {
        let pushed = frag.filter(|_| self.frag_ready(inputs));
        if frag.is_some() {
            events.texel.texel_queue_full += u64::from(self.full());
            events.texel.texel_read_stall += u64::from(!self.full() && !inputs.xrd_ready);
        }
        events.texel.texel_data_wait += u64::from(!self.queue.is_empty() && inputs.xdata.is_none());
        if taken {
            self.queue.pop();
        }
        if let Some(fragment) = pushed {
            events.texel.texel_read += 1;
            self.queue.push(Entry { fragment: *fragment, terms: *terms });
        }
    }
}
