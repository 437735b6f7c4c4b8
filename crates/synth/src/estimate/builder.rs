//! What the logic of a netlist is built with: literals of bits, flip-flops and what drives them.

use super::arithmetic::{Differences, Term};
use super::graph::{FALSE, Graph, Lit, Node, QuickMap};
use super::words::{Bit, Words};
use edgewalk_netlist::ops::Op;
use std::ops::Range;

/// A flip-flop and what drives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct FlipFlop {
    /// What it holds.
    pub q: Lit,
    /// What it takes.
    pub d: Lit,
    /// When it takes it.
    pub enable: Lit,
    /// When it takes `to` in place of that.
    pub reset: Lit,
    pub to: bool,
    /// A choice gives `d`, not an operator of the same meaning.
    pub chosen: bool,
}

/// What cells a memory or product is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Memory blocks.
    Block,
    /// Look-up tables of 16 words of 4 bits.
    Distributed,
    /// A multiplier.
    Product,
}

/// Cells that hold the same bits of all words of a memory, for one of its read ports; or a multiplier.
#[derive(Clone, Debug)]
pub(super) struct BlockMemory {
    pub kind: Kind,
    /// Which of the memories.
    pub place: usize,
    /// Which of its read ports.
    pub port: usize,
    /// Which bits of each word.
    pub bits: Vec<usize>,
    /// How many, one above the other.
    pub blocks: u32,
    /// All that its ports read.
    pub inputs: Vec<Lit>,
    /// Enable and address of each port.
    pub reads: Vec<(Lit, Vec<Lit>)>,
    pub writes: Vec<(Lit, Vec<Lit>)>,
}

/// What is known of bits of state: that they are a constant or equal to another. By bit.
pub(super) type Known = QuickMap<Bit, Known1>;

/// A bit of state that needs no flip-flop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Known1 {
    Constant(bool),
    Same(Bit),
}

pub(super) struct Builder<'w> {
    pub words: &'w Words,
    pub known: &'w Known,
    /// By memory: what it reads in the clock of a write has to be seen to.
    pub guarded: &'w [bool],
    pub graph: Graph,
    /// By bit.
    pub lits: Vec<Lit>,
    pub differences: Differences,
    /// Sums by the first bit of their result: their terms, and how many bits are computed.
    pub sums: QuickMap<Bit, (Vec<Term>, usize)>,
    pub flip_flops: Vec<FlipFlop>,
    /// By flip-flop of a register: its bit.
    pub bits: Vec<Bit>,
    pub memories: Vec<BlockMemory>,
    pub guards: Vec<Guard>,
    /// By the first bit of a state machine's register: its states, and a flip-flop for each.
    pub states: QuickMap<Bit, Vec<(u128, Lit)>>,
    /// By the first bit of its result: a choice, by its place among the cells.
    pub choices: QuickMap<Bit, usize>,
    /// The next bit that is no bit of the words.
    pub own_bits: Bit,
    pub rst: Lit,
}

/// What `emulate_read_first` of Yosys puts around a memory: writes come a clock later, and a read of a word on its way
/// takes it from there.
pub(super) struct Guard {
    /// The write as it reaches the memory: enable, address, data.
    pub enable: Lit,
    pub address: Vec<Lit>,
    pub data: Vec<Lit>,
    /// By read port: it takes the word on its way, and this word.
    pub passes: Vec<(Lit, Vec<Lit>)>,
}

/// A bit that has no literal.
pub(super) const UNKNOWN: Lit = Lit::MAX;

impl<'w> Builder<'w> {
    pub fn new(words: &'w Words, known: &'w Known, guarded: &'w [bool]) -> Builder<'w> {
        let mut graph = Graph::new(2 * words.bits, words.family);
        let rst = graph.node(Node::Leaf);
        Builder {
            words,
            known,
            guarded,
            graph,
            lits: vec![UNKNOWN; words.bits],
            differences: Differences::default(),
            sums: QuickMap::default(),
            flip_flops: Vec::new(),
            bits: Vec::new(),
            memories: Vec::new(),
            guards: Vec::new(),
            states: QuickMap::default(),
            choices: match words.machines.is_empty() {
                true => QuickMap::default(),
                false => (0..words.cells.len())
                    .filter(|cell| words.cells[*cell].op == Op::Mux)
                    .map(|cell| (words.cells[cell].first, cell))
                    .collect(),
            },
            own_bits: words.bits as Bit,
            rst,
        }
    }

    /// What a bit that needs no flip-flop is.
    pub fn of_known(&self, bit: Bit) -> Lit {
        match self.known.get(&bit) {
            Some(Known1::Constant(value)) => Lit::from(*value),
            Some(Known1::Same(other)) => self.of_known(*other),
            None => self.lits[bit as usize],
        }
    }

    /// A flip-flop whose input is connected later.
    pub fn flip_flop(&mut self, bit: Bit) -> Lit {
        let q = self.graph.node(Node::Register(self.flip_flops.len() as u32));
        self.flip_flops.push(FlipFlop { q, d: q, enable: FALSE, reset: FALSE, to: false, chosen: false });
        self.bits.push(bit);
        self.lits[bit as usize] = q;
        q
    }

    /// A bit of state that the words do not have.
    pub fn own(&mut self) -> Lit {
        let bit = self.own_bits;
        self.own_bits += 1;
        self.lits.push(UNKNOWN);
        if self.known.contains_key(&bit) { self.of_known(bit) } else { self.flip_flop(bit) }
    }

    pub fn lit(&mut self, bit: Bit) -> Lit {
        if self.lits[bit as usize] == UNKNOWN {
            self.lits[bit as usize] = self.graph.node(Node::Leaf); // a bit of an input
        }
        self.lits[bit as usize]
    }

    pub fn word(&mut self, place: &Range<usize>) -> Vec<Lit> {
        self.words.at(place).iter().map(|bit| self.lit(*bit)).collect()
    }

    /// A value that is chosen from the register's own: only when it is another is it taken.
    pub fn held(&mut self, when: Lit, value: Lit, q: Lit) -> (Lit, Lit) {
        let (mut when, mut value) = (when, value);
        while let Some((c, t, e)) = self.graph.choice(value) {
            if t == q {
                (when, value) = (self.graph.and(when, c ^ 1), e);
            } else if e == q {
                (when, value) = (self.graph.and(when, c), t);
            } else {
                break;
            }
        }
        (when, value)
    }

    /// Writes down what drives a flip-flop.
    pub fn drive(&mut self, q: Lit, d: Lit, enable: Lit, reset: Option<bool>, chosen: bool) {
        let Node::Register(place) = self.graph.nodes[(q >> 1) as usize] else { return };
        let flip_flop = match reset {
            Some(to) => FlipFlop { q, d, enable, reset: self.rst, to, chosen },
            None => FlipFlop { q, d, enable, reset: FALSE, to: false, chosen },
        };
        self.flip_flops[place as usize] = flip_flop;
    }
}
