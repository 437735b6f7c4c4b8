//! The netlist in the interpreter; a frame begins with building the netlist, which is little beside its cycles.

use super::job::{Job, Times, Work};
use super::stopwatch::Stopwatch;
use anyhow::Result;
use edgewalk_lockstep::tick_rtl;

/// Times it.
pub fn time(job: &Job) -> Result<Times> {
    job.time(&Stopwatch::start(), || {
        let triangles = job.triangles.iter().copied();
        Ok(Work::of(&tick_rtl(job.machine, triangles, job.state, job.shading)?))
    })
}
