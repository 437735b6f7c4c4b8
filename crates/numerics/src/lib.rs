//! Formats, words, rounding, proved bounds, and the one description of a machine.
//!
//! No I/O, no triangles drawn: this crate only says which numbers there are. `model` and `rtl` share nothing else.

pub mod rounding;
pub mod dyadic;
pub mod interval;
pub mod format;
pub mod word;
pub mod steps;
pub mod bounds;
pub mod normal_cone;
pub mod witness;
pub mod solver;
pub mod machine;
pub mod budget;
pub mod vertex;

pub use bounds::Prestep;
pub use budget::{ErrorBudget, NoBound};
pub use dyadic::Dyadic;
pub use format::{Format, FormatError};
pub use interval::Interval;
pub use machine::{Channel, EdgeKind, Fill, Hazard, Machine, MachineError, Widths};
pub use rounding::{Rounding, UnknownRounding};
pub use solver::{Solution, SolverError};
pub use steps::{Screen, Steps};
pub use vertex::{PortVertex, VertexError};
pub use witness::{ChannelBits, Target, Witness};
pub use word::{Word, WordError};
