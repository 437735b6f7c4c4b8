//! The links of a cycle found, and read by what steps or shows them.

use super::Model;
use crate::depth::Block;
use crate::io::Inputs;
use crate::lit::Given;
use crate::stage::{Links, Made};
use crate::tokens::FEW;
use crate::wires::{Offers, STAGES, Wires};
use crate::word_memory::Ask;
use edgewalk_machine::Activity;

impl<const C: usize> Model<C> {
    /// The links in a cycle with these inputs, before the clock edge. What units offer without a register is put into `offers`.
    #[inline(always)]
    #[must_use]
    pub fn wires(&self, inputs: &Inputs, offers: &mut Offers<C>) -> Wires {
        let (pipe, (made, asks)) = (self.pipe(), offers.parts());
        let mut wires = Wires {
            offered: [false; STAGES + 1],
            ready: [false; STAGES + 1],
            rd: None,
            block: None,
            pass_ready: self.blend().is_some_and(|blend| blend.pass_ready(self.depth.pass(), &inputs.blend)),
            there: self.term().is_none_or(|term| term.there(self.span.span())),
            pixel_ready: false,
        };
        for (place, stage) in pipe.iter().enumerate() {
            let (before, own) = made.split_at_mut(place);
            stage.make(|| self.given(before, place), inputs, &mut own[0]);
        }
        let seen = self.given(made, pipe.len());
        wires.block = self.depth.block(seen.map(|given| given.frag), inputs.depth_write);
        wires.rd = seen.filter(|_| wires.block.is_none()).map(|given| given.frag.addr);
        wires.offered[pipe.len()] = seen.is_some();
        wires.ready[pipe.len()] = inputs.rd_ready && wires.block.is_none();
        for (place, stage) in pipe.iter().enumerate().rev() {
            let links = self.links(&wires, made, place);
            wires.offered[place] = links.from.is_some();
            wires.ready[place] = stage.ready(&links, inputs);
            if let Some((memory, ask)) = stage.asks(&links, inputs) {
                asks[memory] = ask;
            }
        }
        if let Some(term) = self.term() {
            asks[0] = Ask { addr: term.read(self.walker.record()), take: term.tdata_ready() };
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
        Links { from: self.given(made, place), gives: wires.offered[place + 1], next: wires.ready[place + 1] }
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
        let links = Links { from, gives: wires.offered[place + 1], next: wires.ready[place + 1] };
        stages[0].step(&links, inputs, events);
    }

    /// The cause of a cycle with these links, the first that holds.
    #[inline(always)]
    pub(super) fn activity(&self, wires: &Wires, made: &[Made<C>]) -> Activity {
        if !self.pixel.advance(wires.ready[0]) {
            let of_pipe = if C > FEW { self.stall(wires, made) } else { None };
            of_pipe.unwrap_or(match wires.block {
                Some(Block::Hazard) => Activity::Hazard,
                Some(Block::Full) if self.depth.pass().is_some() && !wires.pass_ready => Activity::Blend,
                Some(Block::Full) => Activity::Queue,
                None => Activity::Memory,
            })
        } else if self.pixel.active() {
            if self.pixel.on_screen() { Activity::Draw } else { Activity::Offscreen }
        } else if !wires.there && self.span.span().is_some() {
            Activity::Term
        } else if self.span.span().is_some() || self.span.line_held() || self.walker.running() {
            Activity::Edge
        } else if !self.setup.tri_ready() {
            Activity::Setup
        } else if self.pixel.occupied() || self.in_flight() {
            Activity::Flush
        } else {
            Activity::Idle
        }
    }

    /// The stage that PIXEL's fragment waits for.
    #[inline(never)]
    fn stall(&self, wires: &Wires, made: &[Made<C>]) -> Option<Activity> {
        let stages = self.pipe().iter().enumerate();
        stages.filter_map(|(place, stage)| stage.waits(&self.links(wires, made, place))).next()
    }
}
