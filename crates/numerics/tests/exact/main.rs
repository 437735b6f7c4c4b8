//! The numbers of the crate against exact rationals and against crate `fixed`.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod rational;
mod triangle;
mod classical;

mod formats;
mod intervals;
mod bounds;
mod sharp;
mod second_order;
mod term;
mod normal_cone;
mod triangles;
mod solver;
