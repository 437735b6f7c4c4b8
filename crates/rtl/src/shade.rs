//! TERM and SHADE have no netlist yet: a machine with them is refused.

use std::panic::Location;
use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildError, BuildErrors, Fault, Netlist, Place};

/// The netlist of TERM.
///
/// # Errors
/// Always: it is not written yet.
pub fn term(_: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    Err(missing())
}

/// The netlist of TEXEL.
///
/// # Errors
/// Always: it is not written yet.
pub fn texel(_: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    Err(missing())
}

/// The netlist of NORMAL.
///
/// # Errors
/// Always: it is not written yet.
pub fn normal(_: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    Err(missing())
}

/// The netlist of SHADE.
///
/// # Errors
/// Always: it is not written yet.
pub fn shade(_: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    Err(missing())
}

/// Refuses machines with TERM and SHADE.
pub(crate) fn refuse(plan: &Plan) -> Result<(), BuildErrors> {
    if plan.shade.is_there() { Err(missing()) } else { Ok(()) }
}

fn missing() -> BuildErrors {
    let name =
        "term, texel, normal, shade: these units have no netlist yet; set shade.kind = none, or take another engine"
            .to_owned();
    let place = Place(Location::caller());
    BuildErrors(vec![BuildError { module: "edgewalk".to_owned(), place, fault: Fault::Undriven { name } }])
}
