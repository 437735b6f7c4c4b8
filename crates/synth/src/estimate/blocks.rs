//! Memories in memory blocks, in look-up tables or in flip-flops, whichever costs least (`memory_libmap`).

use super::builder::{BlockMemory, Builder, Guard, Kind};
use super::family::Family;
use super::graph::{FALSE, Lit, Node, TRUE};
use super::words::{Bit, Memory, ONE};
use std::ops::Range;

/// Memory blocks of a family: words and bits that one can be set to, and the bits in flip-flops that cost as much
/// (`brams.txt` of Yosys).
fn blocks(family: Family) -> (&'static [(usize, usize)], usize) {
    match family {
        Family::Ice40 => (&[(256, 16), (512, 8), (1024, 4), (2048, 2)], 64),
        Family::Gates => (&[], usize::MAX),
        Family::Ecp5 => (&[(512, 36), (1024, 18), (2048, 9), (4096, 4), (8192, 2), (16_384, 1)], 128),
    }
}

/// Words and bits of a memory in look-up tables, and the bits in flip-flops that cost as much (`lutrams.txt`).
pub(super) const DISTRIBUTED: (usize, usize, usize) = (16, 4, 4);

/// What a memory costs in flip-flops, in bits of them.
fn in_flip_flops(memory: &Memory, held: usize) -> usize {
    memory.words * held / if memory.rom.is_some() { 16 } else { 1 }
}

/// Twice the cost of a memory in cells of `deep` words and `wide` bits that cost `each`: of the cells, of the choice among
/// cells that hold other words, and of logic around the ports. A guarded memory has more of that (`memory_libmap`).
fn twice_in_cells(
    memory: &Memory,
    held: usize,
    (deep, wide, each): (usize, usize, usize),
    guarded: bool,
) -> usize {
    let (rows, reads, writes) = (memory.words.div_ceil(deep), memory.reads.len(), memory.writes.len());
    let choices = if rows > 1 { (rows - 1) * held * reads + rows * writes } else { 0 };
    let ports = reads + if guarded { 3 * (reads + writes) } else { 0 };
    2 * each * rows * held.div_ceil(wide) * reads + choices + 4 * ports
}

/// What a memory in look-up tables costs where flip-flops cost more; none where the family has no such memories.
fn in_tables(family: Family, memory: &Memory, held: usize) -> Option<usize> {
    let twice = twice_in_cells(memory, held, DISTRIBUTED, false);
    let may = family == Family::Ecp5 && memory.writes.len() <= 1;
    (may && twice < 2 * in_flip_flops(memory, held)).then_some(twice / 2)
}

impl Builder<'_> {
    /// The bits of a memory's words that take room. A bit takes none if no port reads it, or if only one constant is
    /// written to it.
    pub fn bits_held(&self, memory: &Memory) -> Vec<usize> {
        let read = |bit: &usize| {
            let fixed = |(_, _, data): &(Bit, Range<usize>, Range<usize>)| self.words.at(data)[*bit] <= ONE;
            let constant = !memory.writes.is_empty() && memory.writes.iter().all(fixed);
            !constant && memory.reads.iter().any(|(_, _, first)| self.words.users[*first as usize + bit] > 0)
        };
        (0..memory.width).filter(read).collect()
    }

    /// Whether look-up tables hold a memory that no blocks hold.
    pub fn is_distributed(&self, memory: &Memory) -> bool {
        in_tables(self.words.family, memory, self.bits_held(memory).len()).is_some()
    }

    /// Blocks for a memory, none where flip-flops or look-up tables are cheaper; and the nodes of its outputs.
    pub fn outputs(&mut self, place: usize) -> Option<usize> {
        let memory = &self.words.memories[place];
        self.graph.unit = memory.unit;
        let held = self.bits_held(memory);
        let (shapes, each) = blocks(self.words.family);
        let twice = |&(deep, wide): &(usize, usize)| {
            twice_in_cells(memory, held.len(), (deep, wide, each), self.guarded[place])
        };
        let (deep, wide) = shapes.iter().copied().min_by_key(twice).unwrap_or((1, 1));
        let else_costs = in_tables(self.words.family, memory, held.len())
            .unwrap_or_else(|| in_flip_flops(memory, held.len()));
        // Of equal costs flip-flops come first, then look-up tables.
        let in_blocks =
            !shapes.is_empty() && memory.writes.len() <= 1 && twice(&(deep, wide)) < 2 * else_costs;
        let first_block = self.memories.len();
        if in_blocks {
            for port in 0..memory.reads.len() {
                for bits in held.chunks(wide) {
                    let (blocks, bits) = (memory.words.div_ceil(deep) as u32, bits.to_vec());
                    let (inputs, reads, writes) = (Vec::new(), Vec::new(), Vec::new());
                    let kind = Kind::Block;
                    self.memories.push(BlockMemory {
                        kind,
                        place,
                        port,
                        bits,
                        blocks,
                        inputs,
                        reads,
                        writes,
                    });
                }
            }
        }
        let guard = (in_blocks && self.guarded[place]).then(|| Guard {
            enable: self.own(),
            address: self.words.at(&memory.writes[0].1).iter().map(|_| self.own()).collect(),
            data: (0..memory.width).map(|_| self.own()).collect(),
            passes: memory
                .reads
                .iter()
                .map(|_| (self.own(), (0..memory.width).map(|_| self.own()).collect()))
                .collect(),
        });
        for (port, (_, _, first)) in memory.reads.iter().enumerate() {
            for at in 0..memory.width {
                let bit = *first + at as Bit;
                if self.known.contains_key(&bit) {
                    continue;
                }
                let output = if in_blocks {
                    let before = held.iter().filter(|held| **held < at).count().min(held.len() - 1);
                    let column = port * held.len().div_ceil(wide) + before / wide;
                    self.graph.node(Node::Memory((first_block + column) as u32))
                } else {
                    self.flip_flop(bit)
                };
                self.lits[bit as usize] = match &guard {
                    Some(guard) => self.graph.mux(guard.passes[port].0, guard.passes[port].1[at], output),
                    None => output,
                };
            }
        }
        self.guards.extend(guard);
        in_blocks.then_some(first_block)
    }

    /// What the blocks of a memory read, from the first of them.
    pub fn block_memory(&mut self, memory: &Memory, first: usize) {
        let reads: Vec<(Lit, Vec<Lit>)> =
            memory.reads.iter().map(|(enable, address, _)| (self.lit(*enable), self.word(address))).collect();
        let place = self.memories[first].place;
        let mut writes = Vec::new();
        for (enable, address, data) in &memory.writes {
            let (mut enable, mut address, mut data) =
                (self.lit(*enable), self.word(address), self.word(data));
            if self.guarded[place] {
                let guard = self.guards.remove(0);
                for (port, (passes, word)) in guard.passes.iter().enumerate() {
                    let (read, from) = &reads[port];
                    let same = self.graph.equal(from, &guard.address);
                    let passing = self.graph.and(guard.enable, same);
                    self.drive(*passes, passing, *read, None, false);
                    for (at, bit) in word.iter().enumerate() {
                        self.drive(*bit, guard.data[at], *read, None, true);
                    }
                }
                self.drive(guard.enable, enable, TRUE, None, true);
                for (late, now) in guard.address.iter().chain(&guard.data).zip(address.iter().chain(&data)) {
                    self.drive(*late, *now, TRUE, None, true);
                }
                (enable, address, data) = (guard.enable, guard.address, guard.data);
            }
            writes.push((enable, address, data));
        }
        for block in self.memories[first..]
            .iter_mut()
            .take_while(|block| (block.kind, block.place) == (Kind::Block, place))
        {
            let read = &reads[block.port];
            block.inputs.push(read.0);
            block.inputs.extend(&read.1);
            block.reads.push(read.clone());
            for (enable, address, data) in &writes {
                block.inputs.push(*enable);
                block.inputs.extend(address);
                block.inputs.extend(block.bits.iter().map(|bit| data[*bit]));
                block.writes.push((*enable, address.clone()));
            }
        }
    }

    /// A flip-flop for each bit, and a tree of choices in front of each read port's.
    pub fn memory_of_flip_flops(&mut self, memory: &Memory) {
        let mut words: Vec<Vec<Lit>> = Vec::new();
        for address in 0..memory.words {
            let word = match &memory.rom {
                Some(rom) => (0..memory.width).map(|bit| Lit::from(rom[address] >> bit & 1 == 1)).collect(),
                None => (0..memory.width).map(|_| self.own()).collect(),
            };
            words.push(word);
        }
        let writes: Vec<(Lit, Vec<Lit>, Vec<Lit>)> = memory
            .writes
            .iter()
            .map(|(enable, address, data)| (self.lit(*enable), self.word(address), self.word(data)))
            .collect();
        for (address, word) in words.iter().enumerate() {
            let mut taken = Vec::new();
            for (enable, at, data) in &writes {
                let here: Vec<Lit> = at
                    .iter()
                    .enumerate()
                    .map(|(bit, lit)| lit ^ Lit::from(address >> bit & 1 == 0))
                    .collect();
                let here = self.graph.all(&here);
                taken.push((self.graph.and(*enable, here), data));
            }
            for (bit, q) in word.iter().enumerate() {
                let (mut d, mut enable) = (*q, FALSE);
                for (when, data) in &taken {
                    d = if enable == FALSE { data[bit] } else { self.graph.mux(*when, data[bit], d) };
                    enable = self.graph.or(enable, *when);
                }
                self.drive(*q, d, enable, None, true);
            }
        }
        for (enable, address, first) in &memory.reads {
            let (enable, address) = (self.lit(*enable), self.word(address));
            for bit in 0..memory.width {
                let own = *first + bit as Bit;
                if self.known.contains_key(&own) {
                    continue;
                }
                let word = self.chosen(words.iter().map(|word| word[bit]).collect(), &address);
                let q = self.lits[own as usize];
                self.drive(q, word, enable, None, true);
            }
        }
    }
}
