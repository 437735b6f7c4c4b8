//! What is known of a run of the program as it is, in front of each of its words: an interval of A, of each row's A, and flags.

use super::range::{FAR, Range};
use super::word::{Row, Word};

/// Rows of a lane.
pub const ROWS: usize = 256;

/// No place of the program: the register of a call holds what it held.
pub const NOWHERE: u32 = u32::MAX;

/// The place in the program, with what the path to it has decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct At {
    pub place: u32,
    pub number: u32,
    /// `NOWHERE` where no call is open.
    pub link: u32,
    pub upper: Option<bool>,
    pub lower: Option<bool>,
    pub right: Option<bool>,
}

/// The values known at this place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Known {
    pub a: Range,
    /// A before the step of the word before: control sees its sign.
    pub before: Range,
    /// The step of the word before has left A.
    pub alike: bool,
    /// W is 0.
    pub w: bool,
    pub rows: Vec<Range>,
    /// Rows whose W is 0.
    pub w_zero: Vec<bool>,
    /// No leading digit is skipped.
    pub settled: bool,
    /// Leading digits may be skipped in this clock.
    pub skips: bool,
    /// No number has been found not to fit.
    pub fits: bool,
    /// A number has been found not to fit.
    pub unfit: bool,
    /// No prim is offered.
    pub room: bool,
    /// The vertices stand in the order of the port.
    pub unsorted: bool,
    /// A is y of the vertex at this place, or its line.
    pub y_of: Option<(bool, u8)>,
    /// A and W are those of which this result of this number was given last.
    pub given: Option<(u8, u8)>,
    /// A is A of this row.
    pub same: Option<u8>,
    /// Of a row that row without its bits below P.
    pub masked: Option<(u8, u8)>,
    /// The digits that have come up are 0.
    pub zeros: bool,
    /// So they are behind the next word, if they are in front of it.
    pub zeros_then: bool,
    /// Words until the skipping of leading digits is over for certain.
    pub settling: u8,
    /// A check of the word before says in the next clock that a number does not fit.
    pub checked: bool,
    /// The factor that was loaded last is not below 0: f, g.
    pub positive: [bool; 2],
    /// Words since each of them was loaded; none: the digits behind the signs have begun.
    pub since: [Option<u8>; 2],
    /// Words in which the skipping of leading digits ends, from the one that begins it.
    pub skipping: u8,
    /// Digits of a factor.
    pub digits: u32,
}

impl Known {
    /// Words in which the skipping ends that begins with this factor g, where f is 0.
    pub fn skipping_of(&self, g: Range) -> u8 {
        match self.zeros && self.since == [None; 2] && g.low == g.high {
            true => 2 + clocks_of_skipping(self.digits, first_digit(self.digits, g.low)),
            false => self.skipping,
        }
    }

    /// The row that a word reads.
    pub fn read(&self, word: &Word, number: u32) -> Row {
        match word.row(number) {
            Row::Digits(table) if self.zeros => Row::At(table),
            row => row,
        }
    }

    pub fn row(&self, row: Row) -> Range {
        match row {
            Row::At(row) => self.rows[usize::from(row)],
            Row::Digits(table) => {
                (0..4).map(|i| self.rows[usize::from(table) + i]).reduce(Range::join).unwrap_or(Range::ANY)
            }
            Row::Vertex(_, part) => self.rows[128 + usize::from(part)],
        }
    }

    /// W of the row is 0.
    pub fn is_w_zero(&self, row: Row) -> bool {
        match row {
            Row::At(row) => self.w_zero[usize::from(row)],
            Row::Digits(table) => (0..4).all(|i| self.w_zero[usize::from(table) + i]),
            Row::Vertex(..) => true,
        }
    }

    /// W is 0 behind the word, which reads this row.
    pub fn is_w_zero_behind(&self, word: &Word, row: Row) -> bool {
        let added =
            !word.is("by_a") && self.is_w_zero(row) && (!word.is("raised") || self.row(row).is_zero());
        let kept = self.w || word.get("base") == 0 && word.get("only") == 0;
        if word.is("steps") { added && kept } else { self.w }
    }

    pub fn join(&mut self, other: &Known, widen: bool) -> bool {
        let was = self.clone();
        let one = |a: Range, b: Range| {
            let all = a.join(b);
            if widen && all != a {
                Range {
                    low: if all.low < a.low { -FAR } else { a.low },
                    high: if all.high > a.high { FAR } else { a.high },
                    ..all
                }
            } else {
                all
            }
        };
        self.a = one(self.a, other.a);
        self.before = one(self.before, other.before);
        for (row, new) in self.rows.iter_mut().zip(&other.rows) {
            *row = one(*row, *new);
        }
        for (zero, new) in self.w_zero.iter_mut().zip(&other.w_zero) {
            *zero &= new;
        }
        self.w &= other.w;
        self.alike &= other.alike;
        self.settled &= other.settled;
        self.skips |= other.skips;
        self.fits &= other.fits;
        self.unfit &= other.unfit;
        self.room &= other.room;
        self.unsorted &= other.unsorted;
        self.y_of = self.y_of.filter(|place| other.y_of == Some(*place));
        self.given = self.given.filter(|given| other.given == Some(*given));
        self.same = self.same.filter(|row| other.same == Some(*row));
        self.masked = self.masked.filter(|rows| other.masked == Some(*rows));
        self.zeros &= other.zeros;
        self.zeros_then &= other.zeros_then;
        self.settling = self.settling.max(other.settling);
        self.checked |= other.checked;
        (0..2).for_each(|factor| self.positive[factor] &= other.positive[factor]);
        (0..2).for_each(|factor| {
            self.since[factor] = self.since[factor].zip(other.since[factor]).map(|(a, b)| a.min(b));
        });
        *self != was
    }
}

/// The numbers of jumps and acts, as the ROM has them.
pub mod code {
    pub const WORDS: u32 = 1;
    pub const ROOM: u32 = 2;
    pub const SETTLE: u32 = 3;
    pub const DIGITS: u32 = 4;
    pub const AGAIN: u32 = 5;
    pub const ZEROS: u32 = 6;
    pub const MORE: u32 = 7;
    pub const NEGATIVE: u32 = 8;
    pub const UNFIT: u32 = 9;
    pub const NO_UPPER: u32 = 10;
    pub const NO_LOWER: u32 = 11;
    pub const ROUNDS: u32 = 12;
    pub const GOTO: u32 = 13;
    pub const CALL: u32 = 14;
    pub const RETURN: u32 = 15;

    pub const UNSORTED: u32 = 1;
    pub const SWAPS: [u32; 2] = [2, 3];
    pub const SIDE: u32 = 4;
    pub const UPPER: u32 = 5;
    pub const LOWER: u32 = 6;
    pub const SHIFT: u32 = 7;
    pub const JUDGE: u32 = 8;
    pub const CHECK: u32 = 9;
    pub const TIMES: [u32; 4] = [10, 11, 23, 24];
    pub const TIMES_K: u32 = 11;
    pub const SCALE: u32 = 12;
    pub const LAST_ROUND: u32 = 13;
    pub const EDGES: [u32; 3] = [14, 15, 16];
    pub const BESIDE: u32 = 17;
    pub const DROPS: [u32; 3] = [19, 20, 21];
    pub const DONE: u32 = 22;
}

/// Clocks of skipping, if so many shifts bring the first digit that differs from the sign behind it. It begins two clocks
/// behind the word that loads a factor of so many digits.
pub fn clocks_of_skipping(digits: u32, first: u32) -> u8 {
    let (mut left, mut first, mut clocks) = (digits - 1, first, 1);
    while first > 0 && left != 1 {
        let shifted = if first >= 4 && left > 4 { 4 } else { 1 };
        (left, first, clocks) = (left - shifted, first - shifted, clocks + 1);
    }
    clocks
}

/// Shifts that bring the first digit of this factor that differs from its sign behind it.
pub fn first_digit(digits: u32, factor: i128) -> u32 {
    let magnitude = if factor < 0 { !factor } else { factor };
    digits.saturating_sub(1 + (128 - magnitude.leading_zeros()))
}
