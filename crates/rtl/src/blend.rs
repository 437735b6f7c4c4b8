//! BLEND has no netlist yet: a machine with it is refused.

use std::panic::Location;
use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildError, BuildErrors, Fault, Netlist, Place};

/// The netlist of BLEND.
///
/// # Errors
/// Always: it is not written yet.
pub fn blend(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    refuse(plan)?;
    Ok(crate::pixel(plan)?) // not reached: only machines with BLEND have this unit
}

/// Refuses machines with BLEND.
pub(crate) fn refuse(plan: &Plan) -> Result<(), BuildErrors> {
    if !plan.blend.is_there() {
        return Ok(());
    }
    let name =
        "blend: this unit has no netlist yet; set blend.kind = none, or take another engine".to_owned();
    let place = Place(Location::caller());
    Err(BuildErrors(vec![BuildError {
        module: "edgewalk".to_owned(),
        place,
        fault: Fault::Undriven { name },
    }]))
}
