//! MAP MEMORY: a light's map behind SHADOW's ports.
//!
//! ```text
//!  mrd ─> word[addr] ─> L cycles, in order ─> mdata
//! ```
//! Formats: addresses ty·2^SB + tx; words of bz bits, with `shadow.transmits` of bz + b. Timing: as the depth memory's. Rules: `docs/machine.md`, section 10.
//! Not modelled: who fills it; refresh, banks.

use crate::fifo::Fifo;
use crate::waits::{Pacer, Waits};
use edgewalk_machine::Plan;

/// State of the memory.
#[derive(Clone, Debug)]
pub struct MapMemory {
    latency: u64,
    pacer: Pacer,
    now: u64,
    reads: Fifo<(u64, u32), 16>,
    words: Vec<u32>,
}

impl MapMemory {
    /// A map that hides nothing: every texel is as far as it can be, all of the light left. It stalls as often as the depth memory, but in other
    /// cycles.
    #[must_use]
    pub fn new(plan: &Plan, waits: impl Into<Waits>) -> Self {
        let shadow = &plan.shadow;
        MapMemory {
            latency: u64::from(shadow.latency),
            pacer: Pacer::new(waits.into().of_another(2)),
            now: 0,
            reads: Fifo::default(),
            words: vec![u32::MAX >> (32 - plan.map_word_bits()); 1 << (2 * shadow.side_bits())],
        }
    }

    /// Every texel, by address.
    pub fn words_mut(&mut self) -> &mut [u32] {
        &mut self.words
    }

    /// A read can be taken in this cycle.
    #[must_use]
    pub fn mrd_ready(&self) -> bool {
        self.pacer.rd_ready
    }

    /// The word of the oldest read, once it is there.
    #[must_use]
    pub fn mdata(&self) -> Option<u64> {
        let (due, word) = *self.reads.head();
        (!self.reads.is_empty() && due <= self.now).then_some(word.into())
    }

    /// Clock edge: the read that fired, whether the word was taken.
    pub fn step(&mut self, read: Option<u32>, taken: bool) {
        if taken {
            self.reads.pop();
        }
        let late = self.pacer.step(self.now, read, None);
        if let Some(addr) = read {
            let due = self.now.wrapping_add(self.latency).wrapping_add(late);
            self.reads.push((due, self.words[addr as usize]));
        }
        self.now = self.now.wrapping_add(1);
    }
}
