//! Which word comes next, and the counters and flags that say so.

use edgewalk_machine::sequencer::edges_are_beside;
use edgewalk_netlist::{Reg, Signal};

use super::Parts;
use super::code::{Deed, Jump, place_bits};
use super::digits::Digits;
use super::shape::most_doublings;

/// Counters and flags.
pub(super) struct Control<'m> {
    /// Place of the word that comes next.
    pub next: Signal<'m>,
    /// A triangle is there, and worked on.
    pub full: Reg<'m>,
    pub prim_there: Signal<'m>,
    /// Words are taken.
    pub idle: Signal<'m>,
    /// The major edge lies right.
    pub right: Signal<'m>,
    /// Numbers of the vertices at the places 0, 1, 2.
    pub order: [Signal<'m>; 3],
    /// Round of channels, or the edge.
    pub number: Signal<'m>,
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
        let does = |deed: Deed| word.does(deed) & *runs;
        let full = flag("full", "a triangle is there, and worked on").reset(0);
        let prim_there = flag("prim_there", "the prim waits for EDGE").reset(0);
        let done = does(Deed::Done).named("done");
        full.when(done | does(Deed::Drop), 0);
        prim_there.when(prim_ready, 0).when(done, 1);
        let idle = (!full.q() & !prim_there.q()).named("idle");

        let negative = parts.of_lane(0, "is_negative");
        let right = flag("right", "the major edge lies right").when(does(Deed::Side), negative).q();
        let upper = flag("upper", "the upper part has lines").when(does(Deed::Upper), !negative).q();
        let lower = flag("lower", "the lower part has lines").when(does(Deed::Lower), !negative).q();
        let beside = edges_are_beside(plan).then(|| {
            let beside = flag("beside", "lanes have edges of their own").reset(0);
            beside.when(does(Deed::Beside), 1).when(does(Deed::Alone), 0).q()
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
            | (is(Jump::NoLower) & !lower)
            | (is(Jump::Rounds) & number.any());
        let (repeats, jumps) = (repeats.named("repeats"), jumps.named("jumps"));
        let other = is(Jump::Return).mux(link.q(), jumps.mux(word.get("target"), behind));
        let next = repeats.mux(place.q(), other) & runs.sext(place_bits(program));
        place.set(next);
        Control {
            next,
            full,
            prim_there: prim_there.q(),
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
        let number = self.number.trunc(2);
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
        place.when(word.does(Deed::Unsorted), number as u128);
    }
    for (deed, first) in [(Deed::Swap01, 0), (Deed::Swap12, 1)] {
        let swaps = word.does(deed) & negative;
        let [a, b] = [places[first], places[first + 1]];
        a.when(swaps, b.q());
        b.when(swaps, a.q());
    }
    places.map(Reg::q)
}

/// Round of channels, or the edge.
fn number<'m>(parts: &Parts<'_, 'm>, does: &impl Fn(Deed) -> Signal<'m>) -> Signal<'m> {
    let rounds = most_doublings(parts.plan).len() as u128;
    let number = parts.m.reg("number", 3).doc("of the round of channels, or of the edge");
    number.when(does(Deed::LastRound), rounds - 1);
    for (edge, deed) in [Deed::Edge0, Deed::Edge1, Deed::Edge2].into_iter().enumerate() {
        number.when(does(deed), edge as u128);
    }
    number.when(parts.word.jumps(Jump::Rounds) & number.q().any(), number.q() - 1).q()
}

/// A checked number does not fit.
fn unfit<'m>(parts: &Parts<'_, 'm>, beside: Option<Signal<'m>>, walked: [Signal<'m>; 2]) -> Signal<'m> {
    let checks = parts.later("checks", parts.word.does(Deed::Check));
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
    unfit.when(checked & any, 1).when(parts.word.does(Deed::Judge), 0).q()
}

/// Doublings that are left, and whether they are a channel's.
fn count<'m>(
    parts: &Parts<'_, 'm>,
    does: &impl Fn(Deed) -> Signal<'m>,
    number: Signal<'m>,
) -> (Signal<'m>, Signal<'m>) {
    const BITS: u32 = 7;
    let Parts { m, plan, word, .. } = parts;
    let scale = m.reg("scale", BITS).doc("i: the modulus of channels is the area times 2^i");
    scale.when(does(Deed::LastRound), 0).when(does(Deed::Scale), scale.q() + 3);
    let rounds = most_doublings(plan);
    let of = |doublings: u32| m.lit(BITS, doublings.into());
    let mut most = of(rounds[0]);
    for (round, doublings) in rounds.iter().enumerate().skip(1).filter(|(_, other)| **other != rounds[0]) {
        most = number.eq(round as u128).mux(of(*doublings), most);
    }
    let count = m.reg("count", BITS).doc("doublings that are left");
    count.when(word.jumps(Jump::Again), count.q() - 1);
    count.when(word.does(Deed::TimesT), u128::from(plan.widths().center_fraction));
    count.when(word.does(Deed::TimesK), most + scale.q());
    let of_channels = m.reg("of_channels", 1).doc("they are a channel's");
    of_channels.when(word.does(Deed::TimesT), 0).when(word.does(Deed::TimesK), 1);
    (count.q(), of_channels.q())
}
