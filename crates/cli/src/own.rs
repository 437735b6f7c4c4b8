//! A user's own design in place of ours: read, and wired to a unit of the machine before any simulator starts.

use anyhow::Result;
use edgewalk_files::Scratch;
use edgewalk_machine::Plan;
use edgewalk_scene::inputs;
use edgewalk_vectors::dut::{self, Dut, DutError, PortsError, Wiring};
use edgewalk_vectors::{Interface, Unit};
use std::path::Path;
use std::time::Duration;

/// Seconds that Yosys may take to read a design.
const LIMIT: Duration = Duration::from_secs(300);

/// The design that the file describes.
pub fn design(file: &Path, machine: &Plan) -> Result<Wiring> {
    let dut = Dut::read(file)?;
    inputs::note(file);
    dut.files.iter().for_each(|file| inputs::note(file));
    let units = Unit::all(machine);
    if !units.contains(&dut.unit) {
        let names: Vec<&str> = units.iter().map(|unit| unit.name()).collect();
        return Err(DutError {
            file: dut.file,
            key: "unit".to_owned(),
            found: format!("{}, which the machine has not", dut.unit.name()),
            permitted: names.join(", "),
            advice: Some("or set the keys that give the machine this unit".to_owned()),
        }
        .into());
    }
    let work = Scratch::temporary()?;
    let found = dut::ports(&dut, work.path(), LIMIT).map_err(|error| match error {
        PortsError::Dut(error) => anyhow::Error::from(error),
        PortsError::Tool(stop) => stop.into(),
    })?;
    let interface = Interface::new(machine, dut.unit);
    Ok(dut.wire(&interface, found.as_ref())?)
}
