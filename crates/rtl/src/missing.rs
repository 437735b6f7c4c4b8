//! Units that are specified and modelled, and have no netlist yet: a machine with one is refused by its name.

use std::panic::Location;
use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildError, BuildErrors, Fault, Netlist, Place};

/// The netlist of PROJECT.
///
/// # Errors
/// Always: it is not written yet.
pub fn project(_: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    Err(missing("project", "shadow.light = parallel"))
}

fn missing(unit: &str, remedy: &str) -> BuildErrors {
    let name = format!("{unit}: this unit has no netlist yet; set {remedy}, or take another engine");
    let place = Place(Location::caller());
    BuildErrors(vec![BuildError { module: "edgewalk".to_owned(), place, fault: Fault::Undriven { name } }])
}
