//! The Verilog that the tools get.

use crate::harness::{MODULE, harness};
use crate::memories::{Memory, memories};
use crate::part::Part;
use edgewalk_machine::Plan;
use edgewalk_netlist::BuildErrors;
use sha2::{Digest, Sha256};

/// A part of a machine as Verilog, with the harness around it.
pub struct Design {
    /// Which part.
    pub part: Part,
    /// Name and text of each file.
    pub files: Vec<(String, String)>,
    /// SHA-256 over names and texts of all files.
    pub hash: String,
    /// The memories outside it.
    pub(crate) memories: Vec<Memory>,
    /// The module that is measured.
    pub(crate) module: String,
    /// Units of the design and their modules, in the order the data flows; none if it is a unit itself.
    pub(crate) units: Vec<(String, String)>,
}

impl Design {
    /// The part, printed.
    ///
    /// # Errors
    /// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
    pub fn new(plan: &Plan, part: Part) -> Result<Design, BuildErrors> {
        let netlist = part.netlist(plan)?;
        let mut files = edgewalk_verilog::print(&harness(&netlist)?);
        // As `*.v` gives them: what Yosys makes of a design depends on the order of its modules by a few per cent.
        files.sort();
        let mut hash = Sha256::new();
        for (name, text) in &files {
            hash.update(name);
            hash.update([0]);
            hash.update(text);
            hash.update([0]);
        }
        let units = netlist.instances.iter().filter(|_| part.has_units());
        let units =
            units.map(|unit| (unit.name.trim_start_matches("u_").to_owned(), unit.module.name.clone()));
        Ok(Design {
            part,
            hash: hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect(),
            memories: memories(plan, part),
            module: netlist.name.clone(),
            units: units.collect(),
            files,
        })
    }

    /// Names of the files without the harness.
    pub(crate) fn sources(&self) -> impl Iterator<Item = &str> {
        let harness = format!("{MODULE}.v");
        self.files.iter().map(|(name, _)| name.as_str()).filter(move |name| *name != harness)
    }
}
