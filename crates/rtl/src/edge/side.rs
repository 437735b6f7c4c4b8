//! The two edges between which the spans of a triangle lie.

use edgewalk_netlist::{Module, Reg, Signal};

use super::walk::Walk;
use crate::stepping::{Rest, first_rest, parts_of_edge};
use crate::wires::{Part, Registers, Token};

/// The column of the major edge, and whether it carries in its next step.
pub(super) fn major<'m>(m: &'m Module, walk: &Walk<'m>, prim: &Token<'m>) -> (Signal<'m>, Signal<'m>) {
    m.comment("The major edge.");
    let first = |f: &str| prim[format!("major_{f}").as_str()];
    let major = match walk.walked {
        None => Edge::new(m, "major", prim),
        Some(_) => Edge::at_port(m, "major", prim),
    };
    let (rest, column) = major.next(m);
    let rest = walk.idle.mux(Edge::rest_of(first), rest).named("major_next");
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
    let second = walk.walked.is_none().then(|| Edge::new(m, "second", prim));
    let second_rest = Edge::rest_of(|f| first("minor2", f)).named("minor2_rest");
    if let Some(second) = &second {
        second.rest.when(offered, second_rest);
        second.own["c"].when(offered, first("minor2", "c"));
        second.keep(offered, |f| first("minor2", f));
    }
    let minor = Edge::new(m, "minor", prim);
    let (rest, column) = minor.next(m);
    let has_upper = prim["n1"].any().named("has_upper");
    let minor1_rest = Edge::rest_of(|f| first("minor1", f)).named("minor1_rest");
    match second {
        Some(second) => {
            let enters = |f: &str| has_upper.mux(first("minor1", f), first("minor2", f));
            let first_rest = has_upper.mux(minor1_rest, second_rest);
            minor.rest.when(moves, exchanges.mux(idle.mux(first_rest, second.rest.q()), rest));
            minor.own["c"].when(moves, exchanges.mux(idle.mux(enters("c"), second.own["c"].q()), column));
            let exchanged = (exchanges & moves).named("exchanged");
            minor.keep(exchanged, |f| idle.mux(enters(f), second.own[f].q()));
        }
        None => {
            let upper = (idle & has_upper).named_doc("upper_enters", "else the second one does");
            let enters = |f: &str| upper.mux(first("minor1", f), first("minor2", f));
            let rest = exchanges.mux(upper.mux(minor1_rest, second_rest), rest);
            minor.rest.when(moves, rest);
            minor.own["c"].when(moves, exchanges.mux(enters("c"), column));
            minor.keep((exchanges & moves).named("exchanged"), enters);
        }
    }
    (minor.own["c"].q(), has_upper)
}

/// An edge as it is walked.
struct Edge<'m> {
    name: &'m str,
    /// R - f; below 0 the step carries.
    rest: Reg<'m>,
    carry: Signal<'m>,
    /// All but R, or, where the port keeps what does not step, C alone.
    own: Registers<'m>,
    /// What the port keeps.
    kept: Option<Token<'m>>,
}

impl<'m> Edge<'m> {
    fn new(m: &'m Module, name: &'m str, prim: &Token<'m>) -> Edge<'m> {
        let mut own = parts_of_edge(&prim.parts());
        own.retain(|part| part.name != "dist");
        Edge::of(m, name, own, None)
    }

    /// An edge whose q, f and M stay at the port.
    fn at_port(m: &'m Module, name: &'m str, prim: &Token<'m>) -> Edge<'m> {
        let (own, mut kept): (Vec<_>, Vec<_>) =
            parts_of_edge(&prim.parts()).into_iter().partition(|part| part.name == "c");
        kept.retain(|part| part.name != "dist");
        let at_port = |f: &str| prim[format!("{name}_{f}").as_str()].named(&format!("{name}_{f}"));
        Edge::of(m, name, own, Some(Token::new(kept, at_port)))
    }

    fn of(m: &'m Module, name: &'m str, own: Vec<Part>, kept: Option<Token<'m>>) -> Edge<'m> {
        let own = Registers::new(m, name, own);
        let f = kept.as_ref().map_or_else(|| own["f"].q(), |kept| kept["f"]);
        let rest =
            m.reg(&format!("{name}_rest"), f.width() + 1).doc("R - f, signed: below 0 the step carries");
        Edge { name, rest, carry: rest.q().msb(), own, kept }
    }

    /// A part that does not step.
    fn part(&self, name: &str) -> Option<Signal<'m>> {
        match &self.kept {
            Some(kept) => kept.get(name),
            None => self.own.get(name).map(Reg::q),
        }
    }

    /// R - f and the column of an edge a line further.
    fn next(&self, m: &'m Module) -> (Signal<'m>, Signal<'m>) {
        let Edge { name, rest, carry, own, .. } = self;
        let part = |name| self.part(name).expect("an edge has q and f");
        let rest = Rest { name, rest: rest.q(), f: part("f"), modulus: self.part("m") }.next(m);
        let (c, q) = (own["c"].q(), part("q"));
        (rest, c + q + carry.zext(c.width()))
    }

    /// R - f of an edge with these parts at its first line.
    fn rest_of(of_prim: impl Fn(&str) -> Signal<'m>) -> Signal<'m> {
        first_rest(of_prim("dist"), of_prim("f"))
    }

    /// What does not step.
    fn keep(&self, when: Signal<'m>, value: impl Fn(&str) -> Signal<'m>) {
        for part in self.own.token().parts().iter().filter(|part| part.name != "c") {
            self.own[part.name.as_str()].when(when, value(&part.name));
        }
    }
}
