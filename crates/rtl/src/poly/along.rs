//! Colours along the edges of a polygon: the value on an edge's first line, and the step of a line.

use edgewalk_machine::{COLOURS, Plan};
use edgewalk_netlist::{Module, Reg, Signal};

/// When the colours of an edge are found.
pub(super) struct Finds<'m> {
    /// An edge waits for its colours.
    seeks: Signal<'m>,
    /// The colours are there.
    pub found: Reg<'m>,
}

/// Lengths of the edge, 1/P line.
pub(super) struct Lengths<'m> {
    /// From its upper to its lower end.
    pub height: Signal<'m>,
    /// From its upper end to its first line.
    pub down: Signal<'m>,
}

/// The steps of a search, each from its first clock on.
struct Clocks {
    /// The differences of the ends' values by 1/M, after their sign.
    store: u32,
    /// The differences are multiplied by the distance down to the first line.
    sum: u32,
    double: u32,
    /// The value is rounded.
    value: u32,
    /// The step is rounded: the last clock.
    step: u32,
}

impl Clocks {
    fn new(plan: &Plan) -> Clocks {
        let (w, colour) = (plan.widths(), plan.channels()[COLOURS.start]);
        let up = colour.fraction - colour.vertex_fraction;
        let store = 1 + colour.vertex_bits();
        let sum = store + 1;
        let double = sum + w.difference - 1;
        let value = double + up;
        Clocks { store, sum, double, value, step: value + 1 + w.center_fraction + up }
    }
}

impl<'m> Finds<'m> {
    /// Without updates; none where no colours run along edges.
    pub fn new(m: &'m Module, bilinear: bool, side_left: Signal<'m>) -> Option<Finds<'m>> {
        if !bilinear {
            return None;
        }
        let found = m.reg("found", 1).doc("the colours of the edge are found").reset(0);
        let seeks = (side_left & !found.q()).named_doc("seeks", "colours of an edge are not found yet");
        Some(Finds { seeks, found })
    }

    /// Value and step of each colour; `ends` are those at the upper and the lower end of the edge.
    pub fn colours(
        &self,
        m: &'m Module,
        plan: &Plan,
        lengths: &Lengths<'m>,
        ends: &dyn Fn(&str) -> [Signal<'m>; 2],
    ) -> Vec<(Signal<'m>, Signal<'m>)> {
        m.comment(
            "Colours along an edge: pairs, whole and rest, of the modulus M, its height. First the difference of its ends over M, a digit a clock.",
        );
        let clocks = Clocks::new(plan);
        let at = m.reg("seek_at", clocks.step.ilog2() + 1).doc("clocks of the search so far").reset(0);
        let is = |clock: u32| at.q().eq(clock as i32);
        let (begins, stores) = (is(0).named("seek_begins"), is(clocks.store).named("pair_stored"));
        let (value_is, step_is) =
            (is(clocks.value).named("value_found"), is(clocks.step).named("step_found"));
        at.when(self.seeks, step_is.mux(0, at.q() + 1));
        self.found.when(self.seeks & step_is, 1);
        let sums = (at.q().ge(clocks.sum as i32) & at.q().lt(clocks.double as i32)).named("sums_down");
        let bits = lengths.height.width();
        let down =
            m.reg("down_digits", bits).doc("digits of the lines down that are left, the highest first");
        down.when(self.seeks, stores.mux(lengths.down, down.q().shl(1)));
        let adds = (sums & down.q().msb()).named("adds_pair");
        let digits = at.q().lt(clocks.store as i32).named("takes_digits");

        let colours = &plan.channels()[COLOURS];
        let colour = |colour: &edgewalk_machine::Channel| {
            let name = |part: &str| format!("{}_{part}", colour.name);
            let (word, taken) = (colour.word(), colour.vertex_bits());
            let [upper, lower] = ends(colour.name);
            let less = (lower.zext(taken + 1) - upper.zext(taken + 1)).named(&name("rise"));
            let digit = m.reg(&name("digits"), taken).doc("digits of the difference that are left");
            digit.when(self.seeks, begins.mux(less.trunc(taken), digit.q().shl(1)));
            let register = |part: &str, bits: u32, doc: &str| m.reg(&name(part), bits).doc(doc);
            let whole = register("whole", word, "whole part of the pair, 2^-r LSB at last");
            let rest = register("rest", bits, "what is left over, in 1/M");
            let pair_whole = register("pair_whole", word, "the difference over M: whole part");
            let pair_rest = register("pair_rest", bits, "what is left over");

            let modulus = lengths.height.zext(bits + 3);
            let added = (digits & digit.q().msb()).zext(bits) | (pair_rest.q() & adds.sext(bits));
            let doubled = (rest.q().zext(bits + 3).shl(1) + added.zext(bits + 3)).named(&name("doubled"));
            let less_one = (doubled - modulus).named(&name("less_one"));
            let less_two = (doubled - modulus.shl(1)).named(&name("less_two"));
            let (one, two) = (!less_one.msb(), !less_two.msb());
            let left = two.mux(less_two, one.mux(less_one, doubled)).trunc(bits);
            let carried = m.cat(&[two, one & !two]).zext(word);
            let both = whole.q().shl(1) + (pair_whole.q() & adds.sext(word)) + carried;
            let rounded = (whole.q() + one.zext(word)).named(&name("rounded"));
            let negative = less.msb();
            let (zero, ends) = (stores, value_is);
            whole.when(
                self.seeks,
                begins.mux(negative.sext(word), zero.mux(0, ends.mux(pair_whole.q(), both))),
            );
            let before = negative.mux(lengths.height - 1, m.lit(bits, 0));
            rest.when(self.seeks, begins.mux(before, zero.mux(0, ends.mux(pair_rest.q(), left))));
            pair_whole.when(self.seeks & stores, whole.q());
            pair_rest.when(self.seeks & stores, rest.q());

            let up = colour.fraction - colour.vertex_fraction;
            let base = upper.zext(word).shl(up);
            let half = 1u128 << colour.fraction >> 1;
            let value = (rounded + base + m.lit(word, half)).named(&name("first"));
            let value = register("edge_value", word, "on the edge's first line, 2^-r LSB")
                .when(self.seeks & value_is, value);
            let step = register("edge_step", word, "to the next line").when(self.seeks & step_is, rounded);
            (value.q(), step.q())
        };
        colours.iter().map(colour).collect()
    }
}
