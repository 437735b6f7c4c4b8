//! The memories outside the machine, and which of them the memory blocks of a device hold.
//!
//! The machine's netlist ends at the ports of its memories, so Yosys sees none of them. They are counted from what the units
//! declare: words, bits, and how often each is read and written.

use crate::part::Part;
use edgewalk_machine::{MemoryPort, Plan, Ports};
use serde::Serialize;

/// Memory blocks of one kind on a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// The maker's name for them.
    pub name: &'static str,
    /// Blocks on the device.
    pub count: u64,
    /// Words and bits that a block can be set to.
    pub shapes: &'static [(u64, u64)],
    /// Accesses in a clock: 2 for a read beside a write.
    pub accesses: u32,
    /// The memories inside the design that are blocks are of this kind.
    pub holds_own: bool,
}

impl Block {
    /// The fewest blocks that hold so many words of so many bits.
    fn needed(&self, words: u64, bits: u64) -> u64 {
        let of = |(deep, wide): &(u64, u64)| words.div_ceil(*deep) * bits.div_ceil(*wide);
        self.shapes.iter().map(of).min().unwrap_or(u64::MAX)
    }
}

/// A memory outside the machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Memory {
    /// What it holds.
    pub name: &'static str,
    /// Words.
    pub words: u64,
    /// Bits of a word.
    pub bits: u64,
    /// Reads in a clock, at most.
    pub reads: f64,
    /// Writes in a clock, at most.
    pub writes: f64,
    /// The blocks that hold it; none where the device has too few of any kind.
    pub held_by: Option<Blocks>,
    /// Why no blocks hold it: a reason for each kind.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub reasons: Vec<String>,
}

/// So many blocks of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Blocks {
    /// Kind of the blocks.
    pub block: &'static str,
    /// How many.
    pub count: u64,
}

/// The memories of a part of the machine, each held by no blocks yet.
#[must_use]
pub fn memories(plan: &Plan, part: Part) -> Vec<Memory> {
    let ports = part.ports(plan);
    let mut list: Vec<Memory> = ports.memory.iter().map(|port| read(plan, port)).collect();
    // Without BLEND nothing reads the colours, so no port for reads is declared.
    let has = |name: &str| list.iter().any(|memory| memory.name == name);
    if has("depth") && !has("color") && !plan.blend.is_there() {
        list.push(Memory { reads: 0.0, ..screen(plan, "color", color_bits(plan)) });
    }
    list
}

/// A memory that a port reads.
fn read(plan: &Plan, port: &MemoryPort) -> Memory {
    match port.name {
        "depth" => screen(plan, "depth", port.data.width().into()),
        "color" => screen(plan, "color", color_bits(plan)),
        // The machine reads a map or texture once for a pixel, tables and records word after word.
        "map" | "textures" => {
            let writes = if plan.shadow.draws_map() && port.name == "map" { rate(plan) } else { 0.0 };
            Memory { reads: rate(plan), writes, ..addressed(port) }
        }
        _ => addressed(port),
    }
}

/// Pixels in a clock.
fn rate(plan: &Plan) -> f64 {
    1.0 / f64::from(plan.clocks_per_pixel())
}

/// Bits of a word of the frame memory: the colours and the user's own channels.
fn color_bits(plan: &Plan) -> u64 {
    let own: u32 = plan.own_channels().map(|(_, channel)| channel.bits).sum();
    u64::from(3 * plan.stored_color().bits + own)
}

/// A memory with a word for each pixel: line y begins at y·2^xb, which leaves a gap behind lines of another length.
fn screen(plan: &Plan, name: &'static str, bits: u64) -> Memory {
    let words = u64::from(plan.height) << plan.widths().x;
    Memory { name, words, bits, reads: rate(plan), writes: rate(plan), held_by: None, reasons: Vec::new() }
}

/// A memory with a word for each address, which the host fills.
fn addressed(port: &MemoryPort) -> Memory {
    Memory {
        name: port.name,
        words: 1 << port.read.width(),
        bits: port.data.width().into(),
        reads: 1.0,
        writes: 0.0,
        held_by: None,
        reasons: Vec::new(),
    }
}

/// Puts memories into blocks, as many of them as possible; of these ways, the one that takes the fewest blocks. The design
/// itself has `own` blocks.
pub(crate) fn place(mut memories: Vec<Memory>, blocks: &[Block], own: u64) -> Vec<Memory> {
    let left: Vec<u64> = blocks
        .iter()
        .map(|block| block.count.saturating_sub(if block.holds_own { own } else { 0 }))
        .collect();
    let chosen = best(&memories, blocks, &left);
    for (memory, kind) in memories.iter_mut().zip(chosen.kinds) {
        let needed = |block: &Block| block.needed(memory.words, memory.bits);
        memory.held_by = kind.map(|kind| Blocks { block: blocks[kind].name, count: needed(&blocks[kind]) });
        if kind.is_none() {
            memory.reasons =
                blocks.iter().zip(&left).map(|(block, left)| refusal(memory, block, *left)).collect();
        }
    }
    memories
}

/// A kind of block for each memory, by its place; none for one that is not held.
struct Choice {
    kinds: Vec<Option<usize>>,
    held: usize,
    taken: u64,
}

fn best(memories: &[Memory], blocks: &[Block], left: &[u64]) -> Choice {
    let Some((memory, others)) = memories.split_first() else {
        return Choice { kinds: Vec::new(), held: 0, taken: 0 };
    };
    let of = |kind: Option<usize>| {
        let needed = kind.map_or(0, |kind| blocks[kind].needed(memory.words, memory.bits));
        let mut left = left.to_vec();
        if let Some(kind) = kind {
            left[kind] = left[kind].checked_sub(needed).filter(|_| suffices(memory, &blocks[kind]))?;
        }
        let mut choice = best(others, blocks, &left);
        choice.kinds.insert(0, kind);
        choice.held += usize::from(kind.is_some());
        choice.taken += needed;
        Some(choice)
    };
    // Of two ways that are as good the last wins: that with the kind named first.
    let ways = std::iter::once(None).chain((0..blocks.len()).rev().map(Some)).filter_map(of);
    let nothing = Choice { kinds: vec![None; memories.len()], held: 0, taken: 0 };
    ways.max_by_key(|choice| (choice.held, std::cmp::Reverse(choice.taken))).unwrap_or(nothing)
}

/// The block can be read and written as often as the machine asks.
fn suffices(memory: &Memory, block: &Block) -> bool {
    memory.reads + memory.writes <= f64::from(block.accesses)
}

fn refusal(memory: &Memory, block: &Block, left: u64) -> String {
    let (name, needed) = (block.name, block.needed(memory.words, memory.bits));
    if !suffices(memory, block) {
        return format!(
            "{needed} {name}: {} access a clock, {} are needed",
            block.accesses,
            memory.reads + memory.writes
        );
    }
    format!("{needed} {name}: {left} of {} are left", block.count)
}

impl Part {
    fn ports(self, plan: &Plan) -> Ports {
        let unit = plan.units().find(|unit| unit.name == self.name());
        unit.map_or_else(|| plan.ports(), |unit| (unit.ports)(plan))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::target::Target;
    use edgewalk_machine::Machine;

    fn placed(settings: &[(&str, &str)], target: &str, own: u64) -> Vec<Memory> {
        let mut machine = Machine::default();
        for (key, value) in settings {
            machine.set(key, value).expect("a key");
        }
        let plan = machine.plan().expect("can be built");
        place(memories(&plan, Part::MACHINE), Target::named(target).expect("a target").blocks, own)
    }

    fn held(memories: &[Memory]) -> Vec<(&str, Option<(&str, u64)>)> {
        memories.iter().map(|of| (of.name, of.held_by.map(|by| (by.block, by.count)))).collect()
    }

    #[test]
    fn a_block_takes_the_shape_that_fits_best() {
        let ebr = Target::named("ice40-hx8k").expect("a target").blocks[0];
        for (words, bits, needed) in
            [(256, 16, 1), (257, 16, 2), (2048, 2, 1), (512, 9, 2), (40_960, 15, 160)]
        {
            assert_eq!(ebr.needed(words, bits), needed, "{words} x {bits}");
        }
    }

    /// 16 x 16 pixels at a pixel a clock: depth and colour of 256 words.
    #[test]
    fn small_memories_lie_in_blocks() {
        let tiny = [("screen.width", "16"), ("screen.height", "16"), ("formats.z_bits", "16")];
        let memories = placed(&tiny, "ice40-up5k", 0);
        assert_eq!(held(&memories), [("depth", Some(("EBR", 1))), ("color", Some(("EBR", 2)))]);
        let depth = &memories[0];
        assert_eq!((depth.words, depth.bits, depth.reads, depth.writes), (256, 16, 1.0, 1.0));
        let color = &memories[1];
        assert_eq!((color.words, color.bits, color.reads, color.writes), (256, 24, 0.0, 1.0));
    }
}
