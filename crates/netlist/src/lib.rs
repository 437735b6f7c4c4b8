//! Hardware as data: registers, operators, memories and instances.
//!
//! A [`Module`] is written like its block diagram, then checked and frozen by [`Module::finish`] into a [`Netlist`].
//!
//! ```
//! use edgewalk_netlist::{Module, Simulator};
//! let m = Module::new("dda", "A value that steps by a slope.");
//! let (load, step) = (m.input("load", 1), m.input("step", 1));
//! let init = m.input_doc("init", 22, "Q8.14 LSB");
//! let slope_in = m.input_doc("slope_in", 22, "Q8.14 LSB/px");
//! let slope = m.reg("slope", 22).doc("Q8.14 LSB/px");
//! slope.when(load, slope_in);
//! let value = m.reg("value", 22).reset(0);
//! value.when(load | step, load.mux(init, value.q() + slope.q()));
//! m.output("q", value.q());
//! let dda = m.finish()?;
//!
//! let mut sim = Simulator::new(&dda);
//! sim.set_input("init", 100)?;
//! sim.set_input("slope_in", 7)?;
//! for (load, step) in [(1, 0), (0, 1), (0, 1)] {
//!     sim.set_input("load", load)?;
//!     sim.set_input("step", step)?;
//!     sim.tick();
//! }
//! assert_eq!(sim.get("q")?, 114);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What it does not know: triangles, files, Verilog text. One clock `clk` and one synchronous reset `rst` reach every
//! module unseen; there are no latches, no other clocks, no tri-states, no asynchronous memory reads.
//!
//! The meaning of every operator is the table in [`ops`].
//!
//! Next: crate `verilog` prints a netlist, crate `jit` compiles it, crate `rtl` builds the machine's.

mod build;
mod describe;
mod error;
pub mod mutate;
mod names;
pub mod netlist;
pub mod ops;
mod simulate;
mod trace;

pub use build::{Instance, Memory, Module, Operand, Reg, Signal, Wire};
pub use error::{BuildError, BuildErrors, Fault, Place};
pub use netlist::{Netlist, NodeId};
pub use ops::Op;
pub use simulate::{InputId, SignalId, SimError, Simulate, Simulator};
pub use trace::{BitBlocks, FstTrace, Labels, Transitions, UnitTransitions, VcdTrace};
