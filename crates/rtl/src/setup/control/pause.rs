//! The pause: numbers that do not fit hold up the operations that follow.

use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{Module, Reg, Signal};

use super::Base;
use super::clocks::{edge_pairs, pairs};
use super::sequence::Sequence;
use super::way::Way;
use crate::setup::steps::{Op, rounds};

/// How long numbers that do not fit hold up what follows.
pub(in crate::setup) struct Pause<'m> {
    /// Nothing is held up.
    pub advance: Signal<'m>,
    /// Clocks still needed for these numbers; in the last of them the next step is formed again.
    pub left: Signal<'m>,
    counter: Reg<'m>,
    paused: Reg<'m>,
}

impl<'m> Pause<'m> {
    /// The registers, without updates.
    pub fn new(m: &'m Module, plan: &Plan) -> Pause<'m> {
        m.comment(
            "A number outside ±M pauses the sequence for two clocks, plus one for each pair of digits.",
        );
        let [edge_rounds, channel_rounds] = rounds(plan);
        let most_rounds = if plan.fill == Fill::Textbook { edge_rounds.max(channel_rounds) } else { 0 };
        let of_channels = (0..most_rounds).map(|round| pairs(plan, round));
        let most_pairs = of_channels.fold(edge_pairs(plan), u32::max);
        let counter = m.reg("pause", (most_pairs + 2).ilog2() + 1).doc("clocks of the pause that are left");
        let paused = m.reg("paused", 1).doc("the operation is not over").reset(0);
        Pause { advance: (!paused.q()).named("advance"), left: counter.q(), counter, paused }
    }

    /// The updates.
    pub(super) fn update(&self, base: &Base<'_, 'm>, sequence: &Sequence<'m>, way: &Way<'m>) {
        let Base { m, plan, feedback, .. } = base;
        let number = |pairs: u32| m.lit(self.left.width(), u128::from(pairs) + 2);
        let mut clocks = number(edge_pairs(plan));
        if plan.fill == Fill::Textbook {
            let of_channels = |round: usize| number(pairs(plan, round));
            let rounds = base.counters.rounds.of_channels;
            clocks = way.stepped.is(Op::TakeDx).mux(clocks, way.stepped.of_round(rounds, of_channels));
        }
        self.counter.set(self.advance.mux(clocks, self.left - 1));
        // What the lanes do right after a reset belongs to no triangle.
        let worked = m.reg("worked", 1).doc("works, a clock ago").reset(0).set(sequence.works).q();
        self.paused.when(way.resumes, 0).when(worked & feedback.unfit.q(), 1);
    }
}
