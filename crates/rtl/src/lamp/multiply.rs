//! The one multiplier, and the ways in which its products are rounded.

use edgewalk_netlist::{Module, Signal};

use crate::cut::cut;

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
    /// `a` of 18 bits, signed, `b` of 17, unsigned, `v` of the entry whose slope `a` may be.
    pub fn new(m: &'m Module, a: Signal<'m>, b: Signal<'m>, v: Signal<'m>) -> Multiplier<'m> {
        let operand =
            |name: &str, doc: &str, value: Signal<'m>| m.reg(name, value.width()).doc(doc).set(value).q();
        let (a, b) = (operand("a", "operand of the multiplier, signed", a), operand("b", "operand", b));
        let v = operand("v", "value at the entry, 2^-16", v);
        let exact = a.smul(b.zext(18)).named_doc("exact", "a * b");
        let less = (exact.trunc(27) + m.lit(27, 1 << 9)).slice(26, 10).named_doc("less", "2^-16");
        let looked = (v - less).named_doc("looked", "2^-16");
        let rounded = (exact + m.lit(exact.width(), 1 << 15)).slice(exact.width() - 1, 16);
        let times = cut(m, "times", rounded.named_doc("rounded", "2^-16"), 18);
        Multiplier { exact, looked, times }
    }
}
