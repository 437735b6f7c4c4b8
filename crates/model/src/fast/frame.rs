//! Walks every triangle as EDGE and SPAN do, draws its spans, and keeps the clock.

use super::Reason;
use super::clock::Clock;
use super::inflight::{InFlight, Reads};
use super::picture::Picture;
use super::pixel::Pixel;
use super::setup::Setup;
use super::span::{self, DepthTest, Ramp};
use crate::counters::Counters;
use crate::run::DrawState;
use crate::tokens::{Prim, Words};
use edgewalk_numerics::{Fill, Machine, PortVertex};
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
        textbook: machine.fill == Fill::Textbook,
        width: machine.width as i32,
        column_bits: machine.widths().column,
        align: machine.channels().map(|c| 64 - c.word()),
        test: DepthTest::new::<P>(machine, state),
        picture,
        clock: Clock::new(machine),
        inflight: InFlight::new(machine, state.depth_write),
        met: false,
        counters: Counters::default(),
    };
    let setup = Setup::new(machine);
    for (id, vertices) in triangles.enumerate() {
        frame.counters.triangles += 1;
        match setup.increments(&vertices) {
            Some(prim) => frame.triangle::<DETAILS>(&prim, id as i32),
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
    textbook: bool,
    width: i32,
    column_bits: u32,
    /// Bits that a word leaves free at the left of 64, by channel.
    align: [u32; 4],
    test: DepthTest,
    picture: &'a mut Picture<P>,
    clock: Clock,
    inflight: Option<InFlight>,
    /// A fragment met its address in flight.
    met: bool,
    counters: Counters,
}

/// The pixels of a line.
struct Cut {
    /// Off the screen, stepped over before the first on it.
    skip: u32,
    /// Column of the first pixel on the screen, in the direction of the span.
    x: i32,
    /// Pixels on the screen, at least 1.
    count: u32,
    left: bool,
}

/// What a triangle's lines share.
struct Triangle<P: Pixel> {
    id: i32,
    ramp: Ramp<P>,
}

impl<P: Pixel> Frame<'_, P> {
    #[inline(always)]
    fn triangle<const DETAILS: bool>(&mut self, prim: &Prim, id: i32) {
        self.clock.triangle();
        let aligned = |words: &Words| -> Words { from_fn(|i| words[i] << self.align[i]) };
        let left = prim.left && !self.textbook;
        let gradient = aligned(&prim.gradient);
        let triangle =
            Triangle { id, ramp: Ramp::new(if left { gradient.map(u64::wrapping_neg) } else { gradient }) };
        let delta = prim.delta.each_ref().map(aligned);
        let start = prim.start.each_ref().map(aligned);
        let mut words = start[0];
        let mut major = prim.major;
        let mut y = prim.line;
        let (mut fresh, mut fence) = (true, true);
        for part in 0..2 {
            let mut minor = prim.minor[part];
            if self.textbook && part == 1 {
                fence = true;
                if prim.left || prim.lines[0] == 0 {
                    words = start[1];
                }
            }
            for line in 1..=prim.lines[part] {
                if let Some(cut) = self.cut(prim.left, major.c, minor.c) {
                    self.span::<DETAILS>(&triangle, &cut, y, &words, fresh, fence);
                    (fresh, fence) = (false, false);
                } else {
                    self.clock.empty_line();
                }
                self.counters.lines += 1;
                if self.textbook && part == 0 && line == prim.lines[0] {
                    break; // the knee line is drawn again
                }
                y += 1;
                minor.step(self.column_bits);
                let carry = major.step(self.column_bits);
                let delta = &delta[if self.textbook { part } else { usize::from(carry) }];
                words = from_fn(|i| words[i].wrapping_add(delta[i]));
            }
        }
        self.clock.end_triangle();
        self.counters.writes += self.test.take_passed();
    }

    /// SPAN's rule (`docs/machine.md`, section 4); `None`: no pixel.
    #[inline(always)]
    fn cut(&self, left: bool, major: i32, minor: i32) -> Option<Cut> {
        if left && !self.textbook {
            let (x, end) = (major - 1, minor.max(0));
            let first = x.min(self.width - 1);
            let empty = x < end || minor >= self.width;
            return (!empty).then(|| Cut {
                skip: (x - first) as u32,
                x: first,
                count: (first - end + 1) as u32,
                left: true,
            });
        }
        let (x, edge) = match (self.textbook, left) {
            (false, _) => (major, minor),
            (true, false) => (major - 1, minor),
            (true, true) => (minor - 1, major),
        };
        let (first, end) = (x.max(0), edge.min(self.width));
        let empty = end <= x || edge <= 0;
        (!empty).then(|| Cut { skip: (first - x) as u32, x: first, count: (end - first) as u32, left: false })
    }

    #[inline(always)]
    fn span<const DETAILS: bool>(
        &mut self,
        triangle: &Triangle<P>,
        cut: &Cut,
        y: u32,
        words: &Words,
        fresh: bool,
        fence: bool,
    ) {
        // From the first pixel of the span to the leftmost on the screen.
        let last = cut.count - 1;
        let (columns, x) = if cut.left {
            (-i64::from(cut.skip + last), cut.x - last as i32)
        } else {
            (i64::from(cut.skip), cut.x)
        };
        let first = self.clock.span(cut.skip, cut.count, fresh, fence);
        if let Some(inflight) = &mut self.inflight {
            let step = if cut.left { -1 } else { 1 };
            self.met |= inflight.meets(Reads { first, y, x: cut.x, count: cut.count, step }, fence);
        }
        self.counters.fragments += u64::from(cut.count);
        let Triangle { ramp, id } = triangle;
        let words: Words =
            from_fn(|i| words[i].wrapping_add(ramp.gradient[i].wrapping_mul(columns as u64)));
        let pixel = y as usize * self.width as usize + x as usize;
        let [leftmost, rightmost] =
            span::draw::<P, DETAILS>(self.picture, pixel, cut.count, &words, ramp, &mut self.test, *id);
        self.clock.last_passed(if cut.left { leftmost } else { rightmost });
    }
}
