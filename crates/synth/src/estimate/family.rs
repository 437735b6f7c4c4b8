//! What logic is built of.

use crate::fpga::Fpga;

/// Cells of an FPGA, or gates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) enum Family {
    /// Lattice iCE40: a carry cell a bit, blocks of 4 kbit. Products are look-up tables.
    #[default]
    Ice40,
    /// Lattice ECP5: a carry cell for two bits, small memories in look-up tables, blocks of 18 kbit, multipliers.
    Ecp5,
    /// Standard cells: memories are flip-flops, sums and products are gates.
    Gates,
}

impl Family {
    /// The cells of a family of FPGAs.
    pub fn of(family: Fpga) -> Family {
        match family {
            Fpga::Ice40 => Family::Ice40,
            Fpga::Ecp5 => Family::Ecp5,
        }
    }

    /// A sum of so few bits has no carry cell (`arith_map.v` of Yosys).
    pub fn short_sum(self) -> usize {
        match self {
            Family::Ice40 => 2,
            Family::Ecp5 => 4,
            Family::Gates => usize::MAX,
        }
    }
}
