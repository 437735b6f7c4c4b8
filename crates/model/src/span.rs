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
use edgewalk_numerics::{Fill, Machine};

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

/// The pixels of a line.
struct Cut {
    x: i32,
    count: i32,
    left: bool,
    /// The screen ended it, not the edge.
    scissored: bool,
}

impl SpanQueue {
    /// An empty unit.
    #[must_use]
    pub fn new(machine: &Machine) -> Self {
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
        self.fifo.len() < self.depth || self.cut(line).is_none()
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
    #[inline]
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
        let cut = self.cut(line);
        if full && cut.is_some() {
            return; // not ready
        }
        let Some(cut) = cut else {
            self.pend_fresh = fresh;
            self.pend_fence = fence;
            coverage.empty_span += 1;
            coverage.dropped_fresh += u64::from(fresh);
            coverage.dropped_when_full += u64::from(full);
            return;
        };
        self.fifo.push(Span {
            x: cut.x,
            y: line.y,
            count: cut.count as u32, // at least 1
            left: cut.left,
            values: line.values,
            fresh,
            fence,
            source: line.source,
        });
        self.fresh_queued |= fresh;
        self.pend_fresh = false;
        self.pend_fence = false;
        coverage.scissor_cut += u64::from(cut.scissored);
    }

    /// The pixels of a line, `None` if there are none.
    #[inline]
    fn cut(&self, line: &Line) -> Option<Cut> {
        if line.left && !self.textbook {
            let x = line.major - 1;
            let end = line.minor.max(0);
            let empty = x < end || line.minor >= self.width;
            return (!empty).then_some(Cut { x, count: x - end + 1, left: true, scissored: line.minor < 0 });
        }
        let (x, edge) = match (self.textbook, line.left) {
            (false, _) => (line.major, line.minor),
            (true, false) => (line.major - 1, line.minor),
            (true, true) => (line.minor - 1, line.major),
        };
        let end = edge.min(self.width);
        let empty = end <= x || edge <= 0;
        (!empty).then_some(Cut { x, count: end - x, left: false, scissored: edge > self.width })
    }
}
