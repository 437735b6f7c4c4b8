//! Delays that were fitted to placed designs, and what a path consists of.

use crate::fpga::Fpga;
use serde::{Deserialize, Serialize};

/// What a path consists of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Look-up tables, with the wire to each.
    pub tables: f64,
    /// Steps of a carry chain.
    pub carries: f64,
    /// Ways into a carry chain.
    pub entries: f64,
    /// Binary logarithms of the readers of each wire on it, added up.
    pub fanout: f64,
}

/// Delays of a device, ns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Delays {
    /// From the clock to a register's output, and what a register wants before the clock.
    pub register: f64,
    /// A table with a wire to it.
    pub table: f64,
    /// A bit of a carry chain.
    pub carry: f64,
    /// The way into a carry chain.
    pub entry: f64,
    /// A doubling of a wire's readers.
    pub fanout: f64,
    /// A doubling of the module's cells.
    pub size: f64,
}

/// A module has so many cells where [`Delays::size`] adds nothing.
const USUAL_CELLS: f64 = 1000.0;

impl Delays {
    /// Where the fit of the delays begins, and what it is drawn to.
    pub(super) fn usual(family: Fpga) -> Delays {
        match family {
            Fpga::Ice40 => {
                Delays { register: 1.2, table: 1.15, carry: 0.19, entry: 1.0, fanout: 0.2, size: 0.3 }
            }
            Fpga::Ecp5 => {
                Delays { register: 0.8, table: 0.8, carry: 0.06, entry: 0.6, fanout: 0.1, size: 0.2 }
            }
        }
    }

    /// Of a path in a module of so many cells, ns.
    #[must_use]
    pub fn of(&self, path: &Path, cells: f64) -> f64 {
        self.parts(path, cells).iter().sum()
    }

    /// What each delay adds.
    #[must_use]
    pub fn parts(&self, path: &Path, cells: f64) -> [f64; 6] {
        let weights = Delays::weights(path, cells);
        let delays = [self.register, self.table, self.carry, self.entry, self.fanout, self.size];
        std::array::from_fn(|at| delays[at] * weights[at])
    }

    /// How often each delay counts on a path, in the order of the fields.
    #[must_use]
    pub fn weights(path: &Path, cells: f64) -> [f64; 6] {
        let size = (cells.max(1.0) / USUAL_CELLS).log2();
        [1.0, path.tables, path.carries, path.entries, path.fanout, size]
    }
}
