//! EDGE and SPAN without their clock: a triangle line by line, and the pixels of each line.
//!
//! Formats: columns of COLW bits, words of b + r bits at the left end of 64. Rules: `docs/machine.md`, sections 3 and 4.

use crate::tokens::{EdgeWalk, Prim, Words};
use edgewalk_numerics::{Fill, Machine};
use std::array::from_fn;

/// What a walk needs to know of a machine.
#[derive(Clone, Debug)]
pub(super) struct Walker {
    pub textbook: bool,
    width: i32,
    column_bits: u32,
    /// Bits that a word leaves free at the left of 64, by channel.
    align: [u32; 4],
}

/// The pixels of a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    /// Off the screen, stepped over before the first on it.
    pub skip: u32,
    /// Column of the first pixel on the screen, in the direction of the span.
    pub x: i32,
    /// Pixels on the screen, at least 1.
    pub count: u32,
    /// The span runs to the left.
    pub left: bool,
}

impl Cut {
    /// From the first pixel of the span to the leftmost on the screen, and the column of that.
    #[inline(always)]
    pub(super) fn leftmost(&self) -> (i64, i32) {
        let last = self.count - 1;
        if self.left {
            (-i64::from(self.skip + last), self.x - last as i32)
        } else {
            (i64::from(self.skip), self.x)
        }
    }
}

/// A triangle on its way down.
pub(super) struct Walk<'a> {
    walker: &'a Walker,
    prim: &'a Prim,
    part: usize,
    /// Lines left of the part.
    pub lines: u32,
    pub y: u32,
    major: EdgeWalk,
    minor: EdgeWalk,
    /// Values at the first pixel of the line.
    pub words: Words,
    delta: [Words; 2],
    /// Increment of a pixel to the right.
    pub gradient: Words,
}

impl Walker {
    pub(super) fn new(machine: &Machine) -> Self {
        Walker {
            textbook: machine.fill == Fill::Textbook,
            width: machine.width as i32,
            column_bits: machine.widths().column,
            align: machine.channels().map(|c| 64 - c.word()),
        }
    }

    #[inline(always)]
    fn aligned(&self, words: &Words) -> Words {
        from_fn(|i| words[i].wrapping_shl(self.align[i]))
    }

    /// A triangle before its first part.
    #[inline(always)]
    pub(super) fn walk<'a>(&'a self, prim: &'a Prim) -> Walk<'a> {
        let gradient = self.aligned(&prim.gradient);
        let to_left = prim.left && !self.textbook;
        Walk {
            walker: self,
            prim,
            part: 0,
            lines: 0,
            y: prim.line,
            major: prim.major,
            minor: prim.minor[0],
            words: self.aligned(&prim.start[0]),
            delta: [self.aligned(&prim.delta[0]), self.aligned(&prim.delta[1])],
            gradient: if to_left { gradient.map(u64::wrapping_neg) } else { gradient },
        }
    }
}

impl Walk<'_> {
    /// Begins a part, 0 or 1, at its first line.
    #[inline(always)]
    pub(super) fn enter(&mut self, part: usize) {
        self.part = part;
        self.lines = self.prim.lines[part];
        self.minor = self.prim.minor[part];
        if self.walker.textbook && part == 1 && (self.prim.left || self.prim.lines[0] == 0) {
            self.words = self.walker.aligned(&self.prim.start[1]);
        }
    }

    /// Goes down a line.
    #[inline(always)]
    pub(super) fn next(&mut self) {
        self.lines -= 1;
        let Walker { textbook, column_bits, .. } = *self.walker;
        if textbook && self.part == 0 && self.lines == 0 {
            return; // the knee line is drawn again
        }
        self.y += 1;
        self.minor.step(column_bits);
        let carry = self.major.step(column_bits);
        let delta = &self.delta[if textbook { self.part } else { usize::from(carry) }];
        self.words = from_fn(|i| self.words[i].wrapping_add(delta[i]));
    }

    /// The pixels of the line; `None`: there are none.
    #[inline(always)]
    pub(super) fn cut(&self) -> Option<Cut> {
        let Walker { textbook, width, .. } = *self.walker;
        let (major, minor, left) = (self.major.c, self.minor.c, self.prim.left);
        if left && !textbook {
            let (x, end) = (major - 1, minor.max(0));
            let first = x.min(width - 1);
            let empty = x < end || minor >= width;
            return (!empty).then(|| Cut {
                skip: (x - first) as u32,
                x: first,
                count: (first - end + 1) as u32,
                left: true,
            });
        }
        let (x, edge) = match (textbook, left) {
            (false, _) => (major, minor),
            (true, false) => (major - 1, minor),
            (true, true) => (minor - 1, major),
        };
        let (first, end) = (x.max(0), edge.min(width));
        let empty = end <= x || edge <= 0;
        (!empty).then(|| Cut { skip: (first - x) as u32, x: first, count: (end - first) as u32, left: false })
    }
}
