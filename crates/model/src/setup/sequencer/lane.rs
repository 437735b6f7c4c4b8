//! A lane: A and W, their rows, and a step.

use edgewalk_machine::sequencer::NAMED_ROWS;
use edgewalk_machine::sequencer::word::{Base, Operand, Sign};

/// A number: W + A / M, or a whole number in A.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Number {
    pub a: i128,
    pub w: i128,
}

/// What a step adds, and how.
pub(super) struct Addend {
    pub base: Base,
    pub row: Number,
    pub operand: Operand,
    pub sign: Sign,
}

/// A lane.
#[derive(Clone, Debug)]
pub(super) struct Lane {
    /// A and W.
    pub now: Number,
    rows: [Number; NAMED_ROWS as usize],
}

/// Numbers that steps depend on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Formats {
    /// Bits of A.
    pub rest_bits: u32,
    /// Bits of a factor: as many of W can be taken into A.
    pub factor_bits: u32,
    /// Bits of W below a whole column: F + 1 of a slope edge, else 0.
    pub below_column: u32,
    /// t.
    pub center_fraction: u32,
    /// t + r - e of the lane's channel.
    pub doublings: u32,
    /// The major edge lies right.
    pub right: bool,
}

impl Lane {
    pub fn new() -> Lane {
        Lane { now: Number::default(), rows: [Number::default(); NAMED_ROWS as usize] }
    }

    pub fn row(&self, row: u8) -> Number {
        self.rows[usize::from(row)]
    }

    pub fn write(&mut self, row: u8, only_a: bool) {
        let place = &mut self.rows[usize::from(row)];
        *place = if only_a { Number { a: self.now.a, w: place.w } } else { self.now };
    }

    /// A row that is there from the start.
    pub fn hold(&mut self, row: u8, a: i128) {
        self.rows[usize::from(row)] = Number { a, w: 0 };
    }

    pub fn step(&mut self, addend: &Addend, formats: &Formats) {
        let Number { a, w } = self.now;
        let base = match addend.base {
            Base::Nothing => Number::default(),
            Base::Same => self.now,
            Base::Twice => Number { a: 2 * a, w: w.wrapping_mul(2) },
            Base::Masked => Number { a: a >> formats.center_fraction << formats.center_fraction, w },
        };
        let row = match addend.operand {
            Operand::Row => addend.row,
            Operand::Whole => {
                Number { a: signed(w >> formats.below_column, formats.factor_bits), w: addend.row.w }
            }
            Operand::Raised => {
                Number { a: addend.row.a, w: addend.row.w.wrapping_add(addend.row.a << formats.doublings) }
            }
        };
        let [to_a, to_w] = match addend.sign {
            Sign::Plus => [1, 1],
            Sign::Minus => [-1, -1],
            Sign::PlusBySide if formats.right => [-1, -1],
            Sign::PlusBySide => [1, 1],
            Sign::MinusBySide if formats.right => [1, 1],
            Sign::MinusBySide => [-1, -1],
            Sign::ByA => {
                // A modulus, whose W is 0.
                let up = if a >= 0 { 1 } else { -1 };
                let rest = signed(base.a - up * row.a, formats.rest_bits);
                self.now = Number { a: rest, w: base.w.wrapping_add(up) };
                return;
            }
        };
        self.now = Number {
            a: signed(base.a + to_a * row.a, formats.rest_bits),
            w: base.w.wrapping_add(row.w.wrapping_mul(to_w)),
        };
    }
}

/// The low bits as a signed number.
pub(super) fn signed(value: i128, bits: u32) -> i128 {
    value << (128 - bits) >> (128 - bits)
}
