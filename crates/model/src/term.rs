//! TERM: walks the terms from the start of a span to the start of the next.
//!
//! ```text
//!  span ─────────> there? ──────────────────────> walked
//!    └─fresh─> trd, tdata ─> V X Y XX XY YY ── down, forward, back
//! ```
//! Formats: words of b + r bits, modular; here of 64, of which the low ones count. Columns signed, COLW bits.
//!
//! Timing: a span that the walk has reached passes at once. A step is a clock, back two (`register`), or a clock for each word
//! that changes, and one more at the end (`memory`). A fresh span waits for its record: its words and the latency, and one.
//!
//! Rules: `docs/machine.md`, section 11. Not modelled: the operations of a step one by one; nothing shows a word before the
//! step is done, only their clocks are seen.

mod view;

use crate::Events;
use crate::fetch::Fetch;
use crate::lit::MAX_TERMS;
use crate::named::{Named, Number, Place, named};
use crate::ports::{Pins, Ported, Shown};
use crate::tokens::{Source, Sourced, Span, sign_extend};
use crate::word_memory::Ask;
use crate::word_memory::WordIn;
use edgewalk_machine::record::GLOSS_BITS;
use edgewalk_machine::{Plan, Walk};

/// V, X, Y, XX, XY, YY of a term; of degree 1 the last three are 0.
type Words = [u64; 6];

/// A term at a pixel of a span: word, step to the next pixel, step of the step. The low b + r bits count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// V at the pixel.
    pub v: u64,
    /// X: to the next pixel.
    pub g: u64,
    /// XX: from a step to the next.
    pub gg: u64,
}

/// What TERM adds to a span: behind the last term 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Walked {
    /// The terms at its first pixel.
    pub terms: [Steps; MAX_TERMS],
    /// The material.
    pub material: u32,
    /// Of the material's highlights, for NORMAL.
    pub gloss: u32,
}

named! {
    [] Walked, |_| Walked::default(),
    {
        terms [] terms ["_v"(.v), "_g"(.g), "_gg"(.gg)];
        material [material()];
        gloss [gloss()];
    }
}

/// A span with its terms, as TERM gives it to PIXEL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WalkedSpan<const C: usize> {
    /// The span.
    pub span: Span<C>,
    /// Terms at its first pixel.
    pub walked: Walked,
}

/// The names of both; the terms come first.
impl<const C: usize> Named for WalkedSpan<C> {
    const NAMES: u16 = Walked::NAMES + Span::<C>::NAMES;

    fn blank(_: &Plan) -> Self {
        WalkedSpan { span: Span::default(), walked: Walked::default() }
    }

    fn find(plan: &Plan, name: &str) -> Option<Place> {
        Walked::find(plan, name).or_else(|| Some(Span::<C>::find(plan, name)?.behind(Walked::NAMES)))
    }

    fn at(&mut self, place: Place) -> &mut dyn Number {
        match place.in_front(Walked::NAMES) {
            None => self.walked.at(place),
            Some(place) => self.span.at(place),
        }
    }
}

impl<const C: usize> Sourced for WalkedSpan<C> {
    fn source(&mut self) -> &mut Source {
        &mut self.span.source
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    Down,
    Forward,
    Back,
}

/// State of TERM.
#[derive(Clone, Debug)]
pub struct Term {
    in_memory: bool,
    column_bits: u32,
    line_mask: u32,
    /// μ, and the bits of gloss.
    material_bits: u32,
    gloss_mask: u32,
    /// wb.
    place_bits: u32,
    /// Words of the terms in a record, in order: which term, which of its words.
    layout: Vec<(usize, usize)>,
    /// S: operations of a step with the words in a memory.
    operations: u32,

    fetch: Fetch,
    begun: bool,
    x: i32,
    y: u32,
    /// Clocks of the step that are done; with a memory `op`, else `half`.
    done: u32,
    under_way: bool,
    material: u32,
    gloss: u32,
    terms: [Words; MAX_TERMS],
}

impl Term {
    /// A unit at rest.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let terms = plan.terms();
        let words =
            |(i, term): (usize, &edgewalk_machine::Term)| (0..term.words() as usize).map(move |w| (i, w));
        let quadratics = terms.iter().filter(|term| term.degree == 2).count();
        Term {
            in_memory: plan.shade.walk == Walk::Memory,
            column_bits: plan.widths().column,
            line_mask: (1 << plan.widths().y) - 1,
            material_bits: plan.shade.material_bits,
            gloss_mask: if plan.shade.normalises() { (1 << GLOSS_BITS) - 1 } else { 0 },
            place_bits: plan.record_place_bits(),
            layout: terms.iter().enumerate().flat_map(words).collect(),
            operations: (terms.len() + 2 * quadratics) as u32, // at most 3 a term
            fetch: Fetch::of(plan.record_length()),
            begun: false,
            x: 0,
            y: 0,
            done: 0,
            under_way: false,
            material: 0,
            gloss: 0,
            terms: [[0; 6]; MAX_TERMS],
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.fetch.reset();
        self.begun = false;
        self.done = 0;
        self.under_way = false;
    }

    /// The span belongs to the words that are here.
    fn fits<const C: usize>(&self, span: &Span<C>) -> bool {
        !self.fetch.loading() && (self.begun || !span.fresh)
    }

    /// The walk stands at the span's first pixel.
    fn stands_at<const C: usize>(&self, span: &Span<C>) -> bool {
        self.x == span.x && self.y == span.y
    }

    /// The span that is offered can go on to PIXEL.
    #[must_use]
    pub fn there<const C: usize>(&self, span: Option<&Span<C>>) -> bool {
        span.is_some_and(|span| self.fits(span) && self.stands_at(span) && !self.under_way)
    }

    /// A span is there, the walk not yet.
    #[must_use]
    pub fn waits<const C: usize>(&self, span: Option<&Span<C>>) -> bool {
        span.is_some() && !self.there(span)
    }

    /// Address of a word of the record to be read.
    #[must_use]
    pub fn read(&self, record: u32) -> Option<u32> {
        self.fetch.read().map(|word| record << self.place_bits | word)
    }

    /// A word of the record can be taken.
    #[must_use]
    pub fn tdata_ready(&self) -> bool {
        self.fetch.loading()
    }

    /// What goes on with the span that is there.
    #[must_use]
    pub fn walked(&self) -> Walked {
        let terms = self.terms.map(|[v, g, _, gg, ..]| Steps { v, g, gg });
        Walked { terms, material: self.material, gloss: self.gloss }
    }

    /// Clock edge. `records`: the ports of the memory; `taken`: PIXEL takes the span that is there.
    pub fn step<const C: usize>(
        &mut self,
        span: Option<&Span<C>>,
        records: &WordIn,
        taken: bool,
        events: &mut Events,
    ) {
        if self.fetch.loading() {
            self.load(records, events);
            return;
        }
        let Some(span) = span else { return };
        if taken {
            self.begun = false;
        } else if !self.fits(span) {
            self.fetch.begin();
        } else if !self.stands_at(span) {
            self.under_way = self.in_memory;
            self.walk(span, events);
        } else {
            events.term.walk_waits += u64::from(!self.under_way);
            events.term.walk_result_last += u64::from(self.under_way);
            self.under_way = false;
        }
    }

    fn load(&mut self, records: &WordIn, events: &mut Events) {
        events.term.term_read_stall += u64::from(self.fetch.send(records.ready));
        let Some(word) = records.word.map(|word| word as u64) else { return }; // at most 64 bits
        let (number, last) = self.fetch.take();
        match number {
            0 => self.x = sign_extend(word as i32, self.column_bits),
            1 => self.y = word as u32 & self.line_mask,
            2 => {
                self.material = word as u32 & ((1 << self.material_bits) - 1);
                self.gloss = (word >> self.material_bits) as u32 & self.gloss_mask;
            }
            place => {
                let (term, which) = self.layout[place as usize - 3];
                self.terms[term][which] = word;
            }
        }
        self.begun = last;
        events.term.record_read += u64::from(last);
    }

    /// A clock of the step that leads on to the span.
    fn walk<const C: usize>(&mut self, span: &Span<C>, events: &mut Events) {
        let way = self.way(span);
        let clocks = match (self.in_memory, way) {
            (true, _) => self.operations,
            (false, Way::Back) => 2,
            (false, _) => 1,
        };
        self.done += 1;
        if self.done < clocks {
            return;
        }
        self.done = 0;
        let ahead = if span.leftward { -1 } else { 1 };
        match way {
            Way::Down => {
                self.y = (self.y + 1) & self.line_mask;
                events.term.walk_down += 1;
            }
            Way::Forward => {
                self.x = sign_extend(self.x + ahead, self.column_bits);
                events.term.walk_forward += 1;
            }
            Way::Back => {
                self.x = sign_extend(self.x - ahead, self.column_bits);
                events.term.walk_back += 1;
            }
        }
        for [v, x, y, xx, xy, yy] in &mut self.terms {
            match way {
                Way::Down => {
                    *v = v.wrapping_add(*y);
                    *x = x.wrapping_add(*xy);
                    *y = y.wrapping_add(*yy);
                }
                Way::Forward => {
                    *v = v.wrapping_add(*x);
                    *x = x.wrapping_add(*xx);
                    *y = y.wrapping_add(*xy);
                }
                Way::Back => {
                    *x = x.wrapping_sub(*xx);
                    *y = y.wrapping_sub(*xy);
                    *v = v.wrapping_sub(*x);
                }
            }
        }
    }

    fn way<const C: usize>(&self, span: &Span<C>) -> Way {
        if self.y != span.y {
            return Way::Down;
        }
        let right = sign_extend(span.x - self.x, self.column_bits);
        let ahead = if span.leftward { sign_extend(-right, self.column_bits) } else { right };
        if ahead > 0 { Way::Forward } else { Way::Back }
    }
}

impl<const C: usize> Ported<C> for Term {
    type Takes = Span<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        let there = self.there(pins.token);
        out.takes(there && pins.next);
        let walked =
            pins.token.filter(|_| there).map(|span| WalkedSpan { span: *span, walked: self.walked() });
        out.gives(walked.as_ref());
        out.asks(Ask { addr: self.read(pins.held.record), take: self.tdata_ready() });
        out.status("term_wait", self.waits(pins.token));
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        let taken = pins.next && self.there(pins.token);
        self.step(pins.token, &pins.word, taken, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
