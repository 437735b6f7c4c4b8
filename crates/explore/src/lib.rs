//! Machines beside one another: which word lengths a frame needs, and what each machine of a sweep costs.
//!
//! ```text
//!  frame, machine ─> size ──────────────────────────> word lengths, and a triangle that breaks one bit fewer
//!  inputs, axes ───> sweep ─> rows ─> table, fronts ─> page
//! ```
//!
//! ```
//! use edgewalk_explore::size::size;
//! use edgewalk_host::port::to_port;
//! use edgewalk_machine::Machine;
//! use edgewalk_scene::triangle_file;
//! let text = "size 16 12\nT 3 1.5 .25 1 0 0 0  13 4.75 .5 0 1 0 0  5.5 10 .5 0 0 1 0\n";
//! let frame = triangle_file::parse("stdin", text.as_bytes())?;
//! let machine = Machine { width: 16, height: 12, ..Machine::default() }.plan()?;
//! let port = to_port(&frame, &machine)?;
//! let found = size(&machine, &frame, &port, 1.0)?;
//! assert_eq!(found.guard_bits.needed, 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: [`sweep`] runs many machines; `docs/exploration.md` shows both at work.

pub mod size;
pub mod sweep;
pub mod page;
