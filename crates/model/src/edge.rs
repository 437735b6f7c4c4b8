//! EDGE: walks the major and a minor edge down the triangle, one line a clock.
//!
//! ```text
//!          ┌─> major C,R ─carry─┐
//!  prim ───┼─> minor C,R        │      ┌─> line {y, columns, values}
//!          └─> values += d0 / d1 ──────┘
//! ```
//! Formats: columns of COLW bits, remainders below M, values of b + r bits, all modular.
//!
//! Timing: a prim taken in cycle n gives its first line in n + 1, then a line a clock; the next prim is taken at the
//! earliest in the cycle after the last line. Behind a sequenced SETUP the prim stays at the port while it is walked, and is
//! taken behind its last line.
//!
//! Rules: `docs/machine.md`, section 3. Not modelled: nothing.

mod view;

use crate::Events;
use crate::counters::one_more;
use crate::ports::{Held, Pins, Ported, Shown};
use crate::tokens::{EdgeWalk, Line, Prim, Words, add, per_channel, word_masks};
use edgewalk_machine::{Fill, Plan};

/// State of EDGE.
#[derive(Clone, Debug)]
pub struct Edge<const C: usize> {
    textbook: bool,
    column_bits: u32,
    masks: Words<C>,
    /// 2^(b+r-1) of signed channels, else 0: with this bit turned the range of a word begins at 0.
    signs: Words<C>,
    running: bool,
    /// A prim stays at the port while it is walked.
    stays: bool,
    /// The triangle is walked, and not taken yet.
    walked: bool,
    /// The line offered: y, columns C of both edges, values, marks.
    line: Line<C>,
    /// Lines remaining in each part.
    remaining: [u32; 2],
    major: EdgeWalk,
    minor: EdgeWalk,
    /// What the whole triangle needs: second minor edge, startB, increments.
    held: Prim<C>,
}

impl<const C: usize> Edge<C> {
    /// A unit at rest.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        Edge {
            textbook: plan.fill == Fill::Textbook,
            column_bits: plan.widths().column,
            masks: word_masks(plan),
            signs: per_channel(plan, |c| u64::from(c.kind.is_signed()) << (c.word() - 1)),
            running: false,
            stays: plan.is_sequenced(),
            walked: false,
            line: Line::default(),
            remaining: [0; 2],
            major: EdgeWalk::default(),
            minor: EdgeWalk::default(),
            held: Prim::default(),
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.running = false;
        self.walked = false;
    }

    /// A triangle is being walked, and its line is valid.
    #[inline]
    #[must_use]
    pub fn running(&self) -> bool {
        self.running
    }

    /// A prim can be taken: no triangle runs, and PIXEL has taken the gradients of the last. One that stays at the port has been
    /// walked.
    #[inline]
    #[must_use]
    pub fn prim_ready(&self, fresh_queued: bool) -> bool {
        !self.running && !fresh_queued && (self.walked || !self.stays)
    }

    /// The line offered to SPAN.
    #[inline]
    #[must_use]
    pub fn line(&self) -> Option<&Line<C>> {
        self.running.then_some(&self.line)
    }

    /// g: the gradients of the last prim, for PIXEL.
    #[inline]
    #[must_use]
    pub fn gradient(&self) -> &Words<C> {
        &self.held.gradient
    }

    /// k_t of the last prim, for PIXEL; 0 where it is a channel.
    #[inline]
    #[must_use]
    pub fn kt(&self) -> u32 {
        self.held.kt
    }

    /// The record of the last prim, for TERM.
    #[inline]
    #[must_use]
    pub fn record(&self) -> u32 {
        self.held.record
    }

    /// Clock edge.
    #[inline(always)]
    pub fn step(
        &mut self,
        prim: Option<&Prim<C>>,
        fresh_queued: bool,
        line_ready: bool,
        events: &mut Events,
    ) {
        if self.running {
            if line_ready {
                self.next_line(events);
            } else {
                self.wait(events);
            }
        } else if self.walked {
            self.walked = fresh_queued;
        } else if let Some(prim) = prim {
            if fresh_queued && !self.stays {
                events.edge.fresh_wait += 1;
            } else {
                self.load(prim);
            }
        }
    }

    /// Clock edge while a triangle runs and its line is not taken.
    #[inline]
    pub(crate) fn wait(&self, events: &mut Events) {
        one_more(&mut events.edge.span_fifo_full);
    }

    fn load(&mut self, prim: &Prim<C>) {
        let part = usize::from(prim.lines[0] == 0);
        self.running = true;
        self.remaining = prim.lines;
        self.major = prim.major;
        self.minor = prim.minor[part];
        self.held = *prim;
        self.line = Line {
            y: prim.line,
            major: self.major.c,
            minor: self.minor.c,
            major_right: prim.major_right,
            thin: prim.thin,
            flat: prim.flat,
            values: prim.start[if self.textbook { part } else { 0 }],
            fresh: true,
            fence: true,
            source: prim.source,
        };
    }

    fn next_line(&mut self, events: &mut Events) {
        let [n1, n2] = self.remaining;
        let knee = n1 == 1 && n2 > 0;
        self.remaining = if n1 > 0 { [n1 - 1, n2] } else { [0, n2 - 1] };
        self.running = n1 + n2 > 1;
        if !self.running {
            self.walked = self.stays;
            return;
        }
        if knee {
            self.minor = self.held.minor[1];
        } else {
            self.minor.step(self.column_bits);
        }
        if knee && self.textbook {
            // The knee line is drawn again, from the left edge of the lower part.
            if self.held.major_right {
                self.line.values = self.held.start[1];
            }
        } else {
            self.line.y += 1;
            let carry = self.major.step(self.column_bits);
            let delta = self.held.delta[usize::from(if self.textbook { n1 == 0 } else { carry })];
            events.edge.carry += u64::from(carry);
            events.edge.no_carry += u64::from(!carry);
            events.edge.wrap += self.wraps(&delta);
            self.line.values = add(&self.line.values, &delta, &self.masks);
        }
        self.line.major = self.major.c;
        self.line.minor = self.minor.c;
        self.line.fresh = false;
        self.line.fence = knee && self.textbook;
    }

    /// How many channels leave the range of their word; the increments are signed words.
    fn wraps(&self, delta: &Words<C>) -> u64 {
        (0..C)
            .map(|i| {
                let carry = (self.line.values[i] ^ self.signs[i]) + delta[i] > self.masks[i];
                let negative = delta[i] > self.masks[i] / 2;
                u64::from(carry != negative)
            })
            .sum()
    }
}

impl<const C: usize> Ported<C> for Edge<C> {
    type Takes = Prim<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.prim_ready(pins.fresh_queued));
        out.gives(self.line());
        out.holds(&Held { gradient: *self.gradient(), kt: self.kt(), record: self.record() });
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        let fires = pins.next && self.line().is_some();
        self.step(pins.token, pins.fresh_queued, fires, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
