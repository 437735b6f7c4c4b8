//! The interpreter: the meaning of a netlist, cycle by cycle.

mod flatten;
mod simulator;

pub use simulator::{InputId, SignalId, SimError, Simulator};
