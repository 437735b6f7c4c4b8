//! The error of a fragment against the plane through the vertices' values as the host knows them.
//!
//! ```text
//!  host's value ──RN to 2^-e──> vertex ──start, steps──> sum ──RN──> output
//!                 2^-(e+1)               bound 2                    1/2        LSB, summed
//! ```

use crate::bounds::{bilinear_error, slope_edge_error, triangle_error};
use crate::dyadic::Dyadic;
use crate::rounding::Rounding;
use crate::steps::Steps;
use std::fmt;

/// The parts of the largest error of a channel, LSB, for the exact fill rule. They hold only if the sum does not wrap,
/// [`ErrorBudget::holds`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ErrorBudget {
    /// Vertex values rounded to nearest in e fraction bits: 2^-(e+1). Inside the triangle a value is a mean of the
    /// vertices' with weights that sum to 1, so no error of theirs grows.
    pub vertex: Dyadic,
    /// Start and increments, bound 2.
    pub steps: Dyadic,
    /// Output rounding: 1/2, and 1 where the output is the floor.
    pub output: Dyadic,
}

impl ErrorBudget {
    /// The budget of a fragment behind `steps` additions of r = `fraction` bits, its vertices rounded to e =
    /// `vertex_fraction` bits; the output is rounded by at most `output`.
    #[must_use]
    pub fn new(vertex_fraction: u32, fraction: u32, steps: Steps, output: Dyadic) -> ErrorBudget {
        let steps = triangle_error(Rounding::NearestHalfUp, fraction, steps).magnitude();
        ErrorBudget { vertex: slope_edge_error(vertex_fraction, 0), steps, output }
    }

    /// Like [`ErrorBudget::new`], of a colour along the edges of a polygon and then from edge to edge, bound 20. What slope edges
    /// beside the true ones make of it comes on top.
    #[must_use]
    pub fn bilinear(vertex_fraction: u32, fraction: u32, steps: Steps, output: Dyadic) -> ErrorBudget {
        let steps = bilinear_error(fraction, steps);
        ErrorBudget { vertex: slope_edge_error(vertex_fraction, 0), steps, output }
    }

    /// Largest difference of the value before the output rounding from the plane, LSB.
    #[must_use]
    pub fn before_rounding(&self) -> Dyadic {
        self.vertex.checked_add(self.steps).expect("below 2^34, no finer than 2^-65")
    }

    /// The additions' part is under 1/2 LSB, so no output leaves the range and wraps (bound 4): only then is there a bound.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.steps < Dyadic::HALF
    }

    /// Largest difference of the output from the plane, LSB, if the budget [holds](ErrorBudget::holds).
    #[must_use]
    pub fn after_rounding(&self) -> Dyadic {
        self.before_rounding().checked_add(self.output).expect("as before_rounding")
    }
}

impl fmt::Display for ErrorBudget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} vertex + {} steps = {}", self.vertex, self.steps, self.before_rounding())?;
        write!(f, ", + {} output = {} LSB", self.output, self.after_rounding())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_are_shown() {
        let budget = ErrorBudget::new(4, 14, Steps { lines: 3, columns: 4 }, Dyadic::HALF);
        assert_eq!(
            budget.to_string(),
            "0.03125 vertex + 0.000244140625 steps = 0.031494140625, + 0.5 output = 0.531494140625 LSB"
        );
    }

    #[test]
    fn senseless_numbers_do_not_panic() {
        let most = Steps { lines: u32::MAX, columns: u32::MAX };
        let budget = ErrorBudget::new(u32::MAX, 0, most, Dyadic::HALF);
        assert!(!budget.holds() && budget.after_rounding() > Dyadic::ONE);
    }
}
