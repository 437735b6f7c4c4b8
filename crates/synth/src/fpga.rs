//! Families of FPGAs whose cells and clock are estimated.

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
}
