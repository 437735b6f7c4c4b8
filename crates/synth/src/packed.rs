//! What nextpnr packs: cells of the device, those of the design apart from those of the harness.

use crate::names::is_of_design;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Cells that logic is packed into.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Packed {
    /// Type of the cells: `ICESTORM_LC` (a LUT4, a flip-flop and a bit of carry), `TRELLIS_COMB` (a LUT4 or a bit of carry).
    pub cell: String,
    /// Taken by the design.
    pub design: u64,
    /// Taken by the harness around it.
    pub harness: u64,
    /// Cells of the device.
    pub available: u64,
    /// Why it does not fit: what there is too little of; `None` if it does.
    pub lacks: Option<String>,
}

/// The netlist that nextpnr writes.
#[derive(Deserialize)]
struct Written {
    modules: BTreeMap<String, Module>,
}

#[derive(Deserialize)]
struct Module {
    cells: BTreeMap<String, Cell>,
}

#[derive(Deserialize)]
struct Cell {
    r#type: String,
}

/// The report that nextpnr writes.
#[derive(Deserialize)]
struct Report {
    utilization: BTreeMap<String, Utilization>,
}

#[derive(Deserialize)]
struct Utilization {
    used: u64,
    available: u64,
}

/// From netlist and report of packing.
pub(crate) fn packed(cell: &str, written: &str, report: &str) -> serde_json::Result<Packed> {
    let written: Written = serde_json::from_str(written)?;
    let report: Report = serde_json::from_str(report)?;
    let cells = written.modules.values().flat_map(|module| &module.cells);
    let (design, harness): (Vec<_>, Vec<_>) = cells
        .filter(|(_, packed)| packed.r#type == cell)
        .map(|(name, _)| name)
        .partition(|name| is_of_design(name));
    let lacks = report.utilization.iter().filter(|(_, of)| of.used > of.available);
    let lacks: Vec<String> =
        lacks.map(|(cell, of)| format!("{} {cell}, the device has {}", of.used, of.available)).collect();
    Ok(Packed {
        cell: cell.to_owned(),
        design: design.len() as u64,
        harness: harness.len() as u64,
        available: report.utilization.get(cell).map_or(0, |of| of.available),
        lacks: (!lacks.is_empty()).then(|| format!("does not fit: {} (harness included)", lacks.join("; "))),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const WRITTEN: &str = r#"{"modules": {"top": {"cells": {
        "dut.queue.count_SB_DFFESR_Q_DFFLC": {"type": "ICESTORM_LC"}, "$nextpnr_ICESTORM_LC_8": {"type": "ICESTORM_LC"},
        "harness_in_line_y_SB_DFF_Q_1_DFFLC": {"type": "ICESTORM_LC"}, "clk$sb_io": {"type": "SB_IO"}}}}}"#;

    fn of(used: u64) -> Packed {
        let lc = format!(
            r#"{{"ICESTORM_LC": {{"available": 7680, "used": {used}}}, "SB_IO": {{"available": 256, "used": 4}}}}"#
        );
        let report = format!(r#"{{"critical_paths": [], "fmax": {{}}, "utilization": {lc}}}"#);
        packed("ICESTORM_LC", WRITTEN, &report).expect("both can be read")
    }

    #[test]
    fn the_harness_is_counted_apart() {
        let fits = of(7680);
        assert_eq!((fits.design, fits.harness, fits.available, fits.lacks), (2, 1, 7680, None));
    }

    #[test]
    fn what_is_lacking_is_named() {
        let why = of(7681).lacks.expect("one too many");
        assert_eq!(why, "does not fit: 7681 ICESTORM_LC, the device has 7680 (harness included)");
    }
}
