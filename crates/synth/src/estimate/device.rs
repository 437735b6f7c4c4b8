//! Whether an estimate fits a device.

use super::fit::Estimate;
use crate::memories::{Memory, place};
use crate::target::Target;
use serde::Serialize;

/// A device, and whether a machine fits it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fits {
    /// The device's name.
    pub device: &'static str,
    /// Whether it does; none where the estimate's error leaves that open.
    pub fits: Option<bool>,
    /// The same in words, with the cells or blocks that decide.
    pub text: String,
    /// The memories outside the machine, and the blocks that hold each. They do not decide whether the machine fits.
    pub memories: Vec<Memory>,
}

/// Whether a machine of this estimate fits the device, by its cells and its own memory blocks; and which of the memories
/// outside the machine the blocks that are left hold.
#[must_use]
pub fn fits(of: &Estimate, memories: Vec<Memory>, device: &Target) -> Fits {
    let of_cells = device.logic_cells as f64;
    let blocks: u64 = device.blocks.iter().filter(|block| block.holds_own).map(|block| block.count).sum();
    // On an ECP5 look-up tables hold the machine's own small memories, which are among the cells and no blocks.
    let own = of.blocks;
    let cells = of.est_cells;
    let said = format!(
        "{:.0} ± {:.0} cells of {of_cells}, {own} blocks of {blocks}",
        cells.value,
        cells.error.ceil()
    );
    let fits = match () {
        () if own > blocks || cells.value - cells.error > of_cells => Some(false),
        () if cells.value + cells.error <= of_cells => Some(true),
        () => None,
    };
    let word = match fits {
        Some(true) => "fits",
        Some(false) => "does not fit",
        None => "may fit",
    };
    let memories = place(memories, device.blocks, own);
    let held = memories.iter().map(|memory| match memory.held_by {
        Some(by) => format!("; {} in {} {}", memory.name, by.count, by.block),
        None => format!("; {} in none", memory.name),
    });
    let text = format!("{word}: {said}{}", held.collect::<String>());
    Fits { device: device.name, fits, text, memories }
}
