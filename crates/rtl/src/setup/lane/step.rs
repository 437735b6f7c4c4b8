//! The rest of a lane's pair: its modulus, the addend of a step, and the step.

use edgewalk_netlist::{Module, Reg, Signal, Wire};

use super::inputs::Inputs;
use super::{apart, flag, repeat};
use crate::setup::steps::{Step, StepCodes};
use crate::wires::plus;

/// -M, or its complement -M - 1, with the 1 that is then missing.
pub(super) struct Modulus<'m> {
    pub value: Signal<'m>,
    pub short: Signal<'m>,
}

impl<'m> Modulus<'m> {
    /// The registers.
    pub fn new(m: &'m Module, inputs: &Inputs<'m>) -> Modulus<'m> {
        m.comment("The modulus: -M, or its complement -M - 1, with the 1 that is then missing.");
        let modulus = m.reg("modulus", inputs.modulus_in.width()).doc("-M or -M - 1, signed");
        let value = modulus.when(inputs.take_modulus, inputs.modulus_in).q();
        let short = m.reg("short", 1).doc("1 is missing in modulus");
        Modulus { value, short: short.when(inputs.take_modulus, inputs.modulus_short).q() }
    }
}

/// The rest of the pair, and those of the slots.
pub(super) struct Rest<'m> {
    pub now: Reg<'m>,
    next: Wire<'m>,
    /// The rest of the slot that is read.
    pub stored: Signal<'m>,
}

impl<'m> Rest<'m> {
    /// The register and the memory of the slots.
    pub fn new(m: &'m Module, inputs: &Inputs<'m>) -> Rest<'m> {
        m.comment("Rests of the slots. Slot 0 is never written and holds 0.");
        let slot = inputs.modulus_in.width() - 1;
        let (write, write_at, read_at) = (inputs.write, inputs.write_at, inputs.read_at);
        let now = m.reg("rest", slot).doc("1/M");
        let next = m.wire("rest_next", slot);
        let slots = m.memory("rests", 3, 8, slot).starts(0).doc("1/M").write(write, write_at, next.q());
        let stored = slots.read(apart(write, write_at, read_at), read_at);
        Rest { now, next, stored }
    }
}

/// What a step adds, by how often M is taken off with it.
pub(super) struct Addends<'m> {
    n: [Signal<'m>; 3],
    /// 1 to add to the sum with n0, and to the other sums.
    carry0: Signal<'m>,
    carry: Signal<'m>,
    /// The addend is a stored pair.
    pub of_slot: Signal<'m>,
}

/// The addend of the step that follows.
pub(super) fn addends<'m>(
    m: &'m Module,
    inputs: &Inputs<'m>,
    codes: &StepCodes<'m>,
    modulus: &Modulus<'m>,
    stored: Signal<'m>,
) -> Addends<'m> {
    m.comment("The addend of the step that follows.");
    let Modulus { value: modulus, short } = *modulus;
    let (step, bits) = (inputs.step, modulus.width()); // M has a bit less; room for a sign
    let n0 = m.reg("n0", bits).doc("a, or M - a");
    let n1 = m.reg("n1", bits + 1).doc("a - M, signed");
    let n2 = m.reg("n2", bits).doc("a - 2 M, modular");
    let of_slot = step.bit(4).named("of_slot");
    let take_modulus_off = step.bit(3).named("take_modulus_off");
    let subtracts = (step.bit(1) & step.bit(0)).named("subtracts");
    let a = take_modulus_off.mux(modulus, of_slot.mux(stored.zext(bits), 0));
    let a = a.named_doc("a", "addend, 1/M, or -M");
    let less_m = plus("a_less_m", a.sext(bits + 1), modulus.sext(bits + 1), short);
    n0.set(subtracts.mux(!less_m.trunc(bits), a));
    n1.set(less_m);
    let twice = m.cat(&[modulus, short]).named_doc("less_2m", "-2 M, or -2 M - 1");
    n2.set(plus("a_less_2m", a, twice.trunc(bits), short));
    let carry0 = m.reg("carry0", 1).doc("1 to add to the sum of n0");
    // Of a number that does not fit the sign stands for -1: M - 1.
    carry0.set((subtracts & !step.eq(codes.of(Step::Begin))) | (take_modulus_off & short));
    let carry = m.reg("carry", 1).doc("1 to add to the other sums").set(take_modulus_off & short);
    Addends { n: [n0, n1, n2].map(Reg::q), carry0: carry0.q(), carry: carry.q(), of_slot }
}

/// The step that is done, as far as the whole part depends on it.
pub(super) struct Done<'m> {
    /// The pair is doubled twice, once, or kept.
    pub fourfold: Signal<'m>,
    pub twofold: Signal<'m>,
    pub keeps: Signal<'m>,
    /// A number below 0 is taken in.
    pub below: Signal<'m>,
    /// The sums with n0, n1 and n2 are not below 0.
    pub fits: [Signal<'m>; 3],
    pub of_slot: Signal<'m>,
}

/// The step: x plus the addend, less M as often as M fits.
pub(super) fn step<'m>(
    m: &'m Module,
    inputs: &Inputs<'m>,
    codes: &StepCodes<'m>,
    addends: &Addends<'m>,
    rest: &Rest<'m>,
) -> Done<'m> {
    m.comment("The step: x plus the addend, less M as often as M fits.");
    let (step, number) = (inputs.step, inputs.number);
    let is = |step: Signal<'m>, which| step.eq(codes.of(which));
    let either = |one, other| is(step, one) | is(step, other);
    let slot = rest.now.q().width();
    let (bits, sums) = (slot + 1, slot + 2);
    let now = m.reg("now", Step::BITS).doc("the step done").set(step).q();
    let fourfold = flag(m, "fourfold", either(Step::Double2, Step::Digits));
    let twofold = flag(m, "twofold", either(Step::Double1, Step::Next));
    let keeps = flag(m, "keeps", either(Step::Rest, Step::Add));
    let takes = flag(m, "takes", either(Step::Take, Step::Begin));
    let added = m.reg("added", number.width()).doc("number or digits taken in; 0 if there are none");
    let of_digits = is(step, Step::Digits).mux(inputs.digits.zext(number.width()), 0);
    added.set(is(step, Step::Take).mux(number, of_digits));
    let sign = (is(step, Step::Take) & number.msb()) | (is(step, Step::Begin) & inputs.digits.msb());
    let below = m.reg("below", 1).doc("the number taken in is below 0").set(sign).q();
    let old = rest.now.q().zext(sums);
    let times = fourfold.mux(old.shl(2), twofold.mux(old.shl(1), 0));
    let x = (times | (old & repeat(keeps, sums)) | added.q().sext(sums)).named("x");
    let Addends { n: [n0, n1, n2], carry0, carry, of_slot } = *addends;
    let s0 = plus("x_and_n0", x.trunc(bits), n0, carry0).named("s0");
    let s1 = plus("x_and_n1", x, n1, carry).named("s1");
    let s2 = plus("x_and_n2", x.trunc(bits), n2, carry).named("s2");
    // A fourfold rest may have M taken off three times, and n0 is the first of them; else n0 takes none off.
    // s1 lies between -2 M and 2 M. If it fits, s2 lies between -M and M; if not, s0 does: they need a bit
    // less. From what lies below M, as a rest that is kept or a number that is taken in, nothing goes.
    let (f0, f1) = ((!s0.msb()).named("fits0"), (!s1.msb()).named("fits1"));
    let f2 = (f1 & !s2.msb()).named("fits2");
    let stays = ((fourfold & !f0) | (takes & !below)).named("stays");
    // Said so that two look-up tables of four inputs do for a bit.
    let lower = f1.mux(f2, stays).named("lower");
    let chosen = f1.mux(repeat(lower, slot), lower.mux(x.trunc(slot), s0.trunc(slot))).named("chosen");
    rest.next.drive(f1.mux((chosen & s2.trunc(slot)) | (!chosen & s1.trunc(slot)), chosen));
    rest.now.set(rest.next);
    m.output_doc(
        "unfit",
        is(now, Step::Take) & below.mux(!f0, f1),
        "the number that was taken in is not between -M and M",
    );
    Done { fourfold, twofold, keeps, below, fits: [f0, f1, f2], of_slot }
}
