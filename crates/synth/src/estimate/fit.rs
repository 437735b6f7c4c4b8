//! The factors and delays that make an estimate of a structure, and how they follow from what was measured.

use super::delay::Delays;
use super::measured::{Measured, Sample};
use super::structure::Structure;
use crate::fpga::Fpga;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A figure with the error that it may have.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// The estimate.
    pub value: f64,
    /// What it may be off by, up or down: nine in ten of the machines that were held out are closer.
    pub error: f64,
}

/// What a machine is estimated to cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// Look-up tables.
    pub est_lut4: Figure,
    /// Carry cells, as Yosys counts them: of a bit on an iCE40, of two on an ECP5.
    pub est_carry: u64,
    /// Flip-flops, as Yosys counts them.
    pub est_ff: u64,
    /// Memories, as Yosys counts them: blocks, and on an ECP5 those of 16 words of 4 bits in look-up tables.
    pub est_ram: u64,
    /// Memory blocks among `est_ram`.
    #[serde(skip)]
    pub blocks: u64,
    /// Multipliers, as Yosys counts them. On an iCE40 products are look-up tables.
    pub est_dsp: u64,
    /// Logic cells after packing: a table, a flip-flop and a bit of carry each on an iCE40; a table with what else its
    /// place holds on an ECP5.
    pub est_cells: Figure,
    /// The clock on the family's device, MHz.
    pub est_mhz: Figure,
    /// Look-up tables of each unit.
    pub est_lut4_by_unit: BTreeMap<String, f64>,
}

/// Shares of a figure that nine in ten held-out machines err by at most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Of the look-up tables.
    pub lut4: f64,
    /// Of the packed cells.
    pub cells: f64,
    /// Of the clock.
    pub mhz: f64,
    /// Of the look-up tables of a part of a machine, times the root of their number: the smaller, the larger a share.
    pub lut4_of_part: f64,
    /// Of the packed cells of a part, times the root of their number.
    pub cells_of_part: f64,
    /// Of the clock of a part.
    pub mhz_of_part: f64,
    /// How many parts tell that. No table was fitted to any of them, and no delay to those that are held out.
    pub parts: usize,
    /// How many machines were held out.
    pub machines: usize,
    /// How many of these have a clock.
    pub placed: usize,
}

/// All that was fitted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// Look-up tables that Yosys makes of one of ours.
    pub lut4: f64,
    /// Cells that nextpnr packs for one of ours.
    pub cells: f64,
    /// On an HX8K.
    pub delays: Delays,
    /// Of the machines held out.
    pub errors: Errors,
}

/// How strongly, for each delay: in samples that contradict it by one of it.
const HOLD: f64 = 1.0;
/// Rounds in which paths are found with the delays, and delays with the paths.
const ROUNDS: usize = 4;
/// Share of the held-out machines that the error covers.
const COVERED: f64 = 0.9;

/// What was fitted to machines of the tree, JSON.
fn fitted(family: Fpga) -> &'static str {
    match family {
        Fpga::Ice40 => include_str!("../../data/ice40.json"),
        Fpga::Ecp5 => include_str!("../../data/ecp5.json"),
    }
}

static FITTED: LazyLock<[Option<Fit>; 2]> =
    LazyLock::new(|| Fpga::ALL.map(|family| serde_json::from_str(fitted(family)).ok()));

impl Fit {
    /// What was fitted to the machines in the tree; without such a file every factor is 1.
    #[must_use]
    pub fn known(family: Fpga) -> Fit {
        FITTED[family as usize].clone().unwrap_or_else(|| Fit::before(family))
    }

    /// Before anything was measured.
    #[must_use]
    pub fn before(family: Fpga) -> Fit {
        Fit { lut4: 1.0, cells: 1.0, delays: Delays::usual(family), errors: Errors::default() }
    }

    /// The estimate of a structure.
    #[must_use]
    pub fn estimate(&self, of: &Structure) -> Estimate {
        let by_unit = self.by_unit(of);
        let lut4: f64 = by_unit.values().sum();
        let cells = self.packed(of, lut4);
        let mhz = 1000.0 / self.delays.of(&of.path, cells);
        let errors = &self.errors;
        let [of_lut4, of_cells, of_mhz] = match of.whole {
            true => [errors.lut4, errors.cells, errors.mhz],
            false => {
                let roots = [lut4, cells].map(|count| count.max(1.0).sqrt());
                [errors.lut4_of_part / roots[0], errors.cells_of_part / roots[1], errors.mhz_of_part]
            }
        };
        let figure = |value: f64, share: f64| Figure { value, error: value * share };
        Estimate {
            est_lut4: figure(lut4.round(), of_lut4),
            est_carry: of.carry,
            est_ff: of.ff,
            est_ram: of.ram + of.distributed,
            blocks: of.ram,
            est_dsp: of.products,
            est_cells: figure(cells.round(), of_cells),
            est_mhz: figure(mhz, of_mhz),
            est_lut4_by_unit: by_unit,
        }
    }

    fn by_unit(&self, of: &Structure) -> BTreeMap<String, f64> {
        of.tables
            .iter()
            .filter(|unit| unit.tables > 0)
            .map(|unit| (unit.unit.clone(), unit.tables as f64 * self.lut4))
            .collect()
    }

    fn packed(&self, of: &Structure, lut4: f64) -> f64 {
        (lut4 + (of.lone_ff + of.lone_carry) as f64) * self.cells
    }

    /// Fits to the samples that are not held out, and tells the errors of those that are. `again` works a sample's
    /// structure out with other delays: another path may be the longest.
    #[must_use]
    pub fn to(family: Fpga, samples: &[Sample], again: impl Fn(&Sample, &Delays) -> Structure + Sync) -> Fit {
        let mut fit = Fit::before(family);
        let used: Vec<&Sample> = samples.iter().filter(|sample| !sample.measured.held_out).collect();
        let whole = || used.iter().filter(|sample| sample.measured.part == WHOLE);
        let tables = whole().map(|sample| sample.measured.cells[0] as f64 / sample.structure.lut4() as f64);
        fit.lut4 = middle(tables.collect()).unwrap_or(1.0);
        let packed = whole().filter_map(|sample| {
            let lut4: f64 = fit.by_unit(&sample.structure).values().sum();
            Some(sample.measured.packed? as f64 / fit.packed(&sample.structure, lut4))
        });
        fit.cells = middle(packed.collect()).unwrap_or(1.0);
        let mut placed: Vec<Sample> = used
            .iter()
            .filter(|sample| sample.measured.mhz.is_some())
            .map(|sample| (*sample).clone())
            .collect();
        for _ in 0..ROUNDS {
            fit.delays = fit.delays_of(Delays::usual(family), &placed);
            placed.par_iter_mut().for_each(|sample| sample.structure = again(sample, &fit.delays));
        }
        fit.errors = fit.errors_of(samples, &again);
        fit
    }

    /// Least squares of the relative error, drawn to the usual delays. No delay is negative.
    fn delays_of(&self, usual: Delays, samples: &[Sample]) -> Delays {
        let usual = [usual.register, usual.table, usual.carry, usual.entry, usual.fanout, usual.size];
        let mut delays = usual;
        let rows: Vec<([f64; 6], f64)> = samples
            .iter()
            .filter_map(|sample| {
                let ns = 1000.0 / sample.measured.mhz?;
                let lut4: f64 = self.by_unit(&sample.structure).values().sum();
                let weights = Delays::weights(&sample.structure.path, self.packed(&sample.structure, lut4));
                Some((weights.map(|weight| weight / ns), 1.0))
            })
            .collect();
        // One after the other, many times: the sum of squares is convex.
        for _ in 0..2000 {
            for at in 0..delays.len() {
                let (mut over, mut under) = (HOLD * 1e-2 / usual[at], HOLD * 1e-2 / (usual[at] * usual[at]));
                for (weights, wanted) in &rows {
                    let others: f64 =
                        (0..6).filter(|other| *other != at).map(|other| weights[other] * delays[other]).sum();
                    over += weights[at] * (wanted - others);
                    under += weights[at] * weights[at];
                }
                delays[at] = (over / under).max(0.0);
            }
        }
        let [register, table, carry, entry, fanout, size] = delays.map(|delay| (delay * 1e4).round() / 1e4);
        Delays { register, table, carry, entry, fanout, size }
    }

    /// Of the machines held out, and of the parts.
    fn errors_of(
        &self,
        samples: &[Sample],
        again: &(impl Fn(&Sample, &Delays) -> Structure + Sync),
    ) -> Errors {
        let mut whole: [Vec<f64>; 3] = Default::default();
        let mut part: [Vec<f64>; 3] = Default::default();
        let all: Vec<_> = samples
            .par_iter()
            .map(|sample| (sample, self.residuals(&sample.measured, &again(sample, &self.delays))))
            .collect();
        for (Sample { measured, .. }, (lut4, cells, mhz)) in all {
            if measured.part != WHOLE {
                part[0].push(lut4 * (measured.cells[0] as f64).sqrt());
                part[1].extend(cells.zip(measured.packed).map(|(off, cells)| off * (cells as f64).sqrt()));
                part[2].extend(mhz.filter(|_| measured.held_out));
            } else if measured.held_out {
                whole[0].push(lut4);
                whole[1].extend(cells);
                whole[2].extend(mhz);
            }
        }
        let (machines, placed, parts) = (whole[0].len(), whole[2].len(), part[0].len());
        let [lut4, cells, mhz] = whole.map(|off| covered(off).unwrap_or(1.0));
        let [lut4_of_part, cells_of_part, mhz_of_part] = part.map(|off| covered(off).unwrap_or(1.0));
        Errors { lut4, cells, mhz, lut4_of_part, cells_of_part, mhz_of_part, parts, machines, placed }
    }

    /// How far the estimates of a sample are off, as shares of what was measured: tables, packed cells, clock.
    #[must_use]
    pub fn residuals(&self, measured: &Measured, of: &Structure) -> (f64, Option<f64>, Option<f64>) {
        let estimate = self.estimate(of);
        let off = |estimate: f64, measured: f64| estimate / measured - 1.0;
        (
            off(estimate.est_lut4.value, measured.cells[0] as f64),
            measured.packed.map(|cells| off(estimate.est_cells.value, cells as f64)),
            measured.mhz.map(|mhz| off(estimate.est_mhz.value, mhz)),
        )
    }
}

/// The part of a sample that is a whole machine.
const WHOLE: &str = "machine";

/// The one in the middle.
fn middle(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).map(|value| (value * 1e4).round() / 1e4)
}

/// What so many of these are at most, without their signs.
pub(super) fn covered(values: Vec<f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.into_iter().map(f64::abs).collect();
    values.sort_by(f64::total_cmp);
    let place = (values.len() as f64 * COVERED).ceil() as usize;
    values.get(place.saturating_sub(1)).map(|value| (value * 1e4).ceil() / 1e4)
}
