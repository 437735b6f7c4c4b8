//! Walks every triangle as EDGE and SPAN do, draws its spans, and keeps the clock.

use super::Reason;
use super::clock::Clock;
use super::inflight::{InFlight, Reads};
use super::picture::Picture;
use super::pixel::Pixel;
use super::setup::Setup;
use super::span::{DepthTest, Ramp, Span};
use super::walk::{Cut, Walk, Walker};
use crate::counters::Counters;
use crate::run::DrawState;
use crate::tokens::Prim;
use edgewalk_numerics::{Machine, PortVertex};
use std::array::from_fn;

/// Draws the triangles into a cleared picture.
#[inline(always)]
pub(super) fn draw<P: Pixel, const DETAILS: bool>(
    machine: &Machine,
    triangles: impl Iterator<Item = [PortVertex; 3]>,
    state: &DrawState,
    picture: &mut Picture<P>,
) -> Result<Counters, Reason> {
    let mut frame = Frame {
        width: machine.width,
        spans: Vec::new(),
        test: DepthTest::new::<P>(machine, state),
        picture,
        clock: Clock::new(machine),
        inflight: InFlight::new(machine, state.depth_write),
        met: false,
        counters: Counters::default(),
    };
    let setup = Setup::new(machine);
    let walker = Walker::new(machine);
    for (id, vertices) in triangles.enumerate() {
        frame.counters.triangles += 1;
        match setup.increments(&vertices) {
            Some(prim) => frame.triangle::<DETAILS>(&walker, &prim, id as i32),
            None => frame.clock.culled(),
        }
        if frame.met {
            return Err(Reason::Interlock);
        }
    }
    let (activity, spans) = frame.clock.finish();
    Ok(Counters { cycles: activity.iter().sum(), activity, spans, ..frame.counters })
}

struct Frame<'a, P: Pixel> {
    width: u32,
    /// Walked, and not yet drawn.
    spans: Vec<Span>,
    test: DepthTest,
    picture: &'a mut Picture<P>,
    clock: Clock,
    inflight: Option<InFlight>,
    /// A fragment met its address in flight.
    met: bool,
    counters: Counters,
}

impl<P: Pixel> Frame<'_, P> {
    /// All lines are walked before the first is drawn, so that the memory has time to come near. But a part is drawn
    /// before the clock meets the fence of the next: there it wants to know who passed.
    #[inline(always)]
    fn triangle<const DETAILS: bool>(&mut self, walker: &Walker, prim: &Prim, id: i32) {
        self.clock.triangle();
        let mut walk = walker.walk(prim);
        let ramp = Ramp::new(walk.gradient);
        let (mut fresh, mut fence) = (true, true);
        for part in 0..2 {
            walk.enter(part);
            fence |= walker.textbook;
            while walk.lines > 0 {
                if let Some(cut) = walk.cut() {
                    self.span(&walk, &cut, fresh, fence);
                    (fresh, fence) = (false, false);
                } else {
                    self.clock.empty_line();
                }
                walk.next();
            }
            self.counters.lines += u64::from(prim.lines[part]);
            if walker.textbook || part == 1 {
                self.draw::<DETAILS>(&ramp, prim.left && !walker.textbook, id);
            }
        }
        self.clock.end_triangle();
    }

    #[inline(always)]
    fn span(&mut self, walk: &Walk, cut: &Cut, fresh: bool, fence: bool) {
        let first = self.clock.span(cut.skip, cut.count, fresh, fence);
        if let Some(inflight) = &mut self.inflight {
            let step = if cut.left { -1 } else { 1 };
            self.met |= inflight.meets(Reads { first, y: walk.y, x: cut.x, count: cut.count, step }, fence);
        }
        let (columns, x) = cut.leftmost();
        self.spans.push(Span {
            pixel: walk.y * self.width + x as u32,
            count: cut.count,
            words: from_fn(|i| walk.words[i].wrapping_add(walk.gradient[i].wrapping_mul(columns as u64))),
        });
        self.counters.fragments += u64::from(cut.count);
    }

    #[inline(always)]
    fn draw<const DETAILS: bool>(&mut self, ramp: &Ramp<P>, left: bool, id: i32) {
        let mut ends = None;
        let mut test = self.test.clone();
        for span in &self.spans {
            ends = Some(test.draw::<P, DETAILS>(self.picture, span, ramp, id));
        }
        if let Some([leftmost, rightmost]) = ends {
            self.clock.last_passed(if left { leftmost } else { rightmost });
        }
        self.spans.clear();
        self.counters.writes += test.passed();
    }
}
