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
use crate::fifo::Fifo;
use crate::tokens::{Fragment, Write};
use edgewalk_numerics::{Hazard, Machine};

/// A fragment that waits for its old depth.
#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    fragment: Fragment,
    /// The old depth, if an older fragment still in flight writes it.
    forward: Option<u64>,
}

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
    queue: Fifo<Entry, 16>,
    w: Option<Write>,
}

impl Depth {
    /// An empty unit.
    #[must_use]
    pub fn new(machine: &Machine) -> Self {
        Depth { hazard: machine.hazard, depth: machine.inflight as usize, queue: Fifo::default(), w: None }
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
        !self.queue.is_empty() || self.w.is_some()
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
                    && ((0..self.queue.len()).any(|i| self.queue.at(i).fragment.addr == frag.addr)
                        || self.w.is_some_and(|w| w.z_en && w.addr == frag.addr))
            }
        }
    }

    /// The old depth can be taken.
    #[inline]
    #[must_use]
    pub fn data_ready(&self, wr_ready: bool) -> bool {
        !self.queue.is_empty() && (self.w.is_none() || wr_ready)
    }

    /// The write offered to the frame memory.
    #[inline]
    #[must_use]
    pub fn write(&self) -> Option<&Write> {
        self.w.as_ref()
    }

    /// The fragment whose read fired last; it says what `rd` was after the cycle of the fire.
    #[inline]
    #[must_use]
    pub fn last_read(&self) -> &Fragment {
        &self.queue.at(self.queue.len().wrapping_sub(1)).fragment
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
        let w_before = self.w;
        let mut compared = None;
        if let (Some(data), true) = (inputs.data, self.data_ready(inputs.wr_ready)) {
            compared = self.compare(data, inputs, coverage);
            self.w = compared;
        } else if inputs.wr_ready {
            self.w = None;
        } else {
            coverage.write_stall += u64::from(self.w.is_some());
        }
        if let Some(frag) = entering {
            let forward = self.forward_entering(frag.addr, compared.as_ref(), w_before.as_ref(), coverage);
            self.queue.push(Entry { fragment: *frag, forward });
        } else if frag.is_some() {
            match (block, self.hazard) {
                (Some(Block::Hazard), Hazard::Drain) => coverage.drain_stall += 1,
                (Some(Block::Hazard), _) => coverage.interlock_stall += 1,
                (Some(Block::Full), _) => coverage.queue_full += 1,
                (None, _) => coverage.memory_stall += 1,
            }
        }
    }

    /// Compares the head and drops it; gives what it writes, if it passes.
    #[inline]
    fn compare(&mut self, data: u64, inputs: &DepthInputs, coverage: &mut Coverage) -> Option<Write> {
        let Entry { fragment, forward } = *self.queue.head();
        self.queue.pop();
        coverage.forward_used += u64::from(forward.is_some());
        let old = forward.unwrap_or(data);
        // Bits 0, 1 and 2 of the function say whether less, equal and greater pass.
        let relation = fragment.z.cmp(&old) as i8 + 1;
        if inputs.depth_func >> relation & 1 == 0 {
            coverage.depth_fail += 1;
            return None;
        }
        coverage.depth_pass += 1;
        if self.hazard == Hazard::Forward && inputs.depth_write {
            for i in 0..self.queue.len() {
                let entry = self.queue.at_mut(i);
                if entry.fragment.addr == fragment.addr {
                    entry.forward = Some(fragment.z);
                    coverage.forward_compare += 1;
                }
            }
        }
        Some(Write {
            addr: fragment.addr,
            z: fragment.z,
            z_en: inputs.depth_write,
            rgb: fragment.rgb,
            tag: fragment.tag,
            id: fragment.id,
        })
    }

    /// The old depth of a fragment that enters, if the compare of this cycle or w still writes it.
    #[inline]
    fn forward_entering(
        &self,
        addr: u32,
        compared: Option<&Write>,
        w: Option<&Write>,
        coverage: &mut Coverage,
    ) -> Option<u64> {
        if self.hazard != Hazard::Forward {
            return None;
        }
        let writes_here = |w: &&Write| w.z_en && w.addr == addr;
        if let Some(compared) = compared.filter(writes_here) {
            coverage.forward_compare_entering += 1;
            return Some(compared.z);
        }
        let w = w.filter(writes_here)?;
        coverage.forward_write += 1;
        Some(w.z)
    }
}
