//! A frame looked at cycle by cycle: where the cycles went on the screen and by size of triangle, what datapath and memory would
//! take alone, and the range of every number.
//!
//! ```text
//!  always ready ─> a run ─> cycles of the datapath, window by window ─┐
//!  waits ────────> a run ─> causes; clocks of the memories ───────────┴─> Profile
//!  waits ────────> a run ─> every register, least and greatest ─────────> ranges
//! ```
//! The lights' own passes are drawn and not looked at. Of use to people alone: no unit keeps anything for it.

mod watch;
mod causes;
mod ranges;
mod roofline;

pub use causes::{Causes, SIZES, Spent};
pub use ranges::{Range, ranges};
pub use roofline::{PortClocks, Roofline, Window};
pub use watch::Sent;

use crate::tokens::for_channels;
use crate::waits::Waits;
use causes::Tracker;
use edgewalk_machine::{ForeignVertex, Plan};
use roofline::Windows;
use watch::run;

/// What was seen.
#[derive(Clone, Debug)]
pub struct Profile {
    /// Cycles by cause over the screen and by size of triangle.
    pub causes: Causes,
    /// Datapath and memories, each alone.
    pub roofline: Roofline,
}

/// Draws the frame with these waits, and with a memory that is always ready.
///
/// # Errors
/// A triangle whose vertices were made for another machine.
pub fn profile(plan: &Plan, sent: &Sent, waits: Waits) -> Result<Profile, ForeignVertex> {
    for_channels!(plan, C => {
        let mut free = Windows::new(plan, Waits::Never);
        run::<C>(plan, sent, Waits::Never, |_, _| (), |model, cycle| free.see(model, cycle))?;
        let (mut windows, mut causes) = (Windows::new(plan, waits), Tracker::new(plan));
        run::<C>(plan, sent, waits, |_, _| (), |model, cycle| {
            windows.see(model, cycle);
            causes.see(model, cycle);
        })?;
        let roofline = windows.roofline(plan, free);
        Ok(Profile { causes: causes.finish(), roofline })
    })
}
