//! Frames and cycles a second of every engine on the same triangles.
//!
//! ```text
//!  triangles ─> job ─> part for the engine ─> frame by frame (fast, tick, jit, interpreter, verilator) ─> table
//! ```
//!
//! ```
//! use edgewalk_bench::Engine;
//! assert_eq!(Engine::Fast.name(), "fast");
//! assert!(Engine::Interpreter.budget() < Engine::Tick.budget(), "cycles that an engine is given");
//! ```
//! Next: [`Job`] holds what is timed, [`Table`] the result; `docs/performance.md` explains the figures.

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
