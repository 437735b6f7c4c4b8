//! TERM: walks the terms from the first pixel of a span to that of the next.

mod record;

mod place;

mod register;

mod memory;

use std::sync::Arc;

use edgewalk_machine::record::GLOSS_BITS;
use edgewalk_machine::units::term::SPEC;
use edgewalk_machine::{Plan, Walk};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use crate::ports::Interface;
use place::Place;
use record::{MATERIAL, Record};

const DOC: &str = "TERM walks polynomials of a pixel's place to the first pixel of each span.

  span ───────┬─────────────────────────────────────────────────┬─> walked
              └─> down, forward, back ─> [x y] [V X Y XX XY YY] ─┘
  inc_record ─ trd (address) ─> terms memory ─ tdata ─┘

Formats: words are modular, with the bits of their term.
  V   the term at (x, y)
  X   change of V a pixel along the span; walked_*_g
  Y   change of V a line
  XX  change of X a pixel; walked_*_gg
  XY  change of X a line
  YY  change of Y a line
Timing: the record is read when a triangle's first span is offered, a word a clock. walked is offered in the cycle in which
(x, y) is the span's first pixel. While PIXEL draws that span, TERM walks to the next.
Rules: TERM holds no span. A step adds words, without a multiplier, and is exact even where words wrap.";

/// The netlist of TERM.
///
/// # Errors
/// None for a machine with TERM that [`edgewalk_machine::Machine::plan`] accepts.
pub fn term(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_term", DOC);
    m.doc(match plan.shade.walk {
        Walk::Register => register::DOC,
        Walk::Memory => memory::DOC,
    });
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (span_valid, span) = ports.takes();
    let number = ports.held_in("inc")["record"];
    let terms = ports.memory("terms");
    let walked_ready = ports.gives_ready();

    let record = Record::new(&m, plan, &terms, (span_valid & span["fresh"]).named("fresh_offered"));
    let place = Place::new(&m, &span);
    let fits = span_valid & !record.loading & (record.begun.q() | !span["fresh"]);
    let fits = fits.named_doc("fits", "the words belong to the offered span's triangle");
    let works = (fits & !place.reached).named_doc("works", "the walk steps in this clock");
    let words = match plan.shade.walk {
        Walk::Register => register::words(&m, plan, works, &place, &record),
        Walk::Memory => memory::words(&m, plan, works, &place, &record),
    };
    place.step(words.stepped, &record);

    m.comment("The span leaves when the walk is at its first pixel.");
    let material = (plan.shade.material_bits > 0).then(|| {
        let material = m.reg("material", plan.shade.material_bits).doc("material of the triangle");
        record.load(material, MATERIAL);
        material.q()
    });
    let gloss = plan.shade.normalises().then(|| {
        let gloss = m.reg("gloss", GLOSS_BITS).doc("gloss of the material");
        record.load_above(gloss, MATERIAL, plan.shade.material_bits);
        gloss.q()
    });
    let stands = fits & place.reached;
    let there = words.settled.map_or(stands, |settled| stands & settled).named("walked_valid");
    let span_ready = (there & walked_ready).named("span_ready");
    record.begun.when(span_ready, 0);

    ports.take_ready(span_ready);
    ports.read("terms", record.read_valid, m.cat(&[number, record.read_place]), record.loading);
    ports.give(there, |f| {
        let word = words.shown.iter().find(|(name, _)| name == f).map(|(_, word)| *word);
        let of_material = match f {
            "material" => material,
            "gloss" => gloss,
            _ => None,
        };
        word.or(of_material).unwrap_or_else(|| span[f])
    });
    ports.status("term_wait", span_valid & !there);
    m.finish()
}

/// What a walk gives.
struct Words<'m> {
    /// By the name of the field of `walked`.
    shown: Vec<(String, Signal<'m>)>,
    /// The step is done in this cycle.
    stepped: Signal<'m>,
    /// No word is on its way; `None`: none ever is.
    settled: Option<Signal<'m>>,
}

/// The lowest bits of a signal; all of it where it has no more.
fn lowest(signal: Signal<'_>, bits: u32) -> Signal<'_> {
    if signal.width() == bits { signal } else { signal.trunc(bits) }
}

/// `a + b`, or `a - b`; the operand that is added has a name.
fn sum<'m>(a: Signal<'m>, b: Signal<'m>, subtract: Signal<'m>, name: &str) -> Signal<'m> {
    let bits = a.width();
    let added = subtract.mux(!b, b).named_doc(name, "inverted for a subtraction");
    a + added + subtract.zext(bits)
}
