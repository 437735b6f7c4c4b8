//! Graph and plan to Cranelift's intermediate form.

mod memory;
mod operators;
mod program;
mod values;

pub(crate) use program::{Program, is_computed, lower};
