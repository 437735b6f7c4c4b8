//! POLY: walks all edges of a polygon down its lines, and gives a span for each pair of them.
//!
//! ```text
//!  prim ─> LOAD ─> edge table, order list ─> PASS ─pair─> MOVER ─> line {y, columns, values}
//!                       lists 0 and 1 of a line's edges ^─┘
//! ```
//! Formats: columns of COLW bits, remainders below M, values of b + r bits, all modular.
//!
//! Timing: an edge is loaded in a clock, the next polygon while one is walked. A line of n edges takes n + 2 clocks and one
//! more for each that enters; a span moves a line a clock, and by a column's distance in as many clocks as that has bits.
//!
//! Rules: `docs/machine.md`, section 19. Not modelled: nothing.

mod table;
mod along;
mod load;
mod pass;
mod between;
mod mover;
mod view;

use crate::Events;
use crate::counters::one_more;
use crate::ports::{Held, Pins, Ported, Shown};
use crate::tokens::{Line, Prim, Words};
use edgewalk_machine::{COLOURS, Plan};
use load::Load;
use mover::Mover;
use pass::Pass;

/// State of POLY.
#[derive(Clone, Debug)]
pub struct Poly<const C: usize> {
    /// W of the picture and, with `light_pass`, of the map.
    widths: [i32; 2],
    load: Load,
    pass: Pass,
    mover: Mover<C>,
    /// g, k_t and record of the last polygon that was begun.
    held: Held<C>,
}

impl<const C: usize> Poly<C> {
    /// A unit at rest.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        Poly {
            widths: [plan.width, plan.shadow.size].map(|side| side as i32), // at most 2^13
            load: Load::new(plan),
            pass: Pass::new(plan),
            mover: Mover::new(plan),
            held: Held::default(),
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.load.reset();
        self.pass.reset();
        self.mover.reset();
    }

    /// A polygon is being walked, or its last span waits.
    #[inline]
    #[must_use]
    pub fn walking(&self) -> bool {
        self.pass.runs() || self.pass.pair().is_some() || self.mover.has_span()
    }

    /// The prim offered can be taken: its edges are loaded and, if it ends a polygon, the one before is over.
    #[inline]
    #[must_use]
    pub fn prim_ready(&self, prim: &Prim<C>, fresh_queued: bool) -> bool {
        self.load.is_through() && (!prim.ends || !self.walking() && !fresh_queued)
    }

    /// The polygon that this prim ends has more edges than the table; asked in the cycle in which it is taken.
    fn refuses(&self, prim: &Prim<C>) -> bool {
        prim.ends && self.load.over()
    }

    /// The pair that waits for MOVER: its line, the columns of its edges, and their colours, words of b + r bits.
    #[must_use]
    pub fn pair(&self) -> Option<(u32, [i32; 2], [[u64; 3]; 2])> {
        self.pass.pair().map(|pair| (pair.y, pair.columns(), pair.ends.map(|end| end.colours)))
    }

    /// The line offered to SPAN.
    #[inline]
    #[must_use]
    pub fn line(&self) -> Option<&Line<C>> {
        self.mover.line()
    }

    /// g: the gradients of the polygon, for PIXEL.
    #[inline]
    #[must_use]
    pub fn gradient(&self) -> &Words<C> {
        &self.held.gradient
    }

    /// k_t of the polygon, for PIXEL; 0 where it is a channel.
    #[inline]
    #[must_use]
    pub fn kt(&self) -> u32 {
        self.held.kt
    }

    /// The record of the polygon, for TERM.
    #[inline]
    #[must_use]
    pub fn record(&self) -> u32 {
        self.held.record
    }

    /// Clock edge; `line_taken`: the line offered is taken.
    pub fn step(
        &mut self,
        prim: Option<&Prim<C>>,
        fresh_queued: bool,
        line_taken: bool,
        light_pass: bool,
        events: &mut Events,
    ) {
        let fires = prim.filter(|prim| self.prim_ready(prim, fresh_queued));
        if let Some(prim) = prim
            && prim.ends
            && fires.is_none()
            && self.load.is_through()
        {
            one_more(&mut events.poly.polygon_fresh_wait);
        }
        if self.line().is_some() && !line_taken {
            one_more(&mut events.poly.polygon_fifo_full);
        }
        let width = self.widths[usize::from(light_pass)];
        let pair = self.pass.pair();
        let emptied = pair.is_some_and(|pair| self.mover.sees(&pair, line_taken, width, events));
        let gradients = self.mover.step(line_taken, pair.filter(|_| emptied), width, fresh_queued, events);
        if let Some(gradients) = gradients {
            self.held.gradient[COLOURS].copy_from_slice(&gradients);
        }
        let (walks, writes) = (self.pass.runs(), self.pass.writes());
        self.load.step(prim, writes, walks, events);
        self.pass.step(self.load.walked(), emptied, events);
        if let Some(prim) = fires {
            self.take(prim, events);
        }
    }

    /// The prim fires.
    fn take(&mut self, prim: &Prim<C>, events: &mut Events) {
        let refused = self.refuses(prim);
        let edges = self.load.take(prim.ends);
        if !prim.ends {
            return;
        }
        events.poly.polygon_refused += u64::from(refused);
        events.poly.polygon_void += u64::from(prim.void);
        events.poly.polygon_ends_only += u64::from(edges == 0);
        if refused || prim.void || edges == 0 {
            return;
        }
        events.poly.polygon_full += u64::from(self.load.is_full(edges));
        let mut gradient = prim.gradient;
        if self.mover.divides() {
            // Those of colours are of a span.
            gradient[COLOURS].copy_from_slice(&self.held.gradient[COLOURS]);
        }
        self.held = Held { gradient, kt: prim.kt, record: prim.record };
        self.pass.begin(edges, prim.start_pixel[1], prim.thin);
        self.mover.begin(prim);
    }
}

impl<const C: usize> Ported<C> for Poly<C> {
    type Takes = Prim<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        let fires = pins.token.filter(|prim| self.prim_ready(prim, pins.fresh_queued));
        out.takes(fires.is_some());
        out.gives(self.line());
        out.holds(&self.held);
        out.status("walking", self.walking());
        out.status("refused", fires.is_some_and(|prim| self.refuses(prim)));
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        let taken = pins.next && self.line().is_some();
        self.step(pins.token, pins.fresh_queued, taken, pins.state.light_pass, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
