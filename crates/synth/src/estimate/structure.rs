//! What a netlist comes to, before any factor is applied.

use super::delay::Path;

/// Counts of a module.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// Whether all units were asked for, and no part of the machine.
    pub whole: bool,
    /// Look-up tables of each unit, the top module's own first.
    pub tables: Vec<UnitTables>,
    /// Bits of carry chains.
    pub carry: u64,
    /// Flip-flops.
    pub ff: u64,
    /// Memory blocks.
    pub ram: u64,
    /// Memories of 16 words of 4 bits in look-up tables, on an ECP5.
    pub distributed: u64,
    /// Multipliers, on an ECP5.
    pub products: u64,
    /// Flip-flops that share no cell with the table before them.
    pub lone_ff: u64,
    /// Cells that a carry chain takes beside its sums: carries without a sum, and ways in and out.
    pub lone_carry: u64,
    /// The longest path.
    pub path: Path,
}

/// Look-up tables of a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitTables {
    /// The unit's name.
    pub unit: String,
    /// How many of its own.
    pub tables: u64,
}

impl Structure {
    /// All look-up tables.
    #[must_use]
    pub fn lut4(&self) -> u64 {
        self.tables.iter().map(|unit| unit.tables).sum()
    }
}
