//! Walks every triangle as EDGE and SPAN do, every polygon as POLY does, draws its spans, and keeps the clock.

use super::clock::Clock;
use super::passage::Passage;
use super::picture::Picture;
use super::pixel::Pixel;
use super::poly::Poly;
use super::refusal::{Reason, Refusal};
use super::setup::Setup;
use super::span::{DepthTest, Ramp};
use super::walk::{Spans, Walker};
use crate::DrawState;
use crate::counters::Counters;
use crate::setup::SetupClocks;
use crate::setup::sort::Sorted;
use crate::tokens::{FEW, Prim};
use edgewalk_machine::{ForeignVertex, Plan};
use std::array::from_fn;

/// Triangles brought in and set up before the first of them is drawn: their vertices come from far memory side by side.
const BATCH: usize = 16;

/// As many triangles, sorted; the last batch of a frame is not full.
pub(super) type Batch = [Sorted<FEW>; BATCH];

/// Fills a batch from the front, and says with how many triangles.
pub(super) type Bring<'a> = dyn FnMut(&Plan, &Setup, &mut Batch) -> Result<usize, ForeignVertex> + 'a;

/// Draws the triangles into a cleared picture.
#[inline(always)]
pub(super) fn draw<P: Pixel, const DETAILS: bool>(
    plan: &Plan,
    bring: &mut Bring,
    state: &DrawState,
    picture: &mut Picture<P>,
    passage: Option<&mut Passage>,
) -> Result<Counters, Refusal> {
    let mut frame = Frame {
        spans: Spans::new(plan),
        test: DepthTest::new::<P>(plan, state),
        picture,
        passage,
        clock: Clock::new(plan, state.depth_write),
        counters: Counters::default(),
    };
    let setup = Setup::new(plan);
    let walker = Walker::new(plan);
    let mut poly = plan.polygon.is_there().then(|| Poly::new(plan));
    // Of the primitive that a token belongs to: a polygon is any number of tokens.
    let mut id = 0;
    let mut batch: Batch = from_fn(|_| Sorted::default());
    let mut prims: [Prim<FEW>; BATCH] = [Prim::default(); BATCH];
    let mut done = [(SetupClocks::default(), false); BATCH];
    loop {
        let count = bring(plan, &setup, &mut batch)?;
        frame.counters.triangles += count as u64;
        for ((done, prim), sorted) in done.iter_mut().zip(&mut prims).zip(&batch[..count]) {
            *done = setup.increments(sorted, prim);
        }
        for (((clocks, is_drawn), prim), sorted) in done.iter().zip(&prims).zip(&batch[..count]) {
            let ends = sorted.role.ends();
            match &mut poly {
                _ if !is_drawn => {
                    frame.clock.culled(*clocks);
                    if let Some(passage) = &mut frame.passage {
                        passage.culled(ends);
                    }
                }
                None => frame.triangle::<DETAILS>(&walker, *clocks, prim, id),
                Some(poly) => frame.token::<DETAILS>(poly, *clocks, prim, id)?,
            }
            id += i32::from(ends); // a frame has fewer
            if frame.clock.interlocked() {
                return Err(Reason::Interlock.into());
            }
        }
        if count < BATCH {
            break;
        }
    }
    frame.counters.writes = frame.test.passed();
    frame.counters.depth_writes = if state.depth_write { frame.counters.writes } else { 0 };
    frame.clock.finish(&mut frame.counters);
    Ok(frame.counters)
}

struct Frame<'a, P: Pixel> {
    /// Walked, and not yet drawn.
    spans: Spans,
    test: DepthTest,
    picture: &'a mut Picture<P>,
    passage: Option<&'a mut Passage>,
    clock: Clock,
    counters: Counters,
}

impl<P: Pixel> Frame<'_, P> {
    /// All lines are walked before the first is drawn, so that the memory has time to come near. But a part is drawn
    /// before the clock meets the fence of the next: there it wants to know who passed.
    #[inline(always)]
    fn triangle<const DETAILS: bool>(
        &mut self,
        walker: &Walker,
        clocks: SetupClocks,
        prim: &Prim<FEW>,
        id: i32,
    ) {
        self.clock.triangle(clocks);
        let mut walk = walker.walk(prim);
        let ramp = Ramp::new(walk.gradient);
        let to_left = prim.runs_left(walker.textbook);
        let (mut empty, mut fresh) = (0, true);
        self.counters.lines += prim.lines.iter().map(|lines| u64::from(*lines)).sum::<u64>();
        let parts = if walker.textbook { 2 } else { 1 };
        for part in 0..parts {
            empty = match prim.thin {
                true => walker.line(prim, &walk, &mut self.spans),
                false => walker.part(prim, part, &mut walk, &mut self.spans, empty, self.picture),
            };
            let spans = self.spans.walked();
            if spans.is_empty() {
                continue;
            }
            self.clock.spans(spans, fresh, to_left);
            fresh = false;
            let [leftmost, rightmost] = self.test.draw::<P, DETAILS>(self.picture, spans, &ramp, id);
            let passed = if to_left { leftmost } else { rightmost };
            self.clock.last_passed(passed);
            if let Some(passage) = &mut self.passage {
                passage.part(spans, to_left, passed);
            }
            self.spans.clear();
        }
        self.clock.end_triangle(empty);
        if let Some(passage) = &mut self.passage {
            passage.triangle(prim.lines, empty);
        }
    }

    /// POLY takes a prim; where it ends a polygon, that is drawn.
    #[inline(always)]
    fn token<const DETAILS: bool>(
        &mut self,
        poly: &mut Poly,
        clocks: SetupClocks,
        prim: &Prim<FEW>,
        id: i32,
    ) -> Result<(), Reason> {
        let loads = poly.load(prim);
        self.clock.token(clocks, &loads, prim.ends);
        if let Some(passage) = &mut self.passage {
            passage.token(loads, prim.ends);
        }
        if !prim.ends {
            return Ok(());
        }
        if poly.begins(prim)? {
            poly.walk(prim, &mut self.spans);
            let (steps, spans) = (&poly.steps, self.spans.walked());
            self.clock.polygon(steps, spans);
            self.counters.lines += steps.iter().filter(|step| step.is_line()).count() as u64;
            let mut passed = false;
            if !spans.is_empty() {
                let ramp = Ramp::new(poly.aligned(&prim.gradient));
                [_, passed] = self.test.draw::<P, DETAILS>(self.picture, spans, &ramp, id);
                self.clock.last_passed(passed);
            }
            if let Some(passage) = &mut self.passage {
                passage.polygon(prim, steps, spans, passed);
            }
            self.spans.clear();
        }
        poly.clear();
        Ok(())
    }
}
