//! The model, cycle by cycle.

use super::job::{Job, Times, Work};
use super::stopwatch::Stopwatch;
use anyhow::Result;
use edgewalk_model::{Rig, for_channels};
use std::convert::Infallible;

/// Times it.
pub fn time(job: &Job) -> Result<Times> {
    job.time(&Stopwatch::start(), || Ok(for_channels!(job.machine, C => frame::<C>(job))))
}

/// Clear and draw all, no more than Verilator's harness does.
fn frame<const C: usize>(job: &Job) -> Work {
    let mut rig = Rig::<C>::new(job.machine, job.state, job.waits);
    rig.memories.write_shading(job.machine, job.shading);
    let triangles = job.triangles.iter().map(|triangle| Ok::<_, Infallible>(*triangle));
    let Ok(()) = rig.draw(triangles, |_, _, _| {});
    Work::of(rig.model.counters())
}
