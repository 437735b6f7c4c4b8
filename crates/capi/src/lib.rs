//! The C library: machines, frames, pictures and ticks behind `edgewalk.h`.
//!
//! ```text
//!  preset | TOML ─> EdgewalkMachine ─> EdgewalkFrame <─ triangles, lines of a triangle file
//!                                            ├─> edgewalk_draw: a picture
//!                                            └─> EdgewalkRun: ticks, with every port of the machine
//! ```
//! `edgewalk.h` is made of these files by cbindgen, and a test holds it against them; `edgewalk_dpi.sv` has the same
//! calls for SystemVerilog. Errors are codes, and no panic crosses the border.
//!
//! # Safety
//! Every call that takes a pointer relies on what the head of `edgewalk.h` asks for. The proofs in this crate name the
//! part that they use: *object*, *text*, *array*.

#![allow(clippy::missing_safety_doc, reason = "what callers promise stands once, in the head of edgewalk.h")]

mod code;
mod pointer;
mod machine;
mod frame;
mod draw;
mod run;
