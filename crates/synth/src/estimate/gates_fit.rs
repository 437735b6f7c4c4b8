//! Areas that make an estimate in standard cells of gates and flip-flops, and how they follow from what was measured.

use super::fit::{Figure, covered};
use super::gates::GateCounts;
use super::gates_measured::MeasuredUnit;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What a machine is estimated to cost in standard cells of 0.18 um.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GatesEstimate {
    /// Area in thousands of NANDs of two inputs.
    pub est_kge: Figure,
    /// Flip-flops, as Yosys counts them.
    pub est_ff: u64,
    /// Thousands of gates of each unit.
    pub est_kge_by_unit: BTreeMap<String, f64>,
}

/// Areas that were fitted to machines mapped onto OSU's cells for 0.18 um, in NANDs of two inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GatesFit {
    /// Of a flip-flop.
    pub ff: f64,
    /// Of the choice before a flip-flop.
    pub held: f64,
    /// Of a reset.
    pub reset: f64,
    /// Of a gate.
    pub gates: f64,
    /// Share of the area that nine in ten held-out machines err by at most.
    pub error: f64,
    /// The same of the units of held-out machines.
    pub error_of_unit: f64,
    /// How many machines were held out.
    pub machines: usize,
}

/// Area of a NAND of two inputs, um2.
const NAND: f64 = 24.0;
/// Units of fewer gates count for nothing in the fit: what joins the units is a handful.
const SMALL: f64 = 100.0;

impl GatesFit {
    /// What was fitted to machines of the tree; without such a file every area is 1.
    #[must_use]
    pub fn known() -> GatesFit {
        serde_json::from_str(include_str!("../../data/osu018.json")).unwrap_or(GatesFit {
            ff: 1.0,
            held: 1.0,
            reset: 1.0,
            gates: 1.0,
            error: 1.0,
            error_of_unit: 1.0,
            machines: 0,
        })
    }

    fn area(&self, of: &GateCounts) -> f64 {
        let GateCounts { ff, held, reset, gates } = *of;
        self.ff * ff as f64 + self.held * held as f64 + self.reset * reset as f64 + self.gates * gates as f64
    }

    /// The estimate of a part; `whole` tells whether it is a machine.
    #[must_use]
    pub fn estimate(&self, units: &BTreeMap<String, GateCounts>, whole: bool) -> GatesEstimate {
        let by_unit: BTreeMap<String, f64> =
            units.iter().map(|(unit, of)| (unit.clone(), self.area(of) / 1000.0)).collect();
        let value: f64 = by_unit.values().sum();
        let error = value * if whole { self.error } else { self.error_of_unit };
        GatesEstimate {
            est_kge: Figure { value, error },
            est_ff: units.values().map(|of| of.ff).sum(),
            est_kge_by_unit: by_unit,
        }
    }

    /// Fits to the units that are not held out, by least squares of the relative error; no area is negative.
    #[must_use]
    pub fn to(rows: &[(MeasuredUnit, GateCounts)]) -> GatesFit {
        let gates = |row: &MeasuredUnit| row.area_um2 / NAND;
        let used = rows.iter().filter(|(row, _)| !row.held_out && gates(row) >= SMALL);
        let weights: Vec<[f64; 4]> = used
            .map(|(row, of)| [of.ff, of.held, of.reset, of.gates].map(|count| count as f64 / gates(row)))
            .collect();
        let mut areas = [4.0, 1.0, 1.0, 1.0];
        for _ in 0..20_000 {
            for at in 0..areas.len() {
                let (mut over, mut under) = (0.0, 1e-9);
                for weights in &weights {
                    let others: f64 =
                        (0..areas.len()).filter(|of| *of != at).map(|of| weights[of] * areas[of]).sum();
                    over += weights[at] * (1.0 - others);
                    under += weights[at] * weights[at];
                }
                areas[at] = (over / under).max(0.0);
            }
        }
        let [ff, held, reset, gates_each] = areas.map(|area| (area * 1e4).round() / 1e4);
        let mut fit =
            GatesFit { ff, held, reset, gates: gates_each, error: 1.0, error_of_unit: 1.0, machines: 0 };
        let mut machines: BTreeMap<&str, [f64; 2]> = BTreeMap::new();
        let mut of_units = Vec::new();
        for (row, of) in rows.iter().filter(|(row, _)| row.held_out) {
            let [estimated, measured] = machines.entry(&row.machine).or_default();
            *estimated += fit.area(of);
            *measured += gates(row);
            if gates(row) >= SMALL {
                of_units.push(fit.area(of) / gates(row) - 1.0);
            }
        }
        let of_machines = machines.values().map(|[estimated, measured]| estimated / measured - 1.0).collect();
        fit.machines = machines.len();
        fit.error = covered(of_machines).unwrap_or(1.0);
        fit.error_of_unit = covered(of_units).unwrap_or(1.0);
        fit
    }
}
