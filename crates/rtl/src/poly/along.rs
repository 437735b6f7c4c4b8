//! Colours along the edges of a polygon: the value on an edge's first line, and the step of a line.

use edgewalk_machine::{COLOURS, Plan};
use edgewalk_netlist::{Module, Reg, Signal};

use crate::wires::plus;

/// When the colours of an edge are found.
pub(super) struct Finds<'m> {
    /// An edge waits for its colours.
    seeks: Signal<'m>,
    /// The colours are there.
    pub found: Reg<'m>,
}

/// Lengths of the edge, in 1/2^t px; t are the fraction bits of centre coordinates.
pub(super) struct Lengths<'m> {
    /// From its upper to its lower end.
    pub height: Signal<'m>,
    /// From its upper end to its first line.
    pub down: Signal<'m>,
}

/// The steps of a search, each from its first clock on. Whole parts follow their rests a clock later.
struct Clocks {
    /// The pair of the ends' difference over M is stored. Sums follow, over the distance down to the first line.
    store: u32,
    /// The sums are over, and are doubled.
    double: u32,
    /// The value is rounded.
    value: u32,
    /// The step is rounded; the last clock follows.
    step: u32,
}

impl Clocks {
    fn new(plan: &Plan) -> Clocks {
        let (w, colour) = (plan.widths(), plan.channels()[COLOURS.start]);
        let up = colour.fraction - colour.vertex_fraction;
        let store = 2 + colour.vertex_bits();
        let double = store + w.difference;
        let value = double + up;
        Clocks { store, double, value, step: value + 1 + w.center_fraction + up }
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
        let last = clocks.step + 1;
        let at = m.reg("seek_at", last.ilog2() + 1).doc("clocks of the search so far").reset(0);
        let is = |clock: u32| at.q().eq(clock as i32);
        let (reads, begins) = (is(0).named("seek_reads"), is(1).named("seek_begins"));
        let (stores, value_is) =
            (is(clocks.store).named("pair_stored"), is(clocks.value).named("value_found"));
        let (begins_late, stores_late) =
            (is(2).named("whole_begins"), is(clocks.store + 1).named("whole_stored"));
        let value_late = is(clocks.value + 1).named("whole_of_value");
        let ended = is(last).named("step_found");
        at.when(self.seeks, ended.mux(0, at.q() + 1));
        self.found.when(self.seeks & ended, 1);
        let reads = (self.seeks & reads).named("reads_edge");
        let kept = |name: &str, value: Signal<'m>, doc: &str| {
            m.reg(name, value.width()).doc(doc).when(reads, value).q()
        };
        let height = kept("height", lengths.height, "of the edge");
        // What is added is chosen a clock ahead.
        let sums = (at.q().ge(clocks.store as i32) & at.q().lt(clocks.double as i32 - 1)).named("sums_down");
        let bits = height.width();
        let whole_way = kept("down_way", lengths.down, "from the upper end to the first line");
        let down =
            m.reg("down_digits", bits).doc("digits of the lines down that are left, the highest first");
        down.when(self.seeks, stores.mux(whole_way, down.q().shl(1)));
        let adds = (sums & stores.mux(whole_way.msb(), down.q().bit(bits - 2))).named("adds_pair");
        let adds_rest = m.reg("adds_rest", 1).doc("the pair's rest is added").when(self.seeks, adds).q();
        let adds_late = m.reg("adds_whole", 1).doc("its whole part is added").when(self.seeks, adds_rest).q();
        let digits = at.q().lt(clocks.store as i32 - 1).named("takes_digits");

        let colours = &plan.channels()[COLOURS];
        let colour = |colour: &edgewalk_machine::Channel| {
            let name = |part: &str| format!("{}_{part}", colour.name);
            let (word, taken) = (colour.word(), colour.vertex_bits());
            let [upper, lower] = ends(colour.name);
            let upper = kept(&name("from"), upper, "at the upper end");
            let lower = kept(&name("to"), lower, "at the lower end");
            let less = (lower.zext(taken + 1) - upper.zext(taken + 1)).named(&name("rise"));
            let digit = m.reg(&name("digits"), taken).doc("digits of the difference that are left");
            let digits_left = begins.mux(less.trunc(taken), digit.q().shl(1));
            digit.when(self.seeks, digits_left);
            let register = |part: &str, bits: u32, doc: &str| m.reg(&name(part), bits).doc(doc);
            let whole = register("whole", word, "whole part of the pair, 2^-r LSB at last");
            let rest = register("rest", bits, "what is left over, in 1/M");
            let pair_whole = register("pair_whole", word, "the difference over M: whole part");
            let pair_rest = register("pair_rest", bits, "what is left over");

            // M and 2 M are taken away side by side.
            let twice = rest.q().zext(bits + 3).shl(1);
            let pair = stores.mux(rest.q(), pair_rest.q()) & adds.sext(bits);
            let added = (digits & digits_left.msb()).zext(bits) | pair;
            let added = register("added", bits, "a digit, or the pair's rest").when(self.seeks, added);
            let added = added.q().zext(bits + 3);
            let doubled = (twice + added).named(&name("doubled"));
            let modulus = height.zext(bits + 3);
            let less_one = less_than(&name("less_one"), twice, added, modulus);
            let less_two = less_than(&name("less_two"), twice, added, modulus.shl(1));
            let (one, two) = (!less_one.msb(), !less_two.msb());
            let left = two.mux(less_two, one.mux(less_one, doubled)).trunc(bits);
            let flag = |part: &str, value: Signal<'m>, doc: &str| {
                m.reg(&name(part), 1).doc(doc).when(self.seeks, value).q()
            };
            let (one, two) = (flag("one", one, "M was in the rest"), flag("two", two, "2 M were in it"));
            let carried = m.cat(&[two, one & !two]).zext(word);
            let both = whole.q().shl(1) + (pair_whole.q() & adds_late.sext(word)) + carried;
            let negative = less.msb();
            whole.when(
                self.seeks,
                begins_late
                    .mux(negative.sext(word), stores_late.mux(0, value_late.mux(pair_whole.q(), both))),
            );
            let before = negative.mux(height - 1, m.lit(bits, 0));
            rest.when(self.seeks, begins.mux(before, stores.mux(0, value_is.mux(pair_rest.q(), left))));
            pair_whole.when(self.seeks & stores_late, whole.q());
            pair_rest.when(self.seeks & stores, rest.q());

            let up = colour.fraction - colour.vertex_fraction;
            let half = 1u128 << colour.fraction >> 1;
            let base = (upper.zext(word).shl(up) + m.lit(word, half)).named(&name("base"));
            let value = plus(&name("first"), whole.q(), base, one);
            let value = register("edge_value", word, "on the edge's first line, 2^-r LSB")
                .when(self.seeks & value_late, value);
            let rounded = (whole.q() + one.zext(word)).named(&name("rounded"));
            let step = register("edge_step", word, "to the next line").when(self.seeks & ended, rounded);
            (value.q(), step.q())
        };
        colours.iter().map(colour).collect()
    }
}

/// a + b - c, by a sum and carries of each digit and one addition.
fn less_than<'m>(name: &str, a: Signal<'m>, b: Signal<'m>, c: Signal<'m>) -> Signal<'m> {
    let (m, c) = (a.module(), !c);
    let digits = (a ^ b ^ c).named(&format!("{name}_digits"));
    let carries = ((a & b) | (a & c) | (b & c)).named(&format!("{name}_carries"));
    (digits + m.cat(&[carries.trunc(a.width() - 1), m.lit(1, 1)])).named(name)
}
