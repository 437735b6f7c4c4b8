//! Stimuli, expected results, manifests and test benches.
//!
//! ```text
//!  suites ─> capture (the model under a bench) ─> write ─> directory ─> simulate (Icarus, Verilator)
//!                        │
//!                        └─> lockstep: model against netlist, every port, every cycle
//! ```
//! A check that compared nothing has failed: whatever compares here says how much it compared. Only [`simulate`] does
//! I/O; directories are made and read in memory.

pub mod suites;
pub mod ports;
pub mod stalls;
pub mod bench;
pub mod status;
pub mod design;
pub mod device;
pub mod capture;
pub mod lockstep;
pub mod drive;
pub mod manifest;
pub mod write;
pub mod read;
pub mod simulate;

pub use capture::{Trace, capture, capture_tokens};
pub use device::Device;
pub use drive::{DriveError, render_rtl, render_rtl_with};
pub use lockstep::{Agreement, Difference, LockstepError, lockstep};
pub use manifest::Manifest;
pub use ports::{Interface, Unit, interface};
pub use read::{ReadError, Vectors, read};
pub use simulate::{Outcome, SimulateError, Simulator, Stop, lint, simulate, synth_ice40};
pub use stalls::StallKind;
pub use status::{StatusPort, status_ports};
pub use suites::{SUITES, Suite, UnknownSuite};
pub use write::{Files, directory};
