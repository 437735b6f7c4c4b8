//! The two edges between which the spans of a triangle lie.

use edgewalk_netlist::{Module, Reg, Signal};

use super::walk::Walk;
use crate::stepping::{Rest, first_rest, parts_of_edge};
use crate::wires::{Registers, Token};

/// The column of the major edge, and whether it carries in its next step.
pub(super) fn major<'m>(m: &'m Module, walk: &Walk<'m>, prim: &Token<'m>) -> (Signal<'m>, Signal<'m>) {
    m.comment("The major edge.");
    let first = |f: &str| prim[format!("major_{f}").as_str()];
    let major = Edge::new(m, "major", prim);
    let (rest, column) = major.next(m);
    let rest = walk.idle.mux(major.first_rest(first), rest).named("major_next");
    major.rest.when(walk.line_done, rest);
    // Beside the sign of R - f, as it chooses in all values; the reset is what tells the two apart.
    let carry = m.reg("carry", 1).doc("the major edge carries in its next step").reset(0);
    carry.when(walk.line_done, rest.msb());
    major.own["c"].when(walk.line_done, walk.idle.mux(first("c"), column));
    major.keep(walk.offered, first);
    (major.own["c"].q(), carry.q())
}

/// The column of the minor edge, and whether the triangle that is offered has an upper part.
pub(super) fn minor<'m>(m: &'m Module, walk: &Walk<'m>, prim: &Token<'m>) -> (Signal<'m>, Signal<'m>) {
    m.comment("The minor edge, and the one that takes its place at the knee.");
    let Walk { idle, offered, moves, exchanges, .. } = *walk;
    let first = |edge: &str, f: &str| prim[format!("{edge}_{f}").as_str()];
    let second = Edge::new(m, "second", prim);
    let second_rest = second.first_rest(|f| first("minor2", f)).named("minor2_rest");
    second.rest.when(offered, second_rest);
    second.own["c"].when(offered, first("minor2", "c"));
    second.keep(offered, |f| first("minor2", f));
    let minor = Edge::new(m, "minor", prim);
    let (rest, column) = minor.next(m);
    let has_upper = prim["n1"].any().named("has_upper");
    let minor1_rest = minor.first_rest(|f| first("minor1", f)).named("minor1_rest");
    let enters = |f: &str| has_upper.mux(first("minor1", f), first("minor2", f));
    let first_rest = has_upper.mux(minor1_rest, second_rest);
    minor.rest.when(moves, exchanges.mux(idle.mux(first_rest, second.rest.q()), rest));
    minor.own["c"].when(moves, exchanges.mux(idle.mux(enters("c"), second.own["c"].q()), column));
    let exchanged = (exchanges & moves).named("exchanged");
    minor.keep(exchanged, |f| idle.mux(enters(f), second.own[f].q()));
    (minor.own["c"].q(), has_upper)
}

/// An edge as it is walked.
struct Edge<'m> {
    name: &'m str,
    /// R - f; below 0 the step carries.
    rest: Reg<'m>,
    carry: Signal<'m>,
    /// All but R.
    own: Registers<'m>,
}

impl<'m> Edge<'m> {
    fn new(m: &'m Module, name: &'m str, prim: &Token<'m>) -> Edge<'m> {
        let mut own = parts_of_edge(&prim.parts());
        own.retain(|part| part.name != "r");
        let own = Registers::new(m, name, own);
        let bits = own["f"].q().width() + 1;
        let rest = m.reg(&format!("{name}_rest"), bits).doc("R - f, signed: below 0 the step carries");
        Edge { name, rest, carry: rest.q().msb(), own }
    }

    /// R - f and the column of an edge a line further.
    fn next(&self, m: &'m Module) -> (Signal<'m>, Signal<'m>) {
        let Edge { name, rest, carry, own } = self;
        let modulus = own.get("m").map(Reg::q);
        let rest = Rest { name, rest: rest.q(), f: own["f"].q(), modulus }.next(m);
        let (c, q) = (own["c"].q(), own["q"].q());
        (rest, c + q + carry.zext(c.width()))
    }

    /// R - f of an edge with these parts at its first line.
    fn first_rest(&self, of_prim: impl Fn(&str) -> Signal<'m>) -> Signal<'m> {
        first_rest(of_prim("r"), of_prim("f"))
    }

    /// What does not step.
    fn keep(&self, when: Signal<'m>, value: impl Fn(&str) -> Signal<'m>) {
        for part in self.own.token().parts().iter().filter(|part| part.name != "c") {
            self.own[part.name.as_str()].when(when, value(&part.name));
        }
    }
}
