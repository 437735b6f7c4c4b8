//! One lane: holds a pair and moves it a step a clock.

use std::sync::Arc;

use edgewalk_machine::{Channel, EdgeKind, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use super::area::area_bits;
use super::steps::{Step, longest_value};

/// Word lengths of a lane, bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    /// What it takes in, signed.
    pub number: u32,
    /// The whole part, modular.
    pub whole: u32,
    /// The modulus, negated. It is longer than what is taken in; the remainder part has no sign.
    pub modulus: u32,
}

impl Shape {
    /// Of a lane for these channels, and for edges.
    pub fn new(plan: &Plan, channels: &[Channel]) -> Shape {
        let w = plan.widths();
        let of_edge = match plan.edge_kind {
            EdgeKind::Exact => w.column,
            EdgeKind::Slope => w.column + plan.edge_fraction,
        };
        let values = channels.iter().map(|c| c.vertex_bits() + 1).max().unwrap_or(1);
        let words = channels.iter().map(|c| c.word() + w.center_fraction).max().unwrap_or(1);
        Shape { number: w.difference.max(values), whole: of_edge.max(words), modulus: modulus_bits(plan) }
    }
}

/// Bits of the modulus, negated: P·DY, the area, or up to four times the longest difference of values.
pub(super) fn modulus_bits(plan: &Plan) -> u32 {
    area_bits(plan).max(longest_value(plan) + 4)
}

const DOC: &str = "A lane of setup holds a pair: the number whole + rest / M, with 0 <= rest < M.

  slots ─> a ─> [n0 n1 n2 = a, a - M, a - 2M] ─┐
                                 x = rest * 1 2 4 ─> + ─> the last sum not below 0 ─> [rest]
                                                          how often M was taken off ─> [whole], a clock later

Timing: a step is named two clocks before it is done: in the first its addend is read, in the second n0 n1 n2 are formed.
Rules: a doubling step adds a = -M three times instead, so that up to 3 M can be taken off. To a number below 0 that is taken in
M is added, and -1 is its whole part. So it is with a pair that is subtracted: M - a is added, and the complement of its whole part.";

/// The netlist of a lane.
pub(super) fn lane(name: &str, shape: Shape) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new(name, DOC);
    let below_two_m = shape.modulus; // M has a bit less; room for a sign
    let (sums, slot) = (below_two_m + 1, below_two_m - 1);

    let read_at = m.input_doc("read_at", 3, "slot of the addend, two clocks before its step");
    let step = m.input_doc("step", Step::BITS, "a clock before it is done");
    let number = m.input_doc("number", shape.number, "to take in, signed; with its step");
    let digits =
        m.input_doc("digits", 2, "of a number that does not fit, or its sign twice; with their step");
    let write = m.input_doc("write", 1, "the result of the step goes to a slot");
    let write_at = m.input("write_at", 3);
    let whole_in =
        m.input_doc("whole_in", shape.whole, "whole number to add to a result, a clock before value");
    let take_modulus = m.input_doc("take_modulus", 1, "two clocks before the first step with it");
    let modulus_in = m.input_doc("modulus_in", below_two_m, "-M, or -M - 1 if modulus_short; signed");
    let modulus_short = m.input("modulus_short", 1);
    let give = m.input_doc("give", 1, "an operation has ended: value is its result, a clock later");
    let nearest =
        m.input_doc("nearest", 1, "value is rounded to nearest, halves up; a clock before it, with rest_out");
    let upwards = m.input_doc("upwards", 1, "else: up; if not, it is cut");
    let negate = m.input_doc("negate", 1, "value is negated, once it is rounded");

    m.comment("The modulus: -M, or its complement -M - 1, with the 1 that is then missing.");
    let modulus =
        m.reg("modulus", below_two_m).doc("-M or -M - 1, signed").when(take_modulus, modulus_in).q();
    let short = m.reg("short", 1).doc("1 is missing in modulus").when(take_modulus, modulus_short).q();

    m.comment("The rests of the slots. Slot 0 is never written: it holds 0.");
    let rest = m.reg("rest", slot).doc("1/M");
    let rest_next = m.wire("rest_next", slot);
    let rests = m.memory("rests", 3, 8, slot).starts(0).doc("1/M").write(write, write_at, rest_next.q());
    let stored = rests.read(apart(write, write_at, read_at), read_at);

    m.comment("The addend of the step that follows.");
    let n0 = m.reg("n0", below_two_m).doc("a, or M - a");
    let n1 = m.reg("n1", below_two_m + 1).doc("a - M, signed");
    let n2 = m.reg("n2", below_two_m).doc("a - 2 M, modular");
    let of_slot = step.bit(4).named("of_slot");
    let take_modulus_off = step.bit(3).named("take_modulus_off");
    let subtracts = (step.bit(1) & step.bit(0)).named("subtracts");
    let a = take_modulus_off
        .mux(modulus, of_slot.mux(stored.zext(below_two_m), 0))
        .named_doc("a", "addend, 1/M, or -M");
    let less_m = plus("a_less_m", a.sext(sums), modulus.sext(sums), short);
    n0.set(subtracts.mux(!less_m.trunc(below_two_m), a));
    n1.set(less_m);
    let twice = m.cat(&[modulus, short]).named_doc("less_2m", "-2 M, or -2 M - 1");
    n2.set(plus("a_less_2m", a, twice.trunc(below_two_m), short));
    let carry0 = m.reg("carry0", 1).doc("1 to add to the sum of n0");
    // Of a number that does not fit the sign stands for -1: M - 1.
    carry0.set((subtracts & !is(step, Step::Begin)) | (take_modulus_off & short));
    let carry = m.reg("carry", 1).doc("1 to add to the other sums").set(take_modulus_off & short);

    m.comment("The step: x and the addend, less M as often as it goes.");
    let now = m.reg("now", Step::BITS).doc("the step done").set(step).q();
    let fourfold = flag(&m, "fourfold", one_of(step, &[Step::Double2, Step::Digits]));
    let twofold = flag(&m, "twofold", one_of(step, &[Step::Double1, Step::Next]));
    let keeps = flag(&m, "keeps", one_of(step, &[Step::Rest, Step::Add]));
    let takes = flag(&m, "takes", one_of(step, &[Step::Take, Step::Begin]));
    let added = m.reg("added", shape.number).doc("number or digits taken in, 0 where there are none");
    let of_digits = is(step, Step::Digits).mux(digits.zext(shape.number), 0);
    added.set(is(step, Step::Take).mux(number, of_digits));
    let sign = (is(step, Step::Take) & number.msb()) | (is(step, Step::Begin) & digits.msb());
    let below = m.reg("below", 1).doc("what is taken in is below 0").set(sign).q();
    let old = rest.q().zext(sums);
    let times = fourfold.mux(old.shl(2), twofold.mux(old.shl(1), 0));
    let x = (times | (old & repeat(keeps, sums)) | added.q().sext(sums)).named("x");
    let s0 = plus("x_and_n0", x.trunc(below_two_m), n0.q(), carry0.q()).named("s0");
    let s1 = plus("x_and_n1", x, n1.q(), carry.q()).named("s1");
    let s2 = plus("x_and_n2", x.trunc(below_two_m), n2.q(), carry.q()).named("s2");
    // A fourfold rest may have M taken off three times, and n0 is the first of them; else n0 takes none off. s1 lies between -2 M
    // and 2 M. If it fits, s2 lies between -M and M; if not, s0 does: they need a bit less. From what lies below M, as a rest that
    // is kept or a number that is taken in, nothing goes.
    let (f0, f1) = ((!s0.msb()).named("fits0"), (!s1.msb()).named("fits1"));
    let f2 = (f1 & !s2.msb()).named("fits2");
    let stays = ((fourfold & !f0) | (takes & !below)).named("stays");
    // Said so that two look-up tables of four inputs do for a bit.
    let lower = f1.mux(f2, stays).named("lower");
    let chosen = f1.mux(repeat(lower, slot), lower.mux(x.trunc(slot), s0.trunc(slot))).named("chosen");
    rest_next.drive(f1.mux((chosen & s2.trunc(slot)) | (!chosen & s1.trunc(slot)), chosen));
    rest.set(rest_next);
    m.output_doc(
        "unfit",
        is(now, Step::Take) & below.mux(!f0, f1),
        "the number that was taken in is not between -M and M",
    );

    m.comment("The whole part, a clock behind.");
    let read_whole_at = m.reg("read_whole_at", 3).set(read_at);
    let whole = m.reg("whole", shape.whole).doc("modular");
    let whole_next = m.wire("whole_next", shape.whole);
    let (write_then, write_then_at) =
        (m.reg("write_then", 1).set(write), m.reg("write_then_at", 3).set(write_at));
    let wholes = m.memory("wholes", 3, 8, shape.whole).starts(0).doc("modular");
    let wholes = wholes.write(write_then.q(), write_then_at.q(), whole_next.q());
    let apart = apart(write_then.q(), write_then_at.q(), read_whole_at.q());
    let stored = wholes.read(apart, read_whole_at.q());
    let subtracted = m.reg("subtracted", 1).set(is(step, Step::Sign)).q();
    let slot_now = m.reg("slot_now", 1).set(of_slot).q();
    let b = m.reg("b", shape.whole).doc("addend");
    let same = repeat(subtracted | below, shape.whole);
    b.set(slot_now.mux(stored ^ same, same));
    // Of a fourfold rest: 0 to 3 times; of others 0 to 2.
    let many = (fourfold.mux(f1, f2)).named("twice_or_more");
    let odd = fourfold.mux((f0 & !f1) | f2, f1 & !f2).named("once_or_thrice");
    let taken = m.reg("taken", 2).doc("how often M was taken off").set(m.cat(&[many, odd])).q();
    let fourfold = flag(&m, "was_fourfold", fourfold);
    let twofold = flag(&m, "was_twofold", twofold);
    let keeps = flag(&m, "was_kept", keeps);
    let old = whole.q();
    let four = m.cat(&[old.trunc(shape.whole - 2), taken]);
    // 2 times: the doubled lowest bit is free for one of them.
    let two = m.cat(&[old.trunc(shape.whole - 1), taken.bit(1)]);
    let x = fourfold.mux(four, twofold.mux(two, keeps.mux(old, 0))).named("whole_x");
    let one = (!fourfold & taken.any()).named("one");
    whole_next.drive(plus("x_and_b", x, b.q(), one));
    whole.set(whole_next);

    m.comment("What is done is given out rounded, with a whole number added, or negated: -w - 1 is the complement of w.");
    m.output_doc("rest_out", rest, "1/M, from the clock after a step");
    let twice = m.cat(&[rest.q(), m.lit(1, 0)]);
    let past_half = plus("past_half", twice, modulus, short);
    let up = nearest.mux(!past_half.msb(), upwards & rest.q().any());
    let carry = m.reg("value_carry", 1).doc("1 to add, rounded up or negated").when(give, up ^ negate).q();
    let negated = m.reg("value_negated", 1).when(give, negate).q();
    let added = m.reg("value_added", shape.whole).doc("whole number, modular").when(give, whole_in).q();
    let value = plus("value_sum", whole.q() ^ repeat(negated, shape.whole), added, carry);
    m.output_doc("value", value, "modular, two clocks after a step");
    m.finish()
}

/// a + b + carry; the sum has a lowest bit more, out of which the carry comes.
pub(super) fn plus<'m>(name: &str, a: Signal<'m>, b: Signal<'m>, carry: Signal<'m>) -> Signal<'m> {
    let m = a.module();
    let sum =
        (m.cat(&[a, m.lit(1, 1)]) + m.cat(&[b, carry])).named_doc(name, "and a carry out of the lowest bit");
    sum.slice(a.width(), 1)
}

/// What is read is not written in this clock. No pair that is needed ever is: said, it spares what would keep the old word.
fn apart<'m>(write: Signal<'m>, write_at: Signal<'m>, read_at: Signal<'m>) -> Signal<'m> {
    !(write & write_at.eq(read_at))
}

/// Whether it was so a clock before.
fn flag<'m>(m: &'m Module, name: &str, is: Signal<'m>) -> Signal<'m> {
    m.reg(name, 1).set(is).q()
}

/// A bit as often as a word is long.
fn repeat(bit: Signal<'_>, bits: u32) -> Signal<'_> {
    bit.sext(bits)
}

/// The step is this one.
fn is(step: Signal<'_>, which: Step) -> Signal<'_> {
    step.eq(which as i32)
}

/// The step is one of these.
fn one_of<'m>(step: Signal<'m>, which: &[Step]) -> Signal<'m> {
    let found = which.iter().map(|one| is(step, *one)).reduce(|any, one| any | one);
    found.unwrap_or(step.module().lit(1, 0))
}
