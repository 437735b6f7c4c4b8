//! Stimuli, expected results, manifests and test benches.
//!
//! ```text
//!  suites ─> capture (the model under the rig of lockstep) ─> write ─> directory ─> simulate (Icarus, Verilator)
//! ```
//! A check that compared nothing has failed: whatever compares here says how much it compared. Only [`simulate()`],
//! [`prove`](prove::prove) and [`dut`] do I/O; directories are made and read in memory.
//!
//! ```
//! use edgewalk_machine::{DrawState, Machine};
//! use edgewalk_vectors::{StallKind, Suite, Unit, capture};
//! let plan = Machine { width: 32, height: 24, ..Machine::default() }.plan()?;
//! let suite = Suite::named(&plan, "corners", 1, 10)?;
//! let trace = capture(&plan, Unit::MACHINE, &suite, DrawState::default(), StallKind::None);
//! assert!(trace.expected() > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: `docs/tutorial/your_rtl.md` takes such vectors to a design of one's own; [`directory`] makes the files.

pub mod suites;
pub mod capture;
pub mod live;
pub mod reach;
pub mod design;
pub mod dut;
pub mod seen;
pub mod manifest;
pub mod write;
pub mod read;
pub mod simulate;
pub mod prove;

pub use capture::{LinkTrace, Runs, Trace, capture, capture_tokens, capture_watched};
pub use edgewalk_lockstep::{Difference, Interface, LockstepError, StallKind, Unit};
pub use live::Live;
pub use manifest::Manifest;
pub use reach::{Reached, not_covered, reached};
pub use read::{ReadError, Vectors, read};
pub use seen::{Sight, sights};
pub use simulate::{Outcome, SimulateError, Simulator, Stop, lint, simulate, synth_ice40};
pub use suites::{Case, MAX_COUNT, SUITES, Suite, Words, words};
pub use write::{Files, Tables, directory, directory_for};
