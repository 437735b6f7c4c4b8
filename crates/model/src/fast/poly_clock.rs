//! POLY's clock: LOAD a side a clock but in those in which PASS writes, PASS a word a clock but for what it moves and what it
//! waits for, MOVER from span to span.
//!
//! With a, the cycle of a word's step, m words that make room for it, w = m > 0 ? m + 2 : 0, E the cycle in which the pair before
//! leaves its place:
//! - the first word of a polygon steps two cycles behind its begin, one that enters into no other's line one more;
//! - the next word steps in `a + 1`, behind which w of the word before counts, and not before E + 1 if it makes a pair;
//! - the line ends in `a + 2 + w`, in `a + 1` if the word has left, behind which w of the word before counts too;
//! - a line of two edges that go on in their order is two such words and the line's end in one step;
//! - a pair leaves in `E = max(a + 1, the line before fires)`, and its line is offered in `E + 1 + way`.

use super::clock::Clock;
use super::poly::{Loads, Step, What};
use super::walk::Span;
use super::walking::Walking;
use crate::setup::SetupClocks;
use edgewalk_machine::Activity;

impl Clock {
    /// POLY takes a prim.
    #[inline(always)]
    pub(super) fn token(&mut self, setup: SetupClocks, loads: &Loads, ends: bool) {
        self.enter_setup();
        self.setup[0] += u64::from(setup.phase1);
        self.setup[1] += u64::from(setup.phase2);
        // An edge is in the edge place a cycle behind the one in which it is chosen. Where no side is left that is known as late.
        let mut prim = self.take + u64::from(setup.all()) + 2;
        for room in loads.room.iter().take(loads.sides.into()) {
            prim = self.walking.free_from(prim) + 1 + u64::from(*room);
        }
        if ends {
            prim = prim.max(self.walking.rests).max(self.edge_free);
        }
        self.take = prim + 1;
        self.spend(prim + 1, Activity::Setup);
    }

    /// The polygon that the last prim ends, with the spans of its steps.
    #[inline(always)]
    pub(super) fn polygon<W>(&mut self, steps: &[Step], spans: &[Span<W>]) {
        let begin = self.take - 1;
        let mut spans = spans.iter();
        let mut writes = std::mem::take(&mut self.walking.writes);
        writes.clear();
        self.fresh = true;
        // When the next word steps or the line ends; when the pair before has left; when MOVER's line has fired.
        let (mut next, mut end) = (begin + 2, begin + 2);
        // Cycles in which words make room for the word before, behind the one in which that one is compared.
        let mut room = 0;
        let (mut emptied, mut fired) = (begin, begin);
        let mut line_begins = true;
        for step in steps {
            if step.what == What::LineEnds {
                (next, end, room) = (end + 1, end + 1, 0);
                line_begins = true;
                continue;
            }
            if step.what == What::Two {
                let second = (next + 1).max(emptied + 1);
                emptied = (second + 1).max(fired);
                self.offer = emptied + 1 + u64::from(step.way);
                self.lines(1);
                fired = self.offer - 1;
                if let Some(span) = spans.next() {
                    let first = self.fresh;
                    self.span(span, first, first, false);
                }
                writes.extend([next + 1, second + 1]);
                (next, end) = (second + 3, second + 3);
                line_begins = true;
                continue;
            }
            // Where no edge stands before it, one that enters is read first.
            let mut at = next + u64::from(line_begins && step.what == What::Enters);
            line_begins = false;
            if !matches!(step.what, What::Enters | What::Half) {
                at = at.max(emptied + 1);
                emptied = at + 1;
            }
            if step.is_line() {
                emptied = emptied.max(fired);
                self.offer = emptied + 1 + u64::from(step.way);
                self.lines(1);
                fired = self.offer - 1;
                if step.what == What::Span
                    && let Some(span) = spans.next()
                {
                    let first = self.fresh;
                    self.span(span, first, first, false);
                }
            }
            if step.stays && step.what != What::Enters {
                writes.push(at + 1);
            }
            next = at + 1 + room;
            let own = if step.moves > 0 { u64::from(step.moves) + 2 } else { 0 };
            end = next + if step.stays { 1 + own } else { 0 };
            room = own;
        }
        // The cycle behind the last line's end.
        self.walking = Walking { rests: next.max(emptied + 1).max(fired + 1), writes, seen: 0 };
        if self.fresh && steps.iter().any(Step::is_line) {
            // Without a span its mark goes with the last line.
            self.edge_free = self.edge_free.max(self.moved);
        }
        self.spend(self.moved.max(self.walking.rests), Activity::Edge);
    }
}
