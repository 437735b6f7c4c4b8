//! Bilinear colours of a span: from its left edge to its right one, by one division of a bit a clock.
//!
//! ```text
//!  T = floor(p / D 2^k), then G = floor(2^F / D 2^k): a bit a clock
//!  A = N T, N G: a bit beside it        V = left + RN(A / 2^k), g = RN(A / 2^k)
//! ```

use super::pass::Pair;
use crate::tokens::Words;
use edgewalk_machine::{COLOURS, Plan};

/// The colours of the span that MOVER has.
#[derive(Clone, Debug)]
pub(super) struct Between {
    /// k = b + r + 1.
    k: u32,
    /// F.
    fraction: u32,
    /// 2^(b+r) - 1.
    mask: u64,
    /// From edge to edge, 2^-F px.
    apart: i64,
    /// The rest of the division, below `apart`.
    rest: i64,
    /// N: the right less the left colours.
    differences: [i64; 3],
    /// A: N times the bits so far.
    sums: [i128; 3],
    /// Bits so far, of both quotients.
    turns: u32,
    /// The bit that was found last, and whether it is to be summed.
    bit: bool,
    summing: bool,
    dividing: bool,
    offers: bool,
}

impl Between {
    pub fn new(plan: &Plan) -> Between {
        let word = plan.channels()[COLOURS.start].word();
        Between {
            k: word + 1,
            fraction: plan.edge_fraction,
            mask: (1 << word) - 1,
            apart: 0,
            rest: 0,
            differences: [0; 3],
            sums: [0; 3],
            turns: 0,
            bit: false,
            summing: false,
            dividing: false,
            offers: false,
        }
    }

    pub fn reset(&mut self) {
        (self.dividing, self.summing, self.offers) = (false, false, false);
    }

    /// Bits are found or summed.
    pub fn dividing(&self) -> bool {
        self.dividing || self.summing
    }

    /// The span is offered.
    pub fn offers(&self) -> bool {
        self.offers
    }

    /// The edges are a pixel apart at most.
    pub fn is_narrow(&self) -> bool {
        self.apart <= 1 << self.fraction
    }

    /// Bits found, from edge to edge, the rest, N and A / 2^k.
    pub fn state(&self) -> (u32, [i64; 2], [i64; 3], [u64; 3]) {
        (self.turns, [self.apart, self.rest], self.differences, self.rounded())
    }

    /// MOVER takes a pair whose first column on the screen is `first`: the values are the left edge's.
    pub fn begin<const C: usize>(&mut self, pair: &Pair, first: i32, values: &mut Words<C>) {
        let [left, right] = pair.ends;
        // Where the edges are, 2^-F px from the columns' centres: C less R / 2^F.
        let place = |column: i32, below: i32| (i64::from(column) << self.fraction) + i64::from(below);
        let from = place(left.column, left.below);
        self.apart = place(right.column, right.below) - from;
        self.rest = place(first, (1 << self.fraction) - 1) - from;
        self.differences = [0, 1, 2].map(|colour| right.colours[colour] as i64 - left.colours[colour] as i64);
        values[COLOURS].copy_from_slice(&left.colours);
        (self.sums, self.turns, self.dividing) = ([0; 3], 0, true);
    }

    /// Clock edge: a bit of T or G, and the one before into the sums.
    pub fn divide<const C: usize>(&mut self, values: &mut Words<C>) {
        if std::mem::replace(&mut self.summing, self.dividing) {
            if self.turns == self.k + 1 {
                let added = self.rounded();
                for (value, added) in values[COLOURS].iter_mut().zip(added) {
                    *value = value.wrapping_add(added) & self.mask;
                }
                self.sums = [0; 3];
            }
            for (sum, difference) in self.sums.iter_mut().zip(self.differences) {
                *sum = 2 * *sum + if self.bit { i128::from(difference) } else { 0 };
            }
        }
        if !self.dividing {
            return;
        }
        self.bit = 2 * self.rest >= self.apart;
        self.rest = 2 * self.rest - if self.bit { self.apart } else { 0 };
        if self.apart == 0 {
            self.rest = 0; // of a line of one pixel: no difference, whatever the bits
        }
        if self.turns + 1 == self.k {
            self.rest = if self.is_narrow() { 0 } else { 1 << self.fraction };
        }
        self.turns += 1;
        self.dividing = self.turns < 2 * self.k;
    }

    /// The span is offered from the next clock on, if its colours are known and it is not offered yet; their g.
    pub fn offer(&mut self) -> Option<[u64; 3]> {
        if self.dividing() || self.offers {
            return None;
        }
        self.offers = true;
        Some(self.rounded())
    }

    /// SPAN takes the span.
    pub fn taken(&mut self) {
        self.offers = false;
    }

    /// RN(A / 2^k).
    fn rounded(&self) -> [u64; 3] {
        self.sums.map(|sum| ((sum + (1 << (self.k - 1))) >> self.k) as u64 & self.mask)
    }
}
