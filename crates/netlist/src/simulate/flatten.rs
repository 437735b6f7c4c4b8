//! The hierarchy taken apart: one list of slots (a value each), instructions in an order in which they can be computed,
//! registers and memories. Wires and ports cost nothing: they are names of a slot.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::netlist::{Instance, Netlist, NodeId, Source};
use crate::ops::{Bits, MAX_WIDTH, Op};

pub(super) type Slot = u32;

/// `dst := op(..)` of up to three slots, those not needed being the first; with the widths of all. It fills half of a
/// cache line: most of a simulation goes into fetching instructions.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub(super) struct Instruction {
    op: Op,
    slots: [Slot; 3],
    pub dst: Slot,
    widths: [u8; 3],
    width: u8,
}

const _: () = assert!(size_of::<Instruction>() == 32 && MAX_WIDTH <= u8::MAX as u32);

#[derive(Clone, Debug)]
pub(super) struct FlatRegister {
    pub q: Slot,
    pub reset: Option<u128>,
    /// Condition and value, the strongest last.
    pub updates: Vec<(Option<Slot>, Slot)>,
}

#[derive(Clone, Debug)]
pub(super) struct FlatMemory {
    pub words: Vec<u128>,
    /// Enable, address, data.
    pub writes: Vec<(Slot, Slot, Slot)>,
    /// Enable, address, output.
    pub reads: Vec<(Slot, Slot, Slot)>,
}

/// What reads each slot: places of instructions, and behind them those of registers.
#[derive(Clone, Debug, Default)]
pub(super) struct Readers {
    /// By slot: where its readers begin in `places`. The last number is that of all.
    first: Vec<u32>,
    places: Vec<u32>,
    /// The place of the first register, a multiple of 64.
    pub registers: usize,
    /// One behind the last place.
    pub end: usize,
}

impl Readers {
    fn new(slots: usize, instructions: &[Instruction], registers: &[FlatRegister]) -> Readers {
        let behind = instructions.len().next_multiple_of(64);
        let mut pairs: Vec<(Slot, u32)> = Vec::new();
        for (place, instruction) in instructions.iter().enumerate() {
            pairs.extend(instruction.slots.map(|slot| (slot, place as u32)));
        }
        for (place, register) in registers.iter().enumerate() {
            let operands = register.updates.iter().flat_map(|(when, value)| when.iter().chain([value]));
            let operands = operands.chain(register.reset.map(|_| &RST));
            pairs.extend(operands.map(|slot| (*slot, (behind + place) as u32)));
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut first = vec![0; slots + 1];
        pairs.iter().for_each(|(slot, _)| first[*slot as usize + 1] += 1);
        for slot in 1..=slots {
            first[slot] += first[slot - 1];
        }
        let places = pairs.into_iter().map(|(_, place)| place).collect();
        Readers { first, places, registers: behind, end: behind + registers.len() }
    }

    /// Readers of one slot. An instruction among them stands behind the one that computes the slot.
    #[inline(always)]
    pub fn of(&self, slot: Slot) -> &[u32] {
        let slot = slot as usize;
        &self.places[self.first[slot] as usize..self.first[slot + 1] as usize]
    }
}

/// Everything a simulator needs; `values` and `widths` by slot.
#[derive(Clone, Debug, Default)]
pub(super) struct Flat {
    pub values: Vec<u128>,
    pub widths: Vec<u32>,
    pub instructions: Vec<Instruction>,
    pub readers: Readers,
    pub registers: Vec<FlatRegister>,
    pub memories: Vec<FlatMemory>,
    /// By slot: it never changes.
    pub constant: Vec<bool>,
    /// Every named signal by its path, `instance.instance.name`.
    pub names: BTreeMap<String, Slot>,
    /// The slots of each instance in the top module, and all that is in it.
    pub units: Vec<(String, Range<Slot>)>,
    /// Every memory by its path.
    pub memory_names: BTreeMap<String, usize>,
}

/// The slot of the top module's `rst`; nobody drives it if there is no register with reset.
pub(super) const RST: Slot = 0;

impl Flat {
    pub fn new(netlist: &Netlist) -> Flat {
        let mut builder = Builder { flat: Flat::default(), sources: Vec::new() };
        builder.slot(1, SlotSource::State); // RST
        builder.module(netlist, "", None);
        builder.finish()
    }
}

impl Instruction {
    fn new(op: Op, operands: &[Slot], dst: Slot, widths: &[u32]) -> Self {
        let mut slots = [operands[0]; 3];
        slots.iter_mut().zip(operands).for_each(|(to, from)| *to = *from);
        let width = |slot: Slot| widths[slot as usize] as u8;
        Instruction { op, slots, dst, widths: slots.map(width), width: width(dst) }
    }

    /// The result, from the values of all slots.
    #[inline(always)]
    pub fn compute(&self, values: &[u128]) -> u128 {
        let operand = |i: usize| Bits { value: values[self.slots[i] as usize], width: self.widths[i].into() };
        self.op.apply(self.width.into(), operand(0), operand(1), operand(2))
    }
}

/// Where a slot's value comes from while flattening.
#[derive(Clone, Debug)]
enum SlotSource {
    /// Inputs, registers, memory outputs.
    State,
    Constant,
    /// At most three operands.
    Op(Op, Vec<Slot>),
    /// Another name of a slot.
    Alias(Slot),
}

struct Builder {
    flat: Flat,
    sources: Vec<SlotSource>,
}

impl Builder {
    fn slot(&mut self, width: u32, source: SlotSource) -> Slot {
        self.flat.values.push(0);
        self.flat.widths.push(width);
        self.sources.push(source);
        (self.sources.len() - 1) as Slot
    }

    /// Gives every node of the module a slot; node i of it has slot base + i. Returns the base.
    fn module(&mut self, netlist: &Netlist, prefix: &str, connections: Option<&[Slot]>) -> Slot {
        let base = self.sources.len() as Slot;
        let at = |id: NodeId| base + id.index() as Slot;
        for node in &netlist.nodes {
            self.slot(node.width, SlotSource::State);
        }
        let mut bases = Vec::new();
        for instance in &netlist.instances {
            let Instance { name, module, connections, .. } = instance;
            let connections: Vec<Slot> = connections.iter().map(|id| at(*id)).collect();
            let first = self.sources.len() as Slot;
            bases.push(self.module(module, &format!("{prefix}{name}."), Some(&connections)));
            if prefix.is_empty() {
                self.flat.units.push((name.clone(), first..self.sources.len() as Slot));
            }
        }
        for (index, node) in netlist.nodes.iter().enumerate() {
            let slot = base + index as Slot;
            self.sources[slot as usize] = match &node.source {
                Source::Input(port) => match connections {
                    Some(connections) => SlotSource::Alias(connections[*port]),
                    None => SlotSource::State,
                },
                Source::Constant { value, .. } => {
                    self.flat.values[slot as usize] = *value;
                    SlotSource::Constant
                }
                Source::Op(op, operands) => {
                    self.op(*op, &operands.iter().map(|id| at(*id)).collect::<Vec<_>>())
                }
                Source::Wire(wire) => SlotSource::Alias(at(netlist.wires[*wire].driver)),
                Source::Register(_) | Source::MemoryRead { .. } => SlotSource::State,
                Source::InstanceOutput { instance, output } => {
                    let driver = netlist.instances[*instance].module.outputs[*output].driver;
                    SlotSource::Alias(bases[*instance] + driver.index() as Slot)
                }
            };
        }
        self.state(netlist, prefix, base);
        self.names(netlist, prefix, base);
        base
    }

    /// The operator with at most three operands; a longer concatenation becomes a chain.
    fn op(&mut self, op: Op, operands: &[Slot]) -> SlotSource {
        match *operands {
            [ref high @ .., low] if op == Op::Concat && high.len() > 1 => {
                let chain = self.op(op, high);
                let width = high.iter().map(|slot| self.flat.widths[*slot as usize]).sum();
                let high = self.slot(width, chain);
                SlotSource::Op(op, vec![high, low])
            }
            [only] if op == Op::Concat => SlotSource::Alias(only),
            _ => SlotSource::Op(op, operands.to_vec()),
        }
    }

    fn state(&mut self, netlist: &Netlist, prefix: &str, base: Slot) {
        let at = |id: NodeId| base + id.index() as Slot;
        for register in &netlist.registers {
            let updates = register.updates.iter().map(|update| (update.when.map(at), at(update.value)));
            self.flat.registers.push(FlatRegister {
                q: at(register.node),
                reset: register.reset,
                updates: updates.collect(),
            });
        }
        for memory in &netlist.memories {
            self.flat.memory_names.insert(format!("{prefix}{}", memory.name), self.flat.memories.len());
            let writes = memory.writes.iter().map(|port| (at(port.en), at(port.addr), at(port.data)));
            let reads = memory.reads.iter().map(|port| (at(port.en), at(port.addr), at(port.node)));
            self.flat.memories.push(FlatMemory {
                words: (0..memory.words).map(|address| memory.contents.word(memory.width, address)).collect(),
                writes: writes.collect(),
                reads: reads.collect(),
            });
        }
    }

    fn names(&mut self, netlist: &Netlist, prefix: &str, base: Slot) {
        for index in 0..netlist.nodes.len() as u32 {
            if let Some(name) = netlist.name_of(NodeId(index)) {
                self.flat.names.insert(format!("{prefix}{name}"), base + index);
            }
        }
        for output in &netlist.outputs {
            self.flat.names.insert(format!("{prefix}{}", output.name), base + output.driver.index() as Slot);
        }
        if netlist.has_reset {
            self.flat.names.insert(format!("{prefix}rst"), RST);
        }
    }

    /// Follows aliases, orders the instructions, computes those of constants once.
    fn finish(mut self) -> Flat {
        let resolve = |mut slot: Slot| {
            while let SlotSource::Alias(of) = self.sources[slot as usize] {
                slot = of;
            }
            slot
        };
        let flat = &mut self.flat;
        flat.names.values_mut().for_each(|slot| *slot = resolve(*slot));
        for register in &mut flat.registers {
            for (when, value) in &mut register.updates {
                *when = when.map(resolve);
                *value = resolve(*value);
            }
        }
        for memory in &mut flat.memories {
            for (en, addr, data) in &mut memory.writes {
                (*en, *addr, *data) = (resolve(*en), resolve(*addr), resolve(*data));
            }
            for (en, addr, _) in &mut memory.reads {
                (*en, *addr) = (resolve(*en), resolve(*addr));
            }
        }
        let mut constant: Vec<bool> =
            self.sources.iter().map(|source| matches!(source, SlotSource::Constant)).collect();
        for slot in in_order(&self.sources, resolve) {
            let SlotSource::Op(op, operands) = &self.sources[slot as usize] else { continue };
            let operands: Vec<Slot> = operands.iter().map(|slot| resolve(*slot)).collect();
            let instruction = Instruction::new(*op, &operands, slot, &flat.widths);
            if operands.iter().all(|slot| constant[*slot as usize]) {
                flat.values[slot as usize] = instruction.compute(&flat.values);
                constant[slot as usize] = true;
            } else {
                flat.instructions.push(instruction);
            }
        }
        flat.constant = constant;
        flat.readers = Readers::new(flat.values.len(), &flat.instructions, &flat.registers);
        self.flat
    }
}

/// All slots, each after those it is computed from. There are no loops: the modules were checked.
fn in_order(sources: &[SlotSource], resolve: impl Fn(Slot) -> Slot) -> Vec<Slot> {
    let mut order = Vec::with_capacity(sources.len());
    let mut seen = vec![false; sources.len()];
    for start in 0..sources.len() as Slot {
        // Depth first with its own stack: a slot and how many of its operands have been visited.
        let mut stack = Vec::new();
        if !std::mem::replace(&mut seen[start as usize], true) {
            stack.push((start, 0));
        }
        while let Some((slot, visited)) = stack.last_mut() {
            let operand = match &sources[*slot as usize] {
                SlotSource::Op(_, operands) => operands.get(*visited),
                _ => None,
            };
            match operand {
                Some(operand) => {
                    *visited += 1;
                    let operand = resolve(*operand);
                    if !std::mem::replace(&mut seen[operand as usize], true) {
                        stack.push((operand, 0));
                    }
                }
                None => {
                    order.push(*slot);
                    stack.pop();
                }
            }
        }
    }
    order
}
