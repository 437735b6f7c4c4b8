//! The machine as netlists, a unit a file, written from `docs/machine.md`.
//!
//! ```text
//!  tri ─> setup ─> edge or poly ─> span ─> [term] ─> pixel ─> [texel] ─> [bump] ─> [normal or lamp] ─> [shade] ─> [project] ─> [shadow] ─> depth ─> memory
//!                                                                                                                                  └──> blend ─> memory
//! ```
//! A function a unit takes a [`Plan`](edgewalk_machine::Plan), the checked machine, and builds the unit's netlist with the ports
//! that [`edgewalk_machine::UNITS`] declares; [`BUILDERS`] lists the functions, [`machine`] joins what they build.
//! What it does not know: the model, files, Verilog text.
//!
//! ```
//! use edgewalk_machine::Plan;
//! let plan = Plan::default();
//! let span = edgewalk_rtl::span(&plan)?;
//! assert_eq!(span.name, "edgewalk_span");
//! assert!(edgewalk_rtl::machine(&plan).is_ok());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: crate `verilog` prints a netlist; crate `lockstep` runs it beside the model; `docs/adding_a_unit.md` adds a unit.

mod wires;
mod ports;
mod light_pass;

mod setup;

mod stepping;
mod edge;
mod poly;
mod fifo;
mod span;

mod term;

mod pixel;

mod share;

mod texel;

mod cut;

mod bump;

mod roots;
mod place;
mod normal;

mod lamp;

mod shade;

mod project;

mod rmw;

mod shadow;

mod dither;

mod depth;

mod blend;

mod memory;

pub mod units;

mod machine;

pub use blend::blend;
pub use bump::bump;
pub use depth::depth;
pub use dither::dither;
pub use edge::edge;
pub use lamp::lamp;
pub use machine::{assemble, engine, join, machine};
pub use memory::memory;
pub use normal::normal;
pub use pixel::pixel;
pub use poly::poly;
pub use project::project;
pub use setup::{RomWord, program_rom, setup};
pub use shade::shade;
pub use shadow::shadow;
pub use span::span;
pub use term::term;
pub use texel::texel;

/// The name of each unit of [`edgewalk_machine::UNITS`], and what builds it.
pub const BUILDERS: &[(&str, units::Build)] = &[
    ("setup", setup),
    ("edge", edge),
    ("poly", poly),
    ("span", span),
    ("term", term),
    ("pixel", pixel),
    ("texel", texel),
    ("bump", bump),
    ("normal", normal),
    ("lamp", lamp),
    ("shade", shade),
    ("project", project),
    ("shadow", shadow),
    ("dither", dither),
    ("depth", depth),
    ("blend", blend),
];
