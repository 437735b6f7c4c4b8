//! What a machine costs on an FPGA or in standard cells, worked out from its netlist in milliseconds, without tools.
//!
//! ```text
//!  netlist ─> words ─> logic, carry chains, flip-flops, memory blocks ─> cover of 4-input tables ─> counts, longest path
//!                                                                              measured machines ─> factors, delays, errors
//! ```
//! Each unit goes through this by itself, with what its neighbours tell of its ports; a unit that several machines have does so
//! once ([`Kept`]). Flip-flops, carry cells and memories are those of Yosys' `synth_ice40` and `synth_ecp5`, as their passes are
//! followed one by one.
//! Look-up tables and clock are a model's, whose factors were fitted to machines that were synthesised.

mod family;
mod ports;
mod words;
mod states;
mod narrow;
mod graph;
mod arithmetic;
mod comparison;
mod sat;
mod builder;
mod operators;
mod registers;
mod blocks;
mod distributed;
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
mod gates;
mod gates_measured;
mod gates_fit;

pub use delay::{Delays, Path};
pub use device::{Fits, fits};
pub use fit::{Errors, Estimate, Figure, Fit};
pub use gates::GateCounts;
pub use gates_fit::{GatesEstimate, GatesFit};
pub use gates_measured::MeasuredUnit;
pub use kept::Kept;
pub use measured::{Measured, Sample};
pub use structure::{Structure, UnitTables};
