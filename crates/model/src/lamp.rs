//! LAMP: the cosines of a light at a point, and how much of it comes.
//!
//! ```text
//!  frag ─> there <─> here: 34 clocks for two fragments, 3 roots, tables C and A, 13 products each ─> nl, nh, beam ─> normed
//!    └─first─> rrd, rdata ─> R, C, A
//! ```
//! Formats: l·l in 2^-30, products with l and V in 2^-23, N·N in 2^-16; cosines, attenuation and beam in 2^-16.
//!
//! Timing: a fragment taken in cycle n is offered in n + 34; two in 34 clocks, in turn. The tables are fetched once, one word a
//! clock, when the first fragment is there.
//!
//! Rules: `docs/machine.md`, section 17. Not modelled: which product is made when; a fragment's cosines are found on its way in.

mod view;

use crate::Events;
use crate::fetch::Fetch;
use crate::lit::{Cosines, Given, Lit};
use crate::normal::index;
use crate::ports::{Pins, Ported, Shown};
use crate::word_memory::Ask;
use crate::word_memory::WordIn;
use edgewalk_machine::Plan;

/// The step in which a fragment is done.
const LAST: u32 = 17;

/// Where C and A begin among the words.
const BEAM: usize = 256;
const ATTENUATION: usize = 512;

/// State of LAMP.
#[derive(Clone, Debug)]
pub struct Lamp<const C: usize> {
    table_bits: u32,
    gloss_bits: u32,
    have: bool,
    fetch: Fetch,
    /// v and slope.
    words: Vec<(i64, i64)>,
    /// The fragment in the first half of its step.
    here: Option<Place<C>>,
    /// The fragment in the second half of its step.
    there: Option<Place<C>>,
}

/// A fragment inside.
#[derive(Clone, Debug)]
struct Place<const C: usize> {
    lit: Lit<C>,
    /// 0 to [`LAST`].
    step: u32,
}

/// The root of a number: what is divided by it is shifted by k first.
struct Root {
    k: u32,
    m: i64,
    y: i64,
}

impl<const C: usize> Lamp<C> {
    /// An empty unit, without tables.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let words = plan.root_words();
        Lamp {
            table_bits: plan.shade.table_bits,
            gloss_bits: plan.shade.gloss_bits,
            have: false,
            fetch: Fetch::of(words),
            words: vec![(0, 0); words as usize],
            here: None,
            there: None,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.have = false;
        self.fetch.reset();
        (self.here, self.there) = (None, None);
    }

    /// A fragment is inside.
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.here.is_some() || self.there.is_some()
    }

    /// Fragments are inside, and none is done.
    #[must_use]
    pub fn working(&self) -> bool {
        self.occupied() && self.normed().is_none()
    }

    /// The fragment offered to SHADE, with its cosines.
    #[must_use]
    pub fn normed(&self) -> Option<&Lit<C>> {
        self.here.as_ref().filter(|place| place.step == LAST).map(|place| &place.lit)
    }

    /// A fragment can be taken.
    #[must_use]
    pub fn frag_ready(&self, normed_ready: bool) -> bool {
        self.have && (self.here.is_none() || (self.normed().is_some() && normed_ready))
    }

    /// A fragment waits for the tables.
    #[must_use]
    pub fn waits(&self, frag: Option<Given<C>>) -> bool {
        frag.is_some() && !self.have
    }

    /// Address of a word to be read.
    #[must_use]
    pub fn read(&self) -> Option<u32> {
        self.fetch.read()
    }

    /// A word can be taken.
    #[must_use]
    pub fn rdata_ready(&self) -> bool {
        self.fetch.loading()
    }

    /// Clock edge. Beside the fragment are the outputs of its terms; `tables`: the ports of the memory.
    pub fn step(&mut self, frag: Option<Given<C>>, tables: &WordIn, normed_ready: bool, events: &mut Events) {
        let (waits, ready) = (self.waits(frag), self.frag_ready(normed_ready));
        if self.fetch.loading() {
            self.load(tables, events);
        } else if waits {
            self.fetch.begin();
        }
        let done = self.normed().is_some();
        events.lamp.lamp_wait += u64::from(frag.is_some() && self.here.is_some() && !done);
        if done && !normed_ready {
            events.lamp.lamp_stall += 1;
            return;
        }
        let stays = self.here.take().filter(|_| !done);
        self.here = self.there.take().map(|place| Place { step: place.step + 1, ..place });
        self.there = match frag.filter(|_| ready) {
            Some(given) => {
                let lit = Lit { frag: *given.frag, cosines: self.cosines(given.cosines, events) };
                Some(Place { lit, step: 0 })
            }
            None => stays,
        };
    }

    fn load(&mut self, tables: &WordIn, events: &mut Events) {
        events.lamp.lamp_read_stall += u64::from(self.fetch.send(tables.ready));
        let Some(word) = tables.word else { return };
        let (number, last) = self.fetch.take();
        self.words[number as usize] = ((word >> 16) as i64 & 0x1_ffff, word as i64 & 0xffff);
        self.have = last;
        events.lamp.lamp_read += u64::from(last);
    }

    /// What SHADE takes.
    fn cosines(&self, terms: &Cosines, events: &mut Events) -> Cosines {
        let [dd, pl, dv, da, pv, nn, ..] = terms.terms.map(i64::from);
        let far = self.root(dd, events);
        events.lamp.lamp_near += u64::from(far.k > 0);
        let attenuation =
            self.look(ATTENUATION as i64 + 64 * i64::from(far.k) + (far.m >> 10), far.m & 0x3ff);
        let [toward, way, axis] = [pl, dv, da].map(|product| far.divided(product, events));

        let normal = self.root(nn << 14, events);
        let diffuse = normal.divided(toward << 7, events);
        let viewed = normal.divided(pv, events);

        let beside = (1 << 16) - axis;
        let cone = beside.clamp(0, 0xffff);
        let dark = beside > self.words[0].0;
        events.lamp.lamp_beside += u64::from(dark);
        let cone = if dark { 0 } else { self.look(BEAM as i64 + (cone >> 8), (cone & 0xff) << 2) };
        let beam = times(attenuation, cone, events);

        let both = self.root(((1 << 16) + way) << 13, events);
        let halfway = both.divided((diffuse + viewed) << 6, events);

        let (t, m) = (self.table_bits, self.gloss_bits);
        let mut cosines = Cosines { material: terms.material, beam: beam as u32, ..Cosines::default() };
        let (nl, nl_cut) = index(diffuse * beam, 32 - t, t + 2);
        let scaled = ((halfway - (1 << 16)) << terms.gloss) + (1 << 16);
        let (nh, nh_cut) = index(scaled, 16 - t, t + m + 2);
        events.lamp.lamp_cut += u64::from(nl_cut) + u64::from(nh_cut);
        (cosines.terms[0], cosines.terms[1]) = (nl, nh);
        cosines
    }

    /// Of x, 2^-30.
    fn root(&self, x: i64, events: &mut Events) -> Root {
        let x = x.clamp(0, (1 << 30) - 1);
        let k = (0..7).take_while(|k| x << (2 * k + 2) < 1 << 30).count() as u32;
        let m = x << (2 * k) >> 14;
        events.lamp.lamp_short += u64::from(m < 1 << 14);
        let m = m.max(1 << 14);
        Root { k, m, y: self.look(m >> 8, (m & 0xff) << 2) }
    }

    /// Between an entry and the next.
    fn look(&self, entry: i64, low: i64) -> i64 {
        let (v, slope) = self.words[entry as usize];
        (v - ((slope * low + (1 << 9)) >> 10)) & 0x1_ffff
    }
}

impl Root {
    /// A number in 2^-23 over the root, 2^-16.
    fn divided(&self, number: i64, events: &mut Events) -> i64 {
        let near = cut(((number << self.k) + (1 << 6)) >> 7, events);
        times(near, self.y, events)
    }
}

/// A product of two numbers in 2^-16.
fn times(a: i64, b: i64, events: &mut Events) -> i64 {
    cut((a * b + (1 << 15)) >> 16, events)
}

/// Cut to 18 bits.
fn cut(number: i64, events: &mut Events) -> i64 {
    let within = number.clamp(-(1 << 17), (1 << 17) - 1);
    events.lamp.lamp_cut += u64::from(within != number);
    within
}

impl<const C: usize> Ported<C> for Lamp<C> {
    type Takes = Lit<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.frag_ready(pins.next));
        out.gives(self.normed());
        out.asks(Ask { addr: self.read(), take: self.rdata_ready() });
        out.status("table_wait", self.waits(pins.token.map(Lit::given)));
        out.status("working", self.working());
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        self.step(pins.token.map(Lit::given), &pins.word, pins.next, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
