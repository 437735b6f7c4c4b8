//! PIXEL: steps along a span, a pixel every ceil(N/A) clocks, with A adders shared by the N channels.

mod phase;
mod drawing;
mod adder;
mod terms;
mod output;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::pixel::SPEC;
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::ports::Interface;
use adder::Words;
use drawing::{Drawing, Links};
use output::Output;
use terms::Terms;

const DOC: &str = "PIXEL steps along a span, a pixel every ceil(N/A) clocks, with A adders shared by the N channels.

  span ─> [x count]───────────────────────────────────────┐
      └─> [a value a channel] <─ + <─ [increments] <─ inc ├─> [out] ─> frag
                 └────────────────────────────────────────┘

Formats: values and increments are modular words; a fragment takes the bits above the fraction.
Timing: a pixel leaves in its last phase. In that phase the additions for the next pixel begin. Each adder serves one
channel a clock; an adder without a channel rests.
Rules: the unit stalls while a fragment waits at the output. A column off the screen costs its phases and makes no
fragment.";

/// The netlist of PIXEL.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn pixel(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_pixel", DOC);
    if plan.segments > 1 {
        m.doc(adder::SKEW_DOC);
    }
    if !plan.terms().is_empty() {
        m.doc(terms::DOC);
    }
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (span_valid, span) = ports.takes();
    let increments = ports.held_in("inc");
    let frag_ready = ports.gives_ready();
    let frag_valid = m.reg("frag_valid", 1).reset(0);

    let links = Links { span_valid, span, increments, frag_valid: frag_valid.q(), frag_ready };
    let drawing = Drawing::new(&m, plan, &links, &ports);
    m.comment("One adder serves one channel, or several in turn.");
    let first = drawing.additions(&m, &links);
    let words = Words::new(&m, plan, drawing.advance, first, &links.span, &links.increments);
    let terms = Terms::new(&m, plan, &links.span, &drawing);
    let output = Output { m: &m, plan, drawing: &drawing, words: &words, terms: &terms };
    let (fragment, occupied) = output.stages(frag_valid);

    ports.take_ready(drawing.span_ready);
    ports.give(frag_valid, |f| fragment[f]);
    ports.status("active", drawing.active);
    ports.status("visible", drawing.visible);
    ports.status("advance", drawing.advance);
    ports.status("occupied", occupied);
    m.finish()
}
