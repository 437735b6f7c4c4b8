//! The proved error of a channel, and how far its values are stepped.

use crate::channel::{Channel, Kind};
use crate::machine::{EdgeKind, Machine};
use edgewalk_numerics::bounds::slope_edge_error;
use edgewalk_numerics::{Dyadic, ErrorBudget, Rounding, Screen, Steps};

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

    /// The most additions behind a visible fragment, [`Screen::max_steps`].
    #[must_use]
    pub fn max_steps(&self) -> Steps {
        self.screen().max_steps()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{MachineError, Plan};

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
    fn without_fraction_bits_there_is_no_bound() -> Result<(), MachineError> {
        let mut machine = Machine::default();
        machine.set("formats.color_vertex", "0")?;
        machine.set("formats.color_fraction", "0")?;
        let plan = machine.plan()?;
        let holds = plan.channels().iter().map(|c| c.error_budget(plan.max_steps()).holds());
        assert_eq!(holds.collect::<Vec<_>>(), [true, false, false, false]);
        Ok(())
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
