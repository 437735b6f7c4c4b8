//! How full the queues and lanes of a machine are over a frame.

use edgewalk_host::raster::Held;
use edgewalk_machine::Plan;
use serde::Serialize;

/// Means over the cycles of a frame, and what there is room for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Occupancy {
    /// Spans in the FIFO.
    pub span_fifo: Mean,
    /// Fragments between read and compare.
    pub inflight: Mean,
    /// Lanes of SETUP at work on an edge or a channel; rounds count as equally long.
    pub lanes: Mean,
}

/// How many there were in the mean, and how many there can be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mean {
    /// In the mean.
    pub mean: f64,
    /// At most.
    pub of: u32,
}

impl Occupancy {
    /// Of a frame that took so many cycles.
    #[must_use]
    pub fn of(machine: &Plan, cycles: u64, held: &Held) -> Self {
        // A triangle has three edges, and so many channels; each round takes one a lane.
        let jobs = [3, machine.channels().len() as u32];
        let at_work = jobs.map(|jobs| f64::from(jobs) / f64::from(jobs.div_ceil(machine.lanes)));
        let lane_clocks: f64 =
            held.setup.iter().zip(at_work).map(|(clocks, lanes)| *clocks as f64 * lanes).sum();
        Occupancy {
            span_fifo: Mean { mean: ratio(held.spans, cycles), of: machine.span_fifo },
            inflight: Mean { mean: ratio(held.fragments, cycles), of: machine.inflight },
            lanes: Mean {
                mean: if cycles == 0 { 0.0 } else { lane_clocks / cycles as f64 },
                of: machine.lanes,
            },
        }
    }

    /// As a line of text.
    #[must_use]
    pub fn lines(&self) -> String {
        let part = |Mean { mean, of }: Mean| format!("{mean:.3} of {of}");
        let [spans, fragments, lanes] = [self.span_fifo, self.inflight, self.lanes].map(part);
        format!("mean occupancy: span FIFO {spans}, fragments in flight {fragments}, setup lanes {lanes}\n")
    }
}

pub(crate) fn ratio(part: u64, whole: u64) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}
