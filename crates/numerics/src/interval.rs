//! Closed intervals with exact dyadic end points: where a value can lie after given operations.

use crate::dyadic::Dyadic;
use crate::rounding::Rounding;
use std::fmt;
use std::ops::Neg;

/// All numbers from `low` to `high`, both included.
///
/// Every operation contains all results of the operation on members (the inclusion property) and is the
/// smallest such interval; `None` means that an end point does not fit [`Dyadic`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Interval {
    low: Dyadic,
    high: Dyadic,
}

impl Interval {
    /// `[low, high]`; `None` if `low > high`.
    pub fn new(low: Dyadic, high: Dyadic) -> Option<Interval> {
        (low <= high).then_some(Interval { low, high })
    }

    /// `[value, value]`.
    pub const fn point(value: Dyadic) -> Interval {
        Interval { low: value, high: value }
    }

    /// The lower end.
    pub const fn low(self) -> Dyadic {
        self.low
    }

    /// The upper end.
    pub const fn high(self) -> Dyadic {
        self.high
    }

    /// Whether `value` lies in the interval.
    pub fn contains(self, value: Dyadic) -> bool {
        self.low <= value && value <= self.high
    }

    /// Whether every member of `other` is a member.
    pub fn contains_interval(self, other: Interval) -> bool {
        self.low <= other.low && other.high <= self.high
    }

    /// All sums of a member of each.
    pub fn checked_add(self, other: Interval) -> Option<Interval> {
        Some(Interval { low: self.low.checked_add(other.low)?, high: self.high.checked_add(other.high)? })
    }

    /// All differences of independent members (so `x - x` is not zero but as wide as twice `x`).
    pub fn checked_sub(self, other: Interval) -> Option<Interval> {
        self.checked_add(-other)
    }

    /// All products of independent members.
    pub fn checked_mul(self, other: Interval) -> Option<Interval> {
        let corners = [
            self.low.checked_mul(other.low)?,
            self.low.checked_mul(other.high)?,
            self.high.checked_mul(other.low)?,
            self.high.checked_mul(other.high)?,
        ];
        Some(Interval { low: corners.into_iter().min()?, high: corners.into_iter().max()? })
    }

    /// The smallest interval that contains both.
    #[must_use]
    pub fn hull(self, other: Interval) -> Interval {
        Interval { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Where the members lie after rounding to `fraction_bits`. Every rounding is monotone, so the rounded
    /// ends are the ends of the rounded.
    #[must_use]
    pub fn round(self, fraction_bits: u32, rounding: Rounding) -> Interval {
        Interval {
            low: self.low.round(fraction_bits, rounding),
            high: self.high.round(fraction_bits, rounding),
        }
    }

    /// The largest magnitude of a member.
    #[must_use]
    pub fn magnitude(self) -> Dyadic {
        self.low.abs().max(self.high.abs())
    }
}

impl Neg for Interval {
    type Output = Interval;

    fn neg(self) -> Interval {
        Interval { low: -self.high, high: -self.low }
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{}, {}]", self.low, self.high)
    }
}
