//! DEPTH: reads the stored depth of every fragment, compares, writes.
//!
//! ```text
//!  frag ─┬─> rd (addr)            data ──┐
//!        └─> in-flight queue ─> head ─> compare ─pass─> w ─> wr
//!               ^── forward ───────────────┴─────────────┘
//! ```
//! Formats: depth and colour of b bits, addresses y·2^xb + x.
//!
//! Timing: a fragment and a compare a clock; a compare in cycle n is offered as a write in n + 1.
//!
//! Rules: `docs/machine.md`, section 6; the three hazard policies draw the same picture. Not modelled: nothing.

use crate::Coverage;
use crate::inflight::{InFlight, InFlightHead};
use crate::tokens::{Fragment, Write};
use edgewalk_numerics::{Hazard, Machine};

/// Why no fragment can enter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// Its pixel may still be in flight.
    Hazard,
    /// The in-flight queue is full.
    Full,
}

/// The unit's inputs of a cycle, but for the fragment.
#[derive(Clone, Copy, Debug, Default)]
pub struct DepthInputs {
    /// Compare function: 0 never, 1 less, 2 equal, 3 lequal, 4 greater, 5 notequal, 6 gequal, 7 always.
    pub depth_func: u8,
    /// Fragments that pass store their depth.
    pub depth_write: bool,
    /// The memory takes a read.
    pub rd_ready: bool,
    /// The oldest read's depth.
    pub data: Option<u64>,
    /// The memory takes a write.
    pub wr_ready: bool,
}

/// State of DEPTH.
#[derive(Clone, Debug)]
pub struct Depth {
    hazard: Hazard,
    depth: usize,
    queue: InFlight,
    w: Option<Write>,
}

impl Depth {
    /// An empty unit.
    #[must_use]
    pub fn new(machine: &Machine) -> Self {
        Depth {
            hazard: machine.hazard,
            depth: machine.inflight as usize,
            queue: InFlight::default(),
            w: None,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.queue.clear();
        self.w = None;
    }

    /// Fragments or a write are in flight.
    #[inline]
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.queue.len() > 0 || self.w.is_some()
    }

    /// What keeps the fragment from being read: `rd_valid` = a fragment and no block, `frag_ready` = `rd_ready` and no
    /// block. Without a fragment there is no hazard.
    #[inline]
    #[must_use]
    pub fn block(&self, frag: Option<&Fragment>, depth_write: bool) -> Option<Block> {
        if frag.is_some_and(|f| self.hazard(f, depth_write)) {
            Some(Block::Hazard)
        } else {
            (self.queue.len() == self.depth).then_some(Block::Full)
        }
    }

    #[inline]
    fn hazard(&self, frag: &Fragment, depth_write: bool) -> bool {
        match self.hazard {
            Hazard::Forward => false,
            Hazard::Drain => frag.fence && self.occupied(),
            Hazard::Interlock => {
                depth_write
                    && (self.queue.holds(frag.addr)
                        || self.w.as_ref().is_some_and(|w| w.z_en && w.addr == frag.addr))
            }
        }
    }

    /// The old depth can be taken.
    #[inline]
    #[must_use]
    pub fn data_ready(&self, wr_ready: bool) -> bool {
        self.queue.len() > 0 && (self.w.is_none() || wr_ready)
    }

    /// The write offered to the frame memory.
    #[inline]
    #[must_use]
    pub fn write(&self) -> Option<&Write> {
        self.w.as_ref()
    }

    /// The fragment whose read fired last (its fence is not kept); it says what `rd` was after the cycle of the fire.
    #[inline]
    #[must_use]
    pub fn last_read(&self) -> Fragment {
        self.queue.youngest()
    }

    /// Clock edge.
    #[inline]
    pub fn step(
        &mut self,
        frag: Option<&Fragment>,
        block: Option<Block>,
        inputs: &DepthInputs,
        coverage: &mut Coverage,
    ) {
        let entering = frag.filter(|_| block.is_none() && inputs.rd_ready);
        if entering.is_none() && frag.is_some() {
            self.count_wait(block, coverage);
        }
        let from_w = entering.and_then(|f| self.forward_from_w(f.addr));
        let compared = inputs.data.filter(|_| self.data_ready(inputs.wr_ready));
        if let Some(data) = compared {
            self.compare(data as u32, inputs, coverage); // b <= 32 bits
        } else if inputs.wr_ready {
            self.w = None;
        } else if self.w.is_some() {
            coverage.write_stall += 1;
        }
        if let Some(frag) = entering {
            // The compare of this same cycle comes first; w now holds what it writes.
            let from_compare = compared.and_then(|_| self.forward_from_w(frag.addr));
            if from_compare.is_some() {
                coverage.forward_compare += 1;
            } else if from_w.is_some() {
                coverage.forward_write += 1;
            }
            self.queue.push(frag, from_compare.or(from_w));
        }
    }

    /// The depth that w writes to this address, if it does.
    #[inline]
    fn forward_from_w(&self, addr: u32) -> Option<u32> {
        match &self.w {
            Some(w) if self.hazard == Hazard::Forward && w.z_en && w.addr == addr => Some(w.z),
            _ => None,
        }
    }

    /// Compares the oldest fragment and drops it; if it passes it is written, and those of its pixel that are queued
    /// take its depth.
    #[inline]
    fn compare(&mut self, data: u32, inputs: &DepthInputs, coverage: &mut Coverage) {
        let InFlightHead { fragment, forward } = self.queue.pop();
        if forward.is_some() {
            coverage.forward_used += 1;
        }
        // Bits 0, 1 and 2 of the function say whether less, equal and greater pass.
        let relation = fragment.z.cmp(&forward.unwrap_or(data)) as i8 + 1;
        if inputs.depth_func >> relation & 1 == 0 {
            self.w = None;
            coverage.depth_fail += 1;
            return;
        }
        self.w = Some(Write {
            addr: fragment.addr,
            z: fragment.z,
            rgb: fragment.rgb,
            z_en: inputs.depth_write,
            source: fragment.source,
        });
        if self.hazard == Hazard::Forward && inputs.depth_write {
            self.queue.forward(fragment.addr, fragment.z, coverage);
        }
    }

    #[inline]
    fn count_wait(&self, block: Option<Block>, coverage: &mut Coverage) {
        match (block, self.hazard) {
            (Some(Block::Hazard), Hazard::Drain) => coverage.drain_stall += 1,
            (Some(Block::Hazard), _) => coverage.interlock_stall += 1,
            (Some(Block::Full), _) => coverage.queue_full += 1,
            (None, _) => coverage.memory_stall += 1,
        }
    }
}
