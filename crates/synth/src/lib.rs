//! What the machine costs on an FPGA: cells, clock and critical path, from Yosys and nextpnr.
//!
//! ```text
//!  part (netlist of rtl) ─> harness ─> Verilog ─> yosys ─┬─> cells, by unit too
//!                                                        └─> nextpnr ─> packed cells, then seed by seed clock and critical path
//! ```
//! Every run of a tool is a step, and its results are kept in a [`Cache`]. A number that a tool did not give is absent,
//! with the reason beside it.
//!
//! ```
//! use edgewalk_machine::Plan;
//! use edgewalk_synth::{Part, TARGETS, Target};
//! let part = Part::named("span", &Plan::default())?;
//! assert_eq!(part.name(), "span");
//! let target = Target::named("ice40-hx8k")?;
//! assert_eq!(target.tools(), ["yosys", "nextpnr-ice40"]);
//! assert!(TARGETS.len() > 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: [`Flow`] runs the tools; `docs/synthesis.md` has what they found.

mod part;
mod harness;
mod design;
mod fpga;
mod target;
mod memories;
mod cells;
mod packed;
mod names;
mod timing;
mod cache;
mod flow;
mod report;
pub mod estimate;
mod standard_cells;

pub use cache::Cache;
pub use cells::Cells;
pub use design::Design;
pub use flow::Flow;
pub use fpga::Fpga;
pub use memories::{Block, Blocks, Memory, memories};
pub use packed::Packed;
pub use part::{Part, UnknownPart};
pub use report::{Mhz, Outcome, Seed, UnitCells};
pub use standard_cells::{
    GateRun, Gates, Library, LibraryError, Placeless, Power, UNSETTLED, UnitArea, UnitPower, gates, power,
};
pub use target::{TARGETS, Target};
pub use timing::{CriticalPath, Point};
