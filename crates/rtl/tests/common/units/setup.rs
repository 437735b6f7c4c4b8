//! SETUP alone.

use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::Coverage;
use edgewalk_model::setup::Setup;
use edgewalk_model::tokens::Prim;
use rand::Rng;
use rand_pcg::Pcg64Mcg;

use super::{Stream, source};
use crate::common::probe::{Failure, Probe};
use crate::common::tokens;
use crate::common::triangles::random_triangle;

/// SETUP: random triangles, prims taken late.
pub fn setup(machine: &Plan, cycles: u64, rng: &mut Pcg64Mcg) -> Result<Probe, Failure> {
    let mut probe = Probe::new(edgewalk_rtl::setup(machine))?;
    let (tri_valid, prim_ready) = (probe.input("tri_valid")?, probe.input("prim_ready")?);
    let none = tokens::triangle(machine, &[PortVertex::default(); 3], 0);
    let tri = probe.input_channel("tri", &none)?;
    let tri_ready = probe.port("setup", "tri_ready", "tri_ready")?;
    let prim_valid = probe.port("setup", "prim_valid", "prim_valid")?;
    let prim = probe.channel("setup", "", "prim", &tokens::prim(machine, &Prim::default()))?;
    let (mut model, mut stream) = (Setup::new(machine), Stream { token: None });
    probe.reset()?;
    while probe.cycle < cycles {
        stream.next(rng, |rng| (random_triangle(machine, rng), source(machine, rng).tag));
        let ready = rng.random_bool(0.2);
        probe.set(tri_valid, stream.token.is_some());
        if let Some((triangle, tag)) = &stream.token {
            probe.set_channel(&tri, &tokens::triangle(machine, triangle, *tag));
        }
        probe.set(prim_ready, ready);
        probe.check(&tri_ready, model.tri_ready())?;
        probe.check(&prim_valid, model.prim().is_some())?;
        if let Some(expected) = model.prim() {
            probe.check_channel(&prim, &tokens::prim(machine, expected))?;
        }
        probe.tick();
        let was_ready = model.tri_ready();
        model.step(
            stream.token.as_ref().map(|(triangle, tag)| (triangle, *tag)),
            ready,
            &mut Coverage::default(),
        );
        probe.triangle += u64::from(stream.taken(was_ready));
    }
    Ok(probe)
}
