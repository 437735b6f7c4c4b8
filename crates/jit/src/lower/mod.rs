//! Lowers a graph and its plan to Cranelift's intermediate form.

mod plan;

mod range;
mod lowered;
mod cursor;
mod known;
mod changes;
mod values;
mod registers;
mod operators;
mod demand;
mod wake_counters;

mod program;
mod copies;
mod memory;

pub(crate) use cursor::ODD;
pub(crate) use plan::{Plan, Program};
pub(crate) use program::lower;
