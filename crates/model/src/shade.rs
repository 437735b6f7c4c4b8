//! SHADE: the colour of a fragment, by tables that hold the material.
//!
//! ```text
//!  frag ─> [A] d, h, lit ─> [B] T[d], S[h] ─> [G] highlight · beam ─> [M] light · colour ─> [C] sum, cut ─> tinted
//!    └─another material─> srd, sdata ─> T, S
//! ```
//! Formats: N·L and N·H of t + 2 and t + m + 2 bits, two's complement, entries of a table; colours of b bits; light of b + 3,
//! 2^(b+2) for 1; the beam of 17 bits, 2^16 for 1.
//!
//! Timing: a fragment taken in cycle n is offered in n + 3, with `multiply` (stage M) and behind LAMP (stage G) one later each; one a clock. All stages move
//! together. A material's tables are fetched one entry a clock when no stage holds a fragment.
//!
//! Rules: `docs/machine.md`, sections 12 and, of stage G, 17. Not modelled: nothing.

mod view;

use crate::Events;
use crate::fetch::Fetch;
use crate::lit::{Cosines, Given, Lit};
use crate::ports::{Pins, Ported, Shown};
use crate::tokens::Fragment;
use crate::word_memory::Ask;
use crate::word_memory::WordIn;
use edgewalk_machine::{Plan, ShadeColour};

/// Most lights at once.
const LIGHTS: usize = 2;

/// A light of a fragment, in stage A.
#[derive(Clone, Copy, Debug, Default)]
struct Indices {
    diffuse: usize,
    highlight: usize,
    lit: bool,
    beam: u32,
}

/// The same in stage B: an entry of T, and s.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    diffuse: u64,
    highlight: u32,
    beam: u32,
}

/// A fragment in a stage, and what is known of its light.
type Stage<T, const C: usize> = Option<(Fragment<C>, T)>;

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
    a: Stage<[Indices; LIGHTS], C>,
    b: Stage<[Found; LIGHTS], C>,
    g: Stage<[Found; LIGHTS], C>,
    /// With the sum of the highlights.
    m: Stage<u32, C>,
    c: Option<Fragment<C>>,
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
            a: None,
            b: None,
            g: None,
            m: None,
            c: None,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.have = false;
        self.fetch.reset();
        (self.a, self.b, self.g, self.m, self.c) = (None, None, None, None, None);
    }

    /// A fragment is in a stage.
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.a.is_some() || self.b.is_some() || self.g.is_some() || self.m.is_some() || self.c.is_some()
    }

    /// The fragment offered on.
    #[must_use]
    pub fn tinted(&self) -> Option<&Fragment<C>> {
        self.c.as_ref()
    }

    /// The tables of its material are here; without a fragment, those of material 0.
    fn fits(&self, frag: Option<Given<C>>) -> bool {
        self.have && frag.map_or(0, |given| given.cosines.material) == self.material
    }

    fn advance(&self, tinted_ready: bool) -> bool {
        self.c.is_none() || tinted_ready
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
        let found = if self.weakens { self.g } else { self.b };
        self.c = if self.multiplies {
            let product = self.m.map(|(fragment, highlight)| self.sum(fragment, highlight, events));
            self.m = found.map(|(fragment, lights)| self.product(fragment, &lights));
            product
        } else {
            found.map(|(fragment, lights)| self.colours(fragment, &lights, events))
        };
        if self.weakens {
            self.g = self.b.map(|(fragment, lights)| (fragment, lights.map(|light| self.weakened(light))));
        }
        self.b = self.a.map(|(fragment, indices)| (fragment, self.look_up(&indices)));
        let taken = frag.filter(|_| waiting.is_none());
        self.a = taken.map(|given| (*given.frag, self.indices(given.cosines, events)));
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

    /// Stage A.
    fn indices(&self, cosines: &Cosines, events: &mut Events) -> [Indices; LIGHTS] {
        let end = 1 << self.table_bits;
        let index = |cosine: i32| cosine.clamp(0, end - 1) as usize;
        std::array::from_fn(|light| {
            if light >= self.lights {
                return Indices::default();
            }
            let [d, h] = [cosines.terms[2 * light], cosines.terms[2 * light + 1]];
            events.shade.diffuse_below += u64::from(d < 0);
            events.shade.diffuse_above += u64::from(d >= end);
            events.shade.highlight_below += u64::from(h < 0);
            events.shade.highlight_above += u64::from(h >= end);
            events.shade.highlight_unlit += u64::from(d < 0 && h > 0);
            Indices { diffuse: index(d), highlight: index(h), lit: d >= 0, beam: cosines.beam }
        })
    }

    /// Stage B.
    fn look_up(&self, indices: &[Indices; LIGHTS]) -> [Found; LIGHTS] {
        std::array::from_fn(|light| {
            if light >= self.lights {
                return Found::default();
            }
            let of_light = &self.tables[light << self.table_bits..];
            let Indices { diffuse, highlight, lit, beam } = indices[light];
            let highlight = if lit { of_light[highlight].1 } else { 0 };
            Found { diffuse: of_light[diffuse].0, highlight, beam }
        })
    }

    /// Stage G: the highlight as far as the light comes.
    fn weakened(&self, light: Found) -> Found {
        let highlight = (u64::from(light.highlight) * u64::from(light.beam) + (1 << 15)) >> 16;
        Found { highlight: (highlight as u32).min(self.largest()), ..light } // below 2^18
    }

    /// Stage M: the fragment's colours times the light, and the sum of the highlights.
    fn product(&self, mut fragment: Fragment<C>, lights: &[Found; LIGHTS]) -> (Fragment<C>, u32) {
        let one = 1u64 << (self.color_bits + 2);
        let light = lights.iter().map(|found| found.diffuse & (2 * one - 1)).sum::<u64>().min(one);
        for color in &mut fragment.values[1..=3] {
            *color = ((u64::from(*color) * light + one / 2) / one) as u32;
        }
        let highlights: u32 = lights.iter().map(|found| found.highlight).sum();
        (fragment, highlights.min(self.largest()))
    }

    /// Stage C behind M.
    fn sum(&self, mut fragment: Fragment<C>, highlight: u32, events: &mut Events) -> Fragment<C> {
        for color in &mut fragment.values[1..=3] {
            *color = self.cut(*color + highlight, events);
        }
        fragment
    }

    /// Stage C behind B.
    fn colours(
        &self,
        mut fragment: Fragment<C>,
        lights: &[Found; LIGHTS],
        events: &mut Events,
    ) -> Fragment<C> {
        let highlights: u32 = lights.iter().map(|found| found.highlight).sum();
        for (color, place) in fragment.values[1..=3].iter_mut().zip([2, 1, 0]) {
            let part = |found: &Found| (found.diffuse >> (place * self.color_bits)) as u32 & self.largest();
            *color = self.cut(lights.iter().map(part).sum::<u32>() + highlights, events);
        }
        fragment
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
