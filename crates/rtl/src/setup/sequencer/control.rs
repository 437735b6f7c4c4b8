//! Which word comes next, and the counters and flags that say so.

use edgewalk_machine::EdgeKind;
use edgewalk_machine::sequencer::word::{Act, Drop};
use edgewalk_machine::sequencer::{edges_are_beside, rounds};
use edgewalk_netlist::{Reg, Signal};

use super::Parts;
use super::code::{Jump, place_bits};
use super::digits::Digits;
use super::shape::most_doublings;

/// Counters and flags.
pub(super) struct Control<'m> {
    /// Place of the word that comes next.
    pub next: Signal<'m>,
    /// A triangle is there, and worked on.
    pub full: Reg<'m>,
    pub prim_there: Signal<'m>,
    /// The last word of a triangle that is not culled.
    pub done: Signal<'m>,
    /// Words are taken.
    pub idle: Signal<'m>,
    /// The major edge lies right.
    pub right: Signal<'m>,
    /// Numbers of the vertices at the places 0, 1, 2.
    pub order: [Signal<'m>; 3],
    /// Round of channels, or the edge; none where a lane has one of each.
    pub number: Option<Signal<'m>>,
    /// Lanes have edges of their own.
    pub beside: Option<Signal<'m>>,
    /// The upper and the lower part have lines.
    pub walked: [Signal<'m>; 2],
    /// Doublings that are left.
    pub count: Signal<'m>,
    /// The doublings are those of a channel.
    pub of_channels: Signal<'m>,
}

impl<'m> Control<'m> {
    /// The registers with their updates.
    pub fn new(parts: &Parts<'_, 'm>, digits: &Digits<'m>, prim_ready: Signal<'m>) -> Control<'m> {
        let Parts { m, plan, program, word, runs, .. } = parts;
        m.comment("Counters and flags.");
        let flag = |name: &str, doc: &str| m.reg(name, 1).doc(doc);
        let does = |act: Act| word.does(act) & *runs;
        let full = flag("full", "a triangle is there, and worked on").reset(0);
        let prim_there = flag("prim_there", "a prim is offered").reset(0);
        let done = does(Act::Done).named("done");
        let drops = [Drop::Lines, Drop::Columns, Drop::Area].map(|drop| does(Act::Drop(drop)));
        full.when(drops.into_iter().fold(done, |any, drop| any | drop), 0);
        prim_there.when(prim_ready, 0).when(done, 1);
        let leaves = flag("leaves", "the prim is offered for the first time").reset(0).set(done).q();
        let idle = (!full.q() & !leaves).named("idle");

        let negative = parts.of_lane(0, "is_negative");
        let right = flag("right", "the major edge lies right").when(does(Act::Side), negative).q();
        let upper = flag("upper", "the upper part has lines").when(does(Act::Upper), !negative).q();
        let lower = flag("lower", "the lower part has lines").when(does(Act::Lower), !negative).q();
        let beside = edges_are_beside(plan).then(|| {
            let beside = flag("beside", "lanes have edges of their own").reset(0);
            beside.when(does(Act::Beside), 1).when(does(Act::Alone), 0).q()
        });
        let order = order(parts, negative);
        let number = number(parts, &does);

        let counts = |lane: usize| counts(beside, [upper, lower], lane);
        let zero = digits.are_zero(counts).named_doc("zero", "both digits are 0");
        digits.update(parts, zero, counts);
        let unfit = unfit(parts, beside, [upper, lower]);
        let (count, of_channels) = count(parts, &does, number);

        m.comment("The next word.");
        let place = m.reg("place", place_bits(program)).doc("of the word that is executed");
        let behind = (place.q() + 1).named("behind");
        let link = m.reg("link", place_bits(program)).doc("of the word behind the call");
        link.when(word.jumps(Jump::Call), behind);
        let is = |jump: Jump| word.jumps(jump);
        let last = digits.is_last;
        let repeats = (is(Jump::Words) & !full.q())
            | (is(Jump::Room) & prim_there.q())
            | (is(Jump::Settle) & digits.are_unsettled())
            | (is(Jump::Digits) & !last)
            | (is(Jump::Again) & !count.eq(1))
            | (is(Jump::Zeros) & zero & !last);
        let jumps = is(Jump::Goto)
            | is(Jump::Call)
            | (is(Jump::Zeros) & zero & last)
            | (is(Jump::More) & !last)
            | (is(Jump::Negative) & negative)
            | (is(Jump::Unfit) & unfit)
            | (is(Jump::NoUpper) & !upper)
            | (is(Jump::NoLower) & !lower);
        let jumps = number.map_or(jumps, |number| jumps | (is(Jump::Rounds) & number.any()));
        let (repeats, jumps) = (repeats.named("repeats"), jumps.named("jumps"));
        let other = is(Jump::Return).mux(link.q(), jumps.mux(word.get("target"), behind));
        let next = repeats.mux(place.q(), other) & runs.sext(place_bits(program));
        place.set(next);
        Control {
            next,
            full,
            prim_there: prim_there.q(),
            done,
            idle,
            right,
            order,
            number,
            beside,
            walked: [upper, lower],
            count,
            of_channels,
        }
    }

    /// The edge of a lane.
    pub fn edge(&self, parts: &Parts<'_, 'm>, lane: usize) -> Signal<'m> {
        let number = self.number.map_or(parts.m.lit(2, 0), |number| number.trunc(2));
        match self.beside {
            Some(beside) => beside.mux(parts.m.lit(2, lane as u128 & 3), number),
            None => number,
        }
    }
}

/// A lane's digits and numbers count: `None` is always.
fn counts<'m>(beside: Option<Signal<'m>>, walked: [Signal<'m>; 2], lane: usize) -> Option<Signal<'m>> {
    match (lane, beside) {
        (1 | 2, Some(beside)) => Some(beside & walked[lane - 1]),
        _ => None,
    }
}

/// Numbers of the vertices at the places 0, 1, 2.
fn order<'m>(parts: &Parts<'_, 'm>, negative: Signal<'m>) -> [Signal<'m>; 3] {
    let Parts { m, word, .. } = parts;
    let places = [0, 1, 2].map(|place| m.reg(&format!("place{place}"), 2).doc("number of the vertex there"));
    for (number, place) in places.iter().enumerate() {
        place.when(word.does(Act::Unsorted), number as u128);
    }
    for (act, first) in [(Act::Swap01, 0), (Act::Swap12, 1)] {
        let swaps = word.does(act) & negative;
        let [a, b] = [places[first], places[first + 1]];
        a.when(swaps, b.q());
        b.when(swaps, a.q());
    }
    places.map(Reg::q)
}

/// Round of channels, or the edge.
fn number<'m>(parts: &Parts<'_, 'm>, does: &impl Fn(Act) -> Signal<'m>) -> Option<Signal<'m>> {
    let rounds = rounds(parts.plan) as u128;
    if edges_are_beside(parts.plan) && rounds == 1 {
        return None;
    }
    let number = parts.m.reg("number", 3).doc("of the round of channels, or of the edge");
    number.when(does(Act::LastRound), rounds - 1);
    for (edge, act) in [0u8, 1, 2].map(|edge| (edge, Act::Edge(edge))) {
        number.when(does(act), u128::from(edge));
    }
    number.when(does(Act::Beside), 0);
    number.when(parts.word.jumps(Jump::Rounds) & number.q().any(), number.q() - 1);
    Some(number.q())
}

/// A checked number does not fit.
fn unfit<'m>(parts: &Parts<'_, 'm>, beside: Option<Signal<'m>>, walked: [Signal<'m>; 2]) -> Signal<'m> {
    let checks = parts.later("checks", parts.word.does(Act::Check));
    let checked = parts.later("checked", checks);
    let of_lane = |lane: usize| {
        let stays = parts.of_lane(lane, "stays");
        match (lane, beside) {
            (0, _) | (_, None) => stays,
            (3, Some(beside)) => stays & !beside,
            (_, Some(beside)) => stays & (!beside | walked[lane - 1]),
        }
    };
    let any = (0..parts.lanes.len()).map(of_lane).reduce(|any, one| any | one).unwrap_or(checked);
    let unfit = parts.m.reg("unfit", 1).doc("a checked number does not fit");
    unfit.when(checked & any, 1).when(parts.word.does(Act::Judge), 0).q()
}

/// Doublings that are left, and whether they are a channel's.
fn count<'m>(
    parts: &Parts<'_, 'm>,
    does: &impl Fn(Act) -> Signal<'m>,
    number: Option<Signal<'m>>,
) -> (Signal<'m>, Signal<'m>) {
    const BITS: u32 = 7;
    let Parts { m, plan, word, .. } = parts;
    let scale = m.reg("scale", BITS).doc("i: the modulus of channels is the area times 2^i");
    scale.when(does(Act::LastRound), 0).when(does(Act::Scale), scale.q() + 3);
    let rounds = most_doublings(plan);
    let of = |doublings: u32| m.lit(BITS, doublings.into());
    let mut most = of(rounds[0]);
    for (round, doublings) in rounds.iter().enumerate().skip(1).filter(|(_, other)| **other != rounds[0]) {
        most = number.map_or(most, |number| number.eq(round as u128).mux(of(*doublings), most));
    }
    let count = m.reg("count", BITS).doc("doublings that are left");
    count.when(word.jumps(Jump::Again), count.q() - 1);
    let t = plan.widths().center_fraction;
    let of_edges = match plan.edge_kind {
        EdgeKind::Exact => vec![(Act::TimesT, t)],
        EdgeKind::Slope => {
            vec![(Act::TimesT, t), (Act::TimesF, plan.edge_fraction), (Act::TimesTf, t + plan.edge_fraction)]
        }
    };
    for (act, doublings) in &of_edges {
        count.when(word.does(*act), u128::from(*doublings));
    }
    count.when(word.does(Act::TimesK), most + scale.q());
    let of_channels = m.reg("of_channels", 1).doc("they are a channel's");
    for (act, _) in of_edges {
        of_channels.when(word.does(act), 0);
    }
    of_channels.when(word.does(Act::TimesK), 1);
    (count.q(), of_channels.q())
}
