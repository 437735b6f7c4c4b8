//! Colours of a span, from its left edge to its right one: a division of a bit a clock, and sums beside it.

use edgewalk_machine::{COLOURS, Plan};
use edgewalk_netlist::{Module, Signal};

use super::pass::Pair;
use crate::wires::Registers;

/// What is known of a span.
pub(super) struct Span<'m> {
    pub pair: Pair<'m>,
    /// MOVER takes the pair.
    pub takes: Signal<'m>,
    /// The values of planes stand at its first pixel.
    pub there: Signal<'m>,
    /// SPAN takes the span.
    pub fires: Signal<'m>,
    /// PIXEL has not loaded the increments of the span before.
    pub fresh_queued: Signal<'m>,
}

/// The colours of the span that MOVER has.
pub(super) struct Between<'m> {
    /// The span is offered.
    pub offers: Signal<'m>,
    /// The span is offered from the next clock on.
    grants: Signal<'m>,
    /// The sums are those of the first pixel.
    moves: Signal<'m>,
    /// For each colour: the left edge's value, and the addend, which is also given as the increment.
    colours: [(Signal<'m>, Signal<'m>); 3],
}

impl<'m> Between<'m> {
    /// None where colours are planes.
    pub fn new(m: &'m Module, plan: &Plan, span: &Span<'m>) -> Option<Between<'m>> {
        let [left, right] = span.pair.ends?;
        m.comment(
            "Colours from edge to edge. Digits of the place of the first pixel, over the width between the edges; then those of a pixel. Each sum is the colours' difference times the digits so far.",
        );
        let Span { pair, takes, there, fires, fresh_queued } = *span;
        let channel = plan.channels()[COLOURS.start];
        let (word, fraction) = (channel.word(), plan.edge_fraction);
        let (k, bits) = (word + 1, left.key.width());
        let dividing = m.reg("dividing", 1).doc("digits are found").reset(0);
        let turns = m.reg("turns", (2 * k).ilog2() + 1).doc("digits found");
        let is = |turn: u32| turns.q().eq(turn as i32);
        let last = is(2 * k - 1);
        turns.when(dividing.q(), turns.q() + 1).when(takes, 0);
        dividing.when(last, 0).when(takes, 1);
        let summing = m.reg("summing", 1).doc("the digit found last is summed").reset(0);
        summing.set(dividing.q());

        let apart =
            m.reg("apart", bits).doc("from edge to edge, 2^-F px").when(takes, right.key - left.key).q();
        let first = m.cat(&[pair.first, m.lit(fraction, (1 << fraction) - 1)]);
        let into = (first - left.key).named_doc("into", "from the left edge to the first pixel, 2^-F px");
        let rest = m.reg("apart_rest", bits).doc("what is left over of the division");
        let doubled = rest.q().zext(bits + 2).shl(1);
        let less = (doubled - apart.zext(bits + 2)).named("less_apart");
        let digit = (!less.msb()).named("digit");
        let found = m.reg("last_digit", 1).set(digit).q();
        let pixel = m.lit(bits, 1 << fraction);
        let wide = apart.gt(pixel).named_doc("wide", "the edges are more than a pixel apart");
        let second =
            m.reg("second_digits", 1).doc("those of a pixel follow").set(dividing.q() & is(k - 2)).q();
        let turned = second.mux(wide.mux(pixel, 0), digit.mux(less, doubled).trunc(bits));
        rest.when(dividing.q(), turned).when(takes, into);

        let restarts = m.reg("second_sum", 1).doc("the sums of a pixel begin").set(dividing.q() & is(k)).q();
        let moves = (summing.q() & restarts).named_doc("starts", "the sums are those of the first pixel");
        let colour = |colour: usize| {
            let name = plan.channels()[COLOURS.start + colour].name;
            let [from, to] = [left.colours[colour], right.colours[colour]];
            let difference = m
                .reg(&format!("{name}_difference"), k)
                .doc("of the right and the left edge, signed")
                .when(takes, to.zext(k) - from.zext(k))
                .q();
            let sum = m.reg(&format!("{name}_sum"), 2 * k).doc("times the digits so far, signed");
            let so_far = restarts.mux(0, sum.q().shl(1));
            let added = difference.sext(2 * k) & found.sext(2 * k);
            sum.when(summing.q(), so_far + added).when(takes, 0);
            let rounded = sum.q().slice(k + word - 1, k) + sum.q().bit(k - 1).zext(word);
            (from, rounded.named(&format!("{name}_part")))
        };
        let colours = [0, 1, 2].map(colour);
        let offers = m.reg("offers", 1).doc("the span is offered").reset(0);
        let grants = there & !dividing.q() & !summing.q() & !offers.q() & !fresh_queued;
        let grants = grants.named_doc("grants", "its increments are shown, and it is offered");
        offers.when(fires, 0).when(grants, 1);
        Some(Between { offers: offers.q(), grants, moves, colours })
    }

    /// Drives the colours of the line, and their increments.
    pub fn connect(&self, plan: &Plan, takes: Signal<'m>, line: &Registers<'m>, increments: &Registers<'m>) {
        for (channel, (from, part)) in plan.channels()[COLOURS].iter().zip(self.colours) {
            let value = line[channel.name];
            value.when(self.moves, value.q() + part).when(takes, from);
            increments[channel.name].when(self.grants, part);
        }
    }
}
