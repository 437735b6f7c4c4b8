//! The model, cycle by cycle.

use super::job::{Job, Times, Work};
use super::stopwatch::Stopwatch;
use anyhow::Result;
use edgewalk_model::tick;

/// Times it: clear and draw all, no more than Verilator's harness does.
pub fn time(job: &Job) -> Result<Times> {
    let frame = || tick(job.machine, job.triangles, job.state, job.waits, job.shading);
    job.time(&Stopwatch::start(), || Ok(Work::of(&frame().0)))
}
