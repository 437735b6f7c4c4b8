//! Machines beside one another: which word lengths a frame needs, and what each machine of a sweep costs.
//!
//! ```text
//!  frame, machine ─> size ──────────────────────────> word lengths, and a triangle that breaks one bit fewer
//!  inputs, axes ───> sweep ─> rows ─> table, fronts ─> page
//! ```

pub mod size;
pub mod sweep;
pub mod page;
