//! What every cycle was spent on, and what passed through the units.

use crate::coverage::one_more;

/// The cause of a cycle (`docs/machine.md`, section 8); the number is the `activity` port.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Activity {
    /// Nothing to do.
    #[default]
    Idle,
    /// A pixel on the screen.
    Draw,
    /// A pixel stepped over off the screen.
    Offscreen,
    /// DEPTH waits for a pixel in flight.
    Hazard,
    /// The in-flight queue is full.
    Queue,
    /// The depth memory takes no read.
    Memory,
    /// PIXEL waits for a span.
    Edge,
    /// All wait for SETUP.
    Setup,
    /// The last fragments leave the pipeline.
    Flush,
}

impl Activity {
    /// All, in the order of the port's code.
    pub const ALL: [Activity; 9] = [
        Activity::Idle,
        Activity::Draw,
        Activity::Offscreen,
        Activity::Hazard,
        Activity::Queue,
        Activity::Memory,
        Activity::Edge,
        Activity::Setup,
        Activity::Flush,
    ];

    /// Name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["idle", "draw", "offscreen", "hazard", "queue", "memory", "edge", "setup", "flush"][self as usize]
    }
}

/// Performance counters of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Clock cycles.
    pub cycles: u64,
    /// Cycles by cause, indexed by [`Activity`].
    pub activity: [u64; 9],
    /// Triangles taken in.
    pub triangles: u64,
    /// Lines that left EDGE.
    pub lines: u64,
    /// Spans that entered PIXEL.
    pub spans: u64,
    /// Fragments whose depth was read.
    pub fragments: u64,
    /// Writes to the frame memory.
    pub writes: u64,
}

impl Counters {
    /// A cycle went by.
    #[inline]
    pub(crate) fn cycle(&mut self, activity: Activity) {
        one_more(&mut self.cycles);
        one_more(&mut self.activity[activity as usize]);
    }

    /// Cycles spent on this.
    #[must_use]
    pub fn spent(&self, activity: Activity) -> u64 {
        self.activity[activity as usize]
    }

    /// Cycles in which PIXEL stepped: DRAW and OFFSCREEN.
    #[must_use]
    pub fn busy(&self) -> u64 {
        self.spent(Activity::Draw) + self.spent(Activity::Offscreen)
    }

    /// Cycles in which it did not, for whatever cause.
    #[must_use]
    pub fn stalls(&self) -> u64 {
        self.activity.iter().sum::<u64>() - self.busy()
    }

    /// Every cycle has one cause: busy + stalls = cycles.
    #[must_use]
    pub fn add_up(&self) -> bool {
        self.busy() + self.stalls() == self.cycles
    }
}
