//! EDGE and SPAN without their clock: a triangle's lines, and the pixels of each.
//!
//! ```text
//!  prim ─> left edge l, right edge r ─ a line at a time ─> [max(l, 0), min(r, W)) ─> spans, fetched ahead
//! ```
//! Formats: columns of COLW bits and words of b + r bits stand at the left end of 32 and 64 bits, so that they wrap by
//! themselves. Rules: `docs/machine.md`, sections 3 and 4; its cuts come to the same interval whichever way a span runs.

use super::prefetch::prefetch;
use crate::tokens::{EdgeWalk, FEW, Prim, per_channel};
use edgewalk_machine::{Fill, Plan};
use std::array::from_fn;

type Words = crate::tokens::Words<FEW>;

/// Pixels of a line that lie on the screen; the clock does without their words.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span<W = Words> {
    /// Words at the leftmost, at the left end of 64 bits.
    pub words: W,
    /// Place of the leftmost, y·W + x.
    pub pixel: u32,
    /// Pixels, at least 1.
    pub count: u32,
    /// Pixels off the screen that PIXEL steps over before.
    pub skip: u32,
    /// Lines without a pixel before this one, since the last span of the triangle.
    pub empty: u32,
}

/// What a walk needs to know of a machine.
#[derive(Clone, Debug)]
pub(super) struct Walker {
    pub textbook: bool,
    width: i32,
    /// Bits that a column leaves free in 32.
    free: u32,
    /// Bits that a word leaves free in 64, by channel.
    align: [u32; FEW],
}

/// An edge on its way down.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// C and q, at the left end.
    c: i32,
    q: i32,
    r: i32,
    f: i32,
    m: i32,
}

impl Edge {
    #[inline(always)]
    fn new(walk: &EdgeWalk, free: u32) -> Self {
        Edge { c: walk.c.wrapping_shl(free), q: walk.q.wrapping_shl(free), r: walk.r, f: walk.f, m: walk.m }
    }

    /// Goes down a line; all ones if R carries.
    #[inline(always)]
    fn step(&mut self, free: u32) -> i32 {
        let r = self.r.wrapping_sub(self.f);
        let carry = r >> 31;
        self.r = r.wrapping_add(self.m & carry);
        self.c = self.c.wrapping_add(self.q).wrapping_sub(carry.wrapping_shl(free));
        carry
    }
}

/// A triangle on its way down.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walk {
    /// Spans run to the left; the major edge lies right.
    to_left: bool,
    major_right: bool,
    y: u32,
    major: Edge,
    words: Words,
    delta: [Words; 2],
    /// Increment of a pixel to the right.
    pub gradient: Words,
}

impl Walker {
    pub(super) fn new(plan: &Plan) -> Self {
        Walker {
            textbook: plan.fill == Fill::Textbook,
            width: plan.width as i32,
            free: 32 - plan.widths().column,
            align: per_channel(plan, |c| 64 - c.word()),
        }
    }

    #[inline(always)]
    fn aligned(&self, words: &Words) -> Words {
        from_fn(|i| words[i].wrapping_shl(self.align[i]))
    }

    /// A triangle before its first line.
    #[inline(always)]
    pub(super) fn walk(&self, prim: &Prim<FEW>) -> Walk {
        let gradient = self.aligned(&prim.gradient);
        let to_left = prim.major_right && !self.textbook;
        Walk {
            to_left,
            major_right: prim.major_right,
            y: prim.line,
            major: Edge::new(&prim.major, self.free),
            words: self.aligned(&prim.start[0]),
            delta: [self.aligned(&prim.delta[0]), self.aligned(&prim.delta[1])],
            gradient: if to_left { gradient.map(u64::wrapping_neg) } else { gradient },
        }
    }

    /// Walks down a part, 0 or 1, and appends its spans. `empty`: lines without a pixel since the last span, before and
    /// after. Pixels are fetched from `memory`, y·W + x.
    #[inline(always)]
    pub(super) fn part<P>(
        &self,
        prim: &Prim<FEW>,
        part: usize,
        walk: &mut Walk,
        spans: &mut Vec<Span>,
        mut empty: u32,
        memory: &[P],
    ) -> u32 {
        let free = self.free;
        let minor = Edge::new(&prim.minor[part], free);
        let (mut left, mut right) = if walk.major_right { (minor, walk.major) } else { (walk.major, minor) };
        let mut words = walk.words;
        let mut delta = walk.delta;
        if self.textbook {
            delta = [delta[part]; 2];
            if part == 1 && (prim.major_right || prim.lines[0] == 0) {
                words = self.aligned(&prim.start[1]);
            }
        }
        // In textbook fill the left end is `Trunc`, one less than C, and the knee line is drawn again.
        let inward = i32::from(self.textbook);
        let knee = if self.textbook && part == 0 { prim.lines[0] } else { u32::MAX };
        let mut row = walk.y * self.width as u32;
        for line in 1..=prim.lines[part] {
            let (l, r) = ((left.c >> free) - inward, right.c >> free);
            let (low, high) = (l.max(0), r.min(self.width));
            if low < high {
                // The columns stepped over, and from the first of the span to the leftmost on the screen.
                let (skip, columns) = if walk.to_left { (r - high, low - r + 1) } else { (low - l, low - l) };
                let span = Span {
                    words: from_fn(|i| {
                        words[i].wrapping_add(walk.gradient[i].wrapping_mul(columns as i64 as u64))
                    }),
                    pixel: row + low as u32,
                    count: (high - low) as u32,
                    skip: skip as u32,
                    empty,
                };
                prefetch(memory, span.pixel as usize, span.count as usize);
                spans.push(span);
                empty = 0;
            } else {
                empty += 1;
            }
            if line == knee {
                break;
            }
            row += self.width as u32;
            let carry_left = left.step(free);
            let carry_right = right.step(free);
            let carry = if walk.major_right { carry_right } else { carry_left };
            let delta = &delta[(carry & 1) as usize];
            words = from_fn(|i| words[i].wrapping_add(delta[i]));
        }
        walk.y = row / self.width as u32;
        walk.words = words;
        walk.major = if walk.major_right { right } else { left };
        empty
    }
}
