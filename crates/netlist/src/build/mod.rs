//! The builder: from a program that reads like a block diagram to a checked netlist.

mod module;
mod operand;
mod signal;
mod storage;
mod structure;

mod check;
mod paths;

pub use module::Module;
pub use operand::Operand;
pub use signal::Signal;
pub use storage::{Memory, Reg};
pub use structure::{Instance, Wire};
