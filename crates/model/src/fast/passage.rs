//! How a frame went through the units, without its pixels: the clock can go over it again for other timing keys.
//!
//! ```text
//!  Renderer ─spans, who passed─> Passage ─┬─ timing keys, SETUP's clocks ─> Clock ─> counters
//!                                         └─> what became of each triangle
//! ```
//! With POLY every token has its place here, and a polygon's pixels and steps are those of the token that ends it.
//! Which pixels a triangle has, and which of them pass the depth test, no timing key changes.

use super::clock::Clock;
use super::poly::{Loads, Step};
use super::refusal::{Reason, Refusal, refused};
use super::setup::Setup;
use super::walk::Span;
use crate::counters::Counters;
use crate::setup::SetupClocks;
use crate::setup::sort::Sorted;
use crate::tokens::{FEW, Prim};
use edgewalk_machine::{Plan, PortVertex};

/// A frame that was drawn.
#[derive(Clone, Debug)]
pub struct Passage {
    plan: Plan,
    depth_write: bool,
    spans: Vec<Span<()>>,
    parts: Vec<Part>,
    triangles: Vec<Fate>,
    /// With POLY: what PASS does, of all polygons.
    steps: Vec<Step>,
    lines: u64,
    writes: u64,
}

/// Spans of a triangle, from one fence to the next.
#[derive(Clone, Copy, Debug)]
struct Part {
    /// Where they end among all spans.
    end: u32,
    to_left: bool,
    /// The last fragment passed the depth test.
    passed: bool,
}

/// What became of a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fate {
    /// EDGE walked it or POLY took it; otherwise SETUP culled it.
    pub walked: bool,
    /// A triangle, a line, or the last token of a polygon, which has the polygon's pixels.
    pub ends: bool,
    /// Pixels on the screen.
    pub pixels: u64,
    /// The pixel behind the most additions, y·W + x, with the lines and columns stepped to it from the first drawn line; in
    /// textbook fill from the first line of its part, with POLY from the pixel at which values start.
    pub farthest: Option<(u32, [u32; 2])>,
    /// Where the fragment's parts end among all parts.
    parts: u32,
    /// Lines without a pixel behind the last span.
    empty: u32,
    /// With POLY: what LOAD does with it, and where its steps end among all steps.
    loads: Loads,
    steps: u32,
}

impl Passage {
    pub(super) fn new(plan: &Plan, depth_write: bool) -> Self {
        Passage {
            plan: plan.clone(),
            depth_write,
            spans: Vec::new(),
            parts: Vec::new(),
            triangles: Vec::new(),
            steps: Vec::new(),
            lines: 0,
            writes: 0,
        }
    }

    pub(super) fn culled(&mut self, ends: bool) {
        self.push(false, ends, Loads::default());
    }

    /// POLY has taken a prim; if a polygon begins it follows.
    pub(super) fn token(&mut self, loads: Loads, ends: bool) {
        self.push(true, ends, loads);
    }

    fn push(&mut self, walked: bool, ends: bool, loads: Loads) {
        let (parts, steps) = (self.parts.len() as u32, self.steps.len() as u32);
        self.triangles.push(Fate { walked, ends, parts, steps, loads, ..Fate::default() });
    }

    /// The polygon that the last prim ends.
    pub(super) fn polygon(&mut self, prim: &Prim<FEW>, steps: &[Step], spans: &[Span], passed: bool) {
        if !spans.is_empty() {
            self.part(spans, false, passed);
        }
        self.steps.extend_from_slice(steps);
        self.lines += steps.iter().filter(|step| step.is_line()).count() as u64;
        let Some(fate) = self.triangles.last_mut() else { return };
        (fate.parts, fate.steps) = (self.parts.len() as u32, self.steps.len() as u32);
        fate.pixels = spans.iter().map(|span| u64::from(span.count)).sum();
        let [x0, y0] = prim.start_pixel;
        let ends = spans.iter().flat_map(|span| [span.pixel, span.pixel + span.count - 1]);
        let stepped = ends.map(|pixel| {
            let [x, y] = [pixel % self.plan.width, pixel / self.plan.width];
            let steps = match (prim.thin, prim.flat) {
                (false, _) => [y.abs_diff(y0), x.abs_diff(x0)],
                (true, false) => [y.abs_diff(y0), 0],
                (true, true) => [x.abs_diff(y0), 0],
            };
            (pixel, steps)
        });
        fate.farthest = stepped.max_by_key(|(_, [lines, columns])| lines + columns);
    }

    pub(super) fn part(&mut self, spans: &[Span], to_left: bool, passed: bool) {
        let bare = |span: &Span| {
            let Span { pixel, count, skip, empty, .. } = *span;
            Span { words: (), pixel, count, skip, empty }
        };
        self.spans.extend(spans.iter().map(bare));
        self.parts.push(Part { end: self.spans.len() as u32, to_left, passed });
    }

    /// The parts since the triangle before are one.
    pub(super) fn triangle(&mut self, lines: [u32; 2], empty: u32) {
        let first = self.triangles.last().map_or(0, |before| before.parts) as usize;
        let parts = self.parts.len() as u32;
        let mut fate = Fate { walked: true, ends: true, parts, empty, ..Fate::default() };
        for place in first..self.parts.len() {
            let (start, part) = (self.start(place), self.parts[place]);
            let mut line = 0;
            for span in &self.spans[start..part.end as usize] {
                line += span.empty;
                fate.pixels += u64::from(span.count);
                let steps = [line, span.skip + span.count - 1];
                if fate.farthest.is_none_or(|(_, most)| steps[0] + steps[1] > most[0] + most[1]) {
                    let pixel = if part.to_left { span.pixel } else { span.pixel + span.count - 1 };
                    fate.farthest = Some((pixel, steps));
                }
                line += 1;
            }
        }
        self.triangles.push(fate);
        self.lines += lines.iter().map(|lines| u64::from(*lines)).sum::<u64>();
    }

    pub(super) fn drawn(&mut self, counters: &Counters) {
        self.writes = counters.writes;
    }

    /// Where the spans of a part begin.
    fn start(&self, part: usize) -> usize {
        part.checked_sub(1).map_or(0, |before| self.parts[before].end as usize)
    }

    /// What became of each triangle, in their order.
    #[must_use]
    pub fn fates(&self) -> &[Fate] {
        &self.triangles
    }

    /// SETUP's clocks for every triangle on this machine, which takes these vertices.
    ///
    /// # Errors
    /// A triangle of another machine.
    pub fn setup(plan: &Plan, triangles: &[[PortVertex; 3]]) -> Result<Vec<SetupClocks>, Refusal> {
        let setup = Setup::new(plan);
        let clocks = |(triangle, number): (&[PortVertex; 3], u64)| {
            plan.accept(triangle, number)?;
            let mut sorted = Sorted::default();
            setup.sort(triangle, &mut sorted);
            Ok(setup.increments(&sorted, &mut Prim::default()).0)
        };
        triangles.iter().zip(0..).map(clocks).collect()
    }

    /// The counters of the same frame on a machine that differs in timing keys alone, with these clocks of SETUP.
    ///
    /// # Errors
    /// Why it has to be ticked.
    pub fn clocked(&self, plan: &Plan, setup: &[SetupClocks]) -> Result<Counters, Reason> {
        if let Some(reason) = refused(plan) {
            return Err(reason);
        }
        debug_assert_eq!((setup.len(), plan.fill), (self.triangles.len(), self.plan.fill));
        let mut clock = Clock::new(plan, self.depth_write);
        let (mut span, mut part, mut step) = (0, 0, 0);
        for (fate, clocks) in self.triangles.iter().zip(setup) {
            if !fate.walked {
                clock.culled(*clocks);
                continue;
            }
            let parts = &self.parts[part..fate.parts as usize];
            part = fate.parts as usize;
            if plan.polygon.is_there() {
                clock.token(*clocks, &fate.loads, fate.ends);
                let steps = &self.steps[step..fate.steps as usize];
                step = fate.steps as usize;
                let end = parts.last().map_or(span, |part| part.end as usize);
                if !steps.is_empty() {
                    clock.polygon(steps, &self.spans[span..end]);
                }
                if let Some(part) = parts.last() {
                    clock.last_passed(part.passed);
                }
                span = end;
            } else {
                clock.triangle(*clocks);
                let mut fresh = true;
                for Part { end, to_left, passed } in parts {
                    clock.spans(&self.spans[span..*end as usize], fresh, *to_left);
                    clock.last_passed(*passed);
                    (span, fresh) = (*end as usize, false);
                }
                clock.end_triangle(fate.empty);
            }
            if clock.interlocked() {
                return Err(Reason::Interlock);
            }
        }
        let mut counters = Counters {
            triangles: self.triangles.len() as u64,
            lines: self.lines,
            writes: self.writes,
            depth_writes: if self.depth_write { self.writes } else { 0 },
            ..Counters::default()
        };
        clock.finish(&mut counters);
        Ok(counters)
    }
}
