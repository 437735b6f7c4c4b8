//! When triangles have come whole by the word port of a sequenced SETUP, from a host that always has another word.
//!
//! Rules: `docs/machine.md`, section 2, "The word port".

use crate::setup::words::PERIOD;
use edgewalk_machine::Plan;

/// The port, from triangle to triangle.
#[derive(Clone, Debug)]
pub(super) struct Words {
    /// Clocks from the first word of a triangle to its last.
    clocks: u64,
    /// No word is taken before this cycle.
    next: u64,
    /// The first cycle with room for each of the next two triangles.
    room: [u64; 2],
}

impl Words {
    pub(super) fn new(plan: &Plan) -> Words {
        Words { clocks: u64::from((plan.triangle_words() - 1) * PERIOD), next: 0, room: [0; 2] }
    }

    /// The cycle in which the last word of the next triangle is taken.
    pub(super) fn bring(&mut self) -> u64 {
        let last = self.next.max(self.room[0]) + self.clocks;
        self.next = last + u64::from(PERIOD);
        last
    }

    /// The triangle that was brought has left its place: there is room from this cycle on.
    pub(super) fn free(&mut self, cycle: u64) {
        self.room = [self.room[1], cycle];
    }
}
