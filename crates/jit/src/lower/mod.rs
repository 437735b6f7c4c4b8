//! Graph and plan to Cranelift's intermediate form.

mod copies;
mod lowered;
mod memory;
mod operators;
mod program;
mod range;
mod registers;
mod values;
mod waking;

pub(crate) use program::{Plan, Program, is_computed, lower};
pub(crate) use values::ODD;
