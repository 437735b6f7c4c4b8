//! Memories in look-up tables of an ECP5: 16 words of 4 bits each, read without a clock, a register behind.

use super::blocks::DISTRIBUTED;
use super::builder::{BlockMemory, Builder, Kind};
use super::graph::{FALSE, Lit, Node};
use super::words::{Bit, Memory};

impl Builder<'_> {
    /// Look-up tables for each 16 words and 4 bits, choices between them by the upper bits of the address, and a
    /// register behind each read port.
    pub fn distributed_memory(&mut self, memory: &Memory) {
        let (deep, wide, _) = DISTRIBUTED;
        let lower = deep.ilog2() as usize;
        let held = self.bits_held(memory);
        let mut written: Vec<Lit> = Vec::new();
        for (enable, address, data) in &memory.writes {
            written.push(self.lit(*enable));
            written.extend(self.word(address));
            written.extend(self.word(data));
        }
        for (enable, address, first) in &memory.reads {
            let (enable, address) = (self.lit(*enable), self.word(address));
            let (low, high) = address.split_at(lower.min(address.len()));
            for bits in held.chunks(wide) {
                let mut rows: Vec<Vec<Lit>> = vec![Vec::new(); bits.len()];
                for _ in 0..memory.words.div_ceil(deep) {
                    let place = self.memories.len() as u32;
                    self.memories.push(BlockMemory {
                        kind: Kind::Distributed,
                        place: 0,
                        port: 0,
                        bits: bits.to_vec(),
                        blocks: 1,
                        inputs: low.iter().chain(&written).copied().collect(),
                        reads: vec![(enable, low.to_vec())],
                        writes: Vec::new(),
                    });
                    rows.iter_mut().for_each(|row| row.push(self.graph.node(Node::Memory(place))));
                }
                for (bit, row) in bits.iter().zip(rows) {
                    let own = *first + *bit as Bit;
                    let word = self.chosen(row, high);
                    if !self.known.contains_key(&own) {
                        self.drive(self.lits[own as usize], word, enable, None, true);
                    }
                }
            }
            for bit in (0..memory.width).filter(|bit| !held.contains(bit)) {
                let own = *first + bit as Bit;
                if !self.known.contains_key(&own) {
                    self.drive(self.lits[own as usize], FALSE, enable, None, true);
                }
            }
        }
    }

    /// One of a row, by the bits of an address.
    pub fn chosen(&mut self, mut row: Vec<Lit>, address: &[Lit]) -> Lit {
        for select in address {
            row = row
                .chunks(2)
                .map(|pair| match pair {
                    [low, high] => self.graph.mux(*select, *high, *low),
                    _ => pair[0],
                })
                .collect();
        }
        row[0]
    }
}
