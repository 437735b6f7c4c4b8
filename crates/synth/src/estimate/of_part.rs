//! Parts of a machine, as the estimate sees them.

use super::delay::Delays;
use super::structure::Structure;
use crate::part::Part;
use edgewalk_machine::Plan;
use edgewalk_netlist::BuildErrors;

impl Part {
    /// What the part's netlist comes to on an iCE40; the longest path is that by these delays.
    ///
    /// # Errors
    /// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
    pub fn structure(self, plan: &Plan, delays: &Delays) -> Result<Structure, BuildErrors> {
        let mut structure = Structure::of(&*self.netlist(plan)?, delays);
        structure.whole = self == Part::MACHINE;
        if let Some(top) = structure.tables.first_mut() {
            top.unit = if self.has_units() { "joints" } else { self.name() }.to_owned();
        }
        Ok(structure)
    }
}
