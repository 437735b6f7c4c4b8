//! The model without ticking.

use super::job::{Job, Times, Work};
use super::stopwatch::Stopwatch;
use anyhow::{Result, anyhow};
use edgewalk_model::fast::{Path, Renderer};

/// Times it, or says why this frame has to be ticked.
pub fn time(job: &Job) -> Result<Result<Times, String>> {
    if let Err(reason) = Renderer::new(job.machine, false).draw(job.triangles.iter().copied(), job.state) {
        return Ok(Err(Path::Ticked(reason).to_string()));
    }
    let start = Stopwatch::start();
    let mut renderer = Renderer::new(job.machine, false);
    let frame = || match renderer.draw(job.triangles.iter().copied(), job.state) {
        Ok(()) => Ok(Work::of(renderer.counters())),
        Err(reason) => Err(anyhow!("{}", Path::Ticked(reason))),
    };
    job.time(&start, frame).map(Ok)
}
