//! The links between the units in one cycle: who offers what, and who takes it.
//!
//! ```text
//!  PIXEL ─given 0─> stage 0 ─given 1─> stage 1 ─> .. ─given n─> DEPTH ─pass─> BLEND
//!        <─ready 0─         <─ready 1─             <─ready n─         <─pass_ready─
//! ```
//! They are found once in a cycle. Step, cause of the cycle, view and lock-step read them here.

use super::{Inputs, Model};
use crate::depth::{Block, DepthInputs};
use crate::lit::Given;
use crate::stage::{Links, Made};
use edgewalk_machine::Activity;

/// Most stages of a pipe.
const STAGES: usize = 8;

/// What is on the links.
#[derive(Clone, Copy, Debug)]
pub struct Wires {
    /// By place in the pipe, and of DEPTH behind the last: the fragment offered there is taken.
    ready: [bool; STAGES + 1],
    /// What keeps the fragment offered to DEPTH from being read.
    pub block: Option<Block>,
    /// BLEND takes a fragment that DEPTH offers.
    pub pass_ready: bool,
    /// The span offered by SPAN is at PIXEL's door: the walk of TERM stands there.
    pub there: bool,
    /// PIXEL takes a span that is at its door.
    pub pixel_ready: bool,
}

impl Wires {
    /// The fragment offered to the stage at this place, or behind the last stage to DEPTH, is taken.
    #[inline(always)]
    #[must_use]
    pub fn ready(&self, place: usize) -> bool {
        self.ready[place]
    }

    /// PIXEL takes the span that is offered.
    #[inline(always)]
    #[must_use]
    pub fn span_ready(&self) -> bool {
        self.there && self.pixel_ready
    }

    /// The inputs of DEPTH.
    #[inline(always)]
    #[must_use]
    pub fn depth_inputs(&self, inputs: &Inputs) -> DepthInputs {
        DepthInputs {
            depth_func: inputs.depth_func,
            depth_write: inputs.depth_write,
            rd_ready: inputs.rd_ready,
            data: inputs.data,
            wr_ready: inputs.wr_ready,
            color_write: inputs.blend.color_write,
            pass_ready: self.pass_ready,
        }
    }
}

impl<const C: usize> Model<C> {
    /// The links in a cycle with these inputs, before the clock edge. What stages make is put into `made`, by place in the pipe.
    #[inline(always)]
    #[must_use]
    pub fn wires(&self, inputs: &Inputs, made: &mut [Made<C>]) -> Wires {
        let pipe = self.pipe();
        let mut wires = Wires {
            ready: [false; STAGES + 1],
            block: None,
            pass_ready: self.blend().is_some_and(|blend| blend.pass_ready(self.depth.pass(), &inputs.blend)),
            there: self.term().is_none_or(|term| term.there(self.span.span())),
            pixel_ready: false,
        };
        for (stage, made) in pipe.iter().zip(made.iter_mut()) {
            stage.make(inputs, made);
        }
        let seen = self.given(made, pipe.len());
        wires.block = self.depth.block(seen.map(|given| given.frag), inputs.depth_write);
        wires.ready[pipe.len()] = inputs.rd_ready && wires.block.is_none();
        for (place, stage) in pipe.iter().enumerate().rev() {
            wires.ready[place] = stage.ready(self.given(made, place), wires.ready[place + 1], inputs);
        }
        wires.pixel_ready = self.pixel.span_ready(wires.ready[0]);
        wires
    }

    /// The fragment offered to the stage at this place, or behind the last stage to DEPTH.
    #[inline(always)]
    #[must_use]
    pub fn given<'a>(&'a self, made: &'a [Made<C>], place: usize) -> Option<Given<'a, C>> {
        match place.checked_sub(1) {
            None => self.pixel.given(),
            Some(before) => self.pipe()[before].gives(&made[before]),
        }
    }

    /// The links of the stage at this place.
    #[inline(always)]
    #[must_use]
    pub fn links<'a>(&'a self, wires: &Wires, made: &'a [Made<C>], place: usize) -> Links<'a, C> {
        Links {
            from: self.given(made, place),
            gives: self.given(made, place + 1).is_some(),
            next: wires.ready[place + 1],
        }
    }

    /// Clock edge of the stage at this place; the stages before it have not stepped yet.
    #[inline(always)]
    pub(super) fn step_stage(&mut self, wires: &Wires, made: &[Made<C>], place: usize, inputs: &Inputs) {
        let Model { pixel, pipe, events, .. } = self;
        let (before, stages) = pipe.split_at_mut(place);
        let from = match before.last() {
            None => pixel.given(),
            Some(stage) => stage.gives(&made[place - 1]),
        };
        let gives = stages[0].gives(&made[place]).is_some();
        stages[0].step(&Links { from, gives, next: wires.ready[place + 1] }, inputs, events);
    }

    /// The cause of a cycle with these links, the first that holds.
    #[inline]
    pub(super) fn activity(&self, wires: &Wires, made: &[Made<C>]) -> Activity {
        if !self.pixel.advance(wires.ready[0]) {
            self.stall(wires, made)
        } else if self.pixel.active() {
            if self.pixel.on_screen() { Activity::Draw } else { Activity::Offscreen }
        } else if !wires.there && self.span.span().is_some() {
            Activity::Term
        } else if self.span.span().is_some() || self.span.line_held() || self.edge.running() {
            Activity::Edge
        } else if !self.setup.tri_ready() {
            Activity::Setup
        } else if self.pixel.occupied() || self.in_flight() {
            Activity::Flush
        } else {
            Activity::Idle
        }
    }

    /// Why PIXEL's fragment is not taken.
    fn stall(&self, wires: &Wires, made: &[Made<C>]) -> Activity {
        let stages = self.pipe().iter().enumerate();
        let cause = stages.filter_map(|(place, stage)| stage.waits(&self.links(wires, made, place))).next();
        cause.unwrap_or(match wires.block {
            Some(Block::Hazard) => Activity::Hazard,
            Some(Block::Full) if self.depth.pass().is_some() && !wires.pass_ready => Activity::Blend,
            Some(Block::Full) => Activity::Queue,
            None => Activity::Memory,
        })
    }
}
