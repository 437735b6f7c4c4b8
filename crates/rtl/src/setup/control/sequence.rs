//! The sequence of the operations: which one begins, and when the next follows.

use edgewalk_machine::Fill;
use edgewalk_netlist::Signal;

use super::parts::Parts;
use super::{Base, Handshakes};
use crate::setup::steps::Op;

/// Where SETUP stands.
pub(in crate::setup) struct Sequence<'m> {
    /// `tri_ready`: no triangle is being set up.
    pub idle: Signal<'m>,
    /// A triangle is accepted.
    pub take: Signal<'m>,
    /// SETUP is at work.
    pub works: Signal<'m>,
    /// The clock after `take`: the lines and the area of the triangle are begun.
    pub begin: Signal<'m>,
    /// `prim_valid`: the triangle is set up.
    pub done: Signal<'m>,
    /// First clock of the operation that begins.
    pub first: Signal<'m>,
    /// Clocks of the operation after this one.
    pub left: Signal<'m>,
    /// The triangle has no line or no column.
    gives_up: Signal<'m>,
    /// Last clock of the operation.
    pub last: Signal<'m>,
    /// The edges end with this operation.
    edges_end: Signal<'m>,
    /// The channels end with this operation.
    pub channels_end: Signal<'m>,
    /// SETUP waits for the area, or for its scale.
    pub waits: Signal<'m>,
    /// The operation is done in this clock.
    pub goes: Signal<'m>,
    /// The operation ends.
    pub ends: Signal<'m>,
    /// The next operation follows.
    pub leaves: Signal<'m>,
    /// With POLY.
    parts: Option<Parts<'m>>,
}

impl<'m> Sequence<'m> {
    /// The conditions, and the updates of all counters but `left`.
    pub(super) fn new(base: &Base<'_, 'm>, handshakes: &Handshakes<'m>) -> Sequence<'m> {
        let sequence = Sequence::conditions(base, handshakes.tri_valid);
        sequence.update_state(base, handshakes.prim_ready);
        sequence.update_operation(base);
        sequence
    }

    fn conditions(base: &Base<'_, 'm>, tri_valid: Signal<'m>) -> Sequence<'m> {
        let Base { states, codes, counters, feedback, .. } = base;
        let (state, rounds) = (counters.state.q(), &counters.rounds);
        let idle = state.eq(states.idle).named("tri_ready");
        let take = (tri_valid & idle).named("take");
        let works = state.eq(states.work).named("works");
        let done = state.eq(states.done).named("prim_valid");
        let is_at = |place: usize| counters.at.q().eq(codes.at(place));
        let begin = (works & is_at(0)).named_doc("begins", "the first clock of a triangle");
        let parts = Parts::new(base.m, base.plan, feedback, rounds, begin);
        let gives_up = match parts {
            None => rounds.during(works & is_at(1), 0),
            Some(parts) => works & parts.second,
        };
        let gives_up = gives_up & feedback.nothing.q();
        let gives_up = gives_up.named_doc("gives_up", "the triangle has no line or no column");
        let last = counters.left.q().eq(0).named_doc("last", "last clock of the operation");
        let edges_end = match parts {
            None => rounds.during(last & is_at(codes.last_edge), rounds.of_edges - 1),
            Some(parts) => last & is_at(codes.last_edge) & parts.last_round,
        };
        let edges_end = edges_end.named("edges_end");
        let last_round = rounds.of_channels - 1;
        let mut begins_channels = edges_end;
        if last_round > 0 {
            let turn = last & is_at(codes.last_channel());
            let turn = rounds.is(last_round).map_or(turn, |is_last| turn & !is_last);
            begins_channels = edges_end | turn.named("round_ends");
        }
        let waits =
            (begins_channels & !feedback.area_known.q()).named_doc("waits", "for the area or its scale");
        let goes =
            (works & !waits & !gives_up).named_doc("goes", "a step of the operation is done in this clock");
        let ends = (goes & last).named_doc("ends", "it ends");
        let leaves = (ends & base.pause.advance).named("leaves");
        let channels_end = rounds.during(is_at(codes.last_channel()), last_round).named("channels_end");
        let (first, left) = (counters.first.q(), counters.left.q());
        Sequence {
            idle,
            take,
            works,
            begin,
            done,
            first,
            left,
            gives_up,
            last,
            edges_end,
            channels_end,
            waits,
            goes,
            ends,
            leaves,
            parts,
        }
    }

    fn update_state(&self, base: &Base<'_, 'm>, prim_ready: Signal<'m>) {
        let Base { states, counters, feedback, pause, .. } = base;
        let state = counters.state;
        let culled = self.parts.map_or(feedback.no_area.q(), |parts| parts.culled);
        state
            .when(self.take, states.work)
            .when(self.gives_up & pause.advance, states.idle)
            .when(self.edges_end & self.leaves & culled, states.idle);
        if let Some(no_values) = self.ends_without_values() {
            state.when(no_values, states.store);
        }
        state
            .when(self.leaves & self.channels_end, states.store)
            .when(state.q().eq(states.store) & self.last, states.done)
            .when(self.done & prim_ready, states.idle);
    }

    /// The edges end, and no channels follow: only with POLY.
    pub(super) fn ends_without_values(&self) -> Option<Signal<'m>> {
        self.parts.map(|parts| self.edges_end & self.leaves & parts.no_values)
    }

    /// DX of a token without a side that counts is taken: the doubling that follows lasts a clock.
    pub(super) fn no_side(&self) -> Option<Signal<'m>> {
        self.parts.map(|parts| parts.no_side)
    }

    fn update_operation(&self, base: &Base<'_, 'm>) {
        let Base { plan, codes, counters, pause, .. } = base;
        let (at, rounds) = (counters.at, &counters.rounds);
        let is_at = |place: usize| at.q().eq(codes.at(place));
        let mut next = at.q() + 1;
        if rounds.of_edges > 1 {
            // The vertices are subtracted already.
            next = (is_at(codes.last_edge) & !self.edges_end).mux(codes.at(1), next);
        }
        if rounds.of_channels > 1 {
            let first_channel = codes.at(codes.last_edge + 1);
            next = (is_at(codes.last_channel()) & !self.channels_end).mux(first_channel, next);
        }
        if let Some(parts) = self.parts {
            // Meanwhile the differences were shown for which the area is scaled.
            let shown = at.q().eq(codes.of(Op::DoubleDx)) & parts.no_side;
            next = shown.mux(codes.at(codes.last_edge), next);
        }
        at.when(self.leaves, next).when(self.take, codes.at(0));
        let first = counters.first;
        match plan.fill {
            // A sum of one digit may wait for the area.
            Fill::Exact => first.set(self.leaves | (first.q() & self.waits)),
            // A sum may be named while numbers do not fit.
            Fill::Textbook => first.when(pause.advance, self.leaves | (first.q() & self.waits)),
        };
        if let Some(round) = rounds.number {
            let turn = is_at(codes.last_edge) | is_at(codes.last_channel());
            let after = round.q() + 1;
            match self.parts.and_then(|parts| parts.first_and_next) {
                None => round.when(self.leaves & turn, after),
                Some([first, next]) => round
                    .when(self.leaves & is_at(codes.last_channel()), after)
                    .when(self.leaves & is_at(codes.last_edge), next)
                    .when(self.leaves & is_at(0), first),
            };
            round.when((self.leaves & self.edges_end) | self.take, 0);
        }
    }
}
