//! The proved error of a channel, and how far its values are stepped.

use crate::channel::{Channel, Kind};
use crate::machine::{EdgeKind, Fill, Machine};
use crate::plan::{COLOURS, Plan};
use crate::shadow::Gate;
use edgewalk_numerics::bounds::slope_edge_error;
use edgewalk_numerics::{Dyadic, ErrorBudget, Rounding, Screen, Steps};

/// Why no error of a machine's outputs is the largest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoBound {
    /// Bound 4 does not hold.
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
    /// The colour comes from tables (bounds 12 to 17).
    #[error(
        "each shaded triangle has the bound of its terms and tables; `edgewalk render` tells those of a frame"
    )]
    Shaded,
    /// The third term of bound 20 is of a frame.
    #[error("the bound of bilinear colours follows the edges of a frame; ask with polygon.values = plane")]
    Bilinear,
    /// Bound 11 grows with the layers of a pixel.
    #[error(
        "the bound of a colour grows with the layers behind its pixel and the light that they take; one layer errs by at most \
         {layer:.4} LSB"
    )]
    Layered {
        /// Of a fragment's own colour, LSB.
        layer: Dyadic,
    },
    /// Bound 19: the defect is of a frame.
    #[error(
        "a polygon adds how far its values lie from a plane; a triangle errs by at most {plane:.4} LSB, and `edgewalk size FILE` \
         tells the bound of a frame"
    )]
    Polygons {
        /// Of a triangle, LSB.
        plane: Dyadic,
    },
}

impl Channel {
    /// The budget of a fragment behind `steps` additions. For all fragments of a machine pass
    /// [`Machine::max_steps`].
    #[must_use]
    pub fn error_budget(&self, steps: Steps) -> ErrorBudget {
        let output = if self.kind == Kind::Floor { Dyadic::ONE } else { Dyadic::HALF };
        ErrorBudget::new(self.vertex_fraction, self.fraction, steps, output)
    }
}

impl Machine {
    /// The screen with its guard band, 2^G - 1 columns before it; a slope edge may start a span further out by its
    /// own error (bound 5).
    #[must_use]
    pub fn screen(&self) -> Screen {
        let slope = match self.edge_kind {
            EdgeKind::Exact => Dyadic::ZERO,
            EdgeKind::Slope => slope_edge_error(self.edge_fraction, self.height),
        };
        let beyond = slope.round(0, Rounding::Ceiling).numerator() as u32; // at most 2^31 px
        // POLY moves from one pixel of the screen to another.
        let guard = if self.polygon.is_there() { 0 } else { (1u32 << self.guard_bits.min(31)) - 1 };
        Screen { width: self.width, height: self.height, guard_columns: guard.saturating_add(beyond) }
    }

    /// The budget of a fragment of this machine behind `steps` additions.
    #[must_use]
    pub fn budget_behind(&self, channel: &Channel, steps: Steps) -> ErrorBudget {
        if self.polygon.is_bilinear() && ["r", "g", "b"].contains(&channel.name) {
            return ErrorBudget::bilinear(channel.vertex_fraction, channel.fraction, steps, Dyadic::HALF);
        }
        channel.error_budget(steps)
    }

    /// What holds for every fragment of this machine whose pixel lies inside its triangle, in a channel of it.
    ///
    /// # Errors
    /// Why outputs may wrap (bound 4): then no error is the largest.
    pub fn proved_budget(&self, channel: &Channel) -> Result<ErrorBudget, NoBound> {
        let additions = self.max_steps();
        let budget = self.budget_behind(channel, additions);
        if self.fill == Fill::Textbook {
            Err(NoBound::Textbook)
        } else if budget.holds() {
            Ok(budget)
        } else {
            Err(NoBound::Wraps { additions: additions.total(), steps: budget.steps })
        }
    }

    /// The most additions behind a visible fragment, [`Screen::max_steps`].
    #[must_use]
    pub fn max_steps(&self) -> Steps {
        self.screen().max_steps()
    }
}

impl Plan {
    /// The largest error of a stored depth (place 0) or colour (places 1 to 3) in every frame, LSB of what PIXEL gives: that of
    /// [`Machine::proved_budget`], of a light's gate, and the step of DITHER (bound 18).
    ///
    /// # Errors
    /// Why there is none for every frame.
    pub fn proved_output(&self, place: usize) -> Result<f64, NoBound> {
        let color = COLOURS.contains(&place);
        if color && self.shade.is_there() {
            return Err(NoBound::Shaded);
        }
        if color && self.polygon.is_bilinear() {
            return Err(NoBound::Bilinear);
        }
        let own = self.proved_budget(&self.channels()[place])?.after_rounding();
        if color && (self.blend.is_there() || self.shadow.transmits()) {
            return Err(NoBound::Layered { layer: own });
        }
        if self.polygon.is_there() {
            return Err(NoBound::Polygons { plane: own });
        }
        // A frame may leave a point in shadow all of its colour.
        let share = (color && self.shadow.is_there() && self.shadow.gate == Gate::Scale).then_some(1.0);
        Ok(gated(own.to_f64(), share) + if color { self.dither_step() } else { 0.0 })
    }
}

/// The error of a colour behind a light's gate that leaves a point in shadow this share of it, LSB: the share is rounded, and so
/// is the product.
#[must_use]
pub fn gated(lit: f64, share: Option<f64>) -> f64 {
    share.map_or(lit, |share| lit.max(lit * share + 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Plan;

    #[test]
    fn the_default_machine_needs_no_clamp_and_stays_within_one_lsb() {
        let plan = Plan::default();
        assert_eq!(plan.max_steps().total(), 9309);
        assert_eq!(plan.channels().len(), 4);
        for channel in plan.channels() {
            let budget = channel.error_budget(plan.max_steps());
            assert!(budget.holds() && budget.after_rounding() < Dyadic::ONE, "{budget}");
        }
    }

    #[test]
    fn no_bound_is_proved_where_sums_may_wrap() {
        let with = |fraction| {
            let mut channel = Plan::default().channels()[1];
            channel.precision.fraction = fraction;
            channel
        };
        let machine = Machine::default();
        assert_eq!(machine.proved_budget(&with(14)), Ok(with(14).error_budget(machine.max_steps())));
        for fraction in [0, 4, 13] {
            let steps = with(fraction).error_budget(machine.max_steps()).steps;
            let wraps = NoBound::Wraps { additions: 9309, steps };
            assert_eq!(machine.proved_budget(&with(fraction)), Err(wraps), "{fraction}");
        }
        let textbook = Machine { fill: Fill::Textbook, ..machine };
        assert_eq!(textbook.proved_budget(&with(14)), Err(NoBound::Textbook));
        // 511 additions and the start reach half an LSB with 9 bits to the dot.
        let edge = Machine { width: 256, height: 1, guard_bits: 8, ..Machine::default() };
        let steps = edge.max_steps().total() + 1;
        assert_eq!(steps, 511);
        assert!(edge.proved_budget(&with(9)).is_ok() && edge.proved_budget(&with(8)).is_err());
        let edge = Machine { height: 2, ..edge };
        assert_eq!(edge.max_steps().total() + 1, 512);
        assert!(edge.proved_budget(&with(9)).is_err(), "exactly 1/2 is not under 1/2");
    }

    #[test]
    fn senseless_numbers_do_not_panic() {
        let machine = Machine {
            height: u32::MAX,
            guard_bits: u32::MAX,
            edge_kind: EdgeKind::Slope,
            edge_fraction: 0,
            ..Machine::default()
        };
        assert_eq!(machine.max_steps().columns, u32::MAX);
    }
}
