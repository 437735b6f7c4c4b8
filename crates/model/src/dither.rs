//! DITHER: rounds colours to fewer bits by a pattern, and drops fragments by the same pattern.
//!
//! ```text
//!  frag ─┬─ dropped? ─────────────────────────> gone
//!        └─ r, g, b ─> [+ pattern, cut] ─> dithered
//! ```
//! Formats: colours of b bits in, of n bits out; the pattern is a number from 0 to 15.
//!
//! Timing: none; a fragment is offered on in the cycle in which it comes.
//!
//! Rules: `docs/machine.md`, section 18. Not modelled: nothing.

mod view;

use crate::Events;
use crate::ports::{Pins, Ported, Shown};
use crate::tokens::Fragment;
use edgewalk_machine::Plan;

/// How far a colour is cut.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    /// xb and yb: bits of the column and of the line in an address.
    place: [u32; 2],
    /// b and n; n = b where no colour is cut.
    bits: [u32; 2],
}

impl Cut {
    /// Of this machine.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let widths = plan.widths();
        Cut { place: [widths.x, widths.y], bits: [plan.color.bits, plan.stored_color().bits] }
    }

    /// The pattern's number at an address.
    #[inline]
    #[must_use]
    pub fn pattern(&self, addr: u32) -> u32 {
        let [xb, yb] = self.place;
        let low = |value: u32, bits: u32| value & ((1 << bits.min(2)) - 1);
        let (x, y) = (low(addr, xb), low(addr >> xb, yb));
        let both = x ^ y;
        (both & 1) << 3 | (y & 1) << 2 | (both >> 1) << 1 | y >> 1
    }

    /// A colour of b bits with the pattern's number there, cut to n bits.
    #[inline]
    #[must_use]
    pub fn color(&self, color: u32, pattern: u32) -> u32 {
        (self.scaled(color) + self.threshold(pattern)) >> self.dropped()
    }

    /// Not hardware: a colour of b bits that becomes this step in every place. The smallest whose part of 2^b has nothing below the step: as
    /// the colour grows by 1 that part does so or stays, so there is one.
    #[must_use]
    pub fn color_of(&self, step: u32) -> u32 {
        let part = step << self.dropped();
        let mut color = part;
        while self.scaled(color) < part {
            color += part - self.scaled(color);
        }
        color
    }

    /// d: bits that are cut off.
    fn dropped(&self) -> u32 {
        self.bits[0] - self.bits[1]
    }

    /// c': the colour as a part of 2^b, so that the last step is as wide as the others.
    fn scaled(&self, color: u32) -> u32 {
        if self.dropped() == 0 { color } else { color - (color >> self.bits[1]) }
    }

    /// t.
    fn threshold(&self, pattern: u32) -> u32 {
        (pattern << self.dropped()) >> 4
    }
}

/// State of DITHER.
#[derive(Clone, Debug)]
pub struct Dither {
    cut: Cut,
    /// κ, where fragments are dropped.
    kt_bits: Option<u32>,
    pend_fence: bool,
}

impl Dither {
    /// An empty unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let kt_bits = plan.dither.drops().then_some(plan.blend.kt_bits);
        Dither { cut: Cut::new(plan), kt_bits, pend_fence: false }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.pend_fence = false;
    }

    /// The pattern drops the fragment.
    #[must_use]
    pub fn drops<const C: usize>(&self, frag: &Fragment<C>) -> bool {
        // What is beyond 1 counts as 1.
        self.kt_bits
            .is_some_and(|bits| self.cut.pattern(frag.addr) << bits < 16 * u32::from(frag.kt).min(1 << bits))
    }

    /// The fragment offered on.
    #[must_use]
    pub fn dithered<const C: usize>(&self, frag: Option<&Fragment<C>>) -> Option<Fragment<C>> {
        let frag = frag.filter(|frag| !self.drops(frag))?;
        let pattern = self.cut.pattern(frag.addr);
        let mut dithered = Fragment { fence: frag.fence || self.pend_fence, ..*frag };
        dithered.values[1..4].iter_mut().for_each(|color| *color = self.cut.color(*color, pattern));
        Some(dithered)
    }

    /// The fragment offered can be taken.
    #[must_use]
    pub fn frag_ready<const C: usize>(&self, frag: Option<&Fragment<C>>, dithered_ready: bool) -> bool {
        dithered_ready || frag.is_some_and(|frag| self.drops(frag))
    }

    /// Clock edge.
    pub fn step<const C: usize>(
        &mut self,
        frag: Option<&Fragment<C>>,
        dithered_ready: bool,
        events: &mut Events,
    ) {
        let Some(frag) = frag.filter(|frag| self.frag_ready(Some(frag), dithered_ready)) else { return };
        let (drops, fence) = (self.drops(frag), frag.fence || self.pend_fence);
        let events = &mut events.dither;
        if drops {
            events.door_dropped += 1;
        } else {
            events.door_passed += u64::from(self.kt_bits.is_some() && frag.kt > 0);
            events.door_fence += u64::from(self.pend_fence && !frag.fence);
            let pattern = self.cut.pattern(frag.addr);
            for color in frag.values[1..4].iter().filter(|_| self.cut.dropped() > 0) {
                let scaled = self.cut.scaled(*color);
                let carries = self.cut.color(*color, pattern) > scaled >> self.cut.dropped();
                events.dither_up += u64::from(carries);
                events.dither_down += u64::from(!carries && scaled & ((1 << self.cut.dropped()) - 1) != 0);
                events.dither_white += u64::from(*color == (1 << self.cut.bits[0]) - 1);
            }
        }
        if self.kt_bits.is_some() {
            self.pend_fence = drops && fence;
        }
    }
}

impl<const C: usize> Ported<C> for Dither {
    type Takes = Fragment<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.frag_ready(pins.token, pins.next));
        out.gives(self.dithered(pins.token).as_ref());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        self.step(pins.token, pins.next, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
