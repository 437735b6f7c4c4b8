//! What the machine costs on an FPGA: cells, clock and critical path, from Yosys and nextpnr.
//!
//! ```text
//!  part (netlist of rtl) ─> harness ─> Verilog ─> yosys ─┬─> cells, by unit too
//!                                                        └─> nextpnr ─> packed cells, then seed by seed clock and critical path
//! ```
//! Every run of a tool is a step, and its results are kept in a [`Cache`]. A number that a tool did not give is absent,
//! with the reason beside it.

mod part;
mod harness;
mod design;
mod target;
mod memories;
mod cells;
mod packed;
mod names;
mod timing;
mod cache;
mod flow;
mod report;
mod standard_cells;

pub use cache::Cache;
pub use cells::Cells;
pub use design::Design;
pub use flow::Flow;
pub use memories::{Block, Blocks, Memory};
pub use packed::Packed;
pub use part::{Part, UnknownPart};
pub use report::{Mhz, Outcome, Seed, UnitCells};
pub use standard_cells::{
    Activity, Gates, LIBRARY, Library, Placeless, Power, UnitArea, UnitPower, gates, power,
};
pub use target::{TARGETS, Target};
pub use timing::{CriticalPath, Point};
