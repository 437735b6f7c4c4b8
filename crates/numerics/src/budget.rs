//! The error of a fragment against the plane through the vertices' values as the host knows them.
//!
//! ```text
//!  host's value ──RN to 2^-e──> vertex ──start, steps──> sum ──RN──> output
//!                 2^-(e+1)               A2                    1/2        LSB, summed
//! ```

use crate::bounds::{slope_edge_error, triangle_error};
use crate::dyadic::Dyadic;
use crate::machine::{Channel, EdgeKind, Fill, Machine};
use crate::rounding::Rounding;
use crate::steps::Steps;
use std::fmt;

/// The parts of the largest error of a channel, LSB, for the exact fill rule. They hold only if the sum does not wrap:
/// [`Machine::proved_budget`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ErrorBudget {
    /// Vertex values rounded to nearest in e fraction bits: 2^-(e+1). Inside the triangle a value is a mean of the
    /// vertices' with weights that sum to 1, so no error of theirs grows.
    pub vertex: Dyadic,
    /// Start and increments, A2.
    pub steps: Dyadic,
    /// Output rounding: 1/2, and 1 where the output is the floor.
    pub output: Dyadic,
}

impl ErrorBudget {
    /// The budget of a fragment behind `steps` additions of r = `fraction` bits, its vertices rounded to e =
    /// `vertex_fraction` bits; the output is rounded by at most `output`.
    #[must_use]
    pub fn new(vertex_fraction: u32, fraction: u32, steps: Steps, output: Dyadic) -> ErrorBudget {
        ErrorBudget {
            vertex: slope_edge_error(vertex_fraction, 0),
            steps: triangle_error(Rounding::NearestHalfUp, fraction, steps).magnitude(),
            output,
        }
    }

    /// Largest difference of the value before the output rounding from the plane, LSB.
    #[must_use]
    pub fn before_rounding(&self) -> Dyadic {
        self.vertex.checked_add(self.steps).expect("below 2^34, no finer than 2^-65")
    }

    /// Largest difference of the output from the plane, LSB, if the output does not wrap.
    #[must_use]
    pub fn after_rounding(&self) -> Dyadic {
        self.before_rounding().checked_add(self.output).expect("as before_rounding")
    }
}

/// Why no error of a machine's outputs is the largest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoBound {
    /// A4 does not hold.
    #[error(
        "{additions} additions may err by {steps} LSB, which is not under 1/2: outputs may wrap past the ends of their range"
    )]
    Wraps {
        /// The most additions behind a fragment.
        additions: u64,
        /// What they may err by, LSB.
        steps: Dyadic,
    },
    /// Spans end outside the triangle.
    #[error(
        "edge.fill = textbook draws pixels outside the triangle, where values leave their range and wrap"
    )]
    Textbook,
}

impl Channel {
    /// The budget of a fragment behind `steps` additions. For all fragments of a machine pass
    /// [`Machine::max_steps`].
    #[must_use]
    pub fn error_budget(self, steps: Steps) -> ErrorBudget {
        ErrorBudget {
            vertex: slope_edge_error(self.vertex_fraction, 0),
            steps: triangle_error(Rounding::NearestHalfUp, self.fraction, steps).magnitude(),
            output: Dyadic::HALF,
        }
    }
}

impl Machine {
    /// The screen with its guard band, 2^G - 1 columns before it; a slope edge may start a span further out by its
    /// own error (A5).
    #[must_use]
    pub fn screen(&self) -> Screen {
        let slope = match self.edge_kind {
            EdgeKind::Exact => Dyadic::ZERO,
            EdgeKind::Slope => slope_edge_error(self.edge_fraction, self.height),
        };
        let beyond = slope.round(0, Rounding::Ceiling).numerator() as u32; // at most 2^31 px
        let guard = (1u32 << self.guard_bits.min(31)) - 1;
        Screen { width: self.width, height: self.height, guard_columns: guard.saturating_add(beyond) }
    }

    /// What holds for every fragment of this machine whose pixel lies inside its triangle, in a channel of it.
    ///
    /// # Errors
    /// Why outputs may wrap (A4): then no error is the largest.
    pub fn proved_budget(&self, channel: Channel) -> Result<ErrorBudget, NoBound> {
        let additions = self.max_steps();
        let budget = channel.error_budget(additions);
        if self.fill == Fill::Textbook {
            Err(NoBound::Textbook)
        } else if budget.steps >= Dyadic::HALF {
            Err(NoBound::Wraps { additions: additions.total(), steps: budget.steps })
        } else {
            Ok(budget)
        }
    }

    /// The most additions behind a visible fragment, [`Screen::max_steps`].
    #[must_use]
    pub fn max_steps(&self) -> Steps {
        self.screen().max_steps()
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
    fn no_bound_is_proved_where_sums_may_wrap() {
        let with = |fraction| Channel { fraction, ..Machine::default().color };
        let machine = Machine::default();
        assert_eq!(machine.proved_budget(with(14)), Ok(with(14).error_budget(machine.max_steps())));
        for fraction in [0, 4, 13] {
            let steps = with(fraction).error_budget(machine.max_steps()).steps;
            let wraps = NoBound::Wraps { additions: 9309, steps };
            assert_eq!(machine.proved_budget(with(fraction)), Err(wraps), "{fraction}");
        }
        let textbook = Machine { fill: Fill::Textbook, ..machine };
        assert_eq!(textbook.proved_budget(with(14)), Err(NoBound::Textbook));
        // 511 additions and the start reach half an LSB with 9 bits to the dot.
        let edge = Machine { width: 256, height: 1, guard_bits: 8, ..Machine::default() };
        let steps = edge.max_steps().total() + 1;
        assert_eq!(steps, 511);
        assert!(edge.proved_budget(with(9)).is_ok() && edge.proved_budget(with(8)).is_err());
        let edge = Machine { height: 2, ..edge };
        assert_eq!(edge.max_steps().total() + 1, 512);
        assert!(edge.proved_budget(with(9)).is_err(), "exactly 1/2 is not under 1/2");
    }

    #[test]
    fn senseless_numbers_do_not_panic() {
        let most = Steps { lines: u32::MAX, columns: u32::MAX };
        let budget = ErrorBudget::new(u32::MAX, 0, most, Dyadic::HALF);
        assert!(!budget.holds() && budget.after_rounding() > Dyadic::ONE);
    }
}
