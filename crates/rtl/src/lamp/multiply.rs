//! The one multiplier, and the ways in which its products are rounded.

use edgewalk_netlist::{Module, Signal};

use super::turns::Turns;
use crate::cut::cut;

/// Bits of the second operand that the first of two products takes.
const LOW: u32 = 9;

/// The operands, and the value at the entry that may belong to them.
pub(super) struct Chosen<'m> {
    /// 18 bits, signed.
    pub a: Signal<'m>,
    /// 17 bits, unsigned.
    pub b: Signal<'m>,
    /// Of the entry whose slope `a` may be, 2^-16.
    pub v: Signal<'m>,
}

/// The product of the operands of the step before.
pub(super) struct Multiplier<'m> {
    /// As it is.
    pub exact: Signal<'m>,
    /// What a table says between two entries.
    pub looked: Signal<'m>,
    /// A product of two numbers in 2^-16.
    pub times: Signal<'m>,
}

impl<'m> Multiplier<'m> {
    /// The product of the operands chosen in the second half of a step.
    pub fn new(m: &'m Module, turns: &Turns<'m>, chosen: &Chosen<'m>) -> Multiplier<'m> {
        m.comment("Multiplier: two partial products in the first half of a step, their sum in the second.");
        let a = turns.between("a", "operand of the multiplier, signed", chosen.a);
        let b = turns.between("b", "operand", chosen.b);
        let v = turns.between("v", "value at the entry, 2^-16", chosen.v);
        let part = |name: &str, doc: &str, bits: Signal<'m>| {
            turns.between(name, doc, a.smul(bits.zext(bits.width() + 1)))
        };
        let low = part("low_part", "a * the low bits of b", b.trunc(LOW));
        let high = part("high_part", "a * the high bits of b", b.slice(16, LOW));
        let v = turns.between("v_summed", "v beside the partial products", v);
        let sum = (low.slice(low.width() - 1, LOW).sext(27) + high.sext(27)).named("high_sum");
        let exact = m.cat(&[sum, low.trunc(LOW)]).named_doc("exact", "a * b");
        let less = (exact.trunc(27) + m.lit(27, 1 << 9)).slice(26, 10).named_doc("less", "2^-16");
        let looked = (v - less).named_doc("looked", "2^-16");
        let rounded = (exact + m.lit(exact.width(), 1 << 15)).slice(exact.width() - 1, 16);
        let times = cut(m, "times", rounded.named_doc("rounded", "2^-16"), 18);
        Multiplier { exact, looked, times }
    }
}
