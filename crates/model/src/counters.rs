//! What every cycle was spent on, and what passed through the units.

use crate::setup::SetupClocks;
use crate::waits::PageCounts;
use crate::word_memory::MEMORIES;
use edgewalk_machine::Activity;

/// Counts what may happen in every cycle: nobody waits for 2^64, so nothing is checked.
#[inline]
pub(crate) fn one_more(counter: &mut u64) {
    *counter = counter.wrapping_add(1);
}

/// Performance counters of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Clock cycles.
    pub cycles: u64,
    /// Cycles by cause, indexed by [`Activity`].
    pub activity: [u64; Activity::ALL.len()],
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
    /// S1 and S2, clocks of SETUP's lanes, of all triangles taken in.
    pub setup_clocks: [u64; 2],
    /// Spans in SPAN's FIFO, summed over the cycles.
    pub queued_spans: u64,
    /// Fragments between their read and their compare, summed over the cycles.
    pub inflight: u64,
    /// Writes that store a depth.
    pub depth_writes: u64,
    /// With BLEND: reads of the colour memory.
    pub color_reads: u64,
    /// Reads of the memories that the host alone writes, in the order of
    /// [`Plan::word_memories`](edgewalk_machine::Plan::word_memories).
    pub word_reads: [u64; MEMORIES],
    /// What the pages of dynamic memories did: depth, colour, then the memories that the host alone writes. A run with its memories
    /// has them, a [`Model`](crate::Model) by itself does not.
    pub pages: [PageCounts; PACED],
}

/// Memories that may make the machine wait.
pub const PACED: usize = 2 + MEMORIES;

impl Counters {
    /// A cycle went by.
    #[inline]
    pub(crate) fn cycle(&mut self, activity: Activity) {
        one_more(&mut self.cycles);
        one_more(&mut self.activity[activity as usize]);
    }

    /// SETUP takes so long over a triangle.
    pub(crate) fn lanes_work(&mut self, setup: SetupClocks) {
        let [edges, channels] = &mut self.setup_clocks;
        *edges += u64::from(setup.phase1);
        *channels += u64::from(setup.phase2);
    }

    /// So many spans and fragments are held over a cycle.
    #[inline]
    pub(crate) fn hold(&mut self, spans: usize, fragments: usize) {
        self.queued_spans = self.queued_spans.wrapping_add(spans as u64);
        self.inflight = self.inflight.wrapping_add(fragments as u64);
    }

    /// Adds the counters of a later part of the run.
    #[must_use]
    pub fn and(&self, after: &Counters) -> Counters {
        Counters {
            cycles: self.cycles + after.cycles,
            activity: std::array::from_fn(|i| self.activity[i] + after.activity[i]),
            triangles: self.triangles + after.triangles,
            lines: self.lines + after.lines,
            spans: self.spans + after.spans,
            fragments: self.fragments + after.fragments,
            writes: self.writes + after.writes,
            setup_clocks: std::array::from_fn(|i| self.setup_clocks[i] + after.setup_clocks[i]),
            queued_spans: self.queued_spans + after.queued_spans,
            inflight: self.inflight + after.inflight,
            depth_writes: self.depth_writes + after.depth_writes,
            color_reads: self.color_reads + after.color_reads,
            word_reads: std::array::from_fn(|i| self.word_reads[i] + after.word_reads[i]),
            pages: std::array::from_fn(|i| self.pages[i].and(after.pages[i])),
        }
    }

    /// What came after these.
    #[must_use]
    pub fn since(&self, before: &Counters) -> Counters {
        Counters {
            cycles: self.cycles - before.cycles,
            activity: std::array::from_fn(|i| self.activity[i] - before.activity[i]),
            triangles: self.triangles - before.triangles,
            lines: self.lines - before.lines,
            spans: self.spans - before.spans,
            fragments: self.fragments - before.fragments,
            writes: self.writes - before.writes,
            setup_clocks: std::array::from_fn(|i| self.setup_clocks[i] - before.setup_clocks[i]),
            queued_spans: self.queued_spans - before.queued_spans,
            inflight: self.inflight - before.inflight,
            depth_writes: self.depth_writes - before.depth_writes,
            color_reads: self.color_reads - before.color_reads,
            word_reads: std::array::from_fn(|i| self.word_reads[i] - before.word_reads[i]),
            pages: std::array::from_fn(|i| self.pages[i].since(before.pages[i])),
        }
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
