//! A machine in standard cells: area, clock and energy from Yosys and OpenSTA.
//!
//! ```text
//!  library (.lib) ──────────────────────┐
//!  part (netlist of rtl) ─> Verilog ─> yosys ─> gates ─┬─> area by unit
//!                                                      ├─> sta ─> critical path
//!  frame ─> transitions of each register and port ──────┴─> sta ─> power by cell ─> energy by unit
//! ```
//! There is no layout: wires have no capacitance and no delay of their own, and the clock has no tree. Figures of one
//! library compare machines; they are no promise of a chip.

mod liberty;
mod function;
mod library;
mod gates;
mod power;

pub use gates::{Gates, Placeless, UnitArea, gates};
pub use library::{Library, LibraryError};
pub use power::{Activity, Power, UnitPower, power};
