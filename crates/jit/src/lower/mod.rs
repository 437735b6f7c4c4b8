//! Graph and plan to Cranelift's intermediate form.

mod memory;
mod operators;
mod program;
mod range;
mod values;
mod waking;

pub(crate) use program::{Plan, Program, is_computed, lower};
