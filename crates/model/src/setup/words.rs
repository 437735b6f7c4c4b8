//! The word port of a sequenced SETUP: triangles come word by word, and one may come while another is worked on.
//!
//! ```text
//!  in ─> place of two ─┬─ whole ─> the program ─> place free again
//!                      └─ the words of the next
//! ```
//! A triangle is taken with its last word. What its words say is looked at then: only their number counts before.
//!
//! Rules: `docs/machine.md`, section 2, "The word port".

use edgewalk_machine::{Plan, PortVertex};
use std::collections::VecDeque;

/// Triangles that SETUP has room for: the one that is worked on, and another.
const PLACES: usize = 2;

/// Clocks from a word to the next that can be taken.
pub(crate) const PERIOD: u32 = 2;

/// What has come by the port.
#[derive(Clone, Debug)]
pub(super) struct WordPort {
    /// Words of a triangle.
    words: u32,
    /// Words taken of the triangle that comes.
    taken: u32,
    /// Clocks in which no word is taken.
    pause: u32,
    /// Whole triangles with their tags, the one that is worked on first.
    whole: VecDeque<([PortVertex; 3], u32)>,
}

impl WordPort {
    pub(super) fn new(plan: &Plan) -> WordPort {
        WordPort { words: plan.triangle_words(), taken: 0, pause: 0, whole: VecDeque::with_capacity(PLACES) }
    }

    /// `in_ready`.
    pub(super) fn ready(&self) -> bool {
        self.whole.len() < PLACES && self.pause == 0
    }

    /// The next word is the last of its triangle.
    pub(super) fn is_last(&self) -> bool {
        self.taken + 1 == self.words
    }

    /// The triangle that is worked on, or will be next.
    pub(super) fn triangle(&self) -> Option<&([PortVertex; 3], u32)> {
        self.whole.front()
    }

    /// The place of the triangle that was worked on is free.
    pub(super) fn free(&mut self) {
        self.whole.pop_front();
    }

    /// Clock edge, with a word of this triangle offered or none.
    pub(super) fn step(&mut self, offered: Option<(&[PortVertex; 3], u32)>) {
        let takes = self.ready();
        self.pause = self.pause.saturating_sub(1);
        let Some((vertices, tag)) = offered.filter(|_| takes) else { return };
        self.pause = PERIOD - 1;
        if self.is_last() {
            self.whole.push_back((*vertices, tag));
            self.taken = 0;
        } else {
            self.taken += 1;
        }
    }

    /// Synchronous reset.
    pub(super) fn reset(&mut self) {
        (self.taken, self.pause) = (0, 0);
        self.whole.clear();
    }
}
