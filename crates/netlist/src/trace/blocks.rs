//! The values of every bit, 64 cycles in a word: for what computes with many cycles at once.

use std::collections::BTreeMap;

use super::watch::{Scope, Watch, everything};
use crate::simulate::Simulator;

/// The values of every named signal that can change, and of every bit of the memories that are written, block by block.
///
/// A block has up to [`BitBlocks::CYCLES`] cycles. Signals are seen once a cycle.
pub struct BitBlocks {
    watch: Watch,
    /// The place of the lowest bit of each signal.
    signals: Vec<usize>,
    memories: Vec<WrittenMemory>,
    names: BTreeMap<String, usize>,
    words: Vec<u64>,
    cycles: u32,
}

struct WrittenMemory {
    path: String,
    /// Bits of a word.
    width: usize,
    /// The place of the lowest bit of the first word.
    first: usize,
    /// The words as they were last seen.
    seen: Vec<u128>,
}

impl BitBlocks {
    /// Cycles of a whole block.
    pub const CYCLES: u32 = u64::BITS;

    /// Nothing is sampled yet.
    pub fn new(sim: &Simulator) -> Self {
        let (scope, watch) = everything(sim, "", &[]);
        let mut bits = 0;
        let mut room = |count: usize| {
            bits += count;
            bits - count
        };
        let signals: Vec<usize> = watch.widths().iter().map(|width| room(*width as usize)).collect();
        let memory = |(path, width): (&str, u32)| {
            let seen = vec![0; sim.memory(path).map_or(0, <[u128]>::len)];
            let width = width as usize;
            WrittenMemory { path: path.to_owned(), width, first: room(width * seen.len()), seen }
        };
        let memories: Vec<WrittenMemory> = sim.written_memories().map(memory).collect();
        let mut blocks =
            BitBlocks { names: BTreeMap::new(), words: vec![0; bits], watch, signals, memories, cycles: 0 };
        blocks.name_signals(&scope, "");
        for WrittenMemory { path, width, first, seen } in &blocks.memories {
            for bit in 0..width * seen.len() {
                blocks.names.insert(format!("{path}[{}][{}]", bit / width, bit % width), first + bit);
            }
        }
        blocks
    }

    fn name_signals(&mut self, scope: &Scope, prefix: &str) {
        for (name, place) in &scope.variables {
            let path = format!("{prefix}{name}");
            match self.watch.widths()[*place] {
                1 => _ = self.names.insert(path, self.signals[*place]),
                width => (0..width as usize).for_each(|bit| {
                    self.names.insert(format!("{path}[{bit}]"), self.signals[*place] + bit);
                }),
            }
        }
        for inner in &scope.scopes {
            self.name_signals(inner, &format!("{prefix}{}.", inner.name));
        }
    }

    /// The place of every bit in a block, by its path: `u_edge.major_c[3]`, or `u_edge.walks` for a signal of one bit. A signal of
    /// several names is there by each of them. A bit of a memory is there by its word and its place in it:
    /// `u_span.queue[2][7]`.
    pub fn names(&self) -> &BTreeMap<String, usize> {
        &self.names
    }

    /// Takes the values of a cycle; to be called once a cycle, before the tick. A whole block gives place to the next one.
    pub fn sample(&mut self, sim: &mut Simulator) {
        if self.cycles == BitBlocks::CYCLES {
            // Each bit goes on with the value it has.
            self.words.iter_mut().for_each(|word| *word = 0_u64.wrapping_sub(*word >> 63));
            self.cycles = 0;
        }
        // From this cycle on.
        let rest = u64::MAX << self.cycles;
        let mut toggle = |first: usize, mut bits: u128| {
            while bits != 0 {
                self.words[first + bits.trailing_zeros() as usize] ^= rest;
                bits &= bits - 1;
            }
        };
        for change in self.watch.changed(sim) {
            toggle(self.signals[change.place], change.from.unwrap_or(0) ^ change.to);
        }
        for WrittenMemory { path, width, first, seen } in &mut self.memories {
            for (place, (seen, word)) in seen.iter_mut().zip(sim.memory(path).unwrap_or_default()).enumerate()
            {
                toggle(*first + place * *width, *seen ^ word);
                *seen = *word;
            }
        }
        self.cycles += 1;
    }

    /// The block so far: a word for each bit, bit 0 of it in the first cycle; and the number of cycles in it.
    pub fn block(&self) -> (&[u64], u32) {
        (&self.words, self.cycles)
    }
}
