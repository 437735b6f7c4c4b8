//! The netlist in the interpreter; a frame begins with building the netlist, which is little beside its cycles.

use super::job::{Job, Times, Work};
use super::stopwatch::Stopwatch;
use anyhow::Result;
use edgewalk_lockstep::{StallKind, render_rtl_passes};
use edgewalk_model::Pass;

/// Times it.
pub fn time(job: &Job) -> Result<Times> {
    job.time(&Stopwatch::start(), || {
        let (triangles, passes) = (job.triangles.iter().copied(), [Pass::all(job.state)]);
        let drawn = render_rtl_passes(job.machine, triangles, &passes, &[], StallKind::None, job.shading);
        Ok(Work::of(&drawn?.counters))
    })
}
