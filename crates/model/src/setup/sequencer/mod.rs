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
mod slow;
mod run;

use edgewalk_machine::PortVertex;
use run::Run;
pub use slow::{Ran, SlowSetup};

/// Most words that a triangle may take: a program that runs on longer has lost its way.
const LONGEST: u32 = 100_000;

impl SlowSetup {
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
}
