//! A recording of the machine at work, and the page that shows it.
//!
//! ```text
//!  triangles ─> model, cycle by cycle ─> Recording ─┬─ JSON, `docs/replay.md`
//!                                                   └─ one HTML file: page, structure, recording
//! ```
//! The recording says what there is to be seen, as the model's units declare it; the page draws what it is told and knows
//! no machine. No I/O.
//!
//! ```
//! use edgewalk_machine::Machine;
//! use edgewalk_model::{DrawState, Stalls};
//! use edgewalk_replay::{Window, record};
//! let plan = Machine { width: 16, height: 12, ..Machine::default() }.plan()?;
//! let corner = |x, y, red| plan.port_vertex(x, y, &[0.5, red, 0.0, 0.0]);
//! let triangle = [corner(3.0, 1.5, 1.0)?, corner(13.25, 4.75, 0.0)?, corner(5.5, 10.0, 0.5)?];
//! let recording = record(&plan, &[triangle], DrawState::default(), Stalls::NONE, Window::default())?;
//! assert_eq!(recording.cycles, 130);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: `docs/tour.md` is drawn from recordings; `docs/replay.md` is the file format.

pub mod recording;
pub mod record;
pub mod lesson;
pub mod encode;
pub mod file;
pub mod page;

pub use file::{Difference, Replay, Truth};
pub use lesson::{Lesson, lesson};
pub use record::{LIMIT, RecordError, Rules, Window, record, record_passes};
pub use recording::{Column, Plane, Recorder, Recording};
