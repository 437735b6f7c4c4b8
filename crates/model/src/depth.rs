//! DEPTH: reads the stored depth of every fragment, compares, writes.
//!
//! ```text
//!  frag ─┬─> rd (addr)            data ──┐
//!        └─> in-flight queue ─> head ─> compare ─pass─> w ─> wr
//!               ^── forward ───────────────┴─────────────┘
//! ```
//! Formats: outputs of b bits, addresses y·2^xb + x.
//!
//! Timing: a fragment and a compare a clock; a compare in cycle n is offered as a write in n + 1.
//!
//! Rules: `docs/machine.md`, section 6; the three hazard policies draw the same picture. Queue, policy and forwarding are those
//! of any read-modify-write, `crate::rmw`; here is the compare. Not modelled: nothing.

mod view;

use crate::Events;
pub use crate::rmw::Block;
use crate::rmw::{Outcome, Retired, Rmw};
use crate::tokens::{Fragment, OutputWords, Source, Write};
use edgewalk_machine::{Hazard, Plan};

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

/// What travels beside the depth.
#[derive(Clone, Copy, Debug)]
struct Side<const C: usize> {
    /// All values, the new depth among them.
    values: OutputWords<C>,
    source: Source,
}

impl<const C: usize> Default for Side<C> {
    fn default() -> Self {
        Side { values: [0; C], source: Source::default() }
    }
}

/// State of DEPTH.
#[derive(Clone, Debug)]
pub struct Depth<const C: usize> {
    rmw: Rmw<u32, Side<C>>,
}

impl<const C: usize> Depth<C> {
    /// An empty unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        Depth { rmw: Rmw::new(plan) }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.rmw.reset();
    }

    /// Fragments or a write are in flight.
    #[inline]
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.rmw.occupied()
    }

    /// What keeps the fragment from being read: `rd_valid` = a fragment and no block, `frag_ready` = `rd_ready` and no
    /// block. Without a fragment there is no hazard.
    #[inline]
    #[must_use]
    pub fn block(&self, frag: Option<&Fragment<C>>, depth_write: bool) -> Option<Block> {
        self.rmw.block(frag.map(|f| (f.addr, f.fence)), depth_write)
    }

    /// The old depth can be taken.
    #[inline]
    #[must_use]
    pub fn data_ready(&self, wr_ready: bool) -> bool {
        self.rmw.data_ready(wr_ready)
    }

    /// The write offered to the frame memory.
    #[inline]
    #[must_use]
    pub fn write(&self) -> Option<Write<C>> {
        self.rmw.write().map(|w| Write {
            addr: w.addr,
            values: w.side.values,
            z_en: w.stored,
            source: w.side.source,
        })
    }

    /// Not hardware: behind a cycle in which a read fired, its fragment, without the fence.
    #[inline]
    #[must_use]
    pub fn last_read(&self) -> Fragment<C> {
        let (addr, Side { values, source }) = self.rmw.youngest();
        Fragment { addr, values, fence: false, source }
    }

    /// Clock edge.
    #[inline(always)]
    pub fn step(
        &mut self,
        frag: Option<&Fragment<C>>,
        block: Option<Block>,
        inputs: &DepthInputs,
        events: &mut Events,
    ) {
        let compared = inputs.data.filter(|_| self.data_ready(inputs.wr_ready));
        if let Some(frag) = frag {
            if block.is_none() && inputs.rd_ready {
                let side = Side { values: frag.values, source: frag.source };
                if self.rmw.enter(frag.addr, side) {
                    events.forward_write += 1;
                }
            } else {
                self.count_wait(block, events);
            }
        }
        if let Some(data) = compared {
            self.compare(data as u32, inputs, events); // b <= 32 bits
        } else {
            if !inputs.wr_ready && self.rmw.write().is_some() {
                events.write_stall += 1;
            }
            self.rmw.no_result(inputs.wr_ready);
        }
    }

    /// Compares the oldest fragment; if it passes it is written.
    #[inline]
    fn compare(&mut self, data: u32, inputs: &DepthInputs, events: &mut Events) {
        let Retired { addr, side, old, forwarded } = self.rmw.retire(data);
        if forwarded {
            events.forward_used += 1;
        }
        let z = side.values[0];
        // Bits 0, 1 and 2 of the function say whether less, equal and greater pass.
        let relation = u8::from(z > old) + u8::from(z >= old);
        let pass = inputs.depth_func >> relation & 1 != 0;
        events.depth_fail = events.depth_fail.wrapping_add(u64::from(!pass)); // in every cycle: not checked
        let result = Outcome { addr, side, word: z, stored: inputs.depth_write };
        let taken = self.rmw.finish(pass, result);
        if taken > 0 {
            events.forward_compare += taken;
        }
    }

    #[inline]
    fn count_wait(&self, block: Option<Block>, events: &mut Events) {
        match (block, self.rmw.policy()) {
            (Some(Block::Hazard), Hazard::Drain) => events.drain_stall += 1,
            (Some(Block::Hazard), _) => events.interlock_stall += 1,
            (Some(Block::Full), _) => events.queue_full += 1,
            (None, _) => events.memory_stall += 1,
        }
    }
}
