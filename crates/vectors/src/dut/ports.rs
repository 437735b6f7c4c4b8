//! The ports of a user's design, as Yosys reads them.

use super::error::DutError;
use super::file::{Dut, Widths};
use edgewalk_tool::{Stop, run};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// A port as it was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Found {
    /// Into the design.
    pub input: bool,
    /// Bits.
    pub width: u32,
}

/// Why the ports cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum PortsError {
    /// The design is not what its file says.
    #[error(transparent)]
    Dut(#[from] DutError),
    /// Yosys is missing or took too long.
    #[error(transparent)]
    Tool(#[from] Stop),
}

#[derive(Deserialize)]
struct Design {
    modules: BTreeMap<String, Module>,
}

#[derive(Deserialize)]
struct Module {
    #[serde(default)]
    attributes: BTreeMap<String, serde_json::Value>,
    #[serde(default)]
    parameter_default_values: BTreeMap<String, serde_json::Value>,
    ports: BTreeMap<String, Port>,
}

#[derive(Deserialize)]
struct Port {
    direction: String,
    bits: Vec<serde_json::Value>,
}

/// What Yosys writes: the modules as they are in the files, and the top module under its parameters.
const MODULES: &str = "modules.json";
const TOP: &str = "top.json";

/// The ports of the top module under its parameters; `None` where the file says that they are not to be read. `work` is a
/// folder for what Yosys writes.
///
/// # Errors
/// A top module or a parameter that is not there; Yosys is missing, refuses the design, or exceeds the limit.
pub fn ports(dut: &Dut, work: &Path, limit: Duration) -> Result<Option<BTreeMap<String, Found>>, PortsError> {
    if dut.widths == Widths::Unchecked {
        return Ok(None);
    }
    let mut script = String::from("read_verilog -sv");
    for folder in &dut.include {
        script += &format!(" -I{}", folder.display());
    }
    for file in &dut.files {
        script += &format!(" {}", file.display());
    }
    script += &format!("; proc; write_json {MODULES}; ");
    for (name, value) in &dut.parameters {
        // Yosys takes no sign.
        let bits = value
            .parse::<i32>()
            .ok()
            .filter(|number| *number < 0)
            .map(|number| format!("32'd{}", number as u32));
        let value = bits.as_ref().unwrap_or(value);
        script += &format!("chparam -set {name} {value} {}; ", dut.top);
    }
    script += &format!("hierarchy -top {}; proc; write_json {TOP}", dut.top);
    let ran = run(Command::new("yosys").args(["-q", "-p", &script]).current_dir(work), limit);
    if let Err(stop @ (Stop::Missing { .. } | Stop::TimeLimit { .. })) = ran {
        return Err(stop.into());
    }
    if let Some(Design { modules }) = design(&work.join(MODULES)) {
        let Some(top) = modules.get(&dut.top) else {
            let found = format!("no module {} in the files", dut.top);
            let names = modules.keys().map(String::as_str);
            return Err(DutError::unknown(&dut.file, "top", found, &dut.top, names).into());
        };
        let names = || top.parameter_default_values.keys().map(String::as_str);
        for (name, _) in &dut.parameters {
            if !top.parameter_default_values.contains_key(name) {
                let found = format!("{} has no parameter {name}", dut.top);
                let key = format!("parameters.{name}");
                return Err(DutError::unknown(&dut.file, key, found, name, names()).into());
            }
        }
    }
    if let Err(Stop::Broken { lines, .. }) = ran {
        let permitted = "Verilog that Yosys reads, or widths = \"unchecked\"";
        return Err(DutError::new(&dut.file, "files", lines.join(" "), permitted).into());
    }
    let top = design(&work.join(TOP)).and_then(|Design { modules }| {
        modules.into_values().find(|module| module.attributes.contains_key("top"))
    });
    let Some(top) = top else {
        return Err(
            Stop::Broken { tool: "yosys".to_owned(), lines: vec![format!("it left no {TOP}")] }.into()
        );
    };
    let found = |(name, port): (String, Port)| {
        // A port of 2^32 bits is none.
        let width = u32::try_from(port.bits.len()).unwrap_or(u32::MAX);
        (name, Found { input: port.direction == "input", width })
    };
    Ok(Some(top.ports.into_iter().map(found).collect()))
}

fn design(path: &Path) -> Option<Design> {
    serde_json::from_slice(&std::fs::read(path).ok()?).ok()
}
