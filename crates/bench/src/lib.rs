//! Frames and cycles a second of every engine on the same triangles.
//!
//! ```text
//!  triangles ─> job ─> part for the engine ─> frame by frame (fast, tick, jit, interpreter, verilator) ─> table
//! ```

mod stopwatch;
mod job;
mod fast;
mod tick;
#[cfg(feature = "jit")]
mod jit;
mod interpreter;
mod ports;
mod verilator;
mod engine;
mod table;

pub use engine::Engine;
pub use job::{Job, Times, Work};
pub use stopwatch::Time;
pub use table::{Row, Table};
