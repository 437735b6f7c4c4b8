//! WORD MEMORY: words that the host alone writes, behind the ports of one unit: records, textures, roots, tables, a map.
//!
//! ```text
//!  read ─> words[addr] ─> L cycles, in order ─> data
//! ```
//! Formats: a word of up to 128 bits an address. Timing and rules: module `served`, and `docs/machine.md`, sections 7 and 10
//! to 17.

use crate::served::Served;
use crate::waits::{PageCounts, Waits};
use edgewalk_machine::MemoryPort;

/// Most memories of a machine that the host alone writes.
pub const MEMORIES: usize = 8;

/// What a memory shows to the machine in a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WordIn {
    /// The memory takes a read.
    pub ready: bool,
    /// The word of the oldest read, once it is there.
    pub word: Option<u128>,
}

impl WordIn {
    /// Of a memory that is not there.
    pub const NONE: WordIn = WordIn { ready: false, word: None };
}

/// What the machine asks of a memory in a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ask {
    /// Address of a read.
    pub addr: Option<u32>,
    /// The word is taken, if it is there.
    pub take: bool,
}

/// Words by address, as narrow as the memory's word permits.
#[derive(Clone, Debug)]
enum Words {
    Narrow(Vec<u32>),
    Wide(Vec<u128>),
}

/// State of the memory.
#[derive(Clone, Debug)]
pub struct WordMemory {
    served: Served<u128, true>,
    words: Words,
    /// The word at an address that was not written.
    clear: u128,
}

impl WordMemory {
    /// A memory that was not written. A light's map then hides nothing: every texel is as far as it can be, with all of the
    /// light left. The words of other memories are 0.
    #[must_use]
    pub fn new(port: &MemoryPort, waits: impl Into<Waits>) -> Self {
        // Random waits differ from memory to memory; the numbers of these five are as old as their recorded runs.
        let names = ["map", "terms", "tables", "roots", "textures"];
        let number = names.iter().position(|name| *name == port.name).unwrap_or(names.len());
        let bits = port.data.width();
        WordMemory {
            served: Served::new(port.latency, waits.into().of_another(number as u64 + 2)),
            words: if bits <= 32 { Words::Narrow(Vec::new()) } else { Words::Wide(Vec::new()) },
            clear: if port.name == "map" { u128::MAX >> (128 - bits) } else { 0 },
        }
    }

    /// Writes words from an address on; the machine is idle.
    pub fn write(&mut self, first: usize, words: impl IntoIterator<Item = u128>) {
        let clear = self.clear;
        match &mut self.words {
            Words::Narrow(stored) => {
                write(stored, first, words.into_iter().map(|word| word as u32), clear as u32)
            }
            Words::Wide(stored) => write(stored, first, words, clear),
        }
    }

    /// The memory's side of its ports in this cycle.
    #[inline]
    #[must_use]
    pub fn port(&self) -> WordIn {
        WordIn { ready: self.served.read_ready(), word: self.served.data() }
    }

    /// What its pages did so far.
    #[must_use]
    pub fn pages(&self) -> PageCounts {
        self.served.pages()
    }

    /// Clock edge: the read that fired, whether the word was taken.
    pub fn step(&mut self, read: Option<u32>, taken: bool) {
        let word = |addr: u32| {
            let stored = match &self.words {
                Words::Narrow(words) => words.get(addr as usize).map(|word| u128::from(*word)),
                Words::Wide(words) => words.get(addr as usize).copied(),
            };
            (addr, stored.unwrap_or(self.clear))
        };
        let read = read.map(word);
        self.served.step(read, taken, None);
    }
}

/// Stores words from a place on; places before it that were not written hold `clear`.
fn write<W: Copy>(stored: &mut Vec<W>, first: usize, words: impl IntoIterator<Item = W>, clear: W) {
    if stored.len() < first {
        stored.resize(first, clear);
    }
    let mut words = words.into_iter();
    for (place, word) in stored[first..].iter_mut().zip(&mut words) {
        *place = word;
    }
    stored.extend(words);
}
