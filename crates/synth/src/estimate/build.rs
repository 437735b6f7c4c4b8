//! From cells to logic: flip-flops, memories, carry chains and what lies between, round after round until no flip-flop is
//! known to be constant or a twin.

use super::builder::{BlockMemory, Builder, FlipFlop, Kind, Known, Known1, UNKNOWN};
use super::family::Family;
use super::graph::{FALSE, Graph, Lit, Node, QuickMap, TRUE};
use super::sat::possible;
use super::words::{Bit, ONE, UNREAD, Words, ZERO};
use std::collections::hash_map::Entry;

/// A module as flip-flops, memory blocks and the logic between.
pub(super) struct Built {
    pub graph: Graph,
    pub flip_flops: Vec<FlipFlop>,
    pub memories: Vec<BlockMemory>,
    /// By bit of the inputs; [`UNKNOWN`] where no operator reads it.
    pub inputs: Vec<Lit>,
    /// In the order of [`Words::outputs`].
    pub outputs: Vec<Lit>,
}

/// Builds it; constants and twins among the bits of state are found and left out, round after round.
pub(super) fn build(words: &Words) -> Built {
    let mut known = Known::default();
    let mut guarded = vec![false; words.memories.len()];
    let (mut built, mut bits) = Builder::new(words, &known, &guarded).build();
    let in_blocks: Vec<&BlockMemory> = built.memories.iter().filter(|of| of.kind == Kind::Block).collect();
    for blocks in in_blocks.chunk_by(|a, b| (a.place, a.port) == (b.place, b.port)) {
        guarded[blocks[0].place] |= collides(&built.graph, blocks[0]);
    }
    if guarded.contains(&true) {
        (built, bits) = Builder::new(words, &known, &guarded).build();
    }
    loop {
        let before = known.len();
        simplify(&built, &bits, &mut known);
        if known.len() == before {
            return finished(built);
        }
        (built, bits) = Builder::new(words, &known, &guarded).build();
    }
}

/// Whether a word can be read in the clock that writes it. A block does not say what is read then.
fn collides(graph: &Graph, memory: &BlockMemory) -> bool {
    memory.reads.iter().any(|(read, from)| {
        memory.writes.iter().any(|(write, to)| {
            let equal: Vec<(Lit, Lit)> = from.iter().copied().zip(to.iter().copied()).collect();
            possible(graph, &[*read, *write], &equal)
        })
    })
}

/// Resets that `opt_dff` finds in values that are a constant under a condition, and the enable that iCE40's
/// flip-flops want: they reset only where they are enabled.
fn finished(mut built: Built) -> Built {
    for flip_flop in &mut built.flip_flops {
        if flip_flop.reset == FALSE {
            if let Some((reset, to, d)) = chosen_reset(&built.graph, flip_flop) {
                (flip_flop.reset, flip_flop.to, flip_flop.d) = (reset, to, d);
            }
        } else if flip_flop.enable != TRUE && built.graph.family == Family::Ice40 {
            flip_flop.enable = built.graph.or(flip_flop.enable, flip_flop.reset);
        }
    }
    built
}

/// Condition, value and what is taken otherwise, where the flip-flop takes a constant by a choice.
fn chosen_reset(graph: &Graph, flip_flop: &FlipFlop) -> Option<(Lit, bool, Lit)> {
    let (c, t, e) = graph.choice(flip_flop.d).filter(|_| flip_flop.chosen)?;
    match (t, e) {
        (FALSE | TRUE, _) => Some((c, t == TRUE, e)),
        (_, FALSE | TRUE) => Some((c ^ 1, e == TRUE, t)),
        _ => None,
    }
}

/// Bits that never change, and bits that are always equal, and those that follow from them.
fn simplify(built: &Built, bits: &[Bit], known: &mut Known) {
    // By node: what it is, as far as flip-flops are known.
    let mut is: Vec<Lit> = (0..built.graph.nodes.len() as Lit).map(|node| node * 2).collect();
    loop {
        let before = known.len();
        let of = |lit: Lit| is[(lit >> 1) as usize] ^ (lit & 1);
        let mut found = Vec::new();
        let mut twins: QuickMap<(Lit, Lit, Lit, bool, bool), usize> = QuickMap::default();
        for (place, (flip_flop, bit)) in built.flip_flops.iter().zip(bits).enumerate() {
            if known.contains_key(bit) {
                continue;
            }
            let FlipFlop { q, d, enable, reset, to, .. } = *flip_flop;
            let (d, enable) = (of(d), of(enable));
            let reset_to = (reset != FALSE).then_some(to);
            let constant = match (d, reset_to) {
                (FALSE | TRUE, None) if enable != FALSE => Some(d == TRUE),
                (FALSE | TRUE, Some(to)) if to == (d == TRUE) || enable == FALSE => Some(to),
                (_, Some(to)) if d == q || enable == FALSE => Some(to),
                (_, None) if d == q || enable == FALSE => Some(false),
                _ => None,
            };
            if let Some(value) = constant {
                known.insert(*bit, Known1::Constant(value));
                found.push((q, Lit::from(value)));
                continue;
            }
            // Of two that take the same value, one with a reset of its own is no twin of one without.
            let own_reset = reset == FALSE && chosen_reset(&built.graph, flip_flop).is_some();
            match twins.entry((d, enable, reset, to, own_reset)) {
                Entry::Occupied(twin) => {
                    known.insert(*bit, Known1::Same(bits[*twin.get()]));
                    found.push((q, built.flip_flops[*twin.get()].q));
                }
                Entry::Vacant(first) => {
                    first.insert(place);
                }
            }
        }
        if known.len() == before {
            return;
        }
        found.into_iter().for_each(|(q, lit)| is[(q >> 1) as usize] = lit);
        built.graph.follow(&mut is);
    }
}

impl Builder<'_> {
    fn build(mut self) -> (Built, Vec<Bit>) {
        self.lits[ZERO as usize] = FALSE;
        self.lits[ONE as usize] = TRUE;
        for machine in &self.words.machines {
            self.graph.unit = self.words.registers[machine.register].unit;
            let first = self.words.registers[machine.register].first;
            let states = machine.states.iter().map(|state| (*state, self.own())).collect();
            self.states.insert(first, states);
        }
        for register in &self.words.registers {
            self.graph.unit = register.unit;
            if self.states.contains_key(&register.first) {
                for bit in register.first..register.first + register.width as Bit {
                    self.lits[bit as usize] = self.graph.node(Node::Leaf); // no cell reads this bit
                }
                continue;
            }
            for bit in register.first..register.first + register.width as Bit {
                if !self.known.contains_key(&bit) {
                    self.flip_flop(bit);
                }
            }
        }
        let memories: Vec<Option<usize>> =
            (0..self.words.memories.len()).map(|place| self.outputs(place)).collect();
        // A bit of the builder's own asks what is known of it where it is made.
        for bit in self.known.keys().filter(|bit| (**bit as usize) < self.words.bits) {
            self.lits[*bit as usize] = self.of_known(*bit);
        }
        for cell in &self.words.cells {
            self.graph.unit = cell.unit;
            self.cell(cell);
        }
        for register in &self.words.registers {
            self.graph.unit = register.unit;
            self.register(register);
        }
        for (memory, place) in self.words.memories.iter().zip(memories) {
            self.graph.unit = memory.unit;
            match place {
                Some(place) => self.block_memory(memory, place),
                None if self.is_distributed(memory) => self.distributed_memory(memory),
                None => self.memory_of_flip_flops(memory),
            }
        }
        let outputs = self.words.outputs.clone().iter().map(|bit| self.lit(*bit)).collect();
        let lit = |bit: &Bit| if *bit == UNREAD { UNKNOWN } else { self.lits[*bit as usize] };
        let inputs = self.words.inputs.iter().map(lit).collect();
        let Builder { graph, flip_flops, memories, bits, .. } = self;
        (Built { graph, flip_flops, memories, inputs, outputs }, bits)
    }
}
