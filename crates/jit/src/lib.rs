//! A netlist compiled to native code by Cranelift: the same values as [`edgewalk_netlist::Simulator`],
//! faster.
//!
//! ```text
//!  netlist ─> elaborate ─> merge_registers ─> free_running ─> design: a graph of values ─> groups ─> schedule: branches ─> order ─┐
//!                                                                          skip_idle_units: which unit is woken by what <────────┤
//!                          code <─ lower <─ layout <─ tables: what is looked up, shared: what is kept <──────────────────────────┘
//! ```
//! A value is computed where something needs it, most often once in a clock. Registers and read ports that
//! change under the same conditions form a group with one branch; groups that need the same condition share a
//! branch around them. A value that only one group needs is computed in its branch. Registers change in
//! place, in an order in which most are read before they change. Registers that are equal in every clock are
//! one register.
//!
//! A unit in which nothing can change is left out as a whole. Registers that would keep a unit awake, or that
//! rest while it works, get a unit of their own. A value that follows from one narrow value is looked up in a
//! table. A register that a number names is read where it lies. Values that several steps need are kept in
//! the state between them, as the processor has few registers.
//!
//! Widths are those of the netlist, 1 to 128 bits: a bit is 8 bits of the processor, up to 64 are one word,
//! more are two.
//!
//! ```
//! use edgewalk_netlist::Module;
//! let m = Module::new("counter", "Counts the clocks in which step is high.");
//! let step = m.input("step", 1);
//! let count = m.reg("count", 8).reset(0);
//! count.when(step, count.q() + 1);
//! m.output("q", count.q());
//! let counter = m.finish()?;
//! let mut simulator = edgewalk_jit::Simulator::new(&counter)?;
//! simulator.set_input("step", 1)?;
//! (0..5).for_each(|_| simulator.tick());
//! assert_eq!(simulator.get("q")?, 5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: `docs/performance.md` has the speed beside other simulators; `edgewalk render --engine jit` draws with it.

mod graph;
mod simplify;
mod operators;

mod design;
mod elaborate;
mod merge_registers;

mod groups;
mod guard;
mod step;
mod effect;
mod sorted;
mod order;
mod free_running;
mod schedule;

mod idle_state;
mod wakes;
mod skip_idle_units;

mod sign_extended;
mod arrays;
mod tables;
mod sink;
mod shared;
mod layout;
mod places;
mod lower;

mod code;
mod state;

mod error;
mod simulator;

pub use code::Cost;
pub use error::JitError;
pub use simulator::{InputId, OutputId, SignalId, Simulator};
