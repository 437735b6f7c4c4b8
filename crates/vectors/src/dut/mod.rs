//! A user's own design in place of ours, as `dut.toml` describes it.
//!
//! ```text
//!  dut.toml ─> Dut ──┐
//!  its Verilog ─> Yosys: ports ─┼─> Wiring: what the bench connects to which port ─> tb.v, Makefile, manifest
//!  Interface of the unit ───────┘
//! ```
//! All of it is checked before any simulator starts.

mod error;
mod reader;
mod files;
mod file;
mod ports;
mod wiring;
mod stand_in;

pub use error::DutError;
pub use file::{Channel, Compare, Dut, Reset, Widths};
pub use ports::{Found, PortsError, ports};
pub use stand_in::stand_in;
pub use wiring::{Ends, Packed, Wire, Wiring};
