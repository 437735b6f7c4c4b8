//! SPAN alone.

use edgewalk_machine::{Fill, Plan};
use edgewalk_model::Coverage;
use edgewalk_model::span::SpanQueue;
use edgewalk_model::tokens::{Line, Span};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

use super::{Stream, source, words};
use crate::common::probe::{Failure, Probe};
use crate::common::tokens;

/// SPAN: lines with any columns around the screen, spans taken at random.
pub fn span(machine: &Plan, cycles: u64, rng: &mut Pcg64Mcg) -> Result<Probe, Failure> {
    let mut probe = Probe::new(edgewalk_rtl::span(machine))?;
    let (line_valid, span_ready) = (probe.input("line_valid")?, probe.input("span_ready")?);
    let line = probe.input_channel("line", &tokens::line(machine, &Line::default()))?;
    let line_ready = probe.port("span", "line_ready", "line_ready")?;
    let span_valid = probe.port("span", "span_valid", "span_valid")?;
    let span = probe.channel("span", "", "span", &tokens::span(machine, &Span::default()))?;
    let fresh_queued = probe.port("span", "fresh_queued", "fresh_queued")?;
    let (mut model, mut stream) = (SpanQueue::new(machine), Stream { token: None });
    probe.reset()?;
    while probe.cycle < cycles {
        // EDGE brings a triangle's first line only when the first span of the one before is gone.
        let may_be_fresh = !model.fresh_queued();
        stream.next(rng, |rng| {
            let fresh = may_be_fresh && rng.random_bool(0.3);
            let column = |rng: &mut Pcg64Mcg| rng.random_range(-3..=machine.width as i32 + 3);
            Line {
                y: rng.random_range(0..machine.height),
                major: column(rng),
                minor: column(rng),
                left: rng.random(),
                values: words(machine, rng),
                fresh,
                fence: fresh || machine.fill == Fill::Textbook && rng.random_bool(0.2),
                source: source(machine, rng),
            }
        });
        let ready = rng.random_bool(0.5);
        probe.set(line_valid, stream.token.is_some());
        probe.set(span_ready, ready);
        let mut was_ready = false;
        if let Some(token) = &stream.token {
            probe.set_channel(&line, &tokens::line(machine, token));
            was_ready = model.line_ready(token);
            probe.check(&line_ready, was_ready)?;
        }
        probe.check(&span_valid, model.span().is_some())?;
        if let Some(expected) = model.span() {
            probe.check_channel(&span, &tokens::span(machine, expected))?;
        }
        probe.check(&fresh_queued, model.fresh_queued())?;
        probe.tick();
        model.step(stream.token.as_ref(), ready, &mut Coverage::default());
        stream.taken(was_ready);
    }
    Ok(probe)
}
