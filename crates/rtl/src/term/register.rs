//! The walk with all words in registers.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use super::place::Place;
use super::record::{Record, V, X, XX, XY, Y, YY, places};
use super::{Words, sum};

pub(super) const DOC: &str = "Walk: in registers, with an adder for each of V, X and Y.
  down     V += Y; X += XY; Y += YY      one clock
  forward  V += X; X += XX; Y += XY      one clock
  back     X -= XX; Y -= XY, then V -= X two clocks";

/// The words, stepped where the walk `works`.
pub(super) fn words<'m>(
    m: &'m Module,
    plan: &Plan,
    works: Signal<'m>,
    place: &Place<'m>,
    record: &Record<'m>,
) -> Words<'m> {
    m.comment("A step back takes two clocks.");
    let half = m.reg("half", 1).doc("second clock of a step back").reset(0);
    let back = (!place.down & !place.forward).named("back");
    half.when(works, back & !half.q());
    let second = half.q();
    let first = (works & !second).named_doc("first_clock", "first clock of a step");
    let stepped = (works & (!back | second)).named_doc("stepped", "the step is complete");

    let mut shown = Vec::new();
    for (term, at) in places(plan) {
        m.comment(&format!("Words of term {}.", term.name));
        let word = |part: &str, doc: &str, offset: u32| {
            let register = m.reg(&format!("{}_{part}", term.name), term.word()).doc(doc);
            record.load(register, at + offset);
            register
        };
        let next = |word: Signal<'m>, step: Signal<'m>, of: &str| {
            let named = |what: &str| format!("{}_{of}_{what}", term.name);
            sum(word, step, back, &named("added")).named(&named("next"))
        };
        let v = word("v", "term at (x, y), modular", V);
        let x = word("x", "step to the next pixel, modular", X);
        let y = word("y", "step to the next line, modular", Y);
        v.when(stepped, next(v.q(), place.down.mux(y, x), "v"));
        shown.extend([(format!("{}_v", term.name), v.q()), (format!("{}_g", term.name), x.q())]);
        if term.degree == 2 {
            let xx = word("xx", "change of x a pixel, modular", XX).q();
            let xy = word("xy", "change of x a line, modular", XY).q();
            let yy = word("yy", "change of y a line, modular", YY).q();
            x.when(first, next(x.q(), place.down.mux(xy, xx), "x"));
            y.when(first, next(y.q(), place.down.mux(yy, xy), "y"));
            shown.push((format!("{}_gg", term.name), xx));
        }
    }
    Words { shown, stepped, settled: None }
}
