//! What the datapath would take with a memory that is always ready, and what each memory would take for the same accesses with a
//! datapath that never keeps it waiting.
//!
//! ```text
//!  spans ───│─────────│──────────────│───  windows of at least 256 cycles of the datapath, ending at the same spans in both runs
//!  datapath │ D1      │ D2           │
//!  memory   │ M1 │    │ M2                │    cycles to be expected = sum of the greater of both
//! ```
//! Windows are there because work of one kind does not hide work of the other from another part of the frame.

use crate::counters::PACED;
use crate::io::Cycle;
use crate::machine::Model;
use crate::service::Service;
use crate::waits::Waits;
use edgewalk_machine::Plan;

/// Least cycles of a window.
const WINDOW: u64 = 256;

/// Clocks of a memory's port, or of its controller.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortClocks {
    /// Name of the memory.
    pub memory: &'static str,
    /// `read`, `write`, or `all` of one controller.
    pub port: &'static str,
    /// Clocks that it works.
    pub clocks: u64,
}

/// Datapath and memories, each alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Roofline {
    /// Cycles with these memories.
    pub cycles: u64,
    /// Cycles with memories that are always ready.
    pub datapath: u64,
    /// Clocks of every port that was used.
    pub ports: Vec<PortClocks>,
    /// Of each window the cycles of the datapath, and the clocks of the port that works longest.
    pub windows: Vec<[u64; 2]>,
}

impl Roofline {
    /// The port that works longest.
    #[must_use]
    pub fn busiest(&self) -> Option<&PortClocks> {
        self.ports.iter().max_by_key(|port| port.clocks)
    }

    /// Clocks of the port that works longest.
    #[must_use]
    pub fn memory(&self) -> u64 {
        self.busiest().map_or(0, |port| port.clocks)
    }

    /// A memory binds, not the datapath.
    #[must_use]
    pub fn memory_binds(&self) -> bool {
        self.memory() > self.datapath
    }

    /// Cycles to be expected if datapath and memories took so many times as long.
    #[must_use]
    pub fn expected(&self, datapath: f64, memory: f64) -> f64 {
        self.windows.iter().map(|[d, m]| (*d as f64 * datapath).max(*m as f64 * memory)).sum()
    }

    /// Windows in which a memory takes longer than the datapath.
    #[must_use]
    pub fn windows_of_memory(&self) -> usize {
        self.windows.iter().filter(|[datapath, memory]| memory > datapath).count()
    }
}

/// Takes windows down.
pub(super) struct Windows {
    services: [Service; PACED],
    /// Reads of each word memory that were seen.
    reads: Vec<u64>,
    /// Reads of the colour memory that were seen.
    color_reads: u64,
    blends: bool,
    /// Spans that have entered PIXEL at the end of each window.
    ends: Vec<u64>,
    /// The ends are those of another run.
    follows: bool,
    cycles: Vec<u64>,
    /// Of each window the clocks of the port that works longest.
    clocks: Vec<u64>,
    now: u64,
    /// Cycle and clocks at the start of the window.
    start: u64,
    before: [[u64; 2]; PACED],
    spans: u64,
}

impl Windows {
    /// Of a run that makes the windows.
    pub fn new(plan: &Plan, waits: Waits) -> Self {
        Windows {
            services: std::array::from_fn(|_| Service::new(waits)),
            reads: vec![0; plan.word_memories().len()],
            color_reads: 0,
            blends: plan.blend.is_there(),
            ends: Vec::new(),
            follows: false,
            cycles: Vec::new(),
            clocks: Vec::new(),
            now: 0,
            start: 0,
            before: [[0; 2]; PACED],
            spans: 0,
        }
    }

    /// Of a run with the windows of another.
    pub fn beside(plan: &Plan, waits: Waits, other: &Windows) -> Self {
        Windows { ends: other.ends.clone(), follows: true, ..Windows::new(plan, waits) }
    }

    /// A cycle, and the machine behind it.
    pub fn see<const C: usize>(&mut self, model: &Model<C>, cycle: &Cycle<C>) {
        self.now += 1;
        self.services[0].access(cycle.read, cycle.write().map(|write| write.addr));
        let counters = model.counters();
        if self.blends {
            let blend = &cycle.outputs.blend;
            let read = blend.crd.filter(|_| counters.color_reads != self.color_reads);
            self.color_reads = counters.color_reads;
            self.services[1].access(read, cycle.color_write().map(|write| write.addr));
        }
        for (place, reads) in self.reads.iter_mut().enumerate() {
            if counters.word_reads[place] != *reads {
                *reads = counters.word_reads[place];
                self.services[2 + place].access(model.asks()[place].addr, None);
            }
        }
        if counters.spans == self.spans {
            return;
        }
        self.spans = counters.spans;
        let ends = match self.follows {
            true => self.ends.get(self.cycles.len()).is_some_and(|end| self.spans >= *end),
            false => self.now - self.start >= WINDOW,
        };
        if ends {
            self.close();
        }
    }

    fn close(&mut self) {
        let clocks = self.services.each_ref().map(Service::clocks);
        let spent = clocks
            .iter()
            .zip(&self.before)
            .flat_map(|(now, before)| [now[0] - before[0], now[1] - before[1]]);
        self.clocks.push(spent.max().unwrap_or(0));
        self.cycles.push(self.now - self.start);
        if !self.follows {
            self.ends.push(self.spans);
        }
        (self.start, self.before) = (self.now, clocks);
    }

    /// Beside the run with memories that are always ready.
    pub fn roofline(mut self, plan: &Plan, mut free: Windows) -> Roofline {
        self.close();
        free.close();
        let names = ["depth", "color"].into_iter();
        let names = names.chain(plan.word_memories().into_iter().map(|(_, memory)| memory.name));
        let mut ports = Vec::new();
        for (memory, service) in names.zip(&self.services) {
            let [first, second] = service.clocks();
            let words = if service.is_shared() { ["all", ""] } else { ["read", "write"] };
            let both = words.into_iter().zip([first, second]).filter(|(_, clocks)| *clocks > 0);
            ports.extend(both.map(|(port, clocks)| PortClocks { memory, port, clocks }));
        }
        let windows = free.cycles.iter().zip(&self.clocks).map(|(datapath, memory)| [*datapath, *memory]);
        Roofline { cycles: self.now, datapath: free.now, ports, windows: windows.collect() }
    }
}
