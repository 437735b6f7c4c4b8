//! The model, cycle by cycle.

use super::job::{Job, Times, Work};
use super::stopwatch::Stopwatch;
use anyhow::Result;
use edgewalk_model::{Inputs, Memory, Model, Stalls};

/// Times it.
pub fn time(job: &Job) -> Result<Times> {
    job.time(&Stopwatch::start(), || Ok(frame(job)))
}

/// Clear and draw all, no more than Verilator's harness does.
fn frame(job: &Job) -> Work {
    let mut model = Model::new(job.machine);
    let mut memory = Memory::new(job.machine, job.state.clear, Stalls::NONE);
    let mut triangles = job.triangles.iter();
    let mut next = triangles.next();
    loop {
        let inputs = Inputs {
            rst: false,
            tri: next.map(|t| (t, 0)),
            depth_func: job.state.depth_func,
            depth_write: job.state.depth_write,
            rd_ready: memory.rd_ready(),
            data: memory.data(),
            wr_ready: memory.wr_ready(),
        };
        let outputs = model.cycle(&inputs);
        let data_taken = inputs.data.is_some() && outputs.data_ready;
        memory.step(
            outputs.rd.filter(|_| inputs.rd_ready),
            data_taken,
            outputs.wr.as_ref().filter(|_| inputs.wr_ready),
        );
        if outputs.tri_ready && next.is_some() {
            next = triangles.next();
        } else if outputs.idle && next.is_none() {
            return Work::of(model.counters());
        }
    }
}
