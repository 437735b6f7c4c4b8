//! How long the next operation takes: what is loaded into `left`.

use edgewalk_netlist::Signal;

use super::Base;
use super::clocks::doubling_clocks;
use super::sequence::Sequence;
use crate::setup::steps::{Length, Op};

/// The updates of `left`.
pub(super) fn load<'m>(base: &Base<'_, 'm>, sequence: &Sequence<'m>) {
    let Base { m, plan, codes, counters, feedback, .. } = base;
    m.comment("How long the next operation takes.");
    let (at, left) = (counters.at.q(), counters.left);
    let number = |clocks: u32| m.lit(left.q().width(), u128::from(clocks) - 1);
    let mut length = m.lit(left.q().width(), 0);
    for ((op, _), (_, before)) in codes.iter().skip(1).zip(codes.iter()) {
        let of_edge = op.is_of_edge(plan);
        let clocks = match op.doing().length {
            Length::Clocks(1) => continue,
            Length::Clocks(clocks) => number(clocks),
            Length::Digits => feedback.top_digit.q(),
            Length::Doublings(_) if of_edge && doubling_clocks(plan, *op, 0) < 2 => continue,
            Length::Doublings(_) if of_edge => number(doubling_clocks(plan, *op, 0)),
            Length::Doublings(_) => of_channels(base, *op, number),
            Length::Scaled(_) => of_channels(base, *op, number) + feedback.scale.q().zext(left.q().width()),
        };
        length = at.eq(*before).mux(clocks, length);
    }
    left.when(base.pause.advance & sequence.works, left.q() - 1).when(sequence.leaves, length);
    if let Some(no_side) = sequence.no_side() {
        left.when(sequence.leaves & no_side & at.eq(codes.of(Op::TakeDx)), 0);
    }
    left.when(sequence.leaves & sequence.channels_end, 3);
    if let Some(no_values) = sequence.ends_without_values() {
        left.when(no_values, 3);
    }
    left.when(counters.state.q().eq(base.states.store), left.q() - 1)
        .when(sequence.waits, 0)
        .when(sequence.take, 0);
}

/// The clocks of an operation that doubles, chosen by the round of channels.
fn of_channels<'m>(base: &Base<'_, 'm>, op: Op, number: impl Fn(u32) -> Signal<'m>) -> Signal<'m> {
    let rounds = &base.counters.rounds;
    let clocks = |round: usize| doubling_clocks(base.plan, op, round);
    let doubled = |round: usize| number(clocks(round).max(1));
    let last = rounds.of_channels - 1;
    let others = (0..last).filter(|round| clocks(*round) != clocks(last));
    others.fold(doubled(last), |chosen, round| {
        rounds.is(round).map_or(chosen, |is| is.mux(doubled(round), chosen))
    })
}
