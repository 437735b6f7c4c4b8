//! Named roundings: how a value that lies between two representable ones is replaced by one of them.
//!
//! Every narrowing in the machine says which of these it uses; nothing rounds silently.

use std::cmp::Ordering;
use std::fmt;

/// A rule that turns a rational number into one of its two neighbouring integers (integers stay as they are).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rounding {
    /// Toward minus infinity: what dropping low bits of two's complement does. Error in (-1, 0].
    Floor,
    /// Toward plus infinity. Error in [0, 1).
    Ceiling,
    /// Drop the fraction of the magnitude (`Trunc` of the textbook). Error in (-1, 1).
    TowardZero,
    /// Next integer away from zero (slopes of the PlayStation GPU). Error in (-1, 1).
    AwayFromZero,
    /// `floor(x + 1/2)`, the machine's RN: nearest, halves up. Error in (-1/2, 1/2].
    NearestHalfUp,
    /// Nearest, halves to the even neighbour (the host's vertex snap). Error in [-1/2, 1/2].
    NearestHalfEven,
    /// Nearest, halves away from zero. Error in [-1/2, 1/2].
    NearestHalfAway,
}

impl Rounding {
    /// Every rounding.
    pub const ALL: [Rounding; 7] = [
        Rounding::Floor,
        Rounding::Ceiling,
        Rounding::TowardZero,
        Rounding::AwayFromZero,
        Rounding::NearestHalfUp,
        Rounding::NearestHalfEven,
        Rounding::NearestHalfAway,
    ];

    /// The name in messages and in `docs/numerics.md`.
    pub const fn name(self) -> &'static str {
        match self {
            Rounding::Floor => "floor",
            Rounding::Ceiling => "ceiling",
            Rounding::TowardZero => "toward-zero",
            Rounding::AwayFromZero => "away-from-zero",
            Rounding::NearestHalfUp => "nearest-half-up",
            Rounding::NearestHalfEven => "nearest-half-even",
            Rounding::NearestHalfAway => "nearest-half-away",
        }
    }

    /// True if the result is never further than 1/2 from the value.
    pub(crate) const fn is_nearest(self) -> bool {
        matches!(self, Rounding::NearestHalfUp | Rounding::NearestHalfEven | Rounding::NearestHalfAway)
    }

    /// `numerator / denominator` rounded to an integer; `None` if the denominator is 0 or the operands
    /// cannot be negated or divided within `i128`.
    pub fn divide(self, numerator: i128, denominator: i128) -> Option<i128> {
        let (numerator, denominator) = if denominator < 0 {
            (numerator.checked_neg()?, denominator.checked_neg()?)
        } else {
            (numerator, denominator)
        };
        let floor = numerator.checked_div_euclid(denominator)?;
        let remainder = numerator.checked_rem_euclid(denominator)?;
        let up = remainder != 0 && self.goes_up(floor, remainder.cmp(&(denominator - remainder)));
        // A remainder other than 0 means a denominator of 2 or more, so the quotient is far from the limit.
        Some(floor + i128::from(up))
    }

    /// Whether a value strictly between `floor` and `floor + 1` goes up; `half` compares its fraction with
    /// 1/2.
    fn goes_up(self, floor: i128, half: Ordering) -> bool {
        let positive = floor >= 0;
        let nearest = |tie: bool| half == Ordering::Greater || (half == Ordering::Equal && tie);
        match self {
            Rounding::Floor => false,
            Rounding::Ceiling => true,
            Rounding::TowardZero => !positive,
            Rounding::AwayFromZero => positive,
            Rounding::NearestHalfUp => nearest(true),
            Rounding::NearestHalfEven => nearest(floor & 1 == 1),
            Rounding::NearestHalfAway => nearest(positive),
        }
    }
}

impl fmt::Display for Rounding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns: value in quarters, then the results in the order of `Rounding::ALL`.
    const TABLE: [(i128, [i128; 7]); 13] = [
        (-6, [-2, -1, -1, -2, -1, -2, -2]),
        (-5, [-2, -1, -1, -2, -1, -1, -1]),
        (-4, [-1, -1, -1, -1, -1, -1, -1]),
        (-3, [-1, 0, 0, -1, -1, -1, -1]),
        (-2, [-1, 0, 0, -1, 0, 0, -1]),
        (-1, [-1, 0, 0, -1, 0, 0, 0]),
        (0, [0, 0, 0, 0, 0, 0, 0]),
        (1, [0, 1, 0, 1, 0, 0, 0]),
        (2, [0, 1, 0, 1, 1, 0, 1]),
        (3, [0, 1, 0, 1, 1, 1, 1]),
        (4, [1, 1, 1, 1, 1, 1, 1]),
        (5, [1, 2, 1, 2, 1, 1, 1]),
        (6, [1, 2, 1, 2, 2, 2, 2]),
    ];

    #[test]
    fn quarters_round_as_the_table_says() {
        for (quarters, results) in TABLE {
            for (rounding, expected) in Rounding::ALL.into_iter().zip(results) {
                assert_eq!(rounding.divide(quarters, 4), Some(expected), "{quarters}/4 {rounding}");
                assert_eq!(rounding.divide(-quarters, -4), Some(expected), "{}/-4 {rounding}", -quarters);
            }
        }
    }

    #[test]
    fn impossible_divisions_are_none() {
        for rounding in Rounding::ALL {
            assert_eq!(rounding.divide(1, 0), None);
            assert_eq!(rounding.divide(i128::MIN, -1), None);
            assert_eq!(rounding.divide(i128::MAX, 1), Some(i128::MAX));
        }
    }
}
