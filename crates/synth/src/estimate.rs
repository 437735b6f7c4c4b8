//! What a machine costs on an iCE40, worked out from its netlist in milliseconds, without tools.
//!
//! ```text
//!  netlist ─> words ─> logic, carry chains, flip-flops, memory blocks ─> cover of 4-input tables ─> counts, longest path
//!                                                                              measured machines ─> factors, delays, errors
//! ```
//! Each unit goes through this by itself, with what its neighbours tell of its ports; a unit that several machines have does so
//! once ([`Kept`]). Flip-flops, carry cells and memory blocks are those of Yosys' `synth_ice40`, as its passes are followed one by one.
//! Look-up tables and clock are a model's, whose factors were fitted to machines that were synthesised.

mod ports;
mod words;
mod states;
mod narrow;
mod graph;
mod arithmetic;
mod sat;
mod builder;
mod operators;
mod registers;
mod blocks;
mod build;
mod cover;
mod merge;
mod delay;
mod ways;
mod structure;
mod module;
mod reads;
mod compose;
mod kept;
mod of_part;
mod fit;
mod measured;
mod device;

pub use delay::{Delays, Path};
pub use device::{Fits, fits};
pub use fit::{Errors, Estimate, Figure, Fit};
pub use kept::Kept;
pub use measured::{Measured, Sample};
pub use structure::{Structure, UnitTables};
