//! A recording of the machine at work, and the page that shows it.
//!
//! ```text
//!  triangles ─> model, cycle by cycle ─> Recording ─┬─ JSON, `docs/replay.md`
//!                                                   └─ one HTML file: page, structure, recording
//! ```
//! The recording says what there is to be seen, as the model's units declare it; the page draws what it is told and knows
//! no machine. No I/O.

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
