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
//!
//! ```
//! use edgewalk_machine::Machine;
//! use edgewalk_model::{DrawState, Stalls, render};
//! let plan = Machine { width: 16, height: 12, ..Machine::default() }.plan()?;
//! // Columns, lines; depth, red, green, blue from 0 to 1.
//! let corner = |x, y, red| plan.port_vertex(x, y, &[0.5, red, 0.0, 0.0]);
//! let triangle = [corner(3.0, 1.5, 1.0)?, corner(13.25, 4.75, 0.0)?, corner(5.5, 10.0, 0.5)?];
//! let frame = render(&plan, [triangle], DrawState::default(), Stalls::NONE)?;
//! assert_eq!(frame.coverage.iter().sum::<u32>(), 39);
//! assert_eq!(frame.counters.cycles, 130);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: [`fast`] gives the same pictures and counts without ticking; crate `lockstep` runs the netlist beside the model;
//! crate `replay` records what each unit holds.

// What moves: tokens with their names, and what is beside them.
pub mod named;
pub mod tokens;
pub mod lit;
// Parts of units.
pub mod fifo;
mod fetch;
mod stages;
mod rmw;
// What a recording sees.
pub mod view;
// The memories of units, and when they make the machine wait.
mod waits;
mod served;
mod service;
pub mod word_memory;
// The units, each by its ports.
pub mod ports;
pub mod setup;
pub mod counters;
pub mod edge;
pub mod poly;
pub mod span;
pub mod term;
pub mod pixel;
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
pub mod alone;
// The machine.
pub mod io;
pub mod stage;
pub mod walker;
pub mod wires;
pub mod machine;
// The machine with its memories.
mod prefetch;
pub mod memory;
pub mod color_memory;
pub mod memories;
pub mod run;
pub mod frame;
pub mod profile;
pub mod fast;

pub use blend::BlendInputs;
pub use color_memory::ColorMemory;
pub use counters::{Counters, PACED};
pub use edgewalk_machine::{Activity, DrawState, Events, Pass, Shading, first_of_picture};
pub use frame::{Drawn, Frame, Sample, render, render_passes, render_passes_with, render_with};
pub use io::{Cycle, Inputs, Outputs};
pub use lit::{Cosines, Given, Lit};
pub use machine::Model;
pub use memories::Memories;
pub use memory::Memory;
pub use prefetch::prefetch;
pub use run::{Rig, tick};
pub use service::clocks_alone;
pub use setup::{Culled, SetupClocks, cull, longest_setup, setup_clocks};
pub use shadow::ShadowInputs;
pub use tokens::Write;
pub use view::View;
pub use waits::{Dram, Fixed, KINDS as WAITS, PageCounts, Stalls, Waits, WaitsError};
pub use word_memory::{Ask, MEMORIES, WordIn, WordMemory};
