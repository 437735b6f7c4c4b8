//! The model without ticking.

use super::job::{Job, Times, Work};
use super::stopwatch::Stopwatch;
use anyhow::{Result, anyhow};
use edgewalk_model::fast::{Path, Refusal, Renderer};

/// Times it, or says why this frame has to be ticked.
pub fn time(job: &Job) -> Result<Result<Times, String>> {
    match Renderer::new(job.machine, false).draw(job.triangles.iter(), job.state) {
        Ok(()) => {}
        Err(Refusal::Tick(reason)) => return Ok(Err(Path::Ticked(reason).to_string())),
        Err(Refusal::Foreign(foreign)) => return Err(foreign.into()),
    }
    let start = Stopwatch::start();
    let mut renderer = Renderer::new(job.machine, false);
    let frame = || match renderer.draw(job.triangles.iter(), job.state) {
        Ok(()) => Ok(Work::of(renderer.counters())),
        Err(refusal) => Err(anyhow!("the fast engine drew this frame before: {refusal:?}")),
    };
    job.time(&start, frame).map(Ok)
}
