//! The fast path: the picture and the clock of the machine, without ticking.
//!
//! ```text
//!  tri ─> setup ─> walk the lines ─────────┬─> span: pixels, LANES at a time ─> picture
//!                  or the polygon's edges ─┴─> clock: max-plus over spans ────> counters
//! ```
//! Written from `docs/machine.md`. What comes out is what [`render`] gives with a memory that never
//! stalls, bit by bit and cycle by cycle. Where that cannot be said without ticking, [`Renderer`] says why, and [`draw`]
//! ticks.
//!
//! DITHER rounds a colour by its pixel alone: so colours are kept as PIXEL gives them, and rounded when they are read.
//!
//! Not modelled: [`Events`], memories that stall, channels of the user's own, BLEND, dropped fragments, TERM and SHADE.

mod refusal;
mod divide;
mod setup;
mod setup_poly;
mod prefetch;
mod edge;
mod walk;
mod poly;
mod inflight;
mod walking;
mod clock;
mod poly_clock;
mod pixel;
mod picture;
mod span;
mod passage;
mod frame;
mod vector;

use crate::DrawState;
use crate::Events;
use crate::counters::Counters;
use crate::frame::{Frame, render};
use crate::waits::Stalls;
use edgewalk_machine::{ForeignVertex, Plan, PortVertex};
use frame::{Batch, Bring};
pub use passage::{Fate, Passage};
use picture::Picture;
use refusal::refused;
pub use refusal::{Reason, Refusal};
use setup::Setup;
use std::borrow::Borrow;
use std::fmt;
use std::ops::Range;

/// How a frame was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// Without ticking.
    Fast,
    /// Cycle by cycle.
    Ticked(Reason),
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Path::Fast => "without ticking",
            Path::Ticked(Reason::Channels) => "ticked: the machine has extra channels",
            Path::Ticked(Reason::Polygons) => {
                "ticked: tokens of a polygon have several windows, or a line ends them"
            }
            Path::Ticked(Reason::Bilinear) => "ticked: colours run along the edges of polygons",
            Path::Ticked(Reason::Shadow) => "ticked: the machine has SHADOW",
            Path::Ticked(Reason::Blend) => "ticked: the machine has BLEND",
            Path::Ticked(Reason::ScreenDoor) => "ticked: the machine drops fragments by a pattern",
            Path::Ticked(Reason::Shade) => "ticked: the machine has TERM and SHADE",
            Path::Ticked(Reason::Passes) => "ticked: the rules change between triangles",
            Path::Ticked(Reason::Queue) => "ticked: the in-flight queue may fill",
            Path::Ticked(Reason::Memory) => "ticked: the memory makes the machine wait",
            Path::Ticked(Reason::Interlock) => "ticked: a fragment may have met its address in flight",
        })
    }
}

/// Colours packed into as few bits as they need.
#[derive(Clone, Debug)]
enum Memory {
    Narrow(Picture<u64>),
    Wide(Picture<u128>),
}

/// Draws frame after frame into the same memory, without ticking.
#[derive(Clone, Debug)]
pub struct Renderer {
    plan: Plan,
    details: bool,
    memory: Memory,
    counters: Counters,
}

impl Renderer {
    /// A renderer without a frame yet. `details`: keep coverage, writes and ids of every pixel.
    #[must_use]
    pub fn new(plan: &Plan, details: bool) -> Self {
        let memory = if plan.color.bits <= 8 {
            Memory::Narrow(Picture::default())
        } else {
            Memory::Wide(Picture::default())
        };
        Renderer { plan: plan.clone(), details, memory, counters: Counters::default() }
    }

    /// Clears the picture and draws the triangles in order; they are taken one by one and not kept.
    ///
    /// # Errors
    /// This frame has to be ticked, or a triangle was made for another machine. What is drawn and counted so far is of no
    /// use.
    pub fn draw(
        &mut self,
        triangles: impl IntoIterator<Item: Borrow<[PortVertex; 3]>>,
        state: DrawState,
    ) -> Result<(), Refusal> {
        self.pass(&mut by_batches(triangles), state, None)
    }

    /// Like `draw`, and keeps how the frame went through the units: it can be clocked again with other timing keys.
    ///
    /// # Errors
    /// As [`Renderer::draw`].
    pub fn draw_passage(
        &mut self,
        triangles: impl IntoIterator<Item: Borrow<[PortVertex; 3]>>,
        state: DrawState,
    ) -> Result<Passage, Refusal> {
        let mut passage = Passage::new(&self.plan, state.depth_write);
        self.pass(&mut by_batches(triangles), state, Some(&mut passage))?;
        passage.drawn(&self.counters);
        Ok(passage)
    }

    /// Compiled here, once for each kind of processor, and not for each iterator.
    fn pass(
        &mut self,
        triangles: &mut Bring,
        state: DrawState,
        passage: Option<&mut Passage>,
    ) -> Result<(), Refusal> {
        let Renderer { plan, details, memory, counters } = self;
        if let Some(reason) = refused(plan) {
            return Err(reason.into());
        }
        *counters = match memory {
            Memory::Narrow(picture) => vector::draw(plan, triangles, &state, *details, picture, passage),
            Memory::Wide(picture) => vector::draw(plan, triangles, &state, *details, picture, passage),
        }?;
        Ok(())
    }

    /// Performance counters of the frame.
    #[must_use]
    pub fn counters(&self) -> &Counters {
        &self.counters
    }

    /// The frame: coverage, writes and ids are empty without details, events are not counted.
    #[must_use]
    pub fn frame(&self) -> Frame {
        self.lines(0..self.plan.height)
    }

    /// Some lines of the frame, with the counters of all of it.
    #[must_use]
    pub fn lines(&self, lines: Range<u32>) -> Frame {
        let [start, end] = [lines.start, lines.end].map(|line| line as usize * self.plan.width as usize);
        let ((z, rgb), details) = match &self.memory {
            Memory::Narrow(picture) => (picture.outputs(&self.plan, start..end), &picture.details),
            Memory::Wide(picture) => (picture.outputs(&self.plan, start..end), &picture.details),
        };
        let part = |counts: &[u32]| counts.get(start..end).unwrap_or_default().to_vec();
        Frame {
            z,
            rgb,
            extra: Vec::new(),
            coverage: part(&details.coverage),
            writes: part(&details.writes),
            id: details.id.get(start..end).unwrap_or_default().to_vec(),
            lit: Vec::new(),
            maps: Vec::new(),
            counters: self.counters.clone(),
            passes: vec![self.counters.clone()],
            events: Events::default(),
        }
    }
}

/// Brings triangles into a batch, sorted, and says how many: fewer than it holds if no more come. Each is read where it lies.
fn by_batches<I>(triangles: I) -> impl FnMut(&Plan, &Setup, &mut Batch) -> Result<usize, ForeignVertex>
where
    I: IntoIterator<Item: Borrow<[PortVertex; 3]>>,
{
    let mut triangles = (0..).zip(triangles);
    move |plan, setup, batch| {
        for (place, sorted) in batch.iter_mut().enumerate() {
            let Some((number, triangle)) = triangles.next() else { return Ok(place) };
            plan.accept(triangle.borrow(), number)?;
            setup.sort(triangle.borrow(), sorted);
        }
        Ok(batch.len())
    }
}

/// Draws the triangles in order, cycle by cycle if need be. Events are counted only where the frame is ticked.
///
/// # Errors
/// A triangle whose vertices were made for another machine.
pub fn draw<I>(plan: &Plan, triangles: I, state: DrawState) -> Result<(Frame, Path), ForeignVertex>
where
    I: IntoIterator<Item = [PortVertex; 3]>,
    I::IntoIter: Clone,
{
    let triangles = triangles.into_iter();
    let mut renderer = Renderer::new(plan, true);
    match renderer.draw(triangles.clone(), state) {
        Ok(()) => Ok((renderer.frame(), Path::Fast)),
        Err(Refusal::Tick(reason)) => {
            Ok((render(plan, triangles, state, Stalls::NONE)?, Path::Ticked(reason)))
        }
        Err(Refusal::Foreign(foreign)) => Err(foreign),
    }
}
