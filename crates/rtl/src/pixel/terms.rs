//! The terms in PIXEL: copies of TERM's words at a pixel, with an adder each, or two.

use edgewalk_machine::{Plan, Term};
use edgewalk_netlist::{Module, Reg, Signal};

use super::drawing::Drawing;
use crate::wires::Token;

/// For the header of machines with terms.
pub(super) const DOC: &str =
    "Terms: a span brings each term's word v and step g; a term of degree 2 also brings gg, the change of g.
Terms step with the channels, in one clock, each on its own adders. Terms have no segments; the output stages delay them.";

/// The words of all terms.
pub(super) struct Terms<'m>(Vec<(Term, Reg<'m>)>);

impl<'m> Terms<'m> {
    /// The words are loaded with a span, and step where it goes on.
    pub fn new(m: &'m Module, plan: &Plan, span: &Token<'m>, drawing: &Drawing<'m>) -> Terms<'m> {
        let Drawing { moves, span_ready: enters, goes_on, .. } = *drawing;
        if !plan.terms().is_empty() {
            m.comment("Terms, stepped once a pixel.");
        }
        let copy = |term: &Term, part: &str, doc: &str| {
            let name = format!("{}_{part}", term.name);
            let loaded = span[name.as_str()];
            (m.reg(&name, loaded.width()).doc(doc), loaded)
        };
        let words = plan.terms().iter().map(|term| {
            let (v, first) = copy(term, "v", "term at the current pixel, modular");
            let (g, step) = copy(term, "g", "step to the next pixel, modular");
            v.when(moves, goes_on.mux(v.q() + g.q(), first));
            if term.degree == 2 {
                let (gg, last_step) = copy(term, "gg", "change of the step a pixel, modular");
                gg.when(enters, last_step);
                g.when(moves, goes_on.mux(g.q() + gg.q(), step));
            } else {
                g.when(enters, step);
            }
            (*term, v)
        });
        Terms(words.collect())
    }

    /// The output of the term of that name, its word without the fraction.
    pub fn output(&self, name: &str) -> Option<Signal<'m>> {
        let (term, v) = self.0.iter().find(|(term, _)| term.name == name)?;
        Some(v.q().slice(term.word() - 1, term.fraction))
    }
}
