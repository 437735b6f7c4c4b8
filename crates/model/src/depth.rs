//! DEPTH: reads the stored depth of every fragment, compares, writes.
//!
//! ```text
//!  frag ─┬─> rd (addr)            data ──┐
//!        └─> in-flight queue ─> head ─> compare ─pass─> w ─> wr, with BLEND zwr
//!               ^── forward ───────────────┼─────────────┘
//!                                          └─pass─> colour ─> pass, with BLEND
//! ```
//! Formats: outputs of b bits, addresses y·2^xb + x.
//!
//! Timing: a fragment and a compare a clock; a compare in cycle n is offered as a write in n + 1.
//!
//! Rules: `docs/machine.md`, section 6, and section 9 for the fork before BLEND; the three hazard policies draw the same picture. Queue, policy and forwarding are those
//! of any read-modify-write, `crate::rmw`; here is the compare. Not modelled: nothing.

mod view;

use crate::Events;
use crate::ports::{Pins, Ported, Shown};
pub use crate::rmw::Block;
use crate::rmw::{Retired, Rmw};
use crate::tokens::{FEW, Fragment, Write};
use crate::word_memory::Ask;
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
    /// The memory takes a write: `wr_ready`, with BLEND `zwr_ready`.
    pub wr_ready: bool,
    /// With BLEND: colours of fragments that pass go on to it.
    pub color_write: bool,
    /// With BLEND: it takes the fragment that is offered to it.
    pub pass_ready: bool,
}

/// State of DEPTH.
#[derive(Clone, Debug)]
pub struct Depth<const C: usize> {
    /// The queue and w. Without BLEND w is the whole write, with BLEND that of the depth.
    /// Fragments travel beside their depths.
    rmw: Rmw<u32, Fragment<C>>,
    fork: Fork<C>,
}

/// The other half of w, where there is BLEND.
#[derive(Clone, Debug)]
struct Fork<const C: usize> {
    /// There is one. Only machines of more than few channels or with BLEND are built so; for the others nothing of it is.
    is_there: bool,
    /// w_c and what it offers.
    color: Option<Fragment<C>>,
    /// Fences of fragments that BLEND did not see.
    pend_fence: bool,
}

impl<const C: usize> Depth<C> {
    /// An empty unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let fork = Fork { is_there: plan.blend.is_there(), color: None, pend_fence: false };
        Depth { rmw: Rmw::new(plan.hazard, plan.inflight), fork }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.rmw.reset();
        self.fork.color = None;
        self.fork.pend_fence = false;
    }

    /// The write is parted.
    #[inline]
    fn forks(&self) -> bool {
        C > FEW && self.fork.is_there
    }

    /// Fragments or a write are in flight.
    #[inline]
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.rmw.occupied() || (self.forks() && self.fork.color.is_some())
    }

    /// Not hardware: fragments between their read and their compare.
    #[inline]
    #[must_use]
    pub fn inflight(&self) -> usize {
        self.rmw.len()
    }

    /// What keeps the fragment from being read: `rd_valid` = a fragment and no block, `frag_ready` = `rd_ready` and no
    /// block. Without a fragment there is no hazard.
    #[inline]
    #[must_use]
    pub fn block(&self, frag: Option<&Fragment<C>>, depth_write: bool) -> Option<Block> {
        self.rmw.block(frag.map(|f| (f.addr, f.fence)), depth_write)
    }

    /// The old depth can be taken. `pass_ready`: with BLEND, it takes the fragment that is offered to it.
    #[inline]
    #[must_use]
    pub fn data_ready(&self, wr_ready: bool, pass_ready: bool) -> bool {
        self.rmw.data_ready(wr_ready) && (!self.forks() || self.fork.color.is_none() || pass_ready)
    }

    /// The fragment offered to BLEND.
    #[inline]
    #[must_use]
    pub fn pass(&self) -> Option<&Fragment<C>> {
        self.fork.color.as_ref().filter(|_| self.forks())
    }

    /// The write offered to the frame memory; with BLEND it goes to the depth memory, and only address and depth count.
    #[inline]
    #[must_use]
    pub fn write(&self) -> Option<Write<C>> {
        self.rmw.write().map(|w| Write {
            addr: w.addr,
            values: w.side.values,
            z_en: w.stored,
            lit: w.side.lit,
            source: w.side.source,
        })
    }

    /// Not hardware: behind a cycle in which a read fired, its fragment, without the fence.
    #[inline]
    #[must_use]
    pub fn last_read(&self) -> Fragment<C> {
        Fragment { fence: false, ..*self.rmw.youngest() }
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
        let compared = inputs.data.filter(|_| self.data_ready(inputs.wr_ready, inputs.pass_ready));
        if let Some(frag) = frag {
            if block.is_none() && inputs.rd_ready {
                if self.rmw.enter(frag.addr, *frag) {
                    events.depth.forward_write += 1;
                }
            } else {
                self.count_wait(block, events);
            }
        }
        if self.forks() {
            self.count_fork(inputs, events);
            self.fork.color.take_if(|_| inputs.pass_ready);
        }
        if let Some(data) = compared {
            self.compare(data as u32, inputs, events); // b <= 32 bits
        } else {
            if !inputs.wr_ready && self.rmw.write().is_some() {
                events.depth.write_stall += 1;
            }
            self.rmw.no_result(inputs.wr_ready);
        }
    }

    /// Compares the oldest fragment; if it passes it is written. A part of every cycle that draws, as the clock edge is.
    #[inline(always)]
    fn compare(&mut self, data: u32, inputs: &DepthInputs, events: &mut Events) {
        let head = self.rmw.retire(data);
        let Retired { old, forwarded, .. } = head;
        if forwarded {
            events.depth.forward_used += 1;
        }
        let z = self.rmw.side(&head).values[0];
        // Bits 0, 1 and 2 of the function say whether less, equal and greater pass.
        let relation = u8::from(z > old) + u8::from(z >= old);
        let pass = inputs.depth_func >> relation & 1 != 0;
        events.depth.depth_fail = events.depth.depth_fail.wrapping_add(u64::from(!pass)); // in every cycle: not checked
        let mut written = pass;
        if self.forks() {
            written &= inputs.depth_write;
            self.hand_on(&head, pass && inputs.color_write, events);
        }
        let taken = self.rmw.finish(written, &head, z, inputs.depth_write);
        if taken > 0 {
            events.depth.forward_compare += taken;
        }
    }

    /// Offers a fragment to BLEND, or keeps its fence for the next that is.
    fn hand_on(&mut self, of: &Retired<u32>, passes: bool, events: &mut Events) {
        let Fork { color, pend_fence, .. } = &mut self.fork;
        let frag = self.rmw.side(of);
        let fence = frag.fence || *pend_fence;
        *pend_fence = fence && !passes;
        if passes {
            events.depth.fence_handed_on += u64::from(fence && !frag.fence);
            *color = Some(Fragment { fence, ..*frag });
        }
    }

    /// Which half of w leaves first.
    fn count_fork(&self, inputs: &DepthInputs, events: &mut Events) {
        let (depth, color) = (self.rmw.write().is_some(), self.fork.color.is_some());
        events.depth.depth_first += u64::from(depth && inputs.wr_ready && color && !inputs.pass_ready);
        events.depth.color_first += u64::from(color && inputs.pass_ready && depth && !inputs.wr_ready);
        events.depth.depth_write_waits +=
            u64::from(depth && !inputs.wr_ready && (!color || inputs.pass_ready));
    }

    #[inline]
    fn count_wait(&self, block: Option<Block>, events: &mut Events) {
        match (block, self.rmw.policy()) {
            (Some(Block::Hazard), Hazard::Drain) => events.depth.drain_stall += 1,
            (Some(Block::Hazard), _) => events.depth.interlock_stall += 1,
            (Some(Block::Full), _) => events.depth.queue_full += 1,
            (None, _) => events.depth.memory_stall += 1,
        }
    }
}

impl<const C: usize> Depth<C> {
    /// With BLEND what is given goes on to it, and the write stands beside.
    fn inputs(&self, pins: &Pins<Fragment<C>, C>) -> DepthInputs {
        DepthInputs {
            depth_func: pins.state.depth_func,
            depth_write: pins.state.depth_write,
            rd_ready: pins.word.ready,
            data: pins.word.word.map(|word| word as u64), // at most 32 bits
            wr_ready: if self.forks() { pins.write } else { pins.next },
            color_write: pins.state.color_write,
            pass_ready: self.forks() && pins.next,
        }
    }
}

impl<const C: usize> Ported<C> for Depth<C> {
    type Takes = Fragment<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        let inputs = self.inputs(pins);
        let block = self.block(pins.token, inputs.depth_write);
        out.takes(inputs.rd_ready && block.is_none());
        if self.forks() {
            out.gives(self.pass());
            out.writes(self.write().as_ref());
        } else {
            out.gives(self.write().as_ref());
        }
        let addr = pins.token.filter(|_| block.is_none()).map(|frag| frag.addr);
        out.asks(Ask { addr, take: self.data_ready(inputs.wr_ready, inputs.pass_ready) });
        out.status("hazard", block == Some(Block::Hazard));
        // Without a fragment only a full queue blocks.
        out.status("full", self.block(None, inputs.depth_write).is_some());
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        let inputs = self.inputs(pins);
        let block = self.block(pins.token, inputs.depth_write);
        self.step(pins.token, block, &inputs, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
