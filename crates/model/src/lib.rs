//! The machine, cycle by cycle and bit by bit, in plain Rust integers.
//!
//! ```text
//!  tri ─> setup ─> edge ─> span ─> pixel ─> depth ─> memory
//!                 term before pixel; texel, bump, normal or lamp, shade, project and shadow before depth, blend behind it, if the machine has them
//!                                              └─> blend ─> colour memory, if the machine has it
//! ```
//! Written from `docs/machine.md` alone. A unit is a plain state struct: methods give its outputs from the state and
//! from the inputs that reach them within the cycle, `step` is the clock edge. [`Model`] wires the units together,
//! [`Rig`] adds the memory, [`render`] draws. No I/O; nothing
//! here fails on a planned machine but vertices of another.

pub mod counters;
pub mod named;
pub mod ports;
mod rmw;
mod fetch;
mod stages;
pub mod lit;
pub mod texel;
pub mod bump;
pub mod normal;
pub mod lamp;
pub mod shade;
pub mod project;
pub mod shadow;
pub mod dither;
pub mod depth;
pub mod blend;
pub mod edge;
pub mod fifo;
pub mod stage;
pub mod machine;
mod prefetch;
mod waits;
mod served;
pub mod memory;
pub mod word_memory;
pub mod color_memory;
pub mod memories;
pub mod pixel;
pub mod run;
pub mod frame;
pub mod fast;
pub mod setup;
pub mod span;
pub mod term;
pub mod tokens;
pub mod view;

pub use color_memory::ColorMemory;
pub use counters::Counters;
pub use edgewalk_machine::{Activity, DrawState, Events, Pass, Shading, first_of_picture};
pub use frame::{Drawn, Frame, Sample, render, render_passes, render_passes_with, render_with};
pub use lit::{Cosines, Given, Lit};
pub use machine::{BlendInputs, Inputs, Model, Outputs, ShadowInputs};
pub use memories::Memories;
pub use memory::{Memory, Stalls};
pub use prefetch::prefetch;
pub use run::{Cycle, Rig, tick};
pub use setup::{Culled, SetupClocks, cull, longest_setup, setup_clocks};
pub use tokens::Write;
pub use view::View;
pub use waits::{Dram, Fixed, KINDS as WAITS, Waits, WaitsError};
pub use word_memory::{Ask, WordIn, WordMemory};
