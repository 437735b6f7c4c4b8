//! Word lengths that follow from a configuration (`docs/machine.md`, section 1).

use crate::machine::Machine;

/// Derived word lengths, in bits unless stated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Widths {
    /// Vertex coordinate at the port, signed, `s` fraction bits: XW.
    pub vertex: u32,
    /// Fraction bits of centre coordinates: t = max(s, 1).
    pub center_fraction: u32,
    /// Centre coordinate, signed: CW.
    pub center: u32,
    /// Difference of two centre coordinates, signed: DW.
    pub difference: u32,
    /// Column, and quotient of an edge step, signed: COLW.
    pub column: u32,
    /// Column part of an address: xb.
    pub x: u32,
    /// Line of the screen, or of the map that the machine draws: yb.
    pub y: u32,
    /// lb: line of a triangle on its way to SPAN: yb, and with lines max(xb, yb), as a flat one has its columns there.
    pub line: u32,
    /// Address of a pixel, y·2^xb + x, or of a texel that the machine draws, y·2^SB + x.
    pub address: u32,
}

impl Machine {
    /// The word lengths of this machine.
    #[must_use]
    pub fn widths(&self) -> Widths {
        let center_fraction = self.subpixel_bits.max(1);
        let center = self.guard_bits + center_fraction + 1;
        let index = |count: u32| count.next_power_of_two().ilog2().max(1);
        let (x, y) = (index(self.width), index(self.height));
        let side = if self.shadow.draws_map() { self.shadow.side_bits() } else { 0 };
        let y = y.max(side);
        Widths {
            vertex: self.subpixel_bits + self.guard_bits + 1,
            center_fraction,
            center,
            difference: center + 1,
            column: self.guard_bits + 2,
            x,
            y,
            line: if self.polygon.has_lines() { x.max(y) } else { y },
            address: x.max(side) + y,
        }
    }
}
