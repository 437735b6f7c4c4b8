//! MAP MEMORY: a light's depth map behind SHADOW's ports.
//!
//! ```text
//!  mrd ─> depth[addr] ─> L cycles, in order ─> mdata
//! ```
//! Formats: addresses ty·2^SB + tx; depths of bz bits. Timing: as the depth memory's. Rules: `docs/machine.md`, section 10.
//! Not modelled: who fills it; refresh, banks.

use crate::fifo::Fifo;
use crate::memory::Stalls;
use edgewalk_machine::Plan;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{RngCore, SeedableRng};

/// State of the memory.
#[derive(Clone, Debug)]
pub struct MapMemory {
    latency: u64,
    stalls: Stalls,
    random: Pcg32,
    now: u64,
    mrd_ready: bool,
    reads: Fifo<(u64, u32), 16>,
    depths: Vec<u32>,
}

impl MapMemory {
    /// A map that hides nothing: every texel is as far as it can be. It stalls as often as the depth memory, but in other
    /// cycles.
    #[must_use]
    pub fn new(plan: &Plan, stalls: Stalls) -> Self {
        let shadow = &plan.shadow;
        let mut memory = MapMemory {
            latency: u64::from(shadow.latency),
            stalls,
            random: Pcg32::seed_from_u64(stalls.seed.wrapping_add(2)),
            now: 0,
            mrd_ready: true,
            reads: Fifo::default(),
            depths: vec![u32::MAX >> (32 - shadow.depth_bits); 1 << (2 * shadow.side_bits())],
        };
        memory.draw_ready();
        memory
    }

    /// Every texel, by address.
    pub fn depths_mut(&mut self) -> &mut [u32] {
        &mut self.depths
    }

    /// A read can be taken in this cycle.
    #[must_use]
    pub fn mrd_ready(&self) -> bool {
        self.mrd_ready
    }

    /// The depth of the oldest read, once it is there.
    #[must_use]
    pub fn mdata(&self) -> Option<u64> {
        let (due, depth) = *self.reads.head();
        (!self.reads.is_empty() && due <= self.now).then_some(depth.into())
    }

    /// Clock edge: the read that fired, whether the word was taken.
    pub fn step(&mut self, read: Option<u32>, taken: bool) {
        if taken {
            self.reads.pop();
        }
        if let Some(addr) = read {
            let due = self.now.wrapping_add(self.latency).wrapping_add(self.late());
            self.reads.push((due, self.depths[addr as usize]));
        }
        self.now = self.now.wrapping_add(1);
        self.draw_ready();
    }

    fn late(&mut self) -> u64 {
        if self.stalls.data == 0 {
            return 0;
        }
        let [chance, cycles, ..] = self.random.next_u32().to_le_bytes();
        if chance < self.stalls.data { 1 + u64::from(cycles % 8) } else { 0 }
    }

    fn draw_ready(&mut self) {
        if self.stalls.rd != 0 {
            self.mrd_ready = self.random.next_u32() as u8 >= self.stalls.rd;
        }
    }
}
