//! NORMAL: divides the products of a fragment's normal by the normal's length.
//!
//! ```text
//!  frag ─> [N1] s ─> [N2, N3] R[s] ─> [N4] slope·low ─> [N5] y = 1/√s ─> [N6] p·y ─> [N7] index ─> normed
//!    └─first─> rrd, rdata ─> R
//! ```
//! Formats: products and s in 2^-16, y too; cosines in entries of SHADE's tables.
//!
//! Timing: a fragment taken in cycle n is offered in n + 7; one a clock. All stages move together. The table R is fetched
//! once, one entry a clock, when the first fragment is there.
//!
//! Rules: `docs/machine.md`, section 13. Not modelled: what each stage holds, as R does not change; cosines are found on
//! the way in.

mod view;

use crate::Events;
use crate::fetch::Fetch;
use crate::lit::{Cosines, Given, Lit, MAX_TERMS};
use crate::ports::{Pins, Ported, Shown};
use crate::stages::Stages;
use crate::word_memory::Ask;
use crate::word_memory::WordIn;
use edgewalk_machine::Plan;

/// Entries of R.
const ENTRIES: u32 = 256;

/// State of NORMAL.
#[derive(Clone, Debug)]
pub struct Normal<const C: usize> {
    table_bits: u32,
    gloss_bits: u32,
    /// Place of N·N among the terms; before it two a light.
    square: usize,
    have: bool,
    fetch: Fetch,
    /// v and slope.
    roots: Vec<(i64, i64)>,
    /// N1 to N7.
    stages: Stages<Lit<C>>,
}

impl<const C: usize> Normal<C> {
    /// An empty unit, without roots.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        Normal {
            table_bits: plan.shade.table_bits,
            gloss_bits: plan.shade.gloss_bits,
            square: 2 * plan.shade.lights as usize,
            have: false,
            fetch: Fetch::of(ENTRIES),
            roots: vec![(0, 0); ENTRIES as usize],
            stages: Stages::new(7),
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

    /// The fragment offered to SHADE, with its cosines.
    #[must_use]
    pub fn normed(&self) -> Option<&Lit<C>> {
        self.stages.last()
    }

    fn advance(&self, normed_ready: bool) -> bool {
        self.normed().is_none() || normed_ready
    }

    /// A fragment can be taken.
    #[must_use]
    pub fn frag_ready(&self, normed_ready: bool) -> bool {
        self.advance(normed_ready) && self.have
    }

    /// A fragment waits for the roots.
    #[must_use]
    pub fn waits(&self, frag: Option<Given<C>>) -> bool {
        frag.is_some() && !self.have
    }

    /// Address of a root to be read.
    #[must_use]
    pub fn read(&self) -> Option<u32> {
        self.fetch.read()
    }

    /// A root can be taken.
    #[must_use]
    pub fn rdata_ready(&self) -> bool {
        self.fetch.loading()
    }

    /// Clock edge. Beside the fragment are the outputs of its terms; `roots`: the ports of the memory.
    pub fn step(&mut self, frag: Option<Given<C>>, roots: &WordIn, normed_ready: bool, events: &mut Events) {
        let waits = self.waits(frag);
        if self.fetch.loading() {
            self.load(roots, events);
        } else if waits {
            self.fetch.begin();
        }
        if !self.advance(normed_ready) {
            events.normal.normal_stall += 1;
            return;
        }
        let taken = frag.filter(|_| !waits);
        let normed =
            |given: Given<C>| Lit { frag: *given.frag, cosines: self.cosines(given.cosines, events) };
        let entering = taken.map(normed);
        self.stages.shift(entering);
    }

    fn load(&mut self, roots: &WordIn, events: &mut Events) {
        events.normal.root_read_stall += u64::from(self.fetch.send(roots.ready));
        let Some(word) = roots.word else { return };
        let (number, last) = self.fetch.take();
        self.roots[number as usize] = ((word >> 10) as i64 & 0x1_ffff, word as i64 & 0x3ff);
        self.have = last;
        events.normal.roots_read += u64::from(last);
    }

    /// What SHADE takes.
    fn cosines(&self, terms: &Cosines, events: &mut Events) -> Cosines {
        let y = self.root(terms.terms[self.square].into(), events);
        let (t, gloss) = (self.table_bits, terms.gloss);
        let mut cosines = Cosines { material: terms.material, ..Cosines::default() };
        for (place, product) in terms.terms[..self.square].iter().enumerate() {
            let cosine = (i64::from(*product) * y + (1 << 15)) >> 16;
            let highlight = place % 2 == 1;
            let (scaled, bits) = match highlight {
                false => (cosine, t + 2),
                true => (((cosine - (1 << 16)) << gloss) + (1 << 16), t + self.gloss_bits + 2),
            };
            let (index, cut) = index(scaled, 16 - t, bits);
            events.normal.cosine_cut += u64::from(cut);
            cosines.terms[place] = index;
        }
        cosines
    }

    /// y: 1/√s in 2^-16.
    fn root(&self, square: i64, events: &mut Events) -> i64 {
        events.normal.normal_short += u64::from(square < 1 << 14);
        events.normal.normal_long += u64::from(square >= 1 << 16);
        let s = square.clamp(1 << 14, (1 << 16) - 1);
        let (v, slope) = self.roots[(s >> 8) as usize];
        (v - ((slope * (s & 0xff) + (1 << 7)) >> 8)) & 0x1_ffff
    }
}

/// The place in a table of a number with so many bits below an entry, cut to so many bits, and whether it was.
pub(crate) fn index(number: i64, below: u32, bits: u32) -> (i32, bool) {
    let (index, end) = (number >> below, 1i64 << (bits - 1));
    let within = index.clamp(-end, end - 1);
    (within as i32, within != index) // at most 20 bits
}

const _: () = assert!(MAX_TERMS >= 5, "two lights and N·N");

impl<const C: usize> Ported<C> for Normal<C> {
    type Takes = Lit<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.frag_ready(pins.next));
        out.gives(self.normed());
        out.asks(Ask { addr: self.read(), take: self.rdata_ready() });
        out.status("table_wait", self.waits(pins.token.map(Lit::given)));
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        self.step(pins.token.map(Lit::given), &pins.word, pins.next, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
