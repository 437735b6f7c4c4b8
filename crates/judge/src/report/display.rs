//! Accesses to the frame memory by a display and by the clearing of the frame.

use edgewalk_machine::Plan;
use edgewalk_model::{Waits, clocks_alone};
use serde::Serialize;
use std::fmt::Write as _;

/// Loads that the host and a display put on the frame memory.
#[derive(Clone, Serialize)]
pub struct Display {
    /// Pictures that the display reads in a second.
    hz: f64,
    /// Before each frame: a depth and a colour for every pixel.
    clear: Load,
    /// For each picture of the display: the colour of every pixel.
    scan_out: Load,
    /// Of a second, MB/s.
    scan_out_mb_per_s: f64,
    /// Of the memory's clocks, in [0, 1] where the memory can do it.
    scan_out_share: f64,
}

/// Every pixel once, line by line.
#[derive(Clone, Serialize)]
struct Load {
    accesses: u64,
    /// Of an access, in all memories.
    bits: u32,
    bytes: f64,
    /// Clocks of the memory that does nothing else; of two memories the greater.
    cycles: u64,
}

impl Display {
    /// Of a display with so many pictures a second, beside a machine with a clock of so many MHz.
    #[must_use]
    pub fn new(machine: &Plan, waits: Waits, hz: f64, mhz: f64) -> Self {
        let own: u32 = machine.own_channels().map(|(_, channel)| channel.bits).sum();
        let rgb = 3 * machine.stored_color().bits;
        let clear = Load::new(machine, waits, machine.z.bits + rgb + own, true);
        let scan_out = Load::new(machine, waits, rgb, false);
        let scan_out_mb_per_s = scan_out.bytes * hz / 1e6;
        let scan_out_share = scan_out.cycles as f64 * hz / (mhz * 1e6);
        Display { hz, clear, scan_out, scan_out_mb_per_s, scan_out_share }
    }

    /// As lines of text.
    pub(super) fn lines(&self) -> String {
        let mut t = String::new();
        // Writing to a string cannot fail.
        for (name, Load { accesses, bits, bytes, cycles }) in
            [("clear", &self.clear), ("scan-out", &self.scan_out)]
        {
            _ = writeln!(
                t,
                "    {name:<16} {accesses:>10} of {bits:>3} bits {bytes:>13.0} bytes, {cycles} cycles"
            );
        }
        let (hz, rate, share) = (self.hz, self.scan_out_mb_per_s, 100.0 * self.scan_out_share);
        let word = if self.scan_out_share > 1.0 { ": the memory is too slow for this display" } else { "" };
        _ = writeln!(t, "    scan-out at {hz} Hz: {rate:.1} MB/s, {share:.1} % of the memory's clocks{word}");
        t
    }
}

impl Load {
    fn new(machine: &Plan, waits: Waits, bits: u32, writes: bool) -> Self {
        let (width, xb) = (machine.width, machine.widths().x);
        let pixels = (0..machine.height).flat_map(|line| (0..width).map(move |column| line << xb | column));
        let accesses = u64::from(width) * u64::from(machine.height);
        let bytes = accesses as f64 * f64::from(bits) / 8.0;
        Load { accesses, bits, bytes, cycles: clocks_alone(waits, pixels, writes) }
    }
}
