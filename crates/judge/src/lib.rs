//! How right a machine's picture is: every pixel beside golden's, within the proved bounds, and where the cycles went.
//!
//! ```text
//!  golden ──┬─> compare ─┐
//!  machine ─┤            ├─> report, verdict
//!           └─> cycles ──┘
//! ```
//! What one machine makes of a frame is a [`report::Report`]; `edgewalk render` prints it.

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
