//! A finished module: what the builder made and the checks passed. Every index in it is valid, every driver present.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::ops::Op;

/// A node's place in [`Netlist::nodes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub(crate) u32);

impl NodeId {
    /// What stands where a driver is still to come; never in a finished netlist.
    pub(crate) const UNDRIVEN: NodeId = NodeId(u32::MAX);

    /// The place as an index.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A module with everything in it, immutable and checked.
#[derive(Clone, Debug)]
pub struct Netlist {
    /// The module's name, a legal Verilog identifier.
    pub name: String,
    /// Header text: purpose, picture, formats, timing. May have several lines.
    pub doc: String,
    /// All values of the module.
    pub nodes: Vec<Node>,
    /// Input ports in order, without `clk` and `rst`.
    pub inputs: Vec<Input>,
    /// Output ports in order.
    pub outputs: Vec<Output>,
    /// Named wires.
    pub wires: Vec<Wire>,
    /// Registers.
    pub registers: Vec<Register>,
    /// Memories.
    pub memories: Vec<Memory>,
    /// Instances of other modules.
    pub instances: Vec<Instance>,
    /// The order in which a reader is told of all this.
    pub items: Vec<Item>,
    /// For each output the inputs it depends on without a register between, ascending.
    pub paths: Vec<Vec<usize>>,
    /// There is a port `clk`.
    pub has_clock: bool,
    /// There is a port `rst`.
    pub has_reset: bool,
}

/// One value of the module.
#[derive(Clone, Debug)]
pub struct Node {
    /// Bits, 1 to 128.
    pub width: u32,
    /// Where the value comes from.
    pub source: Source,
}

/// Where a node's value comes from. The numbers index the netlist's lists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// An input port.
    Input(usize),
    /// A constant; with a name if the reader should see one.
    Constant {
        /// Below 2^width.
        value: u128,
        /// Such as the name of a state.
        name: Option<String>,
    },
    /// An operator and its operands.
    Op(Op, Vec<NodeId>),
    /// A named wire.
    Wire(usize),
    /// A register's output.
    Register(usize),
    /// The registered output of a memory's read port.
    MemoryRead {
        /// In [`Netlist::memories`].
        memory: usize,
        /// In [`Memory::reads`].
        port: usize,
    },
    /// An output of an instance.
    InstanceOutput {
        /// In [`Netlist::instances`].
        instance: usize,
        /// In the instance's [`Netlist::outputs`].
        output: usize,
    },
}

/// An input port.
#[derive(Clone, Debug)]
pub struct Input {
    /// Name of the port.
    pub name: String,
    /// Format and unit, or empty.
    pub doc: String,
    /// The node that carries its value; gives the width.
    pub node: NodeId,
}

/// An output port.
#[derive(Clone, Debug)]
pub struct Output {
    /// Name of the port. A register or wire has the same name if and only if it drives the port.
    pub name: String,
    /// Format and unit, or empty.
    pub doc: String,
    /// What drives it.
    pub driver: NodeId,
}

/// A wire with a name for the reader.
#[derive(Clone, Debug)]
pub struct Wire {
    /// Name of the wire.
    pub name: String,
    /// Format and unit, or empty.
    pub doc: String,
    /// The node that carries its value.
    pub node: NodeId,
    /// What drives it.
    pub driver: NodeId,
}

/// A register. At the clock: `reset` if it has one and `rst` is 1; else the value of the last update whose condition
/// is 1; else as before. Before the first of these it is 0 here; in Verilog it is unknown, unless it starts at zero.
#[derive(Clone, Debug)]
pub struct Register {
    /// Name of the register.
    pub name: String,
    /// Format and unit, or empty.
    pub doc: String,
    /// The node that carries its value.
    pub node: NodeId,
    /// Value after a clock with `rst` = 1.
    pub reset: Option<u128>,
    /// Verilog says that it is 0 before the first clock.
    pub starts_at_zero: bool,
    /// In order of priority, the strongest last.
    pub updates: Vec<Update>,
}

/// One way for a register to change.
#[derive(Clone, Debug)]
pub struct Update {
    /// One bit; `None` is always.
    pub when: Option<NodeId>,
    /// The next value.
    pub value: NodeId,
}

/// A memory of `words` words. Addresses at or beyond `words` must not be used: here such a
/// write is lost and such a read is 0, in Verilog it is unknown.
#[derive(Clone, Debug)]
pub struct Memory {
    /// Name of the memory.
    pub name: String,
    /// What a word is, or empty.
    pub doc: String,
    /// Bits of an address.
    pub addr_bits: u32,
    /// Words, at least 2, more than 2^(addr_bits - 1) and at most 2^addr_bits.
    pub words: usize,
    /// Bits of a word.
    pub width: u32,
    /// Words at the start. A reset does not bring them back: a word that was written stays as written.
    pub contents: Contents,
    /// Write ports; of two writes to one address the later port wins. A memory without one is a ROM: the contents of all its words
    /// are known.
    pub writes: Vec<MemoryWrite>,
    /// Read ports.
    pub reads: Vec<MemoryRead>,
}

/// The words of a memory at the start.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Contents {
    /// Every word that is not among `rows`; `None`: unknown, nobody reads such a word before it is written.
    pub others: Option<u128>,
    /// Words of their own by their address: constants in a RAM, or all of a ROM.
    pub rows: BTreeMap<usize, Row>,
}

/// A word of its own in a memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Below 2^width.
    pub word: u128,
    /// What it is, or empty.
    pub doc: String,
}

impl Contents {
    /// Word `address` of a memory with words of so many bits. Of unknown words each is another number here, so that a netlist
    /// that reads one is seen to; in Verilog it is unknown.
    pub fn word(&self, width: u32, address: usize) -> u128 {
        /// 2^128 over the golden ratio: multiples of it are spread evenly.
        const SPREAD: u128 = 0x9e37_79b9_7f4a_7c15_f39c_c060_5ced_c835;
        let spread = || (address as u128 + 1).wrapping_mul(SPREAD) >> (128 - width);
        self.rows.get(&address).map(|row| row.word).or(self.others).unwrap_or_else(spread)
    }
}

/// At the clock, if `en`: word `addr` := `data`.
#[derive(Clone, Debug)]
pub struct MemoryWrite {
    /// One bit.
    pub en: NodeId,
    /// Word address.
    pub addr: NodeId,
    /// The new word.
    pub data: NodeId,
}

/// At the clock, if `en`: `node` := the word at `addr` as it was before any write of this clock; else `node` holds.
/// Before its first read it is 0 here and unknown in Verilog.
#[derive(Clone, Debug)]
pub struct MemoryRead {
    /// Name of the registered output.
    pub name: String,
    /// One bit.
    pub en: NodeId,
    /// Word address.
    pub addr: NodeId,
    /// The node that carries the registered output.
    pub node: NodeId,
}

/// A module used inside another; `clk` and `rst` are passed on unseen.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Name of the instance.
    pub name: String,
    /// What it is an instance of.
    pub module: Arc<Netlist>,
    /// What drives each of the module's inputs, in their order.
    pub connections: Vec<NodeId>,
    /// The node that carries each of the module's outputs, in their order; `None` if nobody asked for it.
    pub outputs: Vec<Option<NodeId>>,
}

/// A step in the telling of a module. An item uses only what earlier items declared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Item {
    /// A section begins.
    Comment(String),
    /// A named constant, by its node.
    Constant(NodeId),
    /// A wire appears; with its driver, unless a `Drive` follows.
    Wire(usize),
    /// The driver of a wire that was declared ahead of it.
    Drive(usize),
    /// A register appears.
    Register(usize),
    /// All updates of a register.
    Update(usize),
    /// A memory appears.
    Memory(usize),
    /// A write port.
    MemoryWrite {
        /// In [`Netlist::memories`].
        memory: usize,
        /// In [`Memory::writes`].
        port: usize,
    },
    /// A read port and its output.
    MemoryRead {
        /// In [`Netlist::memories`].
        memory: usize,
        /// In [`Memory::reads`].
        port: usize,
    },
    /// The node of an instance's output appears.
    InstanceOutput(NodeId),
    /// The instance, after all its connections.
    Instance(usize),
}

impl Netlist {
    /// The module, or an instance in it, has a register or a memory.
    pub fn needs_clock(&self) -> bool {
        !self.registers.is_empty()
            || !self.memories.is_empty()
            || self.instances.iter().any(|instance| instance.module.has_clock)
    }

    /// The module, or an instance in it, has a register with reset.
    pub fn needs_reset(&self) -> bool {
        self.registers.iter().any(|register| register.reset.is_some())
            || self.instances.iter().any(|instance| instance.module.has_reset)
    }

    /// The same module with ports `clk` and `rst`, whether anything in it needs them or not.
    #[must_use]
    pub fn clocked(mut self: Arc<Self>) -> Arc<Netlist> {
        if !(self.has_clock && self.has_reset) {
            let netlist = Arc::make_mut(&mut self);
            (netlist.has_clock, netlist.has_reset) = (true, true);
        }
        self
    }

    /// The places of all nodes.
    pub fn ids(&self) -> impl Iterator<Item = NodeId> + use<> {
        (0..self.nodes.len() as u32).map(NodeId)
    }

    /// The node at `id`.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// The width of the node at `id`.
    pub fn width(&self, id: NodeId) -> u32 {
        self.node(id).width
    }

    /// The name a reader knows the node by, if it has one.
    pub fn name_of(&self, id: NodeId) -> Option<String> {
        match &self.node(id).source {
            Source::Input(i) => Some(self.inputs[*i].name.clone()),
            Source::Constant { name, .. } => name.clone(),
            Source::Op(..) => None,
            Source::Wire(i) => Some(self.wires[*i].name.clone()),
            Source::Register(i) => Some(self.registers[*i].name.clone()),
            Source::MemoryRead { memory, port } => Some(self.memories[*memory].reads[*port].name.clone()),
            Source::InstanceOutput { instance, output } => {
                let instance = &self.instances[*instance];
                Some(format!("{}_{}", instance.name, instance.module.outputs[*output].name))
            }
        }
    }

    /// Every different module used in this one, itself last; a module comes after those it uses.
    pub fn modules(self: &Arc<Self>) -> Vec<Arc<Netlist>> {
        let mut found = Vec::new();
        collect(self, &mut found);
        found
    }
}

fn collect(module: &Arc<Netlist>, found: &mut Vec<Arc<Netlist>>) {
    if found.iter().any(|known| Arc::ptr_eq(known, module)) {
        return;
    }
    for instance in &module.instances {
        collect(&instance.module, found);
    }
    found.push(Arc::clone(module));
}
