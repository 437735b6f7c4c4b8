//! Synthesis for iCE40 with Yosys: does it accept the design, and how many cells does it take.

use super::{SimulateError, hdl};
use crate::read::read;
use edgewalk_tool::{Stop, first_lines, run};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// Cells by kind, such as `SB_LUT4`.
pub type Cells = BTreeMap<String, u64>;

#[derive(Deserialize)]
struct Statistics {
    design: Design,
}

#[derive(Deserialize)]
struct Design {
    num_cells_by_type: Cells,
}

/// Synthesises the design of a directory (the module under test, not the memory beside it).
///
/// # Errors
/// A changed directory; Yosys missing, refusing the design, leaving not a single cell, or exceeding the limit.
pub fn synth_ice40(directory: &Path, limit: Duration) -> Result<Cells, SimulateError> {
    let manifest = read(|name| std::fs::read(directory.join(name)))?.manifest;
    let mut command = Command::new("yosys");
    command.args(["-Q", "-T", "-p", &format!("synth_ice40 -top {}; stat -json", manifest.module)]);
    let printed = run(command.args(hdl(&manifest)).current_dir(directory), limit)?;
    let cells = cells(&printed).filter(|cells| cells.values().any(|count| *count > 0));
    let lines = || first_lines(printed.lines().rev());
    Ok(cells.ok_or_else(|| Stop::Broken { tool: "yosys".to_owned(), lines: lines() })?)
}

/// The statistics are the last thing printed: a JSON object from a line `{` on.
fn cells(printed: &str) -> Option<Cells> {
    let (_, json) = printed.rsplit_once("\n{\n")?;
    let (json, _) = json.rsplit_once('}')?;
    let statistics: Statistics = serde_json::from_str(&format!("{{{json}}}")).ok()?;
    Some(statistics.design.num_cells_by_type)
}
