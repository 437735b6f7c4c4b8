//! The whole part of a lane's pair, and what the lane gives out.

use edgewalk_netlist::{Module, Reg, Signal};

use super::inputs::Inputs;
use super::step::{Done, Modulus};
use super::{apart, flag, repeat};
use crate::setup::steps::{Step, StepCodes};
use crate::wires::plus;

/// The whole part, a clock behind the rest.
pub(super) fn whole<'m>(
    m: &'m Module,
    inputs: &Inputs<'m>,
    codes: &StepCodes<'m>,
    done: &Done<'m>,
) -> Signal<'m> {
    m.comment("The whole part, a clock behind.");
    let (bits, fourfold) = (inputs.whole_in.width(), done.fourfold);
    let read_whole_at = m.reg("read_whole_at", 3).set(inputs.read_at);
    let whole = m.reg("whole", bits).doc("modular");
    let whole_next = m.wire("whole_next", bits);
    let write = m.reg("write_then", 1).doc("0 at the start: slot 0 is not written").starts_at_zero();
    let write = write.set(inputs.write);
    let write_at = m.reg("write_then_at", 3).set(inputs.write_at);
    let wholes = m.memory("wholes", 3, 8, bits).starts(0).doc("modular");
    let wholes = wholes.write(write.q(), write_at.q(), whole_next.q());
    let apart = apart(write.q(), write_at.q(), read_whole_at.q());
    let stored = wholes.read(apart, read_whole_at.q());
    let subtracted = m.reg("subtracted", 1).set(inputs.step.eq(codes.of(Step::Sign))).q();
    let slot_now = m.reg("slot_now", 1).set(done.of_slot).q();
    let b = m.reg("b", bits).doc("addend");
    let same = repeat(subtracted | done.below, bits);
    b.set(slot_now.mux(stored ^ same, same));
    // Of a fourfold rest: 0 to 3 times; of others 0 to 2.
    let [f0, f1, f2] = done.fits;
    let many = (fourfold.mux(f1, f2)).named("twice_or_more");
    let odd = fourfold.mux((f0 & !f1) | f2, f1 & !f2).named("once_or_thrice");
    let taken = m.reg("taken", 2).doc("how often M was taken off").set(m.cat(&[many, odd])).q();
    let fourfold = flag(m, "was_fourfold", fourfold);
    let twofold = flag(m, "was_twofold", done.twofold);
    let keeps = flag(m, "was_kept", done.keeps);
    let old = whole.q();
    let four = m.cat(&[old.trunc(bits - 2), taken]);
    // 2 times: the doubled lowest bit is free for one of them.
    let two = m.cat(&[old.trunc(bits - 1), taken.bit(1)]);
    let x = fourfold.mux(four, twofold.mux(two, keeps.mux(old, 0))).named("whole_x");
    let one = (!fourfold & taken.any()).named("one");
    whole_next.drive(plus("x_and_b", x, b.q(), one));
    whole.set(whole_next).q()
}

/// The result: rounded, with a whole number added, or negated.
pub(super) fn give<'m>(
    m: &'m Module,
    inputs: &Inputs<'m>,
    modulus: &Modulus<'m>,
    rest: Reg<'m>,
    whole: Signal<'m>,
) {
    m.comment("A result is rounded, has a whole number added, or is negated: -w - 1 is the complement of w.");
    let (give, negate) = (inputs.give, inputs.negate);
    m.output_doc("rest_out", rest, "1/M, from the clock after a step");
    let twice = m.cat(&[rest.q(), m.lit(1, 0)]);
    let past_half = plus("past_half", twice, modulus.value, modulus.short);
    let up = inputs.nearest.mux(!past_half.msb(), inputs.upwards & rest.q().any());
    let carry = m.reg("value_carry", 1).doc("1 to add, rounded up or negated").when(give, up ^ negate).q();
    let negated = m.reg("value_negated", 1).when(give, negate).q();
    let added = m.reg("value_added", whole.width()).doc("whole number, modular");
    let added = added.when(give, inputs.whole_in).q();
    let value = plus("value_sum", whole ^ repeat(negated, whole.width()), added, carry);
    m.output_doc("value", value, "modular, two clocks after a step");
}
