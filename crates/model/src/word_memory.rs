//! WORD MEMORY: words that the host alone writes, behind TERM's or SHADE's ports.
//!
//! ```text
//!  read ─> words[addr] ─> L cycles, in order ─> data
//! ```
//! Formats: a word of up to 128 bits an address; what was never written is 0. Timing: as the depth memory's, but that any
//! number of reads may be on their way. Rules: `docs/machine.md`, sections 7, 11 and 12. Not modelled: refresh, banks.

use crate::waits::{Pacer, Waits};
use std::collections::VecDeque;

/// State of the memory.
#[derive(Clone, Debug)]
pub struct WordMemory {
    latency: u64,
    pacer: Pacer,
    now: u64,
    reads: VecDeque<(u64, u128)>,
    words: Vec<u128>,
}

impl WordMemory {
    /// A memory that was not written. It stalls as often as the depth memory, but in other cycles; `number` tells memories
    /// apart.
    #[must_use]
    pub fn new(latency: u32, waits: impl Into<Waits>, number: u64) -> Self {
        WordMemory {
            latency: latency.into(),
            pacer: Pacer::new(waits.into().of_another(number)),
            now: 0,
            reads: VecDeque::new(),
            words: Vec::new(),
        }
    }

    /// Writes words from an address on; the machine is idle.
    pub fn write(&mut self, first: usize, words: impl IntoIterator<Item = u128>) {
        for (addr, word) in (first..).zip(words) {
            if addr >= self.words.len() {
                self.words.resize(addr + 1, 0);
            }
            self.words[addr] = word;
        }
    }

    /// A read can be taken in this cycle.
    #[must_use]
    pub fn read_ready(&self) -> bool {
        self.pacer.rd_ready
    }

    /// The word of the oldest read, once it is there.
    #[must_use]
    pub fn data(&self) -> Option<u128> {
        self.reads.front().filter(|(due, _)| *due <= self.now).map(|(_, word)| *word)
    }

    /// Clock edge: the read that fired, whether the word was taken.
    pub fn step(&mut self, read: Option<u32>, taken: bool) {
        if taken {
            self.reads.pop_front();
        }
        let late = self.pacer.step(self.now, read, None);
        if let Some(addr) = read {
            let due = self.now.wrapping_add(self.latency).wrapping_add(late);
            self.reads.push_back((due, self.words.get(addr as usize).copied().unwrap_or(0)));
        }
        self.now = self.now.wrapping_add(1);
    }
}
