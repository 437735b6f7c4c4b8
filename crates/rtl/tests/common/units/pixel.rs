//! PIXEL alone.

use edgewalk_machine::Plan;
use edgewalk_model::Coverage;
use edgewalk_model::pixel::Pixel;
use edgewalk_model::tokens::{Fragment, Span, Words};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

use super::{Stream, source, words};
use crate::common::probe::{Failure, Probe};
use crate::common::tokens;

/// PIXEL: spans anywhere around the screen, new increments all the time, fragments taken at random.
pub fn pixel(machine: &Plan, cycles: u64, rng: &mut Pcg64Mcg) -> Result<Probe, Failure> {
    let mut probe = Probe::new(edgewalk_rtl::pixel(machine))?;
    let (span_valid, frag_ready) = (probe.input("span_valid")?, probe.input("frag_ready")?);
    let span = probe.input_channel("span", &tokens::span(machine, &Span::default()))?;
    let increments = probe.input_channel("inc", &tokens::increments(&Words::default()))?;
    let span_ready = probe.port("pixel", "span_ready", "span_ready")?;
    let frag_valid = probe.port("pixel", "frag_valid", "frag_valid")?;
    let fragment = probe.channel("pixel", "", "frag", &tokens::fragment(machine, &Fragment::default()))?;
    let flags = ["active", "visible", "advance", "occupied"];
    let [active, visible, advance, occupied] = flags.map(|name| probe.port("pixel", name, name));
    let (active, visible, advance, occupied) = (active?, visible?, advance?, occupied?);
    let (mut model, mut stream) = (Pixel::new(machine), Stream { token: None });
    let often = rng.random_range(0.2..1.0);
    probe.reset()?;
    while probe.cycle < cycles {
        stream.next(rng, |rng| Span {
            x: rng.random_range(-4..machine.width as i32 + 4),
            y: rng.random_range(0..machine.height),
            count: rng.random_range(1..=9),
            left: rng.random(),
            values: words(machine, rng),
            fresh: rng.random(),
            fence: rng.random(),
            source: source(machine, rng),
        });
        let (ready, gradient) = (rng.random_bool(often), words(machine, rng));
        probe.set(span_valid, stream.token.is_some());
        if let Some(token) = &stream.token {
            probe.set_channel(&span, &tokens::span(machine, token));
        }
        probe.set(frag_ready, ready);
        probe.set_channel(&increments, &tokens::increments(&gradient));
        probe.check(&span_ready, model.span_ready(ready))?;
        probe.check(&frag_valid, model.frag().is_some())?;
        if let Some(expected) = model.frag() {
            probe.check_channel(&fragment, &tokens::fragment(machine, expected))?;
        }
        probe.check(&active, model.active())?;
        if model.active() {
            probe.check(&visible, model.on_screen())?;
        }
        probe.check(&advance, model.advance(ready))?;
        probe.check(&occupied, model.occupied())?;
        probe.tick();
        let was_ready = model.span_ready(ready);
        model.step(stream.token.as_ref(), &gradient, ready, &mut Coverage::default());
        stream.taken(was_ready);
    }
    Ok(probe)
}
