//! A machine in standard cells: area, clock and energy from Yosys and OpenSTA.
//!
//! ```text
//!  library (.lib) ──────────────────────┐
//!  part (netlist of rtl) ─> Verilog ─> yosys ─> gates ─┬─> area by unit
//!                                                      ├─> sta ─> critical path, transition times
//!  frame ─> values of each register and port ───────────┴─> every gate, every cycle ─> energy by unit
//! ```
//! There is no layout: wires have no capacitance and no delay of their own, and the clock has no tree. Figures of one
//! library compare machines; they are no promise of a chip.

mod liberty;
mod function;
mod table;
mod cell;
mod library;
mod written;
mod gates;
mod flat;
mod gate_run;
mod power;
#[cfg(test)]
mod tests;

pub use gate_run::{GateRun, UNSETTLED};
pub use gates::{Gates, Placeless, UnitArea, gates};
pub use library::{Library, LibraryError};
pub use power::{Power, UnitPower, power};
