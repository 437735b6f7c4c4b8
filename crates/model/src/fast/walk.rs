//! EDGE and SPAN without their clock: a triangle's lines, and the pixels of each.
//!
//! ```text
//!  prim ─> left edge l, right edge r ─ LINES at a time ─> [max(l, 0), min(r, W)) ─> spans, fetched ahead
//! ```
//! Formats: words of b + r bits stand at the left end of 64 bits, so that they wrap by themselves. Rules: `docs/machine.md`,
//! sections 3 and 4; its cuts come to the same interval whichever way a span runs.

use super::edge::{Edge, LINES};
use super::picture::Picture;
use super::pixel::Pixel;
use super::prefetch::prefetch;
use crate::tokens::{FEW, Prim, per_channel};
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
        let lines = if plan.polygon.has_lines() { plan.width.max(plan.height) } else { plan.height };
        Spans { room: vec![none; lines as usize + 2], count: 0 }
    }

    /// One more of a polygon, which may have several a line.
    pub(super) fn push(&mut self, span: Span) {
        match self.room.get_mut(self.count) {
            Some(room) => *room = span,
            None => self.room.push(span),
        }
        self.count += 1;
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
    height: i32,
    /// Bits that a column leaves free in 32.
    free: u32,
    /// Bits that a word leaves free in 64, by channel.
    align: [u32; FEW],
    /// 0 to LINES - 1. From memory: known numbers tempt the compiler to treat every line in its own way.
    place: [i32; LINES],
}

/// A triangle on its way down.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walk {
    /// Spans run to the left; the major edge lies right.
    to_left: bool,
    major_right: bool,
    y: u32,
    major: Edge,
    /// C of the major edge on the first line, and q.
    first: i32,
    q: i32,
    /// Lines that the major edge has gone down.
    gone: u32,
    /// At the first pixel of the line, but for the carries of the major edge so far.
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
            height: plan.height as i32,
            free: 32 - plan.widths().column,
            align: per_channel(plan, |c| 64 - c.word()),
            place: std::hint::black_box(from_fn(|i| i as i32)),
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
        let to_left = prim.runs_left(self.textbook);
        Walk {
            to_left,
            major_right: prim.major_right,
            y: prim.line,
            major: Edge::new(&prim.major),
            first: prim.major.c,
            q: prim.major.q,
            gone: 0,
            words: self.aligned(&prim.start[0]),
            delta: [self.aligned(&prim.delta[0]), self.aligned(&prim.delta[1])],
            gradient: if to_left { gradient.map(u64::wrapping_neg) } else { gradient },
        }
    }

    /// Walks along a line; appends a span for each of its pixels on the screen. Gives the steps without one behind the last.
    #[inline(never)]
    pub(super) fn line(&self, prim: &Prim<FEW>, walk: &Walk, spans: &mut Spans) -> u32 {
        let (mut edge, mut words, mut empty) = (prim.major, walk.words, 0);
        let across = if prim.flat { self.height } else { self.width };
        for along in walk.y as i32..(walk.y + prim.lines[0] + prim.lines[1]) as i32 {
            if (0..across).contains(&edge.c) {
                let [x, y] = if prim.flat { [along, edge.c] } else { [edge.c, along] };
                let pixel = (y * self.width + x) as u32; // on the screen
                let span = Span { words, pixel, count: 1, skip: 0, empty };
                spans.room.get_mut(spans.count).into_iter().for_each(|room| *room = span); // there is room: see `Spans`
                (spans.count, empty) = (spans.count + 1, 0);
            } else {
                empty += 1;
            }
            let carry = edge.step(32 - self.free);
            words = from_fn(|c| words[c].wrapping_add(walk.delta[usize::from(carry)][c]));
        }
        empty
    }

    /// Walks down all lines of a triangle or, in textbook fill, a part, 0 or 1; appends their spans. `empty`: lines without a
    /// pixel since the last span, before and after. Pixels are fetched from the picture.
    #[inline(always)]
    pub(super) fn part<P: Pixel>(
        &self,
        prim: &Prim<FEW>,
        part: usize,
        walk: &mut Walk,
        spans: &mut Spans,
        mut empty: u32,
        picture: &mut Picture<P>,
    ) -> u32 {
        let (mut words, mut delta) = (walk.words, walk.delta);
        let (lines, knee) = if self.textbook {
            delta = [delta[part]; 2];
            if part == 1 && (walk.major_right || prim.lines[0] == 0) {
                words = self.aligned(&prim.start[1]);
            }
            (prim.lines[part], if part == 0 { prim.lines[0] } else { 0 })
        } else {
            (prim.lines[0] + prim.lines[1], prim.lines[0])
        };
        let [upper, lower] = prim.minor.each_ref().map(Edge::new);
        let minor = [upper, lower.begun_later(knee)];
        let more: Words = from_fn(|i| delta[1][i].wrapping_sub(delta[0][i]));
        // In textbook fill the left end is `Trunc`, one less than C, and the knee line is drawn again.
        let inward = i32::from(self.textbook);
        let stays = u32::from(self.textbook && part == 0 && lines > 0);
        // From the first pixel of a line to its leftmost.
        let to_leftmost = if walk.to_left { walk.gradient.map(u64::wrapping_neg) } else { walk.gradient };
        let cut = |column: i32| column << self.free >> self.free;
        let mut count = spans.count;
        for line in (0..lines).step_by(LINES) {
            let of_minor = self.place.map(|i| i.wrapping_add(line as i32));
            let of_major = of_minor.map(|i| i.wrapping_add(walk.gone as i32));
            let major = walk.major.columns(&of_major);
            let minor = Edge::columns_of_two(&minor, knee as i32, &of_minor);
            let carries: [i32; LINES] =
                from_fn(|i| major[i].wrapping_sub(walk.first).wrapping_sub(walk.q.wrapping_mul(of_major[i])));
            let [major, minor] = [major.map(cut), minor.map(cut)];
            let (l, r) = if walk.major_right { (minor, major) } else { (major, minor) };
            let l = l.map(|l| l.wrapping_sub(inward));
            let (low, high) = (l.map(|l| l.max(0)), r.map(|r| r.min(self.width)));
            let pixels: [i32; LINES] = from_fn(|i| high[i].wrapping_sub(low[i]));
            // No difference of columns is longer than 32 bits.
            let [skip, columns]: [[i32; LINES]; 2] = if walk.to_left {
                [
                    from_fn(|i| r[i].wrapping_sub(high[i])),
                    from_fn(|i| r[i].wrapping_sub(1).wrapping_sub(low[i])),
                ]
            } else {
                [from_fn(|i| low[i].wrapping_sub(l[i])); 2]
            };
            let row = (walk.y + line) as i32;
            let pixel: [i32; LINES] =
                from_fn(|i| low[i].wrapping_add(self.width.wrapping_mul(self.place[i].wrapping_add(row))));
            let remaining = lines - line;
            let memory = picture.pixels.as_slice();
            for i in 0..LINES.min(remaining as usize) {
                let Some(span) = spans.room.get_mut(count) else { break }; // there is room: see `Spans`
                let (carries, columns) = (u64::from(carries[i] as u32), u64::from(columns[i] as u32));
                *span = Span {
                    words: from_fn(|c| {
                        words[c]
                            .wrapping_add(more[c].wrapping_mul(carries))
                            .wrapping_add(to_leftmost[c].wrapping_mul(columns))
                    }),
                    pixel: pixel[i] as u32,
                    count: pixels[i] as u32,
                    skip: skip[i] as u32,
                    empty,
                };
                prefetch(memory, span.pixel as usize, pixels[i]);
                // Neither is more than the lines.
                let is_empty = pixels[i] <= 0;
                count = count.wrapping_add(usize::from(!is_empty));
                empty = if is_empty { empty.wrapping_add(1) } else { 0 };
                words = from_fn(|c| words[c].wrapping_add(delta[0][c]));
            }
        }
        spans.count = count;
        walk.y += lines - stays;
        walk.gone += lines - stays;
        walk.words = if stays > 0 { from_fn(|c| words[c].wrapping_sub(delta[0][c])) } else { words };
        empty
    }
}
