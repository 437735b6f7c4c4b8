//! The design under test: netlists of `rtl`, and their Verilog.

pub use edgewalk_lockstep::netlist;

use edgewalk_lockstep::Unit;
use edgewalk_machine::Plan;
use edgewalk_netlist::BuildErrors;

/// The Verilog files of a unit, name and text; for the machine also a memory to put behind it.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn verilog(plan: &Plan, unit: Unit) -> Result<Vec<(String, String)>, BuildErrors> {
    let mut files = edgewalk_verilog::print(&netlist(plan, unit)?);
    if unit == Unit::MACHINE {
        files.extend(edgewalk_verilog::print(&edgewalk_rtl::memory(plan, plan.z.max())?));
    }
    let stamp = plan.stamp("//");
    Ok(files.into_iter().map(|(name, text)| (name, format!("{stamp}\n{text}"))).collect())
}
