//! With POLY: which rounds of edges are left out, and which token has no values.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use super::counters::Rounds;
use super::feedback::Feedback;
use crate::setup::steps::edge_of;

/// What a token of a polygon asks for.
#[derive(Clone, Copy)]
pub(super) struct Parts<'m> {
    /// No side counts.
    pub no_side: Signal<'m>,
    /// The second clock of a token.
    pub second: Signal<'m>,
    /// The token has no plane, or none with an area.
    pub no_values: Signal<'m>,
    /// The token is culled if it has no area.
    pub culled: Signal<'m>,
    /// No round of edges follows.
    pub last_round: Signal<'m>,
    /// The first round, and that after this one; `None` where one is enough.
    pub first_and_next: Option<[Signal<'m>; 2]>,
}

impl<'m> Parts<'m> {
    /// None without POLY. `begin` is the first clock of a token.
    pub fn new(
        m: &'m Module,
        plan: &Plan,
        feedback: &Feedback<'m>,
        rounds: &Rounds<'m>,
        begin: Signal<'m>,
    ) -> Option<Parts<'m>> {
        let polygon = feedback.polygon.as_ref()?;
        m.comment("A round of edges of which none counts is left out.");
        let sides = polygon.sides.q();
        let counts: Vec<Signal<'m>> = (0..rounds.of_edges)
            .map(|round| {
                let edges = (0..plan.lanes as usize).filter_map(|lane| edge_of(plan, lane, round));
                let some = edges.map(|edge| sides.bit(edge as u32)).reduce(|any, one| any | one);
                some.unwrap_or_else(|| m.lit(1, 0)).named(&format!("round{round}_counts"))
            })
            .collect();
        let any_of = |rounds: &[Signal<'m>]| rounds.iter().copied().reduce(|any, one| any | one);
        let last_round = (0..rounds.of_edges).fold(m.lit(1, 1), |chosen, round| {
            match (rounds.is(round), any_of(&counts[round + 1..])) {
                (Some(is), Some(more)) => is.mux(!more, chosen),
                _ => chosen,
            }
        });
        let first_and_next = rounds.number.filter(|_| rounds.of_edges > 1).map(|number| {
            let round = |number_of: usize| m.lit(number.q().width(), number_of as u128);
            let from = |first: usize| {
                let others = (first..rounds.of_edges - 1).rev();
                others.fold(round(rounds.of_edges - 1), |chosen, of| counts[of].mux(round(of), chosen))
            };
            let next = (1..rounds.of_edges - 1)
                .fold(number.q() + 1, |chosen, next| number.q().eq(next as i32 - 1).mux(from(next), chosen));
            [from(0).named("first_round"), next.named("next_round")]
        });
        let no_area = feedback.no_area.q();
        let (edges, plane) = (polygon.edges.q(), polygon.plane.q());
        Some(Parts {
            no_side: (!sides.any()).named("no_side"),
            second: m.reg("second", 1).doc("the second clock of a token").set(begin).q(),
            no_values: (edges | (plane & no_area)).named("no_values"),
            culled: (no_area & !edges & !plane).named("culled_by_area"),
            last_round: last_round.named("last_round_of_edges"),
            first_and_next,
        })
    }
}
