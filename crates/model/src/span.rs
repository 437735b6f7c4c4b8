//! SPAN: cuts a line to the pixels to draw, and queues it.
//!
//! ```text
//!  line ─> first column, count ──empty?──> dropped, its marks kept
//!                        └─> FIFO ─> span
//! ```
//! Formats: columns signed, COLW bits, px; count at least 1.
//!
//! Timing: a line taken in cycle n is offered in n + 1 (registered FIFO); a line a clock, empty ones too.
//!
//! Rules: `docs/machine.md`, section 4. A span is cut where it ends; before its start PIXEL steps over the columns off
//! the screen. Not modelled: nothing.

use crate::Coverage;
use crate::fifo::Fifo;
use crate::tokens::{Line, Span};
use edgewalk_machine::{Fill, Plan};

/// State of SPAN.
#[derive(Clone, Debug)]
pub struct SpanQueue {
    textbook: bool,
    width: i32,
    depth: usize,
    fifo: Fifo<Span, 64>,
    pend_fresh: bool,
    pend_fence: bool,
    fresh_queued: bool,
}

impl SpanQueue {
    /// An empty unit.
    #[must_use]
    pub fn new(machine: &Plan) -> Self {
        SpanQueue {
            textbook: machine.fill == Fill::Textbook,
            width: machine.width as i32,
            depth: machine.span_fifo as usize,
            fifo: Fifo::default(),
            pend_fresh: false,
            pend_fence: false,
            fresh_queued: false,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.fifo.clear();
        self.pend_fresh = false;
        self.pend_fence = false;
        self.fresh_queued = false;
    }

    /// The line can be taken: it is empty, or there is room.
    #[inline]
    #[must_use]
    pub fn line_ready(&self, line: &Line) -> bool {
        self.fifo.len() < self.depth || self.is_empty(line)
    }

    /// The span offered to PIXEL.
    #[inline]
    #[must_use]
    pub fn span(&self) -> Option<&Span> {
        (!self.fifo.is_empty()).then(|| self.fifo.head())
    }

    /// The first span of a triangle is queued: PIXEL still needs EDGE's gradients.
    #[inline]
    #[must_use]
    pub fn fresh_queued(&self) -> bool {
        self.fresh_queued
    }

    /// Clock edge.
    #[inline(always)]
    pub fn step(&mut self, line: Option<&Line>, span_ready: bool, coverage: &mut Coverage) {
        let full = self.fifo.len() == self.depth;
        if span_ready && !self.fifo.is_empty() {
            self.fresh_queued &= !self.fifo.head().fresh;
            self.fifo.pop();
        }
        if let Some(line) = line {
            self.take(line, full, coverage);
        }
    }

    fn take(&mut self, line: &Line, full: bool, coverage: &mut Coverage) {
        let fresh = line.fresh | self.pend_fresh;
        let fence = line.fence | self.pend_fence;
        if self.is_empty(line) {
            self.pend_fresh = fresh;
            self.pend_fence = fence;
            coverage.empty_span += 1;
            coverage.dropped_fresh += u64::from(fresh);
            coverage.dropped_when_full += u64::from(full);
            return;
        }
        if full {
            return; // not ready
        }
        let left = line.left && !self.textbook;
        let (start, end) = self.columns(line);
        let (x, count) =
            if left { (end - 1, end - start.max(0)) } else { (start, end.min(self.width) - start) };
        self.fifo.push(Span {
            x,
            y: line.y,
            count: count as u32, // at least 1
            left,
            values: line.values,
            fresh,
            fence,
            source: line.source,
        });
        self.fresh_queued |= fresh;
        self.pend_fresh = false;
        self.pend_fence = false;
        coverage.scissor_cut += u64::from(if left { start < 0 } else { end > self.width });
    }

    /// The columns of a line from left to right, the last one excluded.
    #[inline]
    fn columns(&self, line: &Line) -> (i32, i32) {
        let (start, end) = if line.left { (line.minor, line.major) } else { (line.major, line.minor) };
        // In textbook fill C is 1 + Trunc(X), and both ends are drawn.
        (start.wrapping_sub(i32::from(self.textbook)), end)
    }

    /// No column of the line lies on the screen.
    #[inline]
    fn is_empty(&self, line: &Line) -> bool {
        let (start, end) = self.columns(line);
        end.min(self.width) <= start.max(0)
    }
}
