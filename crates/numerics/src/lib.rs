//! Formats, rounding, proved bounds, and the word-length solver.
//!
//! No I/O, no machine, no triangles: this crate only says which numbers there are.
//!
//! ```text
//!  steps, fraction bits, rounding ─> bounds ─> error of an output ─> budget ─> does the machine show the right value?
//!                                    solver <─ error that is allowed ─> fewest fraction bits, a triangle that breaks one fewer
//! ```
//! A colour is stepped over 639 columns and 479 lines in words of 14 fraction bits:
//! ```
//! use edgewalk_numerics::{Dyadic, Format, Rounding, Steps, bounds};
//! let word = Format::unsigned(8, 14)?;
//! assert_eq!(word.to_string(), "UQ8.14");
//! let steps = Steps { lines: 479, columns: 639 };
//! let error = bounds::triangle_error(Rounding::NearestHalfUp, 14, steps).magnitude();
//! assert!(error < Dyadic::new(1, 1).expect("a half"), "less than half a step of the output");
//! # Ok::<(), edgewalk_numerics::FormatError>(())
//! ```
//! Next: the proofs are in `docs/numerics.md`, numbered as in the names here; `edgewalk size` asks the solver for a frame.

pub mod rounding;
pub mod dyadic;
pub mod interval;
pub mod format;
pub mod steps;
pub mod bounds;
pub mod normal_cone;
pub mod blend;
pub mod witness;
pub mod solver;
pub mod term;
pub mod index_table;
pub mod budget;

pub use blend::{blend_error, blend_error_of_golden};
pub use budget::ErrorBudget;
pub use dyadic::Dyadic;
pub use format::{Format, FormatError};
pub use interval::Interval;
pub use rounding::Rounding;
pub use solver::{Solution, SolverError};
pub use steps::{Screen, Steps};
pub use witness::{ChannelBits, Target, Witness};
