//! A netlist compiled to native code by Cranelift: the same values as [`edgewalk_netlist::Simulator`], faster.

mod graph;
mod simplify;

mod design;
mod elaborate;

mod groups;
mod guard;
mod order;
mod schedule;

mod layout;
mod lower;

mod code;
mod state;

mod error;
mod simulator;

pub use error::JitError;
pub use simulator::{InputId, OutputId, SignalId, Simulator};
