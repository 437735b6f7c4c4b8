//! SHADE: the colour of a fragment, by tables that hold the material.
//!
//! ```text
//!  frag ─> [A] d, h, lit ─> [B] T[d], S[h] ─> [G] highlight · beam ─> [L] sums ─> [M] light · colour ─> [C] sum, cut ─> tinted
//!    └─another material─> srd, sdata ─> T, S
//! ```
//! Formats: N·L and N·H of t + 2 and t + m + 2 bits, two's complement, entries of a table; colours of b bits; light of b + 3,
//! 2^(b+2) for 1; the beam of 17 bits, 2^16 for 1.
//!
//! Timing: a fragment taken in cycle n is offered in n + 3, with `multiply` (stages L and M) two later, behind LAMP (stage G)
//! one later; one a clock. All stages move together. A material's tables are fetched one entry a clock when no stage holds a fragment.
//!
//! Rules: `docs/machine.md`, sections 12 and, of stage G, 17. Not modelled: when each stage does its part; colours are
//! found on the way in, as the tables stay while a fragment is inside.

mod view;

use crate::Events;
use crate::fetch::Fetch;
use crate::lit::{Cosines, Given, Lit};
use crate::ports::{Pins, Ported, Shown};
use crate::stages::Stages;
use crate::tokens::Fragment;
use crate::word_memory::Ask;
use crate::word_memory::WordIn;
use edgewalk_machine::{Plan, ShadeColour};

/// Most lights at once.
const LIGHTS: usize = 2;

/// A light at a fragment: an entry of T, and the highlight.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    diffuse: u64,
    highlight: u32,
}

/// A fragment in a stage.
#[derive(Clone, Copy, Debug)]
struct Shaded<const C: usize> {
    /// With the colours that stage C gives.
    frag: Fragment<C>,
    /// Colours before stage M, and those that it gives.
    own: [u32; 3],
    product: [u32; 3],
}

/// State of SHADE.
#[derive(Clone, Debug)]
pub struct Shade<const C: usize> {
    multiplies: bool,
    weakens: bool,
    color_bits: u32,
    table_bits: u32,
    entry_bits: u32,
    lights: usize,

    have: bool,
    /// cur.
    material: u32,
    fetch: Fetch,
    /// Entries of T and S, light by light.
    tables: Vec<(u64, u32)>,
    /// A, B, with LAMP G, with `multiply` L and M, and C.
    stages: Stages<Shaded<C>>,
}

impl<const C: usize> Shade<C> {
    /// An empty unit, without tables.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let shade = &plan.shade;
        Shade {
            multiplies: shade.colour == ShadeColour::Multiply,
            weakens: shade.is_positional(),
            color_bits: plan.color.bits,
            table_bits: shade.table_bits,
            entry_bits: shade.entry_bits(),
            lights: shade.lights as usize,
            have: false,
            material: 0,
            fetch: Fetch::of(shade.entries()),
            tables: vec![(0, 0); shade.entries() as usize],
            stages: Stages::new(
                3 + usize::from(shade.is_positional())
                    + if shade.colour == ShadeColour::Multiply { 2 } else { 0 },
            ),
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.have = false;
        self.fetch.reset();
        self.stages.clear();
    }

    /// A fragment is in a stage.
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.stages.held() > 0
    }

    /// The fragment offered on.
    #[must_use]
    pub fn tinted(&self) -> Option<&Fragment<C>> {
        self.stages.last().map(|shaded| &shaded.frag)
    }

    /// The tables of its material are here; without a fragment, those of material 0.
    fn fits(&self, frag: Option<Given<C>>) -> bool {
        self.have && frag.map_or(0, |given| given.cosines.material) == self.material
    }

    fn advance(&self, tinted_ready: bool) -> bool {
        self.tinted().is_none() || tinted_ready
    }

    /// The fragment that is offered can be taken.
    #[must_use]
    pub fn frag_ready(&self, frag: Option<Given<C>>, tinted_ready: bool) -> bool {
        self.advance(tinted_ready) && self.fits(frag)
    }

    /// The fragment that is offered waits for the tables of its material.
    #[must_use]
    pub fn waits(&self, frag: Option<Given<C>>) -> bool {
        frag.is_some() && !self.fits(frag)
    }

    /// Address of an entry to be read.
    #[must_use]
    pub fn read(&self) -> Option<u32> {
        self.fetch.read().map(|entry| self.material << self.entry_bits | entry)
    }

    /// An entry can be taken.
    #[must_use]
    pub fn sdata_ready(&self) -> bool {
        self.fetch.loading()
    }

    /// Clock edge. `tables`: the ports of the memory.
    pub fn step(&mut self, frag: Option<Given<C>>, tables: &WordIn, tinted_ready: bool, events: &mut Events) {
        let waiting = frag.filter(|given| !self.fits(Some(*given)));
        if self.fetch.loading() {
            self.load(tables, events);
        } else if let Some(given) = waiting {
            if self.occupied() {
                events.shade.tables_drain += u64::from(self.have);
            } else {
                events.shade.material_change += u64::from(self.have);
                self.fetch.begin();
                self.have = false;
                self.material = given.cosines.material;
            }
        }
        if !self.advance(tinted_ready) {
            events.shade.shade_stall += 1;
            return;
        }
        let taken = frag.filter(|_| waiting.is_none());
        let entering = taken.map(|given| self.shaded(given, events));
        self.stages.shift(entering);
    }

    fn load(&mut self, tables: &WordIn, events: &mut Events) {
        events.shade.table_read_stall += u64::from(self.fetch.send(tables.ready));
        let Some(word) = tables.word else { return };
        let highlight = word as u32 & self.largest(); // b <= 16 bits
        let (number, last) = self.fetch.take();
        self.tables[number as usize] = ((word >> self.color_bits) as u64, highlight);
        self.have = last;
        events.shade.tables_read += u64::from(last);
    }

    /// 2^b - 1.
    fn largest(&self) -> u32 {
        (1 << self.color_bits) - 1
    }

    /// The fragment, and its colours in every stage. The tables stay as they are while it is inside.
    fn shaded(&self, given: Given<C>, events: &mut Events) -> Shaded<C> {
        let mut frag = *given.frag;
        let own = [frag.values[1], frag.values[2], frag.values[3]];
        let lights: [Found; LIGHTS] = std::array::from_fn(|light| {
            if light < self.lights { self.found(given.cosines, light, events) } else { Found::default() }
        });
        let highlights: u32 = lights.iter().map(|found| found.highlight).sum();
        let (product, highlight) = match self.multiplies {
            true => (self.product(own, &lights), highlights.min(self.largest())),
            false => {
                let part = |place: u32, found: &Found| {
                    (found.diffuse >> (place * self.color_bits)) as u32 & self.largest()
                };
                ([2, 1, 0].map(|place| lights.iter().map(|found| part(place, found)).sum()), highlights)
            }
        };
        for (value, color) in frag.values[1..=3].iter_mut().zip(product) {
            *value = self.cut(color + highlight, events);
        }
        Shaded { frag, own, product }
    }

    /// Stages A, B and G: what the tables have of a light, and the highlight as far as the light comes.
    fn found(&self, cosines: &Cosines, light: usize, events: &mut Events) -> Found {
        let end = 1 << self.table_bits;
        let [d, h] = [cosines.terms[2 * light], cosines.terms[2 * light + 1]];
        events.shade.diffuse_below += u64::from(d < 0);
        events.shade.diffuse_above += u64::from(d >= end);
        events.shade.highlight_below += u64::from(h < 0);
        events.shade.highlight_above += u64::from(h >= end);
        events.shade.highlight_unlit += u64::from(d < 0 && h > 0);
        let table = &self.tables[light << self.table_bits..];
        let entry = |cosine: i32| table[cosine.clamp(0, end - 1) as usize];
        let highlight = if d < 0 { 0 } else { entry(h).1 };
        let highlight = match self.weakens {
            true => self.weakened(highlight, cosines.beam),
            false => highlight,
        };
        Found { diffuse: entry(d).0, highlight }
    }

    /// Stage G.
    fn weakened(&self, highlight: u32, beam: u32) -> u32 {
        let weakened = (u64::from(highlight) * u64::from(beam) + (1 << 15)) >> 16;
        (weakened as u32).min(self.largest()) // below 2^18
    }

    /// Stages L and M: the light of all, and colours times it.
    fn product(&self, own: [u32; 3], lights: &[Found; LIGHTS]) -> [u32; 3] {
        let shift = self.color_bits + 2;
        let one = 1u64 << shift;
        let light = lights.iter().map(|found| found.diffuse & (2 * one - 1)).sum::<u64>().min(one);
        own.map(|color| ((u64::from(color) * light + one / 2) >> shift) as u32)
    }

    fn cut(&self, color: u32, events: &mut Events) -> u32 {
        events.shade.color_saturated += u64::from(color > self.largest());
        color.min(self.largest())
    }
}

impl<const C: usize> Ported<C> for Shade<C> {
    type Takes = Lit<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        let frag = pins.token.map(Lit::given);
        out.takes(self.frag_ready(frag, pins.next));
        out.gives(self.tinted());
        out.asks(Ask { addr: self.read(), take: self.sdata_ready() });
        out.status("table_wait", self.waits(frag));
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        self.step(pins.token.map(Lit::given), &pins.word, pins.next, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
