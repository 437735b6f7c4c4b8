//! What Yosys counts: `stat -json`, a module at a time.

use edgewalk_tool::Stop;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::AddAssign;

/// Cells before packing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cells {
    /// Look-up tables of four inputs.
    pub lut4: u64,
    /// Cells of the carry chain: a bit each on iCE40, two bits each on ECP5.
    pub carry: u64,
    /// Flip-flops.
    pub ff: u64,
    /// Memories: blocks, and on ECP5 those of 16 words in look-up tables.
    pub ram: u64,
    /// Memories of `ram` in look-up tables.
    #[serde(skip)]
    pub distributed: u64,
    /// Multipliers.
    pub dsp: u64,
    /// Multiplexers beside the look-up tables, ECP5 only.
    pub mux: u64,
}

/// A memory of an ECP5 in look-up tables.
const DISTRIBUTED: &str = "TRELLIS_DPR16X4";

/// Cells of Yosys that stand for nothing on the device.
const NOTHING: &str = "$scopeinfo";

/// What a cell of that type counts as; `None` for a module and for what is not listed.
fn kind<'c>(cells: &'c mut Cells, cell: &str) -> Option<&'c mut u64> {
    match cell {
        "SB_LUT4" | "LUT4" => Some(&mut cells.lut4),
        "SB_CARRY" | "CCU2C" => Some(&mut cells.carry),
        "SB_RAM40_4K" | "SB_SPRAM256KA" | "DP16KD" | "PDPW16KD" | DISTRIBUTED => Some(&mut cells.ram),
        "SB_MAC16" | "MULT18X18D" | "MULT9X9D" | "ALU54B" => Some(&mut cells.dsp),
        "PFUMX" | "L6MUX21" => Some(&mut cells.mux),
        "TRELLIS_FF" => Some(&mut cells.ff),
        _ if cell.starts_with("SB_DFF") => Some(&mut cells.ff),
        _ => None,
    }
}

impl Cells {
    /// Memory blocks.
    #[must_use]
    pub fn blocks(&self) -> u64 {
        self.ram - self.distributed
    }
}

impl AddAssign for Cells {
    fn add_assign(&mut self, other: Cells) {
        self.lut4 += other.lut4;
        self.carry += other.carry;
        self.ff += other.ff;
        self.ram += other.ram;
        self.distributed += other.distributed;
        self.dsp += other.dsp;
        self.mux += other.mux;
    }
}

/// What `stat -json` says.
#[derive(Deserialize)]
pub(crate) struct Statistics {
    modules: BTreeMap<String, Module>,
}

#[derive(Deserialize)]
struct Module {
    #[serde(default)]
    num_cells_by_type: BTreeMap<String, u64>,
}

impl Statistics {
    pub fn read(json: &str) -> serde_json::Result<Statistics> {
        // Between the modules Yosys 0.23 prints lines of its table of instances, which are no JSON.
        let json: String =
            json.lines().filter(|line| line.trim_start().starts_with(['"', '{', '}'])).collect();
        serde_json::from_str(&json)
    }

    /// The cells of a module, with those of the modules it uses.
    ///
    /// # Errors
    /// It is not there, or has cells that nobody has listed: then the count would not be whole.
    pub fn module(&self, name: &str) -> Result<Cells, Stop> {
        let said = |why: String| Stop::Broken { tool: "yosys".to_owned(), lines: vec![why] };
        let module = self.find(name).ok_or_else(|| said(format!("its statistics tell nothing of {name}")))?;
        let mut all = Cells::default();
        for (cell, count) in &module.num_cells_by_type {
            if self.find(cell).is_some() {
                let each = self.module(cell)?;
                (0..*count).for_each(|_| all += each);
            } else if cell != NOTHING {
                all.distributed += if cell == DISTRIBUTED { *count } else { 0 };
                *kind(&mut all, cell)
                    .ok_or_else(|| said(format!("{name} has cells {cell}, of unknown kind")))? += count;
            }
        }
        Ok(all)
    }

    /// The cells of a module itself, without those of the modules it uses.
    pub fn own(&self, name: &str) -> Cells {
        let mut own = Cells::default();
        for (cell, count) in self.find(name).into_iter().flat_map(|module| &module.num_cells_by_type) {
            if let Some(kind) = kind(&mut own, cell) {
                *kind += count;
            }
        }
        own
    }

    /// Verilog's escape stands before the names of modules, but not where they are used.
    fn find(&self, name: &str) -> Option<&Module> {
        self.modules.get(name).or_else(|| self.modules.get(&format!("\\{name}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As Yosys 0.23 and 0.70 print it, shortened.
    const PRINTED: &str = r#"{ "creator": "Yosys", "modules": {
        "\\edgewalk": { "num_cells": 9, "num_cells_by_type": { "SB_LUT4": 3, "edgewalk_lane": 2, "edgewalk_span": 1, "SB_DFF": 1 } },
        "\\edgewalk_lane": { "num_cells": 12, "num_cells_by_type": { "SB_CARRY": 5, "SB_DFFESR": 4, "SB_LUT4": 7, "SB_DFF": 1 } },
        "\\edgewalk_span": { "num_cells_by_type": { "$scopeinfo": 1, "LUT4": 4, "CCU2C": 2, "PFUMX": 1, "TRELLIS_FF": 8, "DP16KD": 1, "TRELLIS_DPR16X4": 6, "MULT18X18D": 1 } },
        "\\odd": { "num_cells_by_type": { "SB_ODD": 1 } }
        },
            edgewalk_span            1
        "design": { "num_cells": 21 } }"#;

    #[test]
    fn modules_count_with_those_in_them() {
        let statistics = Statistics::read(PRINTED).expect("JSON");
        let all = statistics.module("edgewalk").expect("known cells");
        let [lut4, carry, ff] = [3 + 14 + 4, 10 + 2, 1 + 10 + 8];
        assert_eq!(all, Cells { lut4, carry, ff, ram: 7, distributed: 6, dsp: 1, mux: 1 });
        assert_eq!(all.blocks(), 1);
        assert_eq!(statistics.own("edgewalk"), Cells { lut4: 3, ff: 1, ..Cells::default() });
    }

    #[test]
    fn what_cannot_be_counted_is_said() {
        let statistics = Statistics::read(PRINTED).expect("JSON");
        for (module, why) in [("odd", "odd has cells SB_ODD, of unknown kind"), ("none", "nothing of none")] {
            let stop = statistics.module(module).expect_err("not to be counted").to_string();
            assert!(stop.contains(why), "{stop}");
        }
        assert!(Statistics::read("ERROR").is_err() && Statistics::read("").is_err());
    }
}
