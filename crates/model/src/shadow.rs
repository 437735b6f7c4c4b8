//! SHADOW: is the fragment seen from the light?
//!
//! ```text
//!  frag ─┬─> mrd (texel)                   mdata ──┐
//!        └─> queue ─> head ─ d, known, value ──────┴─> lit ─> gate ─> shaded
//! ```
//! Formats: lx and ly the texel, lz the depth from the light in 2^-bz of the map, two's complement; the map's word bz bits, and with
//! `shadow.transmits` b bits below them: what is left of the light.
//!
//! Timing: a fragment taken in cycle n is offered to DEPTH from n + 1 on, or as soon as its texel is there. One a clock.
//!
//! Rules: `docs/machine.md`, section 10. Not modelled: the memory of the map.

mod view;

use crate::Events;
use crate::fifo::Fifo;
use crate::ports::{Pins, Ported, Shown};
use crate::tokens::Fragment;
use crate::word_memory::{Ask, WordIn};
use edgewalk_machine::DrawState;
use edgewalk_machine::{Gate, Plan};

/// Inputs of the unit that stay the same over a pass.
#[derive(Clone, Copy, Debug, Default)]
pub struct ShadowInputs {
    /// The map counts; else all is lit.
    pub on: bool,
    /// The map is drawn, not the picture: all is lit.
    pub light_pass: bool,
    /// What the colour of a point in shadow is multiplied by, b bits; of the gate `scale`.
    pub ambient: u32,
}

/// A fragment on its way.
#[derive(Clone, Copy, Debug)]
struct Entry<const C: usize> {
    fragment: Fragment<C>,
    /// No texel decides.
    known: bool,
    /// The fragment is lit, if that is known.
    value: bool,
    /// Depth from the light.
    d: i64,
}

impl<const C: usize> Default for Entry<C> {
    fn default() -> Self {
        Entry { fragment: Fragment::default(), known: false, value: false, d: 0 }
    }
}

/// Where a fragment lies in the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// Of the light's own pass.
    Own,
    Off,
    Outside,
    Before,
    Behind,
    /// Address of its texel.
    Texel(u32),
}

/// A word of the map.
struct Texel {
    /// Depth of what is nearest to the light.
    depth: i64,
    /// Share of the light that is left before it, b bits.
    left: u32,
}

/// State of SHADOW.
#[derive(Clone, Debug)]
pub struct Shadow<const C: usize> {
    size: i64,
    /// SB.
    side: u32,
    /// bz.
    depth_bits: u32,
    /// Places of lx, ly, lz among the channels, and their bits.
    at: [usize; 3],
    bits: [u32; 3],
    gate: Gate,
    /// b.
    color_bits: u32,
    /// A word has a share below its depth.
    transmits: bool,
    places: usize,
    queue: Fifo<Entry<C>, 16>,
}

impl<const C: usize> Shadow<C> {
    /// An empty unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let shadow = &plan.shadow;
        let place = |name: &str| plan.channels().iter().position(|channel| channel.name == name).unwrap_or(0);
        let at = ["lx", "ly", "lz"].map(place);
        Shadow {
            size: shadow.size.into(),
            side: shadow.side_bits(),
            depth_bits: shadow.depth_bits,
            at,
            bits: [shadow.texel_bits(), shadow.texel_bits(), shadow.distance_bits()],
            gate: shadow.gate,
            color_bits: plan.color.bits,
            transmits: shadow.transmits(),
            places: shadow.queue as usize,
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

    /// Address of a texel to be read.
    #[must_use]
    pub fn read(&self, frag: Option<&Fragment<C>>, inputs: &ShadowInputs) -> Option<u32> {
        match self.place(frag?, inputs) {
            Place::Texel(addr) if !self.full() => Some(addr),
            _ => None,
        }
    }

    /// The fragment that is offered can be taken. `map`: the ports of the memory.
    #[must_use]
    pub fn frag_ready(&self, frag: Option<&Fragment<C>>, inputs: &ShadowInputs, map: &WordIn) -> bool {
        !self.full() && (map.ready || frag.is_none_or(|frag| self.has_place(self.place(frag, inputs), map)))
    }

    /// A fragment that lies there can be taken.
    #[inline]
    fn has_place(&self, place: Place, map: &WordIn) -> bool {
        !self.full() && (map.ready || !matches!(place, Place::Texel(_)))
    }

    /// Whether a fragment is offered to DEPTH.
    #[inline]
    #[must_use]
    pub fn offers(&self, map: &WordIn) -> bool {
        !self.queue.is_empty() && (self.queue.head().known || map.word.is_some())
    }

    /// Makes the fragment offered to DEPTH. False: none is.
    #[inline]
    pub fn shaded(&self, inputs: &ShadowInputs, map: &WordIn, fragment: &mut Fragment<C>) -> bool {
        if self.queue.is_empty() {
            return false;
        }
        let head = self.queue.head();
        let (lit, left) = match (head.known, map.word) {
            (true, _) => (head.value, self.all()),
            (false, Some(word)) => {
                let texel = self.texel(word);
                (head.d <= texel.depth, texel.left)
            }
            (false, None) => return false,
        };
        *fragment = head.fragment;
        fragment.lit = lit;
        if !lit || self.transmits {
            let share = match (lit, self.gate) {
                (true, _) => left,
                (false, Gate::And) => 0,
                (false, Gate::Scale) => inputs.ambient,
            };
            for channel in 1..=3 {
                fragment.values[channel] = self.gated(fragment.values[channel], share);
            }
        }
        true
    }

    /// The share that leaves a colour as it is.
    fn all(&self) -> u32 {
        u32::MAX >> (32 - self.color_bits)
    }

    fn texel(&self, word: u128) -> Texel {
        match self.transmits {
            true => Texel {
                depth: (word >> self.color_bits) as i64, // bz <= 24 bits
                left: word as u32 & self.all(),
            },
            false => Texel { depth: word as i64, left: self.all() },
        }
    }

    /// The word of a texel can be taken.
    #[must_use]
    pub fn mdata_ready(&self, shaded_ready: bool) -> bool {
        !self.queue.is_empty() && !self.queue.head().known && shaded_ready
    }

    /// Clock edge. `taken`: DEPTH takes the fragment that is offered to it.
    pub fn step(
        &mut self,
        frag: Option<&Fragment<C>>,
        inputs: &ShadowInputs,
        map: &WordIn,
        taken: bool,
        events: &mut Events,
    ) {
        let offered = frag.map(|frag| (frag, self.place(frag, inputs)));
        let pushed = offered.filter(|(_, place)| self.has_place(*place, map));
        if let Some((_, place)) = offered {
            self.count_offered(place, pushed.is_some(), events);
        }
        self.count_texel(map, taken, events);
        if taken {
            self.queue.pop();
        }
        if let Some((fragment, place)) = pushed {
            let known = !matches!(place, Place::Texel(_));
            let (value, d) = (place != Place::Behind, self.coordinate(fragment, 2));
            self.queue.push(Entry { fragment: *fragment, known, value, d });
        }
    }

    /// lx, ly or lz, signed.
    fn coordinate(&self, fragment: &Fragment<C>, which: usize) -> i64 {
        let (word, sign) = (i64::from(fragment.values[self.at[which]]), 1 << (self.bits[which] - 1));
        (word ^ sign) - sign
    }

    fn place(&self, fragment: &Fragment<C>, inputs: &ShadowInputs) -> Place {
        if inputs.light_pass {
            return Place::Own;
        }
        if !inputs.on {
            return Place::Off;
        }
        let (tx, ty, d) =
            (self.coordinate(fragment, 0), self.coordinate(fragment, 1), self.coordinate(fragment, 2));
        let inside = |t: i64| (0..self.size).contains(&t);
        if !inside(tx) || !inside(ty) {
            Place::Outside
        } else if d < 0 {
            Place::Before
        } else if d >> self.depth_bits > 0 {
            Place::Behind
        } else {
            Place::Texel((ty << self.side | tx) as u32) // at most 24 bits
        }
    }

    /// So large a share of a colour, b bits, all ones for all of it: to nearest.
    fn gated(&self, color: u32, share: u32) -> u32 {
        let product = u64::from(color) * u64::from(share) + (1 << (self.color_bits - 1));
        ((product + (product >> self.color_bits)) >> self.color_bits) as u32
    }

    /// What becomes of the fragment that is offered.
    fn count_offered(&self, place: Place, pushed: bool, events: &mut Events) {
        match place {
            _ if self.full() => events.shadow.shadow_queue_full += 1,
            Place::Texel(_) => events.shadow.map_stall += u64::from(!pushed),
            Place::Own => events.shadow.own_map += 1,
            Place::Off => events.shadow.shadow_off += 1,
            Place::Outside => events.shadow.outside_map += 1,
            Place::Before => events.shadow.before_map += 1,
            Place::Behind => events.shadow.behind_map += 1,
        }
        if pushed && !matches!(place, Place::Texel(_)) {
            let waits = (0..self.queue.len()).any(|i| !self.queue.at(i).known);
            events.shadow.known_behind_read += u64::from(waits);
        }
    }

    /// What the texel of the oldest fragment says.
    fn count_texel(&self, map: &WordIn, taken: bool, events: &mut Events) {
        if self.queue.is_empty() || self.queue.head().known {
            return;
        }
        let head = self.queue.head();
        match map.word {
            None => events.shadow.texel_wait += 1,
            Some(word) if taken => {
                let Texel { depth, left } = self.texel(word);
                events.shadow.texel_lit += u64::from(head.d <= depth);
                events.shadow.texel_shadow += u64::from(head.d > depth);
                events.shadow.texel_tie += u64::from(head.d == depth);
                events.shadow.texel_glass += u64::from(head.d <= depth && left < self.all());
            }
            Some(_) => {}
        }
    }
}

impl ShadowInputs {
    /// The constants of SHADOW.
    #[must_use]
    pub fn of(state: &DrawState) -> ShadowInputs {
        // b <= 16 bits
        ShadowInputs { on: state.shadow_on, light_pass: state.light_pass, ambient: state.ambient as u32 }
    }
}

impl<const C: usize> Ported<C> for Shadow<C> {
    type Takes = Fragment<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        let inputs = ShadowInputs::of(&pins.state);
        out.takes(self.frag_ready(pins.token, &inputs, &pins.word));
        let mut fragment = Fragment::default();
        let shaded = self.shaded(&inputs, &pins.word, &mut fragment);
        out.gives(shaded.then_some(&fragment));
        out.asks(Ask { addr: self.read(pins.token, &inputs), take: self.mdata_ready(pins.next) });
        out.status("shadow_full", self.full());
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        let inputs = ShadowInputs::of(&pins.state);
        let taken = pins.next && self.offers(&pins.word);
        self.step(pins.token, &inputs, &pins.word, taken, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
