//! Interlock without ticking: does a fragment meet its own address in flight?
//!
//! Between two fences no address comes twice (a triangle, in textbook fill a part, draws a line once). So a fragment can
//! only meet one from before the last fence, read at most L + 1 cycles before: L in the queue, one in w.

use crate::fifo::Fifo;
use edgewalk_numerics::{Hazard, Machine};

/// The fragments of a span, in the order of their reads.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reads {
    /// Cycle of the first read.
    pub first: u64,
    /// Line.
    pub y: u32,
    /// Column of the first fragment.
    pub x: i32,
    /// Fragments.
    pub count: u32,
    /// To the next column: 1 or -1.
    pub step: i32,
}

impl Reads {
    /// The cycle in which a column is read.
    fn cycle(&self, x: i32, pixel: u64) -> Option<u64> {
        let place = (x - self.x) * self.step;
        (0..self.count as i32).contains(&place).then(|| self.first + place as u64 * pixel)
    }
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
}

impl InFlight {
    /// None if the machine does not look at addresses.
    pub(super) fn new(machine: &Machine, depth_write: bool) -> Option<Self> {
        (machine.hazard == Hazard::Interlock && depth_write).then(|| InFlight {
            window: u64::from(machine.latency) + 1,
            pixel: u64::from(machine.clocks_per_pixel()),
            spans: Fifo::default(),
            older: 0,
        })
    }

    /// Takes in a span; true if a fragment of it may meet its address in flight.
    pub(super) fn meets(&mut self, span: Reads, fence: bool) -> bool {
        if fence {
            self.older = self.spans.len();
        }
        let met = (0..self.older).any(|i| {
            let old = self.spans.at(i);
            let last = old.first + u64::from(old.count - 1) * self.pixel;
            old.y == span.y && last + self.window >= span.first && self.overlap(old, &span)
        });
        if self.spans.len() == 16 {
            self.spans.pop();
            self.older = self.older.saturating_sub(1);
        }
        self.spans.push(span);
        met
    }

    fn overlap(&self, old: &Reads, span: &Reads) -> bool {
        (0..span.count.min(16) as i32).any(|i| {
            let x = span.x + i * span.step;
            let read = span.first + i as u64 * self.pixel;
            old.cycle(x, self.pixel).is_some_and(|cycle| cycle + self.window >= read)
        })
    }
}
