//! The design under test: netlists of `rtl`, and their Verilog.

use crate::ports::Unit;
use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildErrors, Netlist};
use std::sync::Arc;

/// The netlist of the machine or of one of its units.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn netlist(machine: &Plan, unit: Unit) -> Result<Arc<Netlist>, BuildErrors> {
    match unit {
        Unit::Machine => edgewalk_rtl::machine(machine),
        Unit::Setup => edgewalk_rtl::setup(machine),
        Unit::Edge => edgewalk_rtl::edge(machine),
        Unit::Span => edgewalk_rtl::span(machine),
        Unit::Pixel => edgewalk_rtl::pixel(machine),
        Unit::Depth => edgewalk_rtl::depth(machine),
    }
}

/// The Verilog files of a unit, name and text; for the machine also a memory to put behind it.
///
/// # Errors
/// As [`netlist`].
pub fn verilog(machine: &Plan, unit: Unit) -> Result<Vec<(String, String)>, BuildErrors> {
    let mut files = edgewalk_verilog::print(&netlist(machine, unit)?);
    if unit == Unit::Machine {
        files.extend(edgewalk_verilog::print(&edgewalk_rtl::memory(machine, machine.z.max())?));
    }
    Ok(files)
}
