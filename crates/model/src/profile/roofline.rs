//! What the datapath would take with a memory that is always ready, and what each memory would take for the same accesses with a
//! datapath that never keeps it waiting.
//!
//! ```text
//!  spans ───│─────────│──────────────│───  windows of at least 256 cycles of the datapath
//!  datapath │ D1      │ D2           │
//!  reads    │ · ·  ·· │ ·   · · ·  · │    from read to read PIXEL's own cycles P, and the clocks of the memory M
//!  cycles to be expected = sum over the windows of the greater of D, and of the sum over the reads of the greater of P and M
//! ```
//! Windows are there because work of one kind does not hide work of the other from another part of the frame. PIXEL waits while the
//! memory takes no read, so its own cycles, of pixels beside the screen too, hide behind one read alone. SETUP, EDGE and SPAN go on.

use crate::counters::PACED;
use crate::io::Cycle;
use crate::machine::Model;
use crate::service::Service;
use crate::waits::Waits;
use edgewalk_machine::{Activity, Plan};

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
    /// Parts of the frame.
    pub windows: Vec<Window>,
}

/// A part of the frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Window {
    /// Cycles of the datapath.
    pub datapath: u64,
    /// Of each read of a depth, until the next: PIXEL's own cycles, and the clocks of the port that works longest.
    pub reads: Vec<[u32; 2]>,
}

impl Window {
    /// Cycles to be expected if datapath and memories took so many times as long: of the datapath, and of PIXEL with the memory.
    fn expected(&self, datapath: f64, memory: f64) -> [f64; 2] {
        let read = |[own, clocks]: &[u32; 2]| (f64::from(*own) * datapath).max(f64::from(*clocks) * memory);
        [self.datapath as f64 * datapath, self.reads.iter().map(read).sum()]
    }
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
        let windows = self.windows.iter().map(|window| window.expected(datapath, memory));
        windows.map(|[datapath, memory]| datapath.max(memory)).sum()
    }

    /// Windows in which a memory takes longer than the datapath.
    #[must_use]
    pub fn windows_of_memory(&self) -> usize {
        let windows = self.windows.iter().map(|window| window.expected(1.0, 1.0));
        windows.filter(|[datapath, memory]| memory > datapath).count()
    }
}

/// Takes windows down.
pub(super) struct Windows {
    services: [Service; PACED],
    /// Reads of each word memory that were seen.
    word_reads: Vec<u64>,
    /// Reads of the colour memory that were seen.
    color_reads: u64,
    blends: bool,
    /// Of each window the cycles, and how many depths were read before its end.
    closed: Vec<(u64, usize)>,
    /// Of each read of a depth, until the next: PIXEL's own cycles, and the clocks of the port that works longest.
    reads: Vec<[u32; 2]>,
    /// PIXEL's own cycles since the last read.
    own: u32,
    /// Clocks of the ports at the last read.
    before: [[u64; 2]; PACED],
    now: u64,
    /// Cycle at the start of the window.
    start: u64,
    spans: u64,
}

impl Windows {
    /// Of a run that makes the windows.
    pub fn new(plan: &Plan, waits: Waits) -> Self {
        Windows {
            services: std::array::from_fn(|_| Service::new(waits)),
            word_reads: vec![0; plan.word_memories().len()],
            color_reads: 0,
            blends: plan.blend.is_there(),
            closed: Vec::new(),
            reads: Vec::new(),
            own: 0,
            before: [[0; 2]; PACED],
            now: 0,
            start: 0,
            spans: 0,
        }
    }

    /// A cycle, and the machine behind it.
    pub fn see<const C: usize>(&mut self, model: &Model<C>, cycle: &Cycle<C>) {
        self.now += 1;
        if cycle.read.is_some() {
            self.settle();
            self.reads.push([0; 2]);
        }
        self.own += u32::from(matches!(cycle.outputs.activity, Activity::Draw | Activity::Offscreen));
        let counters = model.counters();
        self.services[0].access(cycle.read, cycle.write().map(|write| write.addr));
        if self.blends {
            let blend = &cycle.outputs.blend;
            let read = blend.crd.filter(|_| counters.color_reads != self.color_reads);
            self.color_reads = counters.color_reads;
            self.services[1].access(read, cycle.color_write().map(|write| write.addr));
        }
        for (place, reads) in self.word_reads.iter_mut().enumerate() {
            if counters.word_reads[place] != *reads {
                *reads = counters.word_reads[place];
                self.services[2 + place].access(model.asks()[place].addr, None);
            }
        }
        if counters.spans == self.spans {
            return;
        }
        self.spans = counters.spans;
        if self.now - self.start >= WINDOW {
            self.close();
        }
    }

    /// Books PIXEL's own cycles and the memory's clocks since the last read to that read.
    fn settle(&mut self) {
        let clocks = self.services.each_ref().map(Service::clocks);
        let spent = clocks
            .iter()
            .zip(&self.before)
            .flat_map(|(now, before)| [now[0] - before[0], now[1] - before[1]]);
        let own = std::mem::take(&mut self.own);
        if let Some(last) = self.reads.last_mut() {
            *last = [own, spent.max().unwrap_or(0).try_into().unwrap_or(u32::MAX)];
        }
        self.before = clocks;
    }

    fn close(&mut self) {
        self.closed.push((self.now - self.start, self.reads.len()));
        self.start = self.now;
    }

    /// Beside the run with memories that are always ready.
    pub fn roofline(mut self, plan: &Plan, mut free: Windows) -> Roofline {
        self.settle();
        free.settle();
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
        let mut reads = free.reads.iter().zip(&self.reads).map(|([own, _], [_, clocks])| [*own, *clocks]);
        let mut before = 0;
        let mut windows = Vec::new();
        for (datapath, end) in free.closed {
            windows.push(Window { datapath, reads: reads.by_ref().take(end - before).collect() });
            before = end;
        }
        Roofline { cycles: self.now, datapath: free.now, ports, windows }
    }
}
