//! SHADOW has no netlist yet: a machine with it is refused.

use std::panic::Location;
use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildError, BuildErrors, Fault, Netlist, Place};

/// The netlist of SHADOW.
///
/// # Errors
/// Always: it is not written yet.
pub fn shadow(_: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    Err(missing())
}

/// Refuses machines with SHADOW.
pub(crate) fn refuse(plan: &Plan) -> Result<(), BuildErrors> {
    if plan.shadow.is_there() { Err(missing()) } else { Ok(()) }
}

fn missing() -> BuildErrors {
    let name =
        "shadow: this unit has no netlist yet; set shadow.light = none, or take another engine".to_owned();
    let place = Place(Location::caller());
    BuildErrors(vec![BuildError { module: "edgewalk".to_owned(), place, fault: Fault::Undriven { name } }])
}
