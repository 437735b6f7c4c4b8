//! Walks every triangle as EDGE and SPAN do, draws its spans, and keeps the clock.

use super::Reason;
use super::clock::Clock;
use super::inflight::{InFlight, Reads};
use super::picture::{Color, Picture};
use super::span::{self, DepthTest, Ramp};
use crate::counters::Counters;
use crate::run::DrawState;
use crate::setup;
use crate::tokens::{Prim, Words};
use edgewalk_numerics::{Fill, Machine, PortVertex};

/// Draws the triangles into a cleared picture.
#[inline(always)]
pub(super) fn draw<C: Color, const DETAILS: bool>(
    machine: &Machine,
    triangles: impl Iterator<Item = [PortVertex; 3]>,
    state: &DrawState,
    picture: &mut Picture<C>,
) -> Result<Counters, Reason> {
    let mut frame = Frame {
        textbook: machine.fill == Fill::Textbook,
        width: machine.width as i32,
        column_bits: machine.widths().column,
        align: machine.channels().map(|c| 64 - c.word()),
        test: DepthTest {
            less: state.depth_func & 1 != 0,
            equal: state.depth_func & 2 != 0,
            greater: state.depth_func & 4 != 0,
            write: state.depth_write,
            z_bits: machine.z.bits,
            color_bits: machine.color.bits,
        },
        picture,
        clock: Clock::new(machine),
        inflight: InFlight::new(machine, state.depth_write),
        met: false,
        counters: Counters::default(),
    };
    for (id, vertices) in triangles.enumerate() {
        frame.counters.triangles += 1;
        match setup::increments(machine, &vertices) {
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

struct Frame<'a, C> {
    textbook: bool,
    width: i32,
    column_bits: u32,
    /// Bits that a word leaves free at the left of 64, by channel.
    align: [u32; 4],
    test: DepthTest,
    picture: &'a mut Picture<C>,
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
struct Triangle<C> {
    id: i32,
    ramp: Ramp<C>,
}

impl<C: Color> Frame<'_, C> {
    #[inline(always)]
    fn triangle<const DETAILS: bool>(&mut self, prim: &Prim, id: i32) {
        self.clock.triangle();
        let aligned = |words: &Words| -> Words { std::array::from_fn(|i| words[i] << self.align[i]) };
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
                words = std::array::from_fn(|i| words[i].wrapping_add(delta[i]));
            }
        }
        self.clock.end_triangle();
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
        triangle: &Triangle<C>,
        cut: &Cut,
        y: u32,
        words: &Words,
        fresh: bool,
        fence: bool,
    ) {
        // From the first pixel of the span to the leftmost on the screen, and where its last fragment is drawn.
        let last = cut.count - 1;
        let (columns, x, last_place) = if cut.left {
            (-i64::from(cut.skip + last), cut.x - last as i32, 0)
        } else {
            (i64::from(cut.skip), cut.x, last)
        };
        let gradient = &triangle.ramp.gradient;
        let words: Words =
            std::array::from_fn(|i| words[i].wrapping_add(gradient[i].wrapping_mul(columns as u64)));
        let pixel = y as usize * self.width as usize + x as usize;
        let last_word = words[0].wrapping_add(gradient[0].wrapping_mul(u64::from(last_place)));
        let stored = self.picture.z.get(pixel + last_place as usize).copied().unwrap_or_default();
        let passed = self.test.passes(self.test.depth(last_word), stored);
        let first = self.clock.span(cut.skip, cut.count, fresh, fence, passed);
        if let Some(inflight) = &mut self.inflight {
            let step = if cut.left { -1 } else { 1 };
            self.met |= inflight.meets(Reads { first, y, x: cut.x, count: cut.count, step }, fence);
        }
        self.counters.fragments += u64::from(cut.count);
        self.counters.writes += u64::from(span::draw::<C, DETAILS>(
            self.picture,
            pixel,
            cut.count,
            &words,
            &triangle.ramp,
            &self.test,
            triangle.id,
        ));
    }
}
