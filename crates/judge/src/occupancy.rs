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
        // The lanes of a sequenced SETUP do the steps of its program together.
        let at_work = jobs.map(|jobs| match machine.is_sequenced() {
            true => f64::from(machine.lanes),
            false => f64::from(jobs) / f64::from(jobs.div_ceil(machine.lanes)),
        });
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

#[cfg(test)]
mod tests {
    use super::*;
    use edgewalk_machine::Machine;

    /// Three edges and N channels go over the lanes in rounds: 60 clocks of edges, 90 of channels, in 200 cycles.
    #[test]
    fn lanes_at_work_depend_on_the_channels() {
        let held = Held { setup: [60, 90], spans: 500, fragments: 900 };
        let of = |lanes: u32, extra: u32| {
            let mut machine = Machine { lanes, ..Machine::default() };
            machine.set("channels.extra", &extra.to_string()).expect("a key");
            let plan = machine.plan().expect("a machine");
            assert_eq!(plan.channels().len() as u32, 4 + extra);
            let found = Occupancy::of(&plan, 200, &held);
            assert_eq!(
                (found.span_fifo, found.inflight),
                (Mean { mean: 2.5, of: plan.span_fifo }, Mean { mean: 4.5, of: plan.inflight })
            );
            assert_eq!(found.lanes.of, lanes);
            found.lanes.mean
        };
        // One lane has one edge or one channel.
        assert_eq!([of(1, 0), of(1, 2)], [150.0 / 200.0; 2]);
        // Two lanes: three edges in two rounds, four channels in two, five in three, six in three.
        assert_eq!([of(2, 0), of(2, 2)], [(60.0 * 1.5 + 90.0 * 2.0) / 200.0; 2]);
        assert_eq!(of(2, 1), (60.0 * 1.5 + 90.0 * 5.0 / 3.0) / 200.0);
        // Four lanes: three edges in one round, four channels in one, six in two.
        assert_eq!(of(4, 0), (60.0 * 3.0 + 90.0 * 4.0) / 200.0);
        assert_eq!(of(4, 2), (60.0 * 3.0 + 90.0 * 3.0) / 200.0);
        let idle = Occupancy::of(&Plan::default(), 0, &held);
        assert_eq!((idle.span_fifo.mean, idle.inflight.mean, idle.lanes.mean), (0.0, 0.0, 0.0));
    }
}
