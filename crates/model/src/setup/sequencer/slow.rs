//! The program of a machine, and what became of a triangle that ran through it.

use crate::setup::Culled;
use crate::tokens::Prim;
use edgewalk_machine::sequencer::{Program, rounds};
use edgewalk_machine::{Channel, EdgeKind, Plan};

/// The program of a machine, ready to be run.
#[derive(Clone, Debug)]
pub struct SlowSetup {
    pub(super) plan: Plan,
    pub(super) program: Program,
    pub(super) rounds: usize,
}

/// What became of a triangle.
#[derive(Clone, Debug)]
pub struct Ran<const C: usize> {
    /// S: words that were executed up to the one that waits for room, or drops; each repetition counted.
    pub clocks: u32,
    /// L: words behind it; 0 of a triangle that is culled.
    pub load: u32,
    /// Why the triangle draws nothing, if it is culled.
    pub culled: Option<Culled>,
    /// Lines, edges and channels; without tag, k_t, record and number.
    pub prim: Prim<C>,
    /// Rows read less than three words behind the word that writes them, and tests of what a check less than three words
    /// before has not yet found. A program that is right has none.
    pub early: u32,
}

impl SlowSetup {
    /// The program of this machine.
    #[must_use]
    pub fn new(plan: &Plan) -> SlowSetup {
        SlowSetup::with(plan, Program::of(plan))
    }

    /// Another program for this machine: for tests that alter it.
    #[must_use]
    pub fn with(plan: &Plan, program: Program) -> SlowSetup {
        SlowSetup { plan: plan.clone(), rounds: rounds(plan), program }
    }

    /// Doublings of a channel: t + r - e.
    pub(super) fn doublings(&self, channel: &Channel) -> u32 {
        self.plan.widths().center_fraction + channel.fraction - channel.vertex_fraction
    }

    /// F of slope edges; none of exact ones.
    pub(super) fn slope_fraction(&self) -> Option<u32> {
        (self.plan.edge_kind == EdgeKind::Slope).then_some(self.plan.edge_fraction)
    }

    /// The most doublings of a channel of the round.
    pub(super) fn doublings_of_round(&self, round: usize) -> u32 {
        let lanes = self.plan.lanes as usize;
        let of_round = self.plan.channels().iter().skip(round * lanes).take(lanes);
        of_round.map(|channel| self.doublings(channel)).max().unwrap_or(0)
    }

    /// Bits of A: twice those of a difference, and room for eight times the largest difference of values.
    pub(super) fn rest_bits(&self) -> u32 {
        let values = self.plan.channels().iter().map(|channel| channel.vertex_bits()).max().unwrap_or(0);
        (2 * self.plan.widths().difference).max(values + 5)
    }
}
