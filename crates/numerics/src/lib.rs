//! Formats, rounding, proved bounds, and the word-length solver.
//!
//! No I/O, no machine, no triangles: this crate only says which numbers there are.

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
