//! The machine: the units wired together, one clock.
//!
//! ```text
//!  tri ─> SETUP ─prim─> EDGE or POLY ─line─> SPAN ─span─> PIXEL ─frag─> DEPTH ─> wr
//!                                 └────────── gradients ───┘              ├─> rd, <─ data
//!     with SHADOW, before DEPTH: ─> [PROJECT] ─> SHADOW ─shaded─> DEPTH
//!     with TERM and SHADE: SPAN ─span─> TERM ─walked─> PIXEL ─frag─> [TEXEL] ─> [BUMP] ─> [NORMAL or LAMP] ─> SHADE ─tinted─> DEPTH
//!                                with BLEND, for wr: ─> zwr, ─pass─> BLEND ─> crd, <─ cdata, ─> cwr
//! ```
//! Data runs to the right, readies to the left within the cycle. [`Model::cycle`] therefore works out the readies from
//! DEPTH back to SETUP, and then clocks the units in the same order, so that each still sees its source as it was.
//!
//! Rules: `docs/machine.md`, sections 8 to 19.

mod links;
mod view;
pub mod ports;

use crate::Events;
use crate::blend::{Blend, BlendOutputs};
use crate::counters::{Counters, one_more};
use crate::depth::Depth;
use crate::io::{Inputs, Outputs};
use crate::pixel::Pixel;
use crate::setup::Setup;
use crate::span::Span;
use crate::stage::{self, Made, Stage};
use crate::term::{Term, Walked};
use crate::tokens::{FEW, Fragment, Line};
use crate::walker::Walker;
use crate::wires::{Offers, Wires};
use crate::word_memory::{Ask, WordIn};
use edgewalk_machine::{Activity, Plan};

/// State of the whole machine, `C` words a token; [`for_channels`](crate::for_channels!) finds the number that serves a
/// plan.
#[derive(Clone, Debug)]
pub struct Model<const C: usize> {
    /// Triangles to increments.
    pub setup: Setup<C>,
    /// Increments to lines.
    pub walker: Walker<C>,
    /// Lines to spans.
    pub span: Span<C>,
    term: Option<Term>,
    /// Spans to fragments.
    pub pixel: Pixel<C>,
    pipe: Vec<Stage<C>>,
    offers: Offers<C>,
    /// Fragments to writes.
    pub depth: Depth<C>,
    blend: Option<Blend<C>>,
    counters: Counters,
    events: Events,
    /// Nothing is held behind SETUP, as in the cycle before.
    rests: bool,
}

/// A unit that no machine of few channels has: nothing of it is built for those.
#[inline(always)]
fn optional<const C: usize, T>(unit: &Option<T>) -> Option<&T> {
    if C > FEW { unit.as_ref() } else { None }
}

impl<const C: usize> Model<C> {
    /// A machine after reset.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let pipe = stage::pipe(plan);
        let mut model = Model {
            setup: Setup::new(plan),
            walker: Walker::new(plan),
            span: Span::new(plan),
            term: plan.shade.is_there().then(|| Term::new(plan)),
            pixel: Pixel::new(plan),
            offers: Offers::default(),
            pipe,
            depth: Depth::new(plan),
            blend: plan.blend.is_there().then(|| Blend::new(plan)),
            counters: Counters::default(),
            events: Events::default(),
            rests: false,
        };
        model.offers = model.room();
        model
    }

    /// Performance counters since construction.
    #[must_use]
    pub fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Events since construction.
    #[must_use]
    pub fn events(&self) -> &Events {
        &self.events
    }

    /// Spans to spans with terms, if the machine has it.
    #[inline(always)]
    #[must_use]
    pub fn term(&self) -> Option<&Term> {
        optional::<C, _>(&self.term)
    }

    /// The units between PIXEL and DEPTH, in their order.
    #[inline(always)]
    #[must_use]
    pub fn pipe(&self) -> &[Stage<C>] {
        if C > FEW { &self.pipe } else { &[] }
    }

    /// Room for what units offer.
    fn room(&self) -> Offers<C> {
        Offers::new(self.pipe.len())
    }

    /// What the cycle before asked of the memories that the host alone writes, in the order of [`Plan::word_memories`].
    #[inline(always)]
    #[must_use]
    pub fn asks(&self) -> &[Ask] {
        self.offers.asks()
    }

    /// Fragments that passed to colours, if the machine has it.
    #[inline(always)]
    #[must_use]
    pub fn blend(&self) -> Option<&Blend<C>> {
        optional::<C, _>(&self.blend)
    }

    /// The ports of TERM's memory, which is the first.
    #[inline(always)]
    #[must_use]
    pub fn records<'a>(&self, inputs: &Inputs<'a>) -> &'a WordIn {
        inputs.words.first().unwrap_or(&WordIn::NONE)
    }

    /// Not hardware: the fragment whose read fired in the cycle before.
    #[must_use]
    pub fn last_read(&self) -> Fragment<C> {
        self.depth.last_read()
    }

    /// One clock cycle: the outputs of this cycle, then the clock edge.
    #[inline(always)]
    pub fn cycle(&mut self, inputs: &Inputs) -> Outputs<C> {
        self.cycle_and_tell(inputs, |_| {})
    }

    /// Like `cycle`; calls `tell` with each line that SPAN accepts.
    #[inline(always)]
    pub(crate) fn cycle_and_tell(&mut self, inputs: &Inputs, tell: impl FnOnce(&Line<C>)) -> Outputs<C> {
        let outputs =
            if self.at_rest() { self.cycle_at_rest(inputs) } else { self.cycle_of_all(inputs, tell) };
        if inputs.rst {
            self.reset();
        }
        outputs
    }

    /// Nothing was held behind SETUP in the cycle before: [`Model::cycle_at_rest`] is the next, unless it is one of reset.
    #[inline(always)]
    pub(crate) fn rests(&self) -> bool {
        self.rests
    }

    /// Nothing is held behind SETUP.
    #[inline]
    fn at_rest(&self) -> bool {
        self.rests
            || !self.walker.running()
                && !self.span.line_held()
                && self.span.span().is_none()
                && !self.pixel.active()
                && !self.pixel.occupied()
                && !self.in_flight()
    }

    /// A fragment is in flight behind PIXEL.
    #[inline]
    fn in_flight(&self) -> bool {
        self.depth.occupied()
            || self.pipe().iter().any(Stage::occupied)
            || self.blend().is_some_and(Blend::occupied)
    }

    /// A cycle in which SPAN, PIXEL and DEPTH have nothing to move and nothing is offered to them: they stay as they
    /// are, and so only SETUP and the EDGE or POLY that may take its prim are clocked.
    #[inline(always)]
    pub(crate) fn cycle_at_rest(&mut self, inputs: &Inputs) -> Outputs<C> {
        let tri_ready = self.setup.tri_ready();
        let activity = if tri_ready { Activity::Idle } else { Activity::Setup };
        self.counters.cycle(activity);
        if C > FEW {
            self.offers.parts().1.fill(Ask::default());
        }
        let light_pass = C > FEW && inputs.shadow.light_pass;
        let prim = self.setup.prim();
        let prim_ready = self.walker.prim_ready(prim, false);
        // EDGE that rested a cycle changes only by a prim.
        if C > FEW || prim.is_some() || !self.rests {
            self.walker.step(prim, false, false, light_pass, &mut self.events);
        }
        self.rests = !self.walker.running();
        let triangle = self.setup.takes(inputs.tri.is_some());
        self.setup.step(inputs.tri, prim_ready, light_pass, &mut self.events);
        if triangle {
            self.taken();
        }
        Outputs { tri_ready, triangle, activity, idle: tri_ready, ..Outputs::default() }
    }

    #[inline(always)]
    fn cycle_of_all(&mut self, inputs: &Inputs, tell: impl FnOnce(&Line<C>)) -> Outputs<C> {
        let mut offers = if C > FEW { std::mem::take(&mut self.offers) } else { Offers::new(0) };
        let wires = self.wires(inputs, &mut offers);
        let outputs = self.outputs(inputs, &wires, offers.made());
        self.count(inputs, &outputs);
        let light_pass = C > FEW && inputs.shadow.light_pass;
        // From the back on, so that each unit sees the one before as it was.
        if C > FEW
            && let Some(blend) = &mut self.blend
        {
            blend.step(self.depth.pass(), &inputs.blend, &mut self.events);
        }
        self.step_depth(inputs, &wires, offers.made());
        for place in (0..self.pipe().len()).rev() {
            self.step_stage(&wires, offers.made(), place, inputs);
        }
        if C > FEW {
            self.offers = offers;
        }
        self.count_word_reads(inputs);
        self.step_pixel(inputs, &wires, light_pass);
        self.step_lines(inputs, wires.span_ready(), light_pass, tell);
        if outputs.triangle {
            self.taken();
        }
        outputs
    }

    /// The output ports.
    #[inline(always)]
    fn outputs(&self, inputs: &Inputs, wires: &Wires, made: &[Made<C>]) -> Outputs<C> {
        let pass = self.depth.pass();
        let activity = self.activity(wires, made);
        Outputs {
            tri_ready: self.setup.tri_ready(),
            triangle: self.setup.takes(inputs.tri.is_some()),
            rd: wires.rd,
            data_ready: self.depth.data_ready(inputs.wr_ready, wires.pass_ready),
            wr: self.depth.write(),
            blend: match self.blend() {
                None => BlendOutputs::default(),
                Some(blend) => BlendOutputs {
                    crd: blend.read(pass, inputs.blend.add),
                    cdata_ready: blend.cdata_ready(inputs.blend.cwr_ready),
                    cwr: blend.write(),
                },
            },
            activity,
            idle: activity == Activity::Idle,
        }
    }

    /// Counts the cycle.
    #[inline(always)]
    fn count(&mut self, inputs: &Inputs, outputs: &Outputs<C>) {
        self.counters.cycle(outputs.activity);
        if outputs.rd.is_some() && inputs.rd_ready {
            one_more(&mut self.counters.fragments);
        }
        let written = match self.blend() {
            None => outputs.wr.is_some() && inputs.wr_ready,
            Some(_) => outputs.blend.cwr.is_some() && inputs.blend.cwr_ready,
        };
        if written {
            one_more(&mut self.counters.writes);
        }
        if outputs.wr.as_ref().is_some_and(|write| write.z_en) && inputs.wr_ready {
            one_more(&mut self.counters.depth_writes);
        }
        if C > FEW && outputs.blend.crd.is_some() && inputs.blend.crd_ready {
            one_more(&mut self.counters.color_reads);
        }
        self.counters.hold(self.span.queued(), self.depth.inflight());
        if outputs.triangle {
            self.events.machine.setup_overlap += u64::from(self.pixel.active());
        }
    }

    /// Counts the reads of the memories that the host alone writes.
    #[inline(always)]
    fn count_word_reads(&mut self, inputs: &Inputs) {
        if C > FEW {
            let asks = self.offers.asks().iter().zip(inputs.words);
            for (reads, (ask, port)) in self.counters.word_reads.iter_mut().zip(asks) {
                *reads = reads.wrapping_add(u64::from(ask.addr.is_some() && port.ready));
            }
        }
    }

    #[inline(always)]
    fn step_depth(&mut self, inputs: &Inputs, wires: &Wires, made: &[Made<C>]) {
        let Model { pixel, pipe, depth, events, .. } = self;
        let seen = match pipe.last().filter(|_| C > FEW) {
            None => pixel.given(),
            Some(stage) => stage.gives(&made[pipe.len() - 1]),
        };
        depth.step(seen.map(|given| given.frag), wires.block, &wires.depth_inputs(inputs), events);
    }

    /// PIXEL and TERM.
    #[inline(always)]
    fn step_pixel(&mut self, inputs: &Inputs, wires: &Wires, light_pass: bool) {
        let Model { walker, span, term, pixel, counters, events, .. } = self;
        let (span, span_ready) = (span.span(), wires.span_ready());
        let walked = || term.as_ref().map_or_else(Walked::default, Term::walked);
        if span_ready && span.is_some() {
            one_more(&mut counters.spans);
        }
        let held = (walker.gradient(), walker.kt());
        pixel.step(span.filter(|_| wires.there), held, walked, wires.ready(0), light_pass, events);
        if C > FEW
            && let Some(term) = term
        {
            let records = inputs.words.first().unwrap_or(&WordIn::NONE);
            term.step(span, records, span_ready, events);
        }
    }

    /// SPAN, EDGE or POLY, and SETUP.
    #[inline(always)]
    fn step_lines(
        &mut self,
        inputs: &Inputs,
        span_ready: bool,
        light_pass: bool,
        tell: impl FnOnce(&Line<C>),
    ) {
        let Model { setup, walker, span, counters, events, .. } = self;
        if !span_ready && span.stands_still() && walker.waits(events) {
            // So most cycles of a long span go by.
            setup.step(inputs.tri, false, light_pass, events);
            return;
        }
        let fresh_queued = span.fresh_queued();
        let line = walker.line().filter(|_| span.line_ready());
        let line_ready = line.is_some();
        if let Some(line) = line {
            one_more(&mut counters.lines);
            tell(line);
        }
        span.step(line, span_ready, light_pass, events);
        let prim_ready = walker.prim_ready(setup.prim(), fresh_queued);
        walker.step(setup.prim(), fresh_queued, line_ready, light_pass, events);
        setup.step(inputs.tri, prim_ready, light_pass, events);
    }

    /// SETUP has taken a triangle.
    fn taken(&mut self) {
        one_more(&mut self.counters.triangles);
        self.counters.lanes_work(self.setup.clocks());
    }

    fn reset(&mut self) {
        self.setup.reset();
        self.walker.reset();
        self.span.reset();
        self.pixel.reset();
        self.depth.reset();
        if let Some(term) = &mut self.term {
            term.reset();
        }
        self.pipe.iter_mut().for_each(Stage::reset);
        if let Some(blend) = &mut self.blend {
            blend.reset();
        }
    }
}
