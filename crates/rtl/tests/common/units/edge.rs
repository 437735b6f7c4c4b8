//! EDGE alone.

use edgewalk_machine::Plan;
use edgewalk_model::Coverage;
use edgewalk_model::edge::Edge;
use edgewalk_model::setup::Setup;
use edgewalk_model::tokens::{Line, Prim, Words};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

use super::{Stream, source};
use crate::common::probe::{Failure, Probe};
use crate::common::tokens;
use crate::common::triangles::random_triangle;

/// The prims of random triangles that are not culled.
fn prims(machine: &Plan, count: usize, rng: &mut Pcg64Mcg) -> Vec<Prim> {
    let (mut setup, mut prims) = (Setup::new(machine), Vec::new());
    // A triangle in so many is not culled, in any machine; the limit is for machines where that fails.
    for _ in 0..200 * count {
        let triangle = random_triangle(machine, rng);
        setup.step(Some((&triangle, source(machine, rng).tag)), true, &mut Coverage::default());
        while !setup.tri_ready() {
            prims.extend(setup.prim().copied());
            setup.step(None, true, &mut Coverage::default());
        }
        if prims.len() >= count {
            break;
        }
    }
    prims
}

/// EDGE: prims of random triangles, lines taken at random, PIXEL at random late with the increments.
pub fn edge(machine: &Plan, cycles: u64, rng: &mut Pcg64Mcg) -> Result<Probe, Failure> {
    let mut probe = Probe::new(edgewalk_rtl::edge(machine))?;
    let prims = prims(machine, 50, rng);
    let (prim_valid, line_ready) = (probe.input("prim_valid")?, probe.input("line_ready")?);
    let fresh_queued = probe.input("fresh_queued")?;
    let prim = probe.input_channel("prim", &tokens::prim(machine, &Prim::default()))?;
    let prim_ready = probe.port("edge", "prim_ready", "prim_ready")?;
    let line_valid = probe.port("edge", "line_valid", "line_valid")?;
    let line = probe.channel("edge", "", "line", &tokens::line(machine, &Line::default()))?;
    let increments = probe.channel("edge", "", "inc", &tokens::increments(&Words::default()))?;
    let (mut model, mut stream) = (Edge::new(machine), Stream { token: None });
    probe.reset()?;
    while probe.cycle < cycles && !prims.is_empty() {
        stream.next(rng, |rng| prims[rng.random_range(0..prims.len())]);
        let (ready, queued) = (rng.random_bool(0.7), rng.random_bool(0.3));
        probe.set(prim_valid, stream.token.is_some());
        if let Some(token) = &stream.token {
            probe.set_channel(&prim, &tokens::prim(machine, token));
        }
        probe.set(line_ready, ready);
        probe.set(fresh_queued, queued);
        probe.check(&prim_ready, model.prim_ready(queued))?;
        probe.check(&line_valid, model.line().is_some())?;
        if let Some(expected) = model.line() {
            probe.check_channel(&line, &tokens::line(machine, expected))?;
            probe.check_channel(&increments, &tokens::increments(model.gradient()))?;
        }
        probe.tick();
        let was_ready = model.prim_ready(queued);
        let fires = ready && model.line().is_some();
        model.step(stream.token.as_ref(), queued, fires, &mut Coverage::default());
        probe.triangle += u64::from(stream.taken(was_ready));
    }
    Ok(probe)
}
