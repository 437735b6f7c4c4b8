//! A memory that the rig is: reads come back in order, not before their latency; a read that fires together with a write
//! sees the old word (`docs/machine.md`, section 7).

use crate::interface::{Link, Memory};
use crate::values::PortValues;
use std::collections::VecDeque;
use std::sync::Arc;

/// How a memory behaves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MemorySetting {
    /// Clocks from a read to its data, at the least.
    pub latency: u64,
    /// Every word at the start that is not among these.
    pub clear: u128,
    /// The words at the start, from address 0 on.
    pub start: Arc<[u128]>,
    /// Words.
    pub words: usize,
}

impl MemorySetting {
    /// As declared; every word is the largest, the depth of an empty screen.
    #[must_use]
    pub fn of(memory: &Memory) -> MemorySetting {
        MemorySetting {
            latency: memory.latency,
            clear: u128::MAX >> (128 - memory.word_bits),
            start: Arc::default(),
            words: 1 << memory.address_bits,
        }
    }
}

/// A memory in the middle of a run.
#[derive(Clone, Debug)]
pub(super) struct Served {
    memory: Memory,
    latency: u64,
    words: Vec<u128>,
    /// Words read, with the first cycle in which each may be offered.
    queue: VecDeque<(u64, u128)>,
}

impl Served {
    pub fn new(memory: &Memory, setting: MemorySetting) -> Served {
        let mut words = setting.start.to_vec();
        words.resize(setting.words, setting.clear);
        Served { memory: memory.clone(), latency: setting.latency, words, queue: VecDeque::new() }
    }

    /// Number of the link of its words.
    pub fn data(&self) -> usize {
        self.memory.data
    }

    /// Nothing that was read waits.
    pub fn is_quiet(&self) -> bool {
        self.queue.is_empty()
    }

    /// The word that may be offered, as a token.
    pub fn offered(&self, cycle: u64) -> Option<&[u128]> {
        let (due, word) = self.queue.front()?;
        (*due <= cycle).then_some(std::slice::from_ref(word))
    }

    pub fn reset(&mut self) {
        self.queue.clear();
    }

    pub fn clock(&mut self, links: &[Link], ports: &PortValues, cycle: u64) {
        let moved = |link: usize| links[link].fires(ports).then(|| links[link].token(ports));
        if moved(self.memory.data).is_some() {
            self.queue.pop_front();
        }
        if let Some([address, ..]) = moved(self.memory.read) {
            let word = self.words.get(*address as usize).copied().unwrap_or(0);
            self.queue.push_back((cycle + self.latency, word));
        }
        let Some(write) = self.memory.write else { return };
        if let Some(token) = moved(write.link)
            && write.enable.is_none_or(|enable| token[enable] == 1)
            && let Some(word) = self.words.get_mut(token[write.address] as usize)
        {
            *word = token[write.word];
        }
    }
}
