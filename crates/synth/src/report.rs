//! What is known of a design on a device.

use crate::cells::Cells;
use crate::memories::Memory;
use crate::packed::Packed;
use crate::target::Target;
use crate::timing::CriticalPath;
use edgewalk_tool::Stop;
use serde::Serialize;

/// A design on a device; what is `None` is not known, `reasons` say why.
#[derive(Debug, Serialize)]
pub struct Outcome {
    /// The device's name.
    pub target: &'static str,
    /// The device.
    pub device: &'static str,
    /// Version of Yosys.
    pub yosys: Option<String>,
    /// Version of nextpnr.
    pub nextpnr: Option<String>,
    /// Cells of the design without the harness, flattened.
    pub cells: Option<Cells>,
    /// Cells of each unit, synthesised apart; empty for a single unit.
    pub units: Option<Vec<UnitCells>>,
    /// The memories outside the design, and the blocks of the device that hold them. What holds the picture has to be read
    /// besides, to be shown.
    pub memories: Vec<Memory>,
    /// Cells after packing.
    pub packed: Option<Packed>,
    /// Over the seeds that gave a clock.
    pub mhz: Option<Mhz>,
    /// Every seed.
    pub seeds: Vec<Seed>,
    /// The critical path of the seed that is the median, the slower of two.
    pub critical_path: Option<CriticalPath>,
    /// Why something above is not known.
    pub reasons: Vec<String>,
    /// What kept every tool from running.
    #[serde(skip)]
    pub stop: Option<Stop>,
}

/// Cells of a unit.
#[derive(Debug, Serialize)]
pub struct UnitCells {
    /// Name of the unit; `joints` is what joins the units.
    pub unit: String,
    /// Cells of the unit, with those of the modules in it.
    #[serde(flatten)]
    pub cells: Cells,
}

/// What a seed gives.
#[derive(Debug, Serialize)]
pub struct Seed {
    /// The seed of nextpnr.
    pub seed: u32,
    /// The clock.
    pub mhz: Option<f64>,
}

/// The clock over the seeds, MHz.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mhz {
    /// The one in the middle, or between the two there.
    pub median: f64,
    /// The slowest seed.
    pub min: f64,
    /// The fastest seed.
    pub max: f64,
}

impl Outcome {
    pub(crate) fn unknown(target: &Target) -> Outcome {
        Outcome {
            target: target.name,
            device: target.device,
            yosys: None,
            nextpnr: None,
            cells: None,
            units: None,
            memories: Vec::new(),
            packed: None,
            mhz: None,
            seeds: Vec::new(),
            critical_path: None,
            reasons: Vec::new(),
            stop: None,
        }
    }
}

impl Mhz {
    /// Of rising values, at least one.
    pub(crate) fn of(sorted: &[f64]) -> Option<Mhz> {
        let (min, max) = (*sorted.first()?, *sorted.last()?);
        let middle = (sorted.len() - 1) / 2;
        let median = (sorted[middle] + sorted[sorted.len() / 2]) / 2.0;
        Some(Mhz { median, min, max })
    }
}

#[cfg(test)]
mod tests {
    use super::Mhz;

    #[test]
    fn the_median_is_in_the_middle() {
        assert_eq!(Mhz::of(&[]), None);
        for (sorted, median) in [(&[7.0][..], 7.0), (&[1.0, 2.0, 9.0], 2.0), (&[1.0, 2.0, 4.0, 9.0], 3.0)] {
            let mhz = Mhz::of(sorted).expect("there are some");
            assert_eq!((mhz.median, mhz.min, mhz.max), (median, sorted[0], sorted[sorted.len() - 1]));
        }
    }
}
