//! Formats, words, rounding, proved bounds, and the one description of a machine.
//!
//! No I/O, no triangles drawn: this crate only says which numbers there are. `model` and `rtl` share nothing else.

pub mod machine;
pub mod vertex;

pub use machine::{Channel, EdgeKind, Fill, Hazard, Machine, MachineError, Widths};
pub use vertex::{PortVertex, VertexError};
