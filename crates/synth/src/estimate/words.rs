//! The netlist as cells whose operands are single bits. Hierarchy, wires, slices, extensions and cells without a reader are
//! gone. Equal operators on equal operands are one cell, as Yosys' `opt_merge` makes them.

use super::family::Family;
use super::graph::{Quick, QuickMap};
use super::ports::{Seen, View};
use edgewalk_netlist::netlist::{Netlist, NodeId, Source};
use edgewalk_netlist::ops::Op;
use std::hash::{Hash, Hasher};
use std::ops::Range;

/// One bit: [`ZERO`], [`ONE`], or a bit of an input, a register, a memory's output or an operator.
pub(super) type Bit = u32;
pub(super) const ZERO: Bit = 0;
pub(super) const ONE: Bit = 1;
/// No bit: that of an input that no operator reads.
pub(super) const UNREAD: Bit = Bit::MAX;

/// An operator that is no wiring.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub op: Op,
    /// Places in [`Words::operands`], least significant bit first.
    pub operands: Vec<Range<usize>>,
    /// The bits of its result are `first .. first + width`.
    pub first: Bit,
    pub width: usize,
    /// Which of the top module's instances it lies in; 0 is the top module itself.
    pub unit: u8,
    /// Yosys' `flatten` turned the order of its module round.
    pub backwards: bool,
}

/// A register; bits are least significant first.
#[derive(Clone, Debug)]
pub(super) struct Register {
    pub first: Bit,
    pub width: usize,
    pub reset: Option<u128>,
    /// Condition and value, the strongest last.
    pub updates: Vec<(Option<Bit>, Range<usize>)>,
    pub unit: u8,
}

/// A register whose values are constants, which others only compare with constants: Yosys' `fsm` gives each state a
/// flip-flop.
#[derive(Clone, Debug)]
pub(super) struct StateMachine {
    /// In [`Words::registers`].
    pub register: usize,
    /// Values of the register.
    pub states: Vec<u128>,
}

/// A memory with registered reads.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    pub words: usize,
    pub width: usize,
    /// All words of a memory that has no write port.
    pub rom: Option<Vec<u128>>,
    /// Enable, address, data.
    pub writes: Vec<(Bit, Range<usize>, Range<usize>)>,
    /// Enable, address, first bit of the output.
    pub reads: Vec<(Bit, Range<usize>, Bit)>,
    pub unit: u8,
}

/// All of it.
#[derive(Debug, Default)]
pub(super) struct Words {
    /// Each after those that it is computed from.
    pub cells: Vec<Cell>,
    pub operands: Vec<Bit>,
    pub registers: Vec<Register>,
    pub memories: Vec<Memory>,
    /// The bit of each input bit of the module, by port; [`UNREAD`] if no operator reads the input bit.
    pub inputs: Vec<Bit>,
    /// Bits of outputs that somebody reads, as often as they are read.
    pub outputs: Vec<Bit>,
    /// By bit of [`Words::outputs`]: which bit of all outputs it is.
    pub wanted: Vec<u32>,
    /// How many bits there are, constants included.
    pub bits: usize,
    /// By bit: how many ports of cells, registers and outputs read it.
    pub users: Vec<u32>,
    /// By bit: a choice gives it.
    pub chosen: Vec<bool>,
    /// By bit: an operator that works bit by bit gives it, a choice among them.
    pub bitwise: Vec<bool>,
    /// Registers that are kept a flip-flop a state; none before they are looked for.
    pub machines: Vec<StateMachine>,
    /// What the module is built of.
    pub family: Family,
    /// The instances of the top module, behind the top module's own name.
    pub units: Vec<String>,
}

/// An instance and where its values stand.
struct Scope<'n> {
    netlist: &'n Netlist,
    /// The scope around it and the instance there.
    parent: Option<(usize, usize)>,
    children: Vec<usize>,
    /// Where its nodes begin in [`Reader::known`].
    base: usize,
    unit: u8,
    /// An odd number of modules is around the scope. Putting one into another turns the order of the cells round.
    backwards: bool,
}

struct Reader<'n, 'v> {
    /// The top module's ports.
    view: &'v View,
    /// Where the bits of each input begin in [`Words::inputs`].
    inputs: Vec<usize>,
    /// By instance of a top module that is seen without its instances: where the bits of each output begin there.
    instances: Vec<Vec<usize>>,
    scopes: Vec<Scope<'n>>,
    words: Words,
    /// By node: where its bits stand among the operands.
    known: Vec<Option<Range<usize>>>,
    same: QuickMap<(Op, Vec<Bit>), Bit>,
    registers: Vec<(usize, usize)>,
    memories: QuickMap<(usize, usize), usize>,
    /// Read ports of memories that somebody reads: scope, memory, port.
    waiting: Vec<(usize, usize, usize)>,
}

impl Words {
    /// Of the module, seen so.
    pub fn of(netlist: &Netlist, view: &View) -> Words {
        let mut reader = Reader {
            view,
            inputs: Vec::new(),
            instances: Vec::new(),
            scopes: Vec::new(),
            words: Words {
                bits: 2,
                units: vec![netlist.name.clone()],
                family: view.family,
                ..Words::default()
            },
            known: Vec::new(),
            same: QuickMap::default(),
            registers: Vec::new(),
            memories: QuickMap::default(),
            waiting: Vec::new(),
        };
        reader.number_inputs(netlist);
        reader.scope(netlist, None, 0);
        reader.outputs(netlist);
        reader.state();
        reader.words.count_users();
        reader.words.find_choices();
        reader.words
    }

    /// The bits there.
    pub fn at(&self, place: &Range<usize>) -> &[Bit] {
        &self.operands[place.clone()]
    }

    /// A number for what is computed, the same wherever the program runs.
    pub fn shape(&self) -> u64 {
        let mut hash = Quick::default();
        for cell in &self.cells {
            cell.op.hash(&mut hash);
            (cell.first, cell.width).hash(&mut hash);
            cell.operands.iter().for_each(|place| self.at(place).hash(&mut hash));
        }
        for register in &self.registers {
            (register.first, register.width, register.reset).hash(&mut hash);
            for (when, value) in &register.updates {
                (when, self.at(value)).hash(&mut hash);
            }
        }
        for memory in &self.memories {
            (memory.words, memory.width, &memory.rom).hash(&mut hash);
            for (enable, address, data) in &memory.writes {
                (enable, self.at(address), self.at(data)).hash(&mut hash);
            }
            for (enable, address, first) in &memory.reads {
                (enable, self.at(address), first).hash(&mut hash);
            }
        }
        self.outputs.hash(&mut hash);
        hash.finish()
    }

    fn find_choices(&mut self) {
        (self.chosen, self.bitwise) = (vec![false; self.bits], vec![false; self.bits]);
        for cell in &self.cells {
            let bits = cell.first as usize..cell.first as usize + cell.width;
            self.chosen[bits.clone()].fill(cell.op == Op::Mux);
            self.bitwise[bits].fill(matches!(cell.op, Op::Mux | Op::And | Op::Or | Op::Xor | Op::Not));
        }
    }

    fn count_users(&mut self) {
        let mut users = vec![0u32; self.bits];
        let mut read = |bits: &[Bit]| bits.iter().for_each(|bit| users[*bit as usize] += 1);
        for cell in &self.cells {
            cell.operands.iter().for_each(|place| read(self.at(place)));
        }
        for register in &self.registers {
            for (when, value) in &register.updates {
                read(when.as_slice());
                read(self.at(value));
            }
        }
        for memory in &self.memories {
            for (enable, address, data) in &memory.writes {
                read(&[*enable]);
                read(self.at(address));
                read(self.at(data));
            }
            for (enable, address, _) in &memory.reads {
                read(&[*enable]);
                read(self.at(address));
            }
        }
        read(&self.outputs);
        self.users = users;
    }
}

impl<'n> Reader<'n, '_> {
    fn number_inputs(&mut self, netlist: &Netlist) {
        let mut count = 0;
        let mut place = |width: u32| {
            count += width as usize;
            count - width as usize
        };
        self.inputs = netlist.inputs.iter().map(|input| place(netlist.width(input.node))).collect();
        if self.view.outside {
            self.instances = netlist
                .instances
                .iter()
                .map(|of| of.module.outputs.iter().map(|out| place(of.module.width(out.driver))).collect())
                .collect();
        }
        self.words.inputs = vec![UNREAD; count];
    }

    /// Outputs that somebody reads, and behind them what instances that are not looked into read.
    fn outputs(&mut self, netlist: &'n Netlist) {
        let outside = netlist.instances.iter().take(if self.view.outside { usize::MAX } else { 0 });
        let drivers = netlist.outputs.iter().map(|output| output.driver);
        let mut place = 0;
        for driver in drivers.chain(outside.flat_map(|instance| instance.connections.iter().copied())) {
            let width = netlist.width(driver) as usize;
            if (place..place + width).any(|bit| self.view.readers(bit) > 0) {
                let bits = self.read(0, driver);
                for (at, bit) in bits.enumerate() {
                    let bit = self.words.operands[bit];
                    for _ in 0..self.view.readers(place + at) {
                        self.words.outputs.push(bit);
                        self.words.wanted.push((place + at) as u32);
                    }
                }
            }
            place += width;
        }
    }

    /// The bits of an input, or of an output of an instance that is not looked into.
    fn given(&mut self, first: usize, width: usize) -> Range<usize> {
        let bits: Vec<Bit> = (first..first + width).map(|place| self.given_bit(place)).collect();
        self.keep(&bits)
    }

    fn given_bit(&mut self, place: usize) -> Bit {
        if self.words.inputs[place] == UNREAD {
            self.words.inputs[place] = match self.view.seen(place) {
                Seen::Constant(value) => Bit::from(value),
                Seen::Same(other) => self.given_bit(other as usize),
                Seen::Own => {
                    self.words.bits += 1;
                    self.words.bits as Bit - 1
                }
            };
        }
        self.words.inputs[place]
    }

    fn scope(&mut self, netlist: &'n Netlist, parent: Option<(usize, usize)>, unit: u8) -> usize {
        let index = self.scopes.len();
        let base = self.known.len();
        self.known.resize(base + netlist.nodes.len(), None);
        let backwards = match parent {
            Some((around, _)) => !self.scopes[around].backwards,
            None => self.view.inside,
        };
        self.scopes.push(Scope { netlist, parent, children: Vec::new(), base, unit, backwards });
        if self.view.outside {
            return index;
        }
        for (place, instance) in netlist.instances.iter().enumerate() {
            let unit = if parent.is_none() {
                self.words.units.push(instance.name.trim_start_matches("u_").to_owned());
                u8::try_from(self.words.units.len() - 1).unwrap_or(u8::MAX)
            } else {
                unit
            };
            let child = self.scope(&instance.module, Some((index, place)), unit);
            self.scopes[index].children.push(child);
        }
        index
    }

    /// Where the bits of a node stand; a first reader makes them.
    fn read(&mut self, scope: usize, node: NodeId) -> Range<usize> {
        let slot = self.scopes[scope].base + node.index();
        if let Some(known) = &self.known[slot] {
            return known.clone();
        }
        let place = self.made(scope, node);
        self.known[slot] = Some(place.clone());
        place
    }

    fn made(&mut self, scope: usize, node: NodeId) -> Range<usize> {
        let netlist = self.scopes[scope].netlist;
        let width = netlist.width(node) as usize;
        match &netlist.node(node).source {
            Source::Input(port) => match self.scopes[scope].parent {
                Some((parent, instance)) => {
                    let driver = self.scopes[parent].netlist.instances[instance].connections[*port];
                    self.read(parent, driver)
                }
                None => self.given(self.inputs[*port], width),
            },
            Source::Constant { value, .. } => {
                let bits: Vec<Bit> = (0..width).map(|bit| (value >> bit & 1) as Bit).collect();
                self.keep(&bits)
            }
            Source::Wire(wire) => self.read(scope, netlist.wires[*wire].driver),
            Source::Register(register) => {
                self.registers.push((scope, *register));
                self.fresh(width)
            }
            Source::MemoryRead { memory, port } => {
                self.waiting.push((scope, *memory, *port));
                self.fresh(width)
            }
            Source::InstanceOutput { instance, output } if self.view.outside => {
                self.given(self.instances[*instance][*output], width)
            }
            Source::InstanceOutput { instance, output } => {
                let driver = netlist.instances[*instance].module.outputs[*output].driver;
                let child = self.scopes[scope].children[*instance];
                self.read(child, driver)
            }
            Source::Op(op, operands) => {
                let operands: Vec<Range<usize>> = operands.iter().map(|id| self.read(scope, *id)).collect();
                match self.wiring(*op, &operands, width) {
                    Some(bits) => self.keep(&bits),
                    None => self.cell(*op, operands, width, scope),
                }
            }
        }
    }

    fn keep(&mut self, bits: &[Bit]) -> Range<usize> {
        let start = self.words.operands.len();
        self.words.operands.extend_from_slice(bits);
        start..start + bits.len()
    }

    fn fresh(&mut self, width: usize) -> Range<usize> {
        let start = self.words.operands.len();
        let first = self.words.bits;
        self.words.operands.extend((first..first + width).map(|bit| bit as Bit));
        self.words.bits += width;
        start..start + width
    }

    /// The bits of an operator that only moves them.
    fn wiring(&self, op: Op, operands: &[Range<usize>], width: usize) -> Option<Vec<Bit>> {
        let a = &self.words.operands[operands[0].clone()];
        let sign = *a.last()?;
        let filled = |from: usize, fill: Bit| -> Vec<Bit> {
            (0..width).map(|bit| a.get(bit + from).copied().unwrap_or(fill)).collect()
        };
        Some(match op {
            Op::Slice { lo, .. } => a[lo as usize..lo as usize + width].to_vec(),
            Op::ZeroExtend(_) => filled(0, ZERO),
            Op::SignExtend(_) => filled(0, sign),
            Op::Shr(n) => filled(n as usize, ZERO),
            Op::Sar(n) => filled(n as usize, sign),
            Op::Shl(n) => {
                (0..width).map(|bit| if bit < n as usize { ZERO } else { a[bit - n as usize] }).collect()
            }
            Op::Concat => {
                operands.iter().rev().flat_map(|place| &self.words.operands[place.clone()]).copied().collect()
            }
            _ => return None,
        })
    }

    fn cell(&mut self, op: Op, operands: Vec<Range<usize>>, width: usize, scope: usize) -> Range<usize> {
        let mut key: Vec<Bit> = Vec::new();
        for place in &operands {
            key.extend_from_slice(&self.words.operands[place.clone()]);
            key.push(Bit::MAX);
        }
        let key = (op, key);
        if let Some(first) = self.same.get(&key) {
            let bits: Vec<Bit> = (*first..*first + width as Bit).collect();
            return self.keep(&bits);
        }
        let place = self.fresh(width);
        let first = self.words.operands[place.start];
        self.same.insert(key, first);
        let Scope { unit, backwards, .. } = self.scopes[scope];
        self.words.cells.push(Cell { op, operands, first, width, unit, backwards });
        place
    }

    /// Registers and memories that somebody reads, and what these read in turn.
    fn state(&mut self) {
        let mut done = 0;
        loop {
            if let Some((scope, register)) = self.registers.get(done).copied() {
                done += 1;
                self.register(scope, register);
            } else if let Some((scope, memory, port)) = self.waiting.pop() {
                self.memory_read(scope, memory, port);
            } else {
                return;
            }
        }
    }

    fn register(&mut self, scope: usize, index: usize) {
        let netlist = self.scopes[scope].netlist;
        let register = &netlist.registers[index];
        let place = self.read(scope, register.node);
        let first = self.words.operands[place.start];
        let mut updates = Vec::new();
        for update in &register.updates {
            let when = update.when.map(|when| self.bit(scope, when));
            updates.push((when, self.read(scope, update.value)));
        }
        let unit = self.scopes[scope].unit;
        self.words.registers.push(Register {
            first,
            width: place.len(),
            reset: register.reset,
            updates,
            unit,
        });
    }

    /// A read port that somebody reads; with the first of them its memory and all that is written there.
    fn memory_read(&mut self, scope: usize, index: usize, port: usize) {
        let memory = &self.scopes[scope].netlist.memories[index];
        let place = match self.memories.get(&(scope, index)) {
            Some(place) => *place,
            None => {
                let place = self.words.memories.len();
                self.memories.insert((scope, index), place);
                let (words, width, unit) = (memory.words, memory.width as usize, self.scopes[scope].unit);
                let word = |address| memory.contents.word(memory.width, address);
                let rom = memory.writes.is_empty().then(|| (0..words).map(word).collect());
                self.words.memories.push(Memory {
                    words,
                    width,
                    rom,
                    writes: Vec::new(),
                    reads: Vec::new(),
                    unit,
                });
                for port in &memory.writes {
                    let enable = self.bit(scope, port.en);
                    let (address, data) = (self.read(scope, port.addr), self.read(scope, port.data));
                    self.words.memories[place].writes.push((enable, address, data));
                }
                place
            }
        };
        let port = &memory.reads[port];
        let (enable, first) = (self.bit(scope, port.en), self.bit(scope, port.node));
        let address = self.read(scope, port.addr);
        self.words.memories[place].reads.push((enable, address, first));
    }

    /// The lowest bit of a node.
    fn bit(&mut self, scope: usize, node: NodeId) -> Bit {
        let place = self.read(scope, node);
        self.words.operands[place.start]
    }
}
