//! Interlock without ticking: does a fragment meet its own address in flight?
//!
//! Between two fences no address comes twice (a triangle, in textbook fill a part, draws a line once). So a fragment can
//! only meet one from before the last fence, read at most L + 1 cycles before: L in the queue, one in w.

use super::walk::Span;
use crate::fifo::Fifo;
use edgewalk_machine::{Hazard, Plan};

/// The fragments of a span, in the order of their reads.
#[derive(Clone, Copy, Debug, Default)]
struct Reads {
    /// Cycle of the first read; D is left out, it is the same for all.
    first: u64,
    /// Place of the first fragment, y·W + x, and from one to the next: 1 or -1.
    place: i64,
    step: i64,
    /// Fragments.
    count: i64,
}

/// The spans that may still be in flight.
#[derive(Clone, Debug)]
pub(super) struct InFlight {
    /// L + 1.
    window: u64,
    /// T: cycles from read to read.
    pixel: u64,
    /// Spans read before the last fence and since. A span takes a cycle, so those of a window are at most 9.
    spans: Fifo<Reads, 16>,
    /// So many of them lie before the last fence.
    older: usize,
    met: bool,
}

impl InFlight {
    /// None if the machine does not look at addresses.
    pub(super) fn new(plan: &Plan, depth_write: bool) -> Option<Self> {
        (plan.hazard == Hazard::Interlock && depth_write).then(|| InFlight {
            window: u64::from(plan.latency) + 1,
            pixel: u64::from(plan.clocks_per_pixel()),
            spans: Fifo::default(),
            older: 0,
            met: false,
        })
    }

    /// A fragment may have met its address in flight.
    pub(super) fn met(&self) -> bool {
        self.met
    }

    /// Takes in a span whose first fragment is read in cycle `first`; `fence`: it is the first behind a fence.
    pub(super) fn meet<W>(&mut self, span: &Span<W>, first: u64, to_left: bool, fence: bool) {
        let (leftmost, count) = (i64::from(span.pixel), i64::from(span.count));
        let (place, step) = if to_left { (leftmost + count - 1, -1) } else { (leftmost, 1) };
        let reads = Reads { first, place, step, count };
        if fence {
            self.older = self.spans.len();
        }
        self.met |= (0..self.older).any(|i| self.overlap(self.spans.at(i), &reads));
        if self.spans.len() == 16 {
            self.spans.pop();
            self.older = self.older.saturating_sub(1);
        }
        self.spans.push(reads);
    }

    /// A fragment of `new` is read while that of `old` of the same place is in flight.
    fn overlap(&self, old: &Reads, new: &Reads) -> bool {
        let cycle = |reads: &Reads, i: i64| reads.first + i as u64 * self.pixel;
        let last = cycle(old, old.count - 1) + self.window;
        (0..new.count).take_while(|i| cycle(new, *i) <= last).any(|i| {
            let before = (new.place + i * new.step - old.place) * old.step;
            (0..old.count).contains(&before) && cycle(old, before) + self.window >= cycle(new, i)
        })
    }
}
