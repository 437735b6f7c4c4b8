//! A frame on machines: what each makes of it, how right that is, where its cycles go, and how machines compare.
//!
//! ```text
//!  scene | mesh | triangle file ─> input ─> port ─> draw ─┬─> compare ─┐
//!                                                         └─> cycles ──┴─> report
//! ```
//! What one machine makes of a frame is a [`report::Report`]; `edgewalk render` prints it.

pub mod verdict;
pub mod extra;
pub mod input;
pub mod light;
pub mod port;
pub mod shade;
pub mod raster;
pub mod reach;
pub mod draw;
pub mod compare;
pub mod lights;
pub mod size;
pub mod setup_report;
pub mod occupancy;
pub mod report;
pub mod sweep;
pub mod page;

pub use verdict::Verdict;
