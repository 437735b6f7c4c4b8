//! POLY without its clock: what LOAD does with a prim, what PASS does word by word, and the pixels of each pair.
//!
//! ```text
//!  prims ─> edges by their first lines ─> lists of a line's edges ─┬─> spans
//!                                                                  └─> steps, for the clock
//! ```
//! Formats: words of b + r bits stand at the left end of 64 bits, so that they wrap by themselves. Rules: `docs/machine.md`,
//! section 19; MOVER's way does not matter for its values, which are start + (y − y0)·d0 + (x − x0)·g.

use super::refusal::Reason;
use super::walk::{Span, Spans};
use crate::tokens::{EdgeWalk, FEW, Prim, per_channel};
use edgewalk_machine::Plan;
use std::array::from_fn;

/// What LOAD does with a prim.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Loads {
    /// Sides that it loads.
    pub sides: u8,
    /// Clocks behind each of them in which the order list makes room.
    pub room: [u8; 3],
}

/// What PASS does with a word, or at the end of a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub what: What,
    /// The word goes into the list of the next line.
    pub stays: bool,
    /// Words of that list that make room for it.
    pub moves: u8,
    /// Of a pair that MOVER takes: clocks until the values are there.
    pub way: u16,
}

/// Kinds of steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum What {
    /// An edge enters.
    Enters,
    /// The left column of a pair.
    Half,
    /// The right column of a pair without a pixel.
    NoPixel,
    /// A pixel of a line, off the screen.
    Dropped,
    /// The right column of a pair with pixels, or a pixel of a line.
    Span,
    /// A whole line: two edges that go on in their order, and the pixels between them.
    Two,
    /// The line ends.
    LineEnds,
}

impl Step {
    const LINE_ENDS: Step = Step { what: What::LineEnds, stays: false, moves: 0, way: 0 };

    /// Whether a line goes to SPAN.
    #[inline(always)]
    pub(super) fn is_line(&self) -> bool {
        matches!(self.what, What::Dropped | What::Span | What::Two)
    }
}

/// A word of a list: the column of an edge, and its place in the table.
type Word = (i32, u32);

/// State of LOAD, and room for the lists of PASS.
#[derive(Clone, Debug)]
pub(super) struct Poly {
    screen: [i32; 2],
    column_bits: u32,
    line_mask: u32,
    /// N.
    places: usize,
    /// Bits that a word leaves free in 64, by channel.
    align: [u32; FEW],
    /// The edge table: an edge and the lines that it has left.
    edges: Vec<(EdgeWalk, u32)>,
    /// The order list: first line of an edge, and its place in the table.
    order: Vec<(u32, u32)>,
    over: bool,
    old: Vec<Word>,
    new: Vec<Word>,
    /// Steps of the polygon that was walked last.
    pub steps: Vec<Step>,
}

impl Poly {
    pub(super) fn new(plan: &Plan) -> Self {
        Poly {
            screen: [plan.width as i32, plan.height as i32], // at most 2^13
            column_bits: plan.widths().column,
            line_mask: u32::MAX >> (32 - plan.widths().line),
            places: plan.polygon.edges as usize,
            align: per_channel(plan, |c| 64 - c.word()),
            edges: Vec::new(),
            order: Vec::new(),
            over: false,
            old: Vec::new(),
            new: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// LOAD takes the sides of a prim.
    #[inline(always)]
    pub(super) fn load(&mut self, prim: &Prim<FEW>) -> Loads {
        let [n1, n2] = prim.lines;
        let sides = [(prim.major, n1 + n2, 0), (prim.minor[0], n1, 0), (prim.minor[1], n2, n1)];
        let mut loads = Loads::default();
        for (side, (walk, lines, below)) in sides.into_iter().enumerate() {
            if prim.sides >> side & 1 == 0 || lines == 0 {
                continue;
            }
            if self.edges.len() == self.places {
                self.over = true;
            } else {
                let line = (prim.line + below) & self.line_mask;
                let moves = insert(&mut self.order, (line, self.edges.len() as u32)); // at most 128
                self.edges.push((walk, lines));
                loads.room[usize::from(loads.sides)] = if moves > 0 { moves + 1 } else { 0 };
            }
            loads.sides += 1;
        }
        loads
    }

    /// A prim that ends a polygon fires; true: the polygon is walked.
    ///
    /// # Errors
    /// Tokens that no polygon is made of: of several windows, or a line behind edges that nothing ended.
    #[inline(always)]
    pub(super) fn begins(&self, prim: &Prim<FEW>) -> Result<bool, Reason> {
        if self.order.is_empty() || self.over || prim.void {
            return Ok(false);
        }
        let together = self.order[0].0 >= prim.start_pixel[1] && (!prim.thin || self.edges.len() == 1);
        if together { Ok(true) } else { Err(Reason::Polygons) }
    }

    /// The polygon is over: LOAD begins anew.
    pub(super) fn clear(&mut self) {
        self.edges.clear();
        self.order.clear();
        self.over = false;
    }

    #[inline(always)]
    pub(super) fn aligned(&self, words: &[u64; FEW]) -> [u64; FEW] {
        from_fn(|i| words[i].wrapping_shl(self.align[i]))
    }

    /// Walks down the polygon that begins with this prim; appends its spans, and leaves its steps.
    #[inline(always)]
    pub(super) fn walk(&mut self, prim: &Prim<FEW>, spans: &mut Spans) {
        self.steps.clear();
        self.old.clear();
        let [x0, y0] = prim.start_pixel;
        let mut mover = Mover {
            words: self.aligned(&prim.start[0]),
            down: self.aligned(&prim.delta[0]),
            across: self.aligned(&prim.gradient),
            x: x0 as i32,
            x0: x0 as i32,
            y: y0,
            y0,
        };
        // The line before the first is passed: there edges only enter.
        let (mut y, mut entered) = (y0.wrapping_sub(1) & self.line_mask, 0);
        loop {
            let next = y.wrapping_add(1) & self.line_mask;
            let enters = self.order.get(entered).is_some_and(|(first, _)| *first == next);
            if !enters
                && !prim.thin
                && let Some(step) = self.two(y, &mut mover, spans)
            {
                self.steps.push(step);
                y = next;
                continue;
            }
            let mut left = None;
            for place in 0..self.old.len() {
                let index = self.old[place].1;
                let (walk, lines) = &mut self.edges[index as usize];
                let column = walk.c;
                *lines -= 1;
                let stays = *lines > 0;
                walk.step(self.column_bits);
                let stepped = walk.c;
                let pair = match (prim.thin, left) {
                    (true, _) => self.pixel_of_line(prim.flat, column, y, &mut mover, spans),
                    (false, None) => (What::Half, 0),
                    (false, Some(left)) => self.pair([left, column], y, &mut mover, spans),
                };
                left = if left.is_none() { Some(column) } else { None };
                let moves = if stays { insert(&mut self.new, (stepped, index)) } else { 0 };
                self.steps.push(Step { what: pair.0, stays, moves, way: pair.1 });
            }
            while let Some((_, index)) = self.order.get(entered).filter(|(first, _)| *first == next).copied()
            {
                let moves = insert(&mut self.new, (self.edges[index as usize].0.c, index));
                self.steps.push(Step { what: What::Enters, stays: true, moves, way: 0 });
                entered += 1;
            }
            self.steps.push(Step::LINE_ENDS);
            if self.new.is_empty() && entered == self.order.len() {
                return;
            }
            std::mem::swap(&mut self.old, &mut self.new);
            self.new.clear();
            y = next;
        }
    }

    /// A line of two edges that go on in their order, with pixels between them; of any other line none, and nothing is done.
    #[inline(always)]
    fn two(&mut self, y: u32, mover: &mut Mover, spans: &mut Spans) -> Option<Step> {
        let [(left, a), (right, b)] = self.old[..] else { return None };
        let [(mut one, one_left), (mut other, other_left)] = [self.edges[a as usize], self.edges[b as usize]];
        one.step(self.column_bits);
        other.step(self.column_bits);
        let goes_on = one_left > 1 && other_left > 1 && one.c <= other.c;
        if !goes_on || left.max(0) >= right.min(self.screen[0]) {
            return None;
        }
        self.edges[a as usize] = (one, one_left - 1);
        self.edges[b as usize] = (other, other_left - 1);
        // What was the line's list is that of the next.
        (self.old[0].0, self.old[1].0) = (one.c, other.c);
        let (_, way) = self.pair([left, right], y, mover, spans);
        Some(Step { what: What::Two, stays: true, moves: 0, way })
    }

    /// The right column of a pair on line `y`.
    #[inline(always)]
    fn pair(&self, [left, right]: [i32; 2], y: u32, mover: &mut Mover, spans: &mut Spans) -> (What, u16) {
        let [first, behind] = [left.max(0), right.min(self.screen[0])];
        if behind <= first {
            return (What::NoPixel, 0);
        }
        let way = self.down_to(y, mover) + (32 - first.abs_diff(mover.x).leading_zeros());
        mover.x = first;
        let words = self.values(mover, first - mover.x0);
        let pixel = (y as i32 * self.screen[0] + first) as u32; // on the screen
        spans.push(Span { words, pixel, count: (behind - first) as u32, skip: 0, empty: 0 });
        (What::Span, way as u16) // at most 2^13 + 16
    }

    /// A pixel of a line.
    #[inline(always)]
    fn pixel_of_line(
        &self,
        flat: bool,
        column: i32,
        y: u32,
        mover: &mut Mover,
        spans: &mut Spans,
    ) -> (What, u16) {
        let way = self.down_to(y, mover) as u16; // at most 2^13
        let [width, height] = self.screen;
        if !(0..if flat { height } else { width }).contains(&column) {
            return (What::Dropped, way);
        }
        let [x, y] = if flat { [y as i32, column] } else { [column, y as i32] };
        let pixel = (y * width + x) as u32; // on the screen
        spans.push(Span { words: self.values(mover, 0), pixel, count: 1, skip: 0, empty: 0 });
        (What::Span, way)
    }

    /// MOVER goes down to line `y`; gives how many lines these are.
    #[inline(always)]
    fn down_to(&self, y: u32, mover: &mut Mover) -> u32 {
        let lines = y.wrapping_sub(mover.y) & self.line_mask;
        mover.y = y;
        lines
    }

    /// The values on MOVER's line, so many columns right of the start.
    #[inline(always)]
    fn values(&self, mover: &Mover, columns: i32) -> [u64; FEW] {
        let lines = u64::from(mover.y.wrapping_sub(mover.y0) & self.line_mask);
        let columns = i64::from(columns) as u64;
        from_fn(|c| {
            mover.words[c]
                .wrapping_add(mover.down[c].wrapping_mul(lines))
                .wrapping_add(mover.across[c].wrapping_mul(columns))
        })
    }
}

/// Puts a word into a list of at most 128, behind those that are not greater; gives how many make room.
#[inline(always)]
fn insert<T: Copy + PartialOrd>(list: &mut Vec<(T, u32)>, word: (T, u32)) -> u8 {
    let mut place = list.len();
    list.push(word);
    while place > 0 && list[place - 1].0 > word.0 {
        list[place] = list[place - 1];
        place -= 1;
    }
    list[place] = word;
    (list.len() - 1 - place) as u8
}

/// MOVER between two spans: X and Y, where its polygon starts, and the values there.
struct Mover {
    words: [u64; FEW],
    down: [u64; FEW],
    across: [u64; FEW],
    x: i32,
    x0: i32,
    y: u32,
    y0: u32,
}
