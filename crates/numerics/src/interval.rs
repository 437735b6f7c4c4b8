//! Closed intervals with exact dyadic end points: where a value can lie.

use crate::dyadic::Dyadic;
use std::fmt;

/// All numbers from `low` to `high`, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Interval {
    low: Dyadic,
    high: Dyadic,
}

impl Interval {
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

    /// The smallest interval that contains both.
    #[must_use]
    pub fn hull(self, other: Interval) -> Interval {
        Interval { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The largest magnitude of a member.
    #[must_use]
    pub fn magnitude(self) -> Dyadic {
        self.low.abs().max(self.high.abs())
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{}, {}]", self.low, self.high)
    }
}
