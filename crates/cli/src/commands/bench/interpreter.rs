//! The netlist in the interpreter; a frame begins with building the netlist, which is little beside its cycles.

use super::job::{Job, Times, Work};
use super::stopwatch::Stopwatch;
use anyhow::{Result, anyhow};
use edgewalk_lockstep::{StallKind, render_rtl};

/// Times it.
pub fn time(job: &Job) -> Result<Times> {
    job.time(&Stopwatch::start(), || {
        let drawn = render_rtl(job.machine, job.triangles.iter().copied(), job.state, StallKind::None);
        drawn.map(|frame| Work::of(&frame.counters)).map_err(|e| anyhow!("{e}"))
    })
}
