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
    words: Words,
    /// Words read, with the first cycle in which each may be offered.
    queue: VecDeque<(u64, u128)>,
}

impl Served {
    pub fn new(memory: &Memory, setting: MemorySetting) -> Served {
        let latency = setting.latency;
        Served { memory: memory.clone(), latency, words: Words::new(setting), queue: VecDeque::new() }
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
            self.queue.push_back((cycle + self.latency, self.words.get(*address as usize)));
        }
        let Some(write) = self.memory.write else { return };
        if let Some(token) = moved(write.link)
            && write.enable.is_none_or(|enable| token[enable] == 1)
        {
            self.words.set(token[write.address] as usize, token[write.word]);
        }
    }
}

/// The words of a memory by address. Only pages that were written take up the host's memory: a screen may have 2^26 words.
#[derive(Clone, Debug)]
struct Words {
    setting: MemorySetting,
    /// Pages that were written; none behind the last.
    pages: Vec<Option<Box<[u128; PAGE]>>>,
}

/// Words of a page.
const PAGE: usize = 1024;

impl Words {
    fn new(setting: MemorySetting) -> Words {
        Words { setting, pages: Vec::new() }
    }

    /// The word at an address; 0 behind the last.
    fn get(&self, address: usize) -> u128 {
        match self.pages.get(address / PAGE) {
            Some(Some(page)) if address < self.setting.words => page[address % PAGE],
            _ => self.at_start(address),
        }
    }

    /// The word that the memory had there at the start.
    fn at_start(&self, address: usize) -> u128 {
        let MemorySetting { start, words, clear, .. } = &self.setting;
        match start.get(address) {
            Some(word) => *word,
            None if address < *words => *clear,
            None => 0,
        }
    }

    /// Stores a word; behind the last nothing is stored.
    fn set(&mut self, address: usize, word: u128) {
        if address >= self.setting.words {
            return;
        }
        let (number, first) = (address / PAGE, address / PAGE * PAGE);
        if self.pages.len() <= number {
            self.pages.resize(number + 1, None);
        }
        if self.pages[number].is_none() {
            self.pages[number] = Some(Box::new(std::array::from_fn(|place| self.at_start(first + place))));
        }
        if let Some(page) = &mut self.pages[number] {
            page[address % PAGE] = word;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_hold_what_a_list_of_words_does() {
        // Words at the start, cleared ones, and a last page that is not full.
        let start: Arc<[u128]> = (0..1500).map(|word| word * 3).collect();
        let setting = MemorySetting { latency: 1, clear: 7, start, words: 5 * PAGE + 10 };
        let mut list: Vec<u128> = setting.start.to_vec();
        list.resize(setting.words, setting.clear);
        let mut words = Words::new(setting);
        let mut compared = 0;
        for step in 0..20_000_usize {
            let address = step.wrapping_mul(7919) % (6 * PAGE);
            if step % 3 == 0 {
                words.set(address, step as u128);
                list.get_mut(address).into_iter().for_each(|word| *word = step as u128);
            }
            assert_eq!(words.get(address), list.get(address).copied().unwrap_or(0), "address {address}");
            compared += 1;
        }
        assert_eq!(compared, 20_000);
    }
}
