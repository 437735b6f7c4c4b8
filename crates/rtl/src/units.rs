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
