//! The number that a root is taken of: its exponent, and what is left of it.

use edgewalk_netlist::Module;

use super::made::Results;
use super::turns::{Made, Turns};
use super::zeros_behind;

/// x = m·4^-k, 2^-16, of the root that was begun last.
pub(super) struct Root<'m> {
    pub k: Made<'m>,
    pub m: Made<'m>,
}

impl<'m> Root<'m> {
    /// The roots of a fragment: of dd in step 1, of nn in step 6, of 1 + L.V in step 11.
    pub fn new(m: &'m Module, turns: &Turns<'m>, results: &Results<'m>) -> Root<'m> {
        m.comment("Arguments of the roots, 2^-30, signed.");
        let of_normal = zeros_behind(turns.of("nn"), 14);
        let of_way = zeros_behind(results.way.here().sext(19) + m.lit(19, 1 << 16), 13);
        let x = turns.first(1).mux(turns.of("dd"), turns.first(6).mux(of_normal, of_way));
        let x = turns.between("x", "argument of a root, 2^-30", x);
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
        let begun = [1, 6, 11].map(|step| turns.second(step));
        let begun = (begun[0] | begun[1] | begun[2]).named_doc("begun", "a root is begun");
        let k = turns.result(m, "k", 3, "exponent of the root");
        let of_root = turns.result(m, "m", 16, "mantissa of the root's argument, 2^-16");
        k.when(begun, m.cat(&digits));
        of_root.when(begun, left);
        Root { k, m: of_root }
    }
}
