//! The program of a SETUP of kind `sequenced`, run word by word: what it gives, and in how many clocks.
//!
//! ```text
//!  rows of pairs ──> step ──> A, W ──> rows, results        a pair is worth W + A / M
//!  f, g ──> digits: which row of a table        flags, counters ──> which word comes next
//! ```
//! Slow, and no part of the machine's model, whose results follow from closed formulae. It is what shows that the program
//! gives those results.
//!
//! Rules: `docs/machine.md`, section 2, *The sequencer*.

mod factors;
mod lane;
mod run;

use super::Culled;
use crate::tokens::Prim;
use edgewalk_machine::sequencer::{Program, rounds};
use edgewalk_machine::{Channel, Plan, PortVertex};
use run::Run;

/// Most words that a triangle may take: a program that runs on longer has lost its way.
const LONGEST: u32 = 100_000;

/// The program of a machine, ready to be run.
#[derive(Clone, Debug)]
pub struct SlowSetup {
    plan: Plan,
    program: Program,
    rounds: usize,
}

/// What became of a triangle.
#[derive(Clone, Debug)]
pub struct Ran<const C: usize> {
    /// S: words that were executed, each repetition counted.
    pub clocks: u32,
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

    /// Runs the program on a triangle of the picture, or of the map. `None`: it does not end.
    #[must_use]
    pub fn run<const C: usize>(&self, vertices: &[PortVertex; 3], light_pass: bool) -> Option<Ran<C>> {
        let mut run = Run::new(self, vertices, light_pass);
        while !run.is_over() {
            if run.clocks() == LONGEST {
                return None;
            }
            run.word();
        }
        Some(run.ran())
    }

    /// Doublings of a channel: t + r - e.
    fn doublings(&self, channel: &Channel) -> u32 {
        self.plan.widths().center_fraction + channel.fraction - channel.vertex_fraction
    }

    /// The most doublings of a channel of the round.
    fn doublings_of_round(&self, round: usize) -> u32 {
        let lanes = self.plan.lanes as usize;
        let of_round = self.plan.channels().iter().skip(round * lanes).take(lanes);
        of_round.map(|channel| self.doublings(channel)).max().unwrap_or(0)
    }

    /// Bits of A: twice those of a difference, and room for eight times the largest difference of values.
    fn rest_bits(&self) -> u32 {
        let values = self.plan.channels().iter().map(|channel| channel.vertex_bits()).max().unwrap_or(0);
        (2 * self.plan.widths().difference).max(values + 5)
    }
}
