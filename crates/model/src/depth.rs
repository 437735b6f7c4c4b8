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
use edgewalk_machine::{Hazard, Plan};

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
    /// The hazard policy is forward.
    forwards: bool,
    depth: usize,
    queue: InFlight,
    w_valid: bool,
    w: Write,
}

impl Depth {
    /// An empty unit.
    #[must_use]
    pub fn new(machine: &Plan) -> Self {
        Depth {
            hazard: machine.hazard,
            forwards: machine.hazard == Hazard::Forward,
            depth: machine.inflight as usize,
            queue: InFlight::default(),
            w_valid: false,
            w: Write::default(),
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.queue.clear();
        self.w_valid = false;
    }

    /// Fragments or a write are in flight.
    #[inline]
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.queue.len() > 0 || self.w_valid
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
                        || self.w_valid && self.w.z_en && self.w.addr == frag.addr)
            }
        }
    }

    /// The old depth can be taken.
    #[inline]
    #[must_use]
    pub fn data_ready(&self, wr_ready: bool) -> bool {
        self.queue.len() > 0 && (!self.w_valid || wr_ready)
    }

    /// The write offered to the frame memory.
    #[inline]
    #[must_use]
    pub fn write(&self) -> Option<&Write> {
        self.w_valid.then_some(&self.w)
    }

    /// The fragment whose read fired last (its fence is not kept); it says what `rd` was after the cycle of the fire.
    #[inline]
    #[must_use]
    pub fn last_read(&self) -> Fragment {
        self.queue.youngest()
    }

    /// Clock edge.
    #[inline(always)]
    pub fn step(
        &mut self,
        frag: Option<&Fragment>,
        block: Option<Block>,
        inputs: &DepthInputs,
        coverage: &mut Coverage,
    ) {
        let compared = inputs.data.filter(|_| self.data_ready(inputs.wr_ready));
        if let Some(frag) = frag {
            if block.is_none() && inputs.rd_ready {
                self.enter(frag, coverage);
            } else {
                self.count_wait(block, coverage);
            }
        }
        // The fragment that enters in this same cycle is queued by now: what the compare writes reaches it too.
        if let Some(data) = compared {
            self.compare(data as u32, inputs, coverage); // b <= 32 bits
        } else if inputs.wr_ready {
            self.w_valid = false;
        } else if self.w_valid {
            coverage.write_stall += 1;
        }
    }

    /// Queues a fragment; if w writes its pixel, with the depth that w writes.
    #[inline]
    fn enter(&mut self, frag: &Fragment, coverage: &mut Coverage) {
        let written = self.forwards && self.w_valid && self.w.z_en && self.w.addr == frag.addr;
        if written {
            coverage.forward_write += 1;
        }
        self.queue.push(frag, written.then_some(self.w.z));
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
        let old = forward.unwrap_or(data);
        let relation = u8::from(fragment.z > old) + u8::from(fragment.z >= old);
        let pass = inputs.depth_func >> relation & 1 != 0;
        // Nobody looks at w where it is not valid; so it is loaded without asking, as a register would be.
        self.w_valid = pass;
        self.w = Write {
            addr: fragment.addr,
            z: fragment.z,
            rgb: fragment.rgb,
            z_en: inputs.depth_write,
            source: fragment.source,
        };
        coverage.depth_fail = coverage.depth_fail.wrapping_add(u64::from(!pass)); // in every cycle: not checked
        if self.forwards && pass && inputs.depth_write {
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
