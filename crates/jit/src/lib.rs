//! A netlist compiled to native code by Cranelift: the same values as [`edgewalk_netlist::Simulator`], faster.
//!
//! ```text
//!  netlist ─> elaborate ─> equal ─> apart ─> design: a graph of values ─> groups ─> schedule: branches ─> order ─> lower ─> code
//!                                                                           └─> quiet: who wakes whom ─────────────┤
//!                                                  tables, shared: what is looked up, what is kept ─> layout ──────┘
//! ```
//! A value is computed where something needs it, most often once in a clock: registers and read ports that change under
//! the same conditions form a group with one branch, groups that need the same condition share another around them. What
//! only a group needs is computed in its branch. Registers change in place, in an order in which most are read before;
//! those that are equal in every clock are one.
//! A unit in which nothing can change is left out as a whole; what would keep it awake for nothing, or rests while it works, is a unit too. What follows from a narrow value alone is looked up, a register
//! that such a value names is read where it lies, and what several steps need is kept in the state between them: the processor
//! has few registers.
//!
//! Widths are those of the netlist, 1 to 128 bits: a bit is 8 bits of the processor, up to 64 are one word, more are two.

mod graph;
mod simplify;

mod design;
mod elaborate;
mod equal;
mod apart;

mod groups;
mod guard;
mod step;
mod effect;
mod order;
mod sorted;
mod schedule;

mod signs;
mod arrays;
mod tables;
mod alone;
mod shared;
mod idle;
mod quiet;
mod layout;
mod lower;

mod code;
mod state;

mod error;
mod simulator;

pub use code::Cost;
pub use error::JitError;
pub use simulator::{InputId, OutputId, SignalId, Simulator};
