//! NORMAL has no netlist yet: a machine with it is refused.

use std::panic::Location;
use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildError, BuildErrors, Fault, Netlist, Place};

/// The netlist of NORMAL.
///
/// # Errors
/// Always: it is not written yet.
pub fn normal(_: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let name = "normal: this unit has no netlist yet; set shade.kind = fast-phong, or take another engine"
        .to_owned();
    let place = Place(Location::caller());
    Err(BuildErrors(vec![BuildError {
        module: "edgewalk".to_owned(),
        place,
        fault: Fault::Undriven { name },
    }]))
}
