//! MOVER: takes the values of a polygon from span to span.

use super::between::Between;
use super::pass::Pair;
use crate::Events;
use crate::tokens::{Line, Prim, Words, add, word_masks};
use edgewalk_machine::Plan;

/// State of MOVER.
#[derive(Clone, Debug)]
pub(super) struct Mover<const C: usize> {
    line_mask: u32,
    masks: Words<C>,
    /// The span to be given, once the values are there.
    has: bool,
    /// The line offered. The values in it are V.
    line: Line<C>,
    /// X and Y: where V is.
    x: i32,
    y: u32,
    /// g and d0 of the polygon.
    across: Words<C>,
    down: Words<C>,
    /// D: 2^k·g, the step that comes next.
    step: Words<C>,
    /// md: columns to go, without those that are done, over 2^k.
    columns: u32,
    /// neg: to the left.
    left: bool,
    /// With bilinear colours: those of the span.
    between: Option<Between>,
}

impl<const C: usize> Mover<C> {
    pub fn new(plan: &Plan) -> Self {
        Mover {
            line_mask: u32::MAX >> (32 - plan.widths().line),
            masks: word_masks(plan),
            has: false,
            line: Line::default(),
            x: 0,
            y: 0,
            across: [0; C],
            down: [0; C],
            step: [0; C],
            columns: 0,
            left: false,
            between: plan.polygon.is_bilinear().then(|| Between::new(plan)),
        }
    }

    pub fn reset(&mut self) {
        self.has = false;
        if let Some(between) = &mut self.between {
            between.reset();
        }
    }

    /// Colours are found between two edges.
    pub fn divides(&self) -> bool {
        self.between.is_some()
    }

    /// With bilinear colours: those of the span.
    pub fn between(&self) -> Option<&Between> {
        self.between.as_ref()
    }

    /// A span is on its way, or waits for SPAN.
    pub fn has_span(&self) -> bool {
        self.has
    }

    /// The values of planes stand at the span's first pixel.
    fn is_there(&self) -> bool {
        self.has && self.y == self.line.y && self.columns == 0
    }

    /// The span offered.
    pub fn line(&self) -> Option<&Line<C>> {
        let offers =
            self.between.as_ref().map_or_else(|| self.is_there(), |between| self.has && between.offers());
        offers.then_some(&self.line)
    }

    /// The span to be given, where V is, the columns to go, and whether to the left.
    pub fn way(&self) -> (&Line<C>, i32, u32, u32, bool) {
        (&self.line, self.x, self.y, self.columns, self.left)
    }

    /// D and d0.
    pub fn steps(&self) -> [&Words<C>; 2] {
        [&self.step, &self.down]
    }

    /// A polygon begins.
    pub fn begin(&mut self, prim: &Prim<C>) {
        let [x, y] = prim.start_pixel;
        (self.x, self.y) = (x as i32, y);
        (self.across, self.down) = (prim.gradient, prim.delta[0]);
        self.line = Line {
            values: prim.start[0],
            thin: prim.thin,
            flat: prim.flat,
            fresh: true,
            fence: true,
            source: prim.source,
            ..Line::default()
        };
    }

    /// The pixels of a pair: its first column on the screen and that behind the last; none if it has no pixel.
    fn pixels(pair: &Pair, width: i32) -> Option<[i32; 2]> {
        let [left, right] = pair.columns();
        if pair.thin {
            return Some([left, right]);
        }
        let [first, behind] = [left.max(0), right.min(width)];
        (first < behind).then_some([first, behind])
    }

    /// The pair leaves its place: it has no pixel, or is taken.
    pub fn sees(&self, pair: &Pair, line_taken: bool, width: i32, events: &mut Events) -> bool {
        if Self::pixels(pair, width).is_none() {
            events.poly.polygon_empty_pair += 1;
            return true;
        }
        let taken = !self.has || line_taken;
        events.poly.polygon_left += u64::from(taken && !pair.thin && pair.columns()[0] < 0);
        taken
    }

    /// Clock edge, with a pair that leaves its place, if one does. With bilinear colours it may give g of those of the span.
    pub fn step(
        &mut self,
        line_taken: bool,
        pair: Option<Pair>,
        width: i32,
        fresh_queued: bool,
        events: &mut Events,
    ) -> Option<[u64; 3]> {
        let there = self.is_there();
        let mut gradients = None;
        if let Some(between) = &mut self.between {
            events.poly.polygon_divides += u64::from(there && between.dividing());
            gradients = (there && !fresh_queued).then(|| between.offer()).flatten();
            between.divide(&mut self.line.values);
        }
        if line_taken {
            (self.line.fresh, self.line.fence, self.has) = (self.between.is_some(), false, false);
            if let Some(between) = &mut self.between {
                between.taken();
            }
        } else if self.has && self.y != self.line.y {
            self.line.values = add(&self.line.values, &self.down, &self.masks);
            self.y = (self.y + 1) & self.line_mask;
        } else if self.has && self.columns > 0 {
            if self.columns & 1 == 1 {
                let step = if self.left { self.step.map(u64::wrapping_neg) } else { self.step };
                self.line.values = add(&self.line.values, &step, &self.masks);
            }
            self.step = add(&self.step, &self.step, &self.masks);
            self.columns >>= 1;
        }
        let pixels = pair.and_then(|pair| Some((pair, Self::pixels(&pair, width)?)));
        if let Some((pair, [first, behind])) = pixels {
            self.has = true;
            (self.line.y, self.line.major, self.line.minor) = (pair.y, first, behind);
            let way = first - self.x;
            (self.columns, self.left) = (if pair.thin { 0 } else { way.unsigned_abs() }, way < 0);
            (self.x, self.step) = (first, self.across);
            if let Some(between) = &mut self.between {
                between.begin(&pair, first, &mut self.line.values);
                events.poly.polygon_narrow += u64::from(!pair.thin && between.is_narrow());
            }
        }
        gradients
    }
}
