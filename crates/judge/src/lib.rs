//! How right a machine's picture is: every pixel beside golden's, within the proved bounds, and where the cycles went.
//!
//! ```text
//!  golden ──┬─> compare ─┐
//!  machine ─┤            ├─> report, verdict
//!           └─> cycles ──┘
//! ```
//! What one machine makes of a frame is a [`report::Report`]; `edgewalk render` prints it.
//!
//! ```
//! use edgewalk_host::draw;
//! use edgewalk_judge::compare::compare;
//! use edgewalk_machine::Machine;
//! use edgewalk_model::Waits;
//! use edgewalk_scene::triangle_file;
//! let text = "size 16 12\nT 3 1.5 .25 1 0 0 0  13 4.75 .5 0 1 0 0  5.5 10 .5 0 0 1 0\n";
//! let frame = triangle_file::parse("stdin", text.as_bytes())?;
//! let plan = Machine { width: 16, height: 12, ..Machine::default() }.plan()?;
//! let (golden, drawn) = (draw::golden(&frame, &plan), draw::fast(&frame, &plan, Waits::Never)?);
//! let found = compare(&plan, &frame, &golden, &drawn);
//! assert_eq!(found.counts.coverage_mismatches, 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: [`outside`] judges the picture of another rasterizer (`docs/judge.md`); the bounds are those of crate `numerics`.

pub mod verdict;
pub mod shaded;
pub mod compare;
pub mod beside;
pub mod outside;
pub mod passes;
pub mod setup_report;
pub mod occupancy;
pub mod report;

pub use verdict::Verdict;
