//! Which function builds which unit.

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildErrors, Netlist};

use crate::BUILDERS;

/// Builds the netlist of a unit.
pub type Build = fn(&Plan) -> Result<Arc<Netlist>, BuildErrors>;

/// What builds the unit of that name.
#[must_use]
pub fn builder(name: &str) -> Option<Build> {
    BUILDERS.iter().find(|(unit, _)| *unit == name).map(|(_, build)| *build)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_declared_unit_has_a_builder() {
        let declared: Vec<&str> = edgewalk_machine::UNITS.iter().map(|unit| unit.name).collect();
        let built: Vec<&str> = BUILDERS.iter().map(|(name, _)| *name).collect();
        assert_eq!(built, declared);
    }
}
