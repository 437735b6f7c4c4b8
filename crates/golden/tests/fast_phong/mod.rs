//! Fast Phong: its quadratics under bound 10, their convergence, the walk by additions, and the table.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cases;

mod bound;
mod convergence;
mod walk;
mod table;
mod picture;
