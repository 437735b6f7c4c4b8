//! How full the queues and lanes of a machine are over a frame.

use edgewalk_host::raster::Held;
use edgewalk_machine::Plan;
use serde_json::{Value, json};

/// Means over the cycles of a frame, and what there is room for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occupancy {
    /// Spans in the FIFO.
    pub spans: (f64, u32),
    /// Fragments between read and compare.
    pub fragments: (f64, u32),
    /// Lanes of SETUP at work on an edge or a channel; rounds count as equally long.
    pub lanes: (f64, u32),
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
            spans: (ratio(held.spans, cycles), machine.span_fifo),
            fragments: (ratio(held.fragments, cycles), machine.inflight),
            lanes: (if cycles == 0 { 0.0 } else { lane_clocks / cycles as f64 }, machine.lanes),
        }
    }

    /// As JSON.
    #[must_use]
    pub fn value(&self) -> Value {
        let part = |(mean, of): (f64, u32)| json!({ "mean": mean, "of": of });
        json!({
            "span_fifo": part(self.spans),
            "inflight": part(self.fragments),
            "lanes": part(self.lanes),
        })
    }

    /// As a line of text.
    #[must_use]
    pub fn text(&self) -> String {
        let part = |(mean, of): (f64, u32)| format!("{mean:.3} of {of}");
        let [spans, fragments, lanes] = [self.spans, self.fragments, self.lanes].map(part);
        format!("mean occupancy: span FIFO {spans}, fragments in flight {fragments}, setup lanes {lanes}\n")
    }
}

pub(crate) fn ratio(part: u64, whole: u64) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}
