//! EDGE and SPAN without their clock: a triangle's lines, and the pixels of each.
//!
//! ```text
//!  prim ─> left edge l, right edge r ─ a line at a time ─> [max(l, 0), min(r, W)) ─> spans, fetched ahead
//! ```
//! Formats: columns of COLW bits and words of b + r bits stand at the left end of 32 and 64 bits, so that they wrap by
//! themselves. Rules: `docs/machine.md`, sections 3 and 4; its cuts come to the same interval whichever way a span runs.

use super::picture::Picture;
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

/// Spans walked and not yet drawn, and room for one more than a triangle can have: a line without a pixel writes there too, so
/// that nothing depends on whether it has one.
#[derive(Clone, Debug)]
pub(super) struct Spans {
    room: Vec<Span>,
    count: usize,
}

impl Spans {
    /// None of a machine's. In textbook fill the knee line is drawn twice.
    pub(super) fn new(plan: &Plan) -> Self {
        let none = Span { words: [0; FEW], pixel: 0, count: 0, skip: 0, empty: 0 };
        Spans { room: vec![none; plan.height as usize + 2], count: 0 }
    }

    #[inline(always)]
    pub(super) fn walked(&self) -> &[Span] {
        &self.room[..self.count]
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }
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
    /// after. Pixels are fetched from the picture, and their lines marked.
    #[inline(always)]
    pub(super) fn part<P>(
        &self,
        prim: &Prim<FEW>,
        part: usize,
        walk: &mut Walk,
        spans: &mut Spans,
        mut empty: u32,
        picture: &mut Picture<P>,
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
        let lines = prim.lines[part];
        let stays = self.textbook && part == 0 && lines > 0;
        let more: Words = from_fn(|i| delta[1][i].wrapping_sub(delta[0][i]));
        let mut row = walk.y * self.width as u32;
        // From the first pixel of a line to its leftmost.
        let to_leftmost = if walk.to_left { walk.gradient.map(u64::wrapping_neg) } else { walk.gradient };
        let memory = &picture.pixels;
        // All lines are on the screen.
        let rows = picture.drawn.get_mut(walk.y as usize..(walk.y + lines) as usize).unwrap_or_default();
        let mut count = spans.count;
        for (drawn, below) in rows.iter_mut().zip((0..lines).rev()) {
            let (l, r) = ((left.c >> free).wrapping_sub(inward), right.c >> free);
            let (low, high) = (l.max(0), r.min(self.width));
            // No difference of columns is longer than 32 bits.
            let from_left = low.wrapping_sub(l);
            let [skip, columns] = if walk.to_left {
                [r.wrapping_sub(high), r.wrapping_sub(1).wrapping_sub(low)]
            } else {
                [from_left; 2]
            };
            let pixels = high.wrapping_sub(low);
            let Some(span) = spans.room.get_mut(count) else { break }; // there is room: see `Spans`
            *span = Span {
                words: from_fn(|i| {
                    words[i].wrapping_add(to_leftmost[i].wrapping_mul(u64::from(columns as u32)))
                }),
                pixel: row.wrapping_add(low as u32),
                count: pixels as u32,
                skip: skip as u32,
                empty,
            };
            prefetch(memory, span.pixel as usize, pixels);
            *drawn = [drawn[0].min(low), drawn[1].max(high)];
            let is_empty = u32::from(pixels <= 0);
            count += 1 - is_empty as usize;
            empty = (empty + 1) * is_empty;
            if stays && below == 0 {
                break;
            }
            row = row.wrapping_add(self.width as u32);
            let carry_left = left.step(free);
            let carry_right = right.step(free);
            let carry = if walk.major_right { carry_right } else { carry_left };
            let carry = i64::from(carry) as u64; // all ones or zero
            words = from_fn(|i| words[i].wrapping_add(delta[0][i]).wrapping_add(more[i] & carry));
        }
        spans.count = count;
        walk.y += lines - u32::from(stays);
        walk.words = words;
        walk.major = if walk.major_right { right } else { left };
        empty
    }
}
