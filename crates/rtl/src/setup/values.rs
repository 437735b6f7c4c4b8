//! Which values of the vertices the lanes are shown.

use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{Module, Signal};

use super::area::Area;
use super::control::Control;
use super::scale::{SHOWN_FIRST, SHOWN_NEXT};
use super::sort::Vertices;
use super::steps::{Op, rounds};

/// What the lanes are shown: DX or DY of an edge, the difference of a channel's values at two vertices, or
/// one value. All are chosen a clock before.
pub(super) struct Values<'m> {
    /// The vertex whose value is subtracted.
    pub from: Signal<'m>,
    /// The vertex whose value it is subtracted from.
    pub to: Signal<'m>,
    /// The value at `to` alone is shown, less its rounding.
    pub single: Signal<'m>,
    /// The channels are those of round 1, 2, ...; else those of round 0.
    pub rounds: Vec<Signal<'m>>,
    /// An edge is shown.
    pub of_edge: Signal<'m>,
    /// Of the edge, DY is shown.
    pub height: Signal<'m>,
}

/// The places of two vertices among the sorted ones.
#[derive(Clone, Copy)]
struct Places<'m> {
    from: Signal<'m>,
    to: Signal<'m>,
}

impl<'m> Places<'m> {
    fn choose(is: Signal<'m>, yes: Places<'m>, no: Places<'m>) -> Places<'m> {
        Places { from: is.mux(yes.from, no.from), to: is.mux(yes.to, no.to) }
    }
}

impl<'m> Values<'m> {
    /// dc1 - dc2, dc1 and -dc2, turned round where the area is below 0, but not when they are only shown. In
    /// textbook fill the differences at the ends of the left edges too.
    pub fn new(
        m: &'m Module,
        plan: &Plan,
        control: &Control<'m>,
        vertices: &Vertices<'m>,
        area: &Area<'m>,
    ) -> Values<'m> {
        m.comment("Inputs of the lanes in the next clock.");
        let (named, right) = (&control.way.named, area.negative);
        let place = |number: u128| m.lit(2, number);
        // Values of an edge are tested while nothing else is to be shown; of textbook fill those of channels
        // are too.
        let reg = |name: &str, value: Signal<'m>| {
            let reg = m.reg(name, value.width());
            match plan.fill {
                Fill::Exact => reg.set(value).q(),
                Fill::Textbook => reg.when(control.pause.advance, value).q(),
            }
        };
        let of_edge = |name: &str, is: Signal<'m>| m.reg(name, 1).when(control.pause.advance, is).q();
        let of = |which: usize, taken: Op| named.one_of(&[taken, SHOWN_FIRST[which], SHOWN_NEXT[which]]);
        let (third, second) = (of(0, Op::Take12), of(2, Op::Take2));
        let turned = right & named.one_of(&[Op::Take12, Op::Take1, Op::Take2]);
        // dc1 - dc2 = c1 - c2, dc1 = c1 - c0, -dc2 = c0 - c2, the other way round where the area is below 0.
        let pair = |from: u128, to: u128| Places { from: place(from), to: place(to) };
        let chosen = Places::choose(third, pair(2, 1), Places::choose(second, pair(2, 0), pair(0, 1)));
        let turned_round = Places { from: chosen.to, to: chosen.from };
        let Places { mut from, mut to } = Places::choose(turned, turned_round, chosen);
        let single = named.one_of(&[Op::SignStart, Op::DoubleStartA, Op::DoubleStartB]);
        to = single.mux(place(0), to);
        if plan.fill == Fill::Textbook {
            to = (named.is(Op::DoubleStartB) & right).mux(place(1), to);
            // The left edge is the major one, or that of the part.
            let (a, b) = (named.is(Op::TakeA), named.is(Op::TakeB));
            from = (a | b).mux((b & right).mux(place(1), place(0)), from);
            to = (a | b).mux((a & right).mux(place(1), place(2)), to);
        }
        let shown = named.one_of(&SHOWN_NEXT);
        let of_first = named.one_of(&SHOWN_FIRST);
        let round = |round: usize| {
            let (own, before) = (named.in_round(round)?, named.in_round(round - 1)?);
            Some(reg(&format!("values_of_round{round}"), shown.mux(before, own) & !of_first))
        };
        let vertex = |place: Signal<'m>| {
            place.eq(2).mux(vertices.order[2], place.eq(1).mux(vertices.order[1], vertices.order[0]))
        };
        Values {
            from: vertex(reg("from_place", from)).named("from_vertex"),
            to: vertex(reg("to_place", to)).named("to_vertex"),
            single: reg("single_value", single),
            rounds: (1..rounds(plan)[1]).filter_map(round).collect(),
            of_edge: of_edge("number_of_edge", named.one_of(&[Op::TakeDx, Op::TakeDy])),
            height: of_edge("number_is_height", named.is(Op::TakeDy)),
        }
    }
}
