//! The machine as netlists, a unit a file, written from `docs/machine.md`.
//!
//! ```text
//!  tri ─> setup ─> edge ─> span ─> pixel ─> depth ─> memory
//! ```
//! A function a unit takes a checked [`Machine`](edgewalk_machine::Machine) and builds the unit's netlist; [`machine`] joins them.
//! What it does not know: the model, files, Verilog text.

mod token;

mod setup;

mod edge;
mod fifo;
mod span;

mod pixel;

mod depth;

mod memory;

mod machine;

pub use depth::depth;
pub use edge::edge;
pub use machine::machine;
pub use memory::memory;
pub use pixel::pixel;
pub use setup::setup;
pub use span::span;
