//! Readable Verilog-2001 from a netlist, for a person first and for Icarus, Verilator and Yosys as well.
//!
//! One file a module. Names, docs and section comments survive; an operator without a name is written inside the
//! expression that uses it, unless it is used twice, is long, or Verilog wants a name for it (a slice of a sum).
//!
//! Verilog widens what stands inside an expression to the width of its surroundings, and turns it unsigned if anything
//! beside it is. Two rules keep every bit as [`edgewalk_netlist::ops`] says:
//!
//! 1. Every expression stands where exactly its own width is wanted, or where Verilog lets it decide for itself (inside
//!    braces, as a condition, a shift distance, a function's argument). Extensions are therefore written out: `{4'd0, a}`.
//! 2. A signed operation beside unsigned ones is enclosed: `$unsigned($signed(a) >>> 3)`.
//!
//! The text passes `verilator -Wall` without waivers: what is not used on purpose ends in a wire `unused`.
//!
//! ```
//! use edgewalk_netlist::Module;
//! let m = Module::new("counter", "Counts clocks.");
//! let count = m.reg("count", 8).reset(0);
//! count.set(count.q() + 1);
//! m.output("q", count.q());
//! let files = edgewalk_verilog::print(&m.finish()?);
//! assert_eq!(files[0].0, "counter.v");
//! assert!(files[0].1.contains("count <= "));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: crate `rtl` builds the machine's netlists; `edgewalk emit` writes their text, which stands in `hdl/`.

mod expression;
mod groups;
mod interface;
mod literal;
mod memory;
mod module;
mod operator;
mod paragraph;
mod registers;
mod simplify;
mod symbols;
mod text;
mod usage;

use std::sync::Arc;

use edgewalk_netlist::Netlist;

/// The file name and the text of every module in the hierarchy, those used by others first.
pub fn print(netlist: &Arc<Netlist>) -> Vec<(String, String)> {
    netlist.modules().iter().map(|module| (format!("{}.v", module.name), module::print(module))).collect()
}
