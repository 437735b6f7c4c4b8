//! The number that a root is taken of: its exponent, and what is left of it.

use edgewalk_netlist::{Module, Signal};

use super::steps::Steps;
use super::zeros_behind;

/// x = m·4^-k, 2^-16.
pub(super) struct Root<'m> {
    /// Of the root that was begun last.
    pub k: Signal<'m>,
    pub m: Signal<'m>,
    /// The entry of table R of the root that is begun.
    pub entry: Signal<'m>,
    /// A root is begun.
    pub begins: Signal<'m>,
    /// The constant 1.0 of 19 bits, 2^-16.
    pub one: Signal<'m>,
}

impl<'m> Root<'m> {
    /// The roots of a fragment: of dd in step 0, of nn in step 5, of 1 + L.V in step 10; `way` is L.V, 2^-16.
    pub fn of_steps(m: &'m Module, steps: &Steps<'m>, way: Signal<'m>) -> Root<'m> {
        m.comment("Arguments of the roots, 2^-30, signed.");
        let [first, second, third] = [0, 5, 10].map(|step| steps.at(step));
        let rooting = (first | second | third).named_doc("rooting", "a root begins");
        let one = m.lit(19, 1 << 16);
        let of_normal = zeros_behind(steps.of("nn"), 14);
        let of_way = zeros_behind(way.sext(19) + one, 13);
        let x = first.mux(steps.of("dd"), second.mux(of_normal, of_way)).named_doc("x", "2^-30");
        Root::new(m, rooting, one, x)
    }

    /// `rooting`: the root of `x`, 32 bits, signed, 2^-30, is begun.
    fn new(m: &'m Module, rooting: Signal<'m>, one: Signal<'m>, x: Signal<'m>) -> Root<'m> {
        m.comment("Exponent: pairs of leading zeros of x, at most seven.");
        let ones = m.lit(30, (1 << 30) - 1);
        let within = x.slice(30, 30).mux(ones, x.trunc(30)) & (!x.msb()).sext(30);
        let mut rest = within.named_doc("below_one", "x, limited to [0, 1)");
        let mut digits = Vec::new();
        for shift in [8, 4, 2] {
            // What lies below the 16 bits that are left, however far they move, goes no further.
            let (top, width) = (rest.width() - 1, rest.width() - shift);
            let small = (!rest.slice(top, width).any()).named(&format!("small_{shift}"));
            rest = small.mux(rest.trunc(width), rest.slice(top, shift)).named(&format!("moved_{shift}"));
            digits.push(small);
        }
        let left = rest.slice(15, 14).any().mux(rest, m.lit(16, 1 << 14));
        let left = left.named_doc("left", "normalised x in [1/4, 1), 2^-16");
        let k = m.reg("k", 3).doc("exponent of the root").when(rooting, m.cat(&digits)).q();
        let of_root = m.reg("m", 16).doc("mantissa of the root's argument, 2^-16").when(rooting, left).q();
        Root { k, m: of_root, entry: left.slice(15, 8), begins: rooting, one }
    }
}
