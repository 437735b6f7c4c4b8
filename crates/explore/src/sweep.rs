//! Many machines on the same frames, each a row.
//!
//! ```text
//!  definition ─> points ─┬─ same pixels? ─> drawn and compared once ─┐
//!                        └─ timing keys ──> clock, or ticks ─────────┴─> rows ─> store ─> table, bests, fronts, report
//! ```
//! A row is what `edgewalk render --json` says of its machine, with what identifies it.

pub mod axis;
pub mod definition;
pub mod point;
pub mod objective;
pub mod shared;
pub mod row;
pub mod store;
pub mod evaluate;
pub mod front;
pub mod table;

pub use definition::{Definition, Sample};
pub use evaluate::run;
pub use objective::Objective;
pub use point::{Point, Sweep};
pub use store::Store;
