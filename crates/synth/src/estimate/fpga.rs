//! Families of FPGAs whose cells and clock are estimated.

use super::delay::Delays;
use super::family::Family;
use crate::target::Target;

/// A family of FPGAs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fpga {
    /// Lattice iCE40: a carry cell a bit, blocks of 4 kbit. Products are look-up tables.
    Ice40,
    /// Lattice ECP5: a carry cell for two bits, small memories in look-up tables, blocks of 18 kbit, multipliers.
    Ecp5,
}

impl Fpga {
    /// All of them.
    pub const ALL: [Fpga; 2] = [Fpga::Ice40, Fpga::Ecp5];

    /// Name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Fpga::Ice40 => "ice40",
            Fpga::Ecp5 => "ecp5",
        }
    }

    /// The device whose clock is estimated.
    #[must_use]
    pub fn device(self) -> &'static str {
        match self {
            Fpga::Ice40 => "HX8K",
            Fpga::Ecp5 => "ECP5-25",
        }
    }

    /// The device that machines are synthesised for to fit an estimate. The Yosys is that whose passes the estimate
    /// follows, and not the wheel of `edgewalk synth`.
    #[must_use]
    pub fn measured(self) -> Target {
        match self {
            Fpga::Ice40 => Target::HX8K,
            Fpga::Ecp5 => Target { yosys: "yosys", ..Target::ECP5 },
        }
    }

    /// What was fitted to machines of the tree, JSON.
    pub(super) fn fitted(self) -> &'static str {
        match self {
            Fpga::Ice40 => include_str!("../../data/ice40.json"),
            Fpga::Ecp5 => include_str!("../../data/ecp5.json"),
        }
    }

    /// Where the fit of the delays begins, and what it is drawn to.
    pub(super) fn usual(self) -> Delays {
        match self {
            Fpga::Ice40 => {
                Delays { register: 1.2, table: 1.15, carry: 0.19, entry: 1.0, fanout: 0.2, size: 0.3 }
            }
            Fpga::Ecp5 => {
                Delays { register: 0.8, table: 0.8, carry: 0.06, entry: 0.6, fanout: 0.1, size: 0.2 }
            }
        }
    }

    /// What its cells are.
    pub(super) fn family(self) -> Family {
        match self {
            Fpga::Ice40 => Family::Ice40,
            Fpga::Ecp5 => Family::Ecp5,
        }
    }
}
