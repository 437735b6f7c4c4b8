//! SPAN: cuts a line to the pixels to draw, and queues it.
//!
//! ```text
//!  line ─> [held] ─> first column, count ──empty?──> dropped, its marks kept
//!                                  └─> FIFO ─> span
//! ```
//! Formats: columns signed, COLW bits, px; count at least 1.
//!
//! Timing: a line taken in cycle n is held in n + 1 and offered in n + 2 (registered FIFO); a line a clock while there is room,
//! empty ones too.
//!
//! Rules: `docs/machine.md`, section 4. A span is cut where it ends; before its start PIXEL steps over the columns off
//! the screen. Not modelled: nothing.

mod view;

use crate::Events;
use crate::fifo::Fifo;
use crate::ports::{Pins, Ported, Shown};
use crate::tokens::{self, Line};
use edgewalk_machine::{Fill, Plan};

/// State of SPAN.
#[derive(Clone, Debug)]
pub struct Span<const C: usize> {
    textbook: bool,
    /// W and H, and with `light_pass` SIZE and SIZE.
    screens: [[i32; 2]; 2],
    /// Columns and lines of the pass of the line held.
    screen: [i32; 2],
    depth: usize,
    held: Option<Line<C>>,
    fifo: Fifo<tokens::Span<C>, 64>,
    pend_fresh: bool,
    pend_fence: bool,
    /// Tokens with fresh in the FIFO.
    fresh_in_fifo: u32,
}

impl<const C: usize> Span<C> {
    /// An empty unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        Span {
            textbook: plan.fill == Fill::Textbook,
            screens: [[plan.width as i32, plan.height as i32], [plan.shadow.size as i32; 2]],
            screen: [plan.width as i32, plan.height as i32],
            depth: plan.span_fifo as usize,
            held: None,
            fifo: Fifo::default(),
            pend_fresh: false,
            pend_fence: false,
            fresh_in_fifo: 0,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.held = None;
        self.fifo.clear();
        self.pend_fresh = false;
        self.pend_fence = false;
        self.fresh_in_fifo = 0;
    }

    /// A line can be taken: none is held, or the one that is moves on.
    #[inline]
    #[must_use]
    pub fn line_ready(&self) -> bool {
        self.held.is_none() || self.has_room()
    }

    /// No line is taken and none moves on, before PIXEL takes a span.
    #[inline]
    pub(crate) fn stands_still(&self) -> bool {
        self.held.is_some() && !self.has_room()
    }

    /// The FIFO takes a token.
    #[inline]
    fn has_room(&self) -> bool {
        self.fifo.len() < self.depth
    }

    /// The span offered to PIXEL.
    #[inline]
    #[must_use]
    pub fn span(&self) -> Option<&tokens::Span<C>> {
        (!self.fifo.is_empty()).then(|| self.fifo.head())
    }

    /// Not hardware: spans in the FIFO.
    #[inline]
    #[must_use]
    pub fn queued(&self) -> usize {
        self.fifo.len()
    }

    /// A line stands before the FIFO.
    #[inline]
    #[must_use]
    pub fn line_held(&self) -> bool {
        self.held.is_some()
    }

    /// The first span of a triangle is queued, or may come of the line held: PIXEL still needs EDGE's gradients.
    #[inline]
    #[must_use]
    pub fn fresh_queued(&self) -> bool {
        self.fresh_in_fifo > 0 || self.held.as_ref().is_some_and(|line| line.fresh | self.pend_fresh)
    }

    /// Clock edge; `line`: the one taken, if `line_ready`; `light_pass`: it is one of the map.
    #[inline(always)]
    pub fn step(&mut self, line: Option<&Line<C>>, span_ready: bool, light_pass: bool, events: &mut Events) {
        let (ready, room) = (self.line_ready(), self.has_room());
        if span_ready && !self.fifo.is_empty() {
            self.fresh_in_fifo -= u32::from(self.fifo.head().fresh);
            self.fifo.pop();
        }
        if room && let Some(held) = self.held.take() {
            self.move_on(&held, events);
        }
        if ready && let Some(line) = line {
            self.held = Some(*line);
            self.screen = self.screens[usize::from(light_pass)];
        }
    }

    /// The held line is a span, or dropped.
    fn move_on(&mut self, line: &Line<C>, events: &mut Events) {
        let fresh = line.fresh | self.pend_fresh;
        let fence = line.fence | self.pend_fence;
        let Some(Cut { start, end, turned, side }) = self.cut(line) else {
            self.pend_fresh = fresh;
            self.pend_fence = fence;
            events.span.empty_span += 1;
            events.span.dropped_fresh += u64::from(fresh);
            events.span.line_off += u64::from(line.thin);
            return;
        };
        let leftward = line.major_right && !self.textbook && !line.thin;
        let (x, count) =
            if leftward { (end - 1, end - start.max(0)) } else { (start, end.min(side) - start) };
        let (x, y) = if turned { (line.y as i32, x as u32) } else { (x, line.y) }; // both on the screen
        self.fifo.push(tokens::Span {
            x,
            y,
            count: count as u32, // at least 1
            leftward,
            values: line.values,
            fresh,
            fence,
            source: line.source,
        });
        self.fresh_in_fifo += u32::from(fresh);
        self.pend_fresh = false;
        self.pend_fence = false;
        // A pixel of a line is on the screen or dropped.
        events.span.scissor_cut += u64::from(if leftward { start < 0 } else { end > side });
    }

    /// The columns of a line, if one lies on the screen.
    #[inline(always)]
    fn cut(&self, line: &Line<C>) -> Option<Cut> {
        let (start, end) = if line.thin {
            (line.major, line.major.wrapping_add(1))
        } else {
            let (start, end) =
                if line.major_right { (line.minor, line.major) } else { (line.major, line.minor) };
            // In textbook fill C is 1 + Trunc(X), and both ends are drawn.
            (start.wrapping_sub(i32::from(self.textbook)), end)
        };
        let [width, height] = self.screen;
        let turned = line.thin & line.flat;
        let side = if turned { height } else { width };
        (end.min(side) > start.max(0)).then_some(Cut { start, end, turned, side })
    }
}

/// The columns of a line from left to right, the last one excluded.
struct Cut {
    start: i32,
    end: i32,
    /// A pixel of a flat line: x and y have changed places, so these are lines.
    turned: bool,
    /// Columns of the screen, or lines.
    side: i32,
}

impl<const C: usize> Ported<C> for Span<C> {
    type Takes = Line<C>;

    fn show(&self, _: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.line_ready());
        out.gives(self.span());
        out.status("fresh_queued", self.fresh_queued());
        out.status("line_held", self.line_held());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        self.step(pins.token, pins.next, pins.state.light_pass, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
