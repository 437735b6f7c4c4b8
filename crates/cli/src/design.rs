//! The machine as files of Verilog.

use anyhow::{Result, anyhow};
use edgewalk_files::Staging;
use edgewalk_machine::Plan;
use edgewalk_vectors::Unit;
use edgewalk_vectors::write::core;

/// The files that `write_design` may write under `folder` for some machine: a machine has some of the units, 1, 2 or 4 lanes of
/// SETUP, and queues.
pub fn own(folder: &str) -> Vec<String> {
    let lanes = (0..4).map(|lane| format!("setup_lane{lane}"));
    let units = Unit::known().flat_map(|unit| [unit.name().to_owned(), format!("{}_fifo", unit.name())]);
    units.chain(lanes).map(|module| format!("{folder}edgewalk_{module}.v")).collect()
}

/// Prints every module of the machine under `folder` of `out`, with the machine file and the list of modules in compile
/// order, which is returned too.
pub fn write_design(machine: &Plan, out: &Staging, folder: &str) -> Result<Vec<String>> {
    let design = edgewalk_rtl::machine(machine).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    let (stamp, mut names) = (machine.stamp("//"), Vec::new());
    for (name, text) in edgewalk_verilog::print(&design) {
        out.write(&format!("{folder}{name}"), format!("{stamp}\n{text}"))?;
        names.push(name);
    }
    out.write(&format!("{folder}filelist.f"), format!("{stamp}{}\n", names.join("\n")))?;
    let (name, stamp) = (format!("machine_{}", machine.hash()), machine.stamp("#"));
    out.write(&format!("{folder}edgewalk.core"), core::of_design(&stamp, &name, "edgewalk", &names))?;
    out.write(&format!("{folder}machine.toml"), machine.stamp("#") + "\n" + &machine.to_toml())?;
    Ok(names)
}
