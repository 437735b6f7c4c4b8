//! Exact dyadic numbers, numerator / 2^n: every word, every fixed-point error and every bound is one.

use crate::rounding::Rounding;
use std::cmp::Ordering;
use std::fmt;
use std::ops::Neg;

/// `numerator / 2^fraction_bits`, kept in lowest terms, so equal values are equal structs.
///
/// Operations are exact; where the exact result needs more than 127 bits or more than
/// [`Dyadic::MAX_FRACTION_BITS`] they return `None`, never an approximation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dyadic {
    numerator: i128,
    fraction_bits: u32,
}

impl Dyadic {
    /// The finest resolution: 2^-126, so that a half of the finest step's denominator stays an `i128`.
    pub const MAX_FRACTION_BITS: u32 = 126;
    /// 0.
    pub const ZERO: Dyadic = Dyadic { numerator: 0, fraction_bits: 0 };
    /// 1/2: the error of one rounding to nearest.
    pub const HALF: Dyadic = Dyadic { numerator: 1, fraction_bits: 1 };
    /// 1.
    pub const ONE: Dyadic = Dyadic { numerator: 1, fraction_bits: 0 };

    /// `numerator / 2^fraction_bits`; `None` if in lowest terms that is finer than 2^-126, or is -2^127, the one
    /// numerator without a negative.
    pub fn new(numerator: i128, fraction_bits: u32) -> Option<Dyadic> {
        if numerator == 0 {
            return Some(Dyadic::ZERO);
        }
        let shift = numerator.trailing_zeros().min(fraction_bits);
        let lowest = Dyadic { numerator: numerator >> shift, fraction_bits: fraction_bits - shift };
        let held = lowest.fraction_bits <= Dyadic::MAX_FRACTION_BITS && lowest.numerator != i128::MIN;
        held.then_some(lowest)
    }

    /// The integer `value`.
    pub const fn integer(value: i64) -> Dyadic {
        Dyadic { numerator: value as i128, fraction_bits: 0 }
    }

    /// The numerator in lowest terms.
    pub const fn numerator(self) -> i128 {
        self.numerator
    }

    /// The n of the denominator 2^n in lowest terms.
    pub const fn fraction_bits(self) -> u32 {
        self.fraction_bits
    }

    /// The numerator over the denominator 2^`fraction_bits`, if that is an integer within `i128`.
    pub fn scaled(self, fraction_bits: u32) -> Option<i128> {
        let shift = fraction_bits.checked_sub(self.fraction_bits)?;
        if self.numerator == 0 {
            return Some(0);
        }
        let factor = 1i128.checked_shl(shift).filter(|factor| *factor > 0)?;
        self.numerator.checked_mul(factor)
    }

    /// Sum.
    pub fn checked_add(self, other: Dyadic) -> Option<Dyadic> {
        let bits = self.fraction_bits.max(other.fraction_bits);
        Dyadic::new(self.scaled(bits)?.checked_add(other.scaled(bits)?)?, bits)
    }

    /// Difference.
    pub fn checked_sub(self, other: Dyadic) -> Option<Dyadic> {
        self.checked_add(-other)
    }

    /// Product.
    pub fn checked_mul(self, other: Dyadic) -> Option<Dyadic> {
        Dyadic::new(
            self.numerator.checked_mul(other.numerator)?,
            self.fraction_bits + other.fraction_bits, // both at most 126
        )
    }

    /// Magnitude.
    #[must_use]
    pub fn abs(self) -> Dyadic {
        if self.numerator < 0 { -self } else { self }
    }

    /// The neighbour with `fraction_bits` fraction bits that `rounding` chooses.
    #[must_use]
    pub fn round(self, fraction_bits: u32, rounding: Rounding) -> Dyadic {
        let Some(excess) = self.fraction_bits.checked_sub(fraction_bits).filter(|excess| *excess > 0) else {
            return self;
        };
        let rounded = rounding.divide(self.numerator, 1 << excess).expect("a divisor from 2 to 2^126");
        Dyadic::new(rounded, fraction_bits).expect("coarser than before, and at least halved")
    }

    /// The nearest `f64` (exact up to 53 significant bits).
    pub fn to_f64(self) -> f64 {
        // Two exact powers of two: 2^-126 is a normal f64.
        self.numerator as f64 * (-f64::from(self.fraction_bits)).exp2()
    }
}

impl Neg for Dyadic {
    type Output = Dyadic;

    fn neg(self) -> Dyadic {
        Dyadic { numerator: -self.numerator, ..self } // never -2^127
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        let bits = self.fraction_bits.max(other.fraction_bits);
        match (self.scaled(bits), other.scaled(bits)) {
            (Some(a), Some(b)) => a.cmp(&b),
            // Only one of the two is scaled up; if that leaves i128 its magnitude exceeds the other's.
            (None, _) => self.numerator.cmp(&0),
            (_, None) => 0.cmp(&other.numerator),
        }
    }
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Display for Dyadic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.to_f64(), f)
    }
}
