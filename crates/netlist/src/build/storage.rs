//! Registers and memories: what keeps a value over the clock.

use super::module::Module;
use super::operand::Operand;
use super::signal::Signal;
use crate::error::Fault;
use crate::netlist::{self, Item, MemoryRead, MemoryWrite, Row, Source, Update};

/// A register under construction. At the clock it takes its reset value if it has one and `rst` is 1; else the value of
/// the last update whose condition holds; else it stays.
#[derive(Clone, Copy, Debug)]
pub struct Reg<'m> {
    q: Signal<'m>,
    index: usize,
}

impl<'m> Reg<'m> {
    #[track_caller]
    pub(super) fn new(module: &'m Module, name: &str, width: u32) -> Self {
        let width = module.checked_width(name, width);
        let index = module.draft().netlist.registers.len();
        let q = module.node(width, Source::Register(index));
        module.declare(name, Some(q.id));
        let register = netlist::Register {
            name: name.to_string(),
            doc: String::new(),
            node: q.id,
            reset: None,
            starts_at_zero: false,
            updates: Vec::new(),
        };
        module.draft().netlist.registers.push(register);
        module.item(Item::Register(index));
        Reg { q, index }
    }

    /// The register's value.
    pub fn q(self) -> Signal<'m> {
        self.q
    }

    /// Documents format and unit.
    pub fn doc(self, doc: &str) -> Self {
        self.q.module.draft().netlist.registers[self.index].doc = doc.to_string();
        self
    }

    /// Gives it a synchronous reset to `value`.
    #[track_caller]
    pub fn reset(self, value: u128) -> Self {
        let value = self.q.module.checked_value(self.q.width, value);
        self.q.module.draft().netlist.registers[self.index].reset = Some(value);
        self
    }

    /// The register is 0 before the first clock, when a memory has its first contents. So is whatever decides whether a
    /// word of such a memory is written.
    pub fn starts_at_zero(self) -> Self {
        self.q.module.draft().netlist.registers[self.index].starts_at_zero = true;
        self
    }

    /// Takes `value` at the clock where `condition`, one bit, is 1. Of several the later call wins.
    #[track_caller]
    pub fn when(self, condition: Signal<'m>, value: impl Operand<'m>) -> Self {
        let condition = self.q.module.fitted(&format!("condition of {}", self.q.describe()), 1, condition);
        self.update(Some(condition), value)
    }

    /// Takes `value` at every clock. Later calls of [`Reg::when`] win over it.
    #[track_caller]
    pub fn set(self, value: impl Operand<'m>) -> Self {
        self.update(None, value)
    }

    #[track_caller]
    fn update(self, when: Option<Signal<'m>>, value: impl Operand<'m>) -> Self {
        let value = self.q.module.fitted(&self.q.describe(), self.q.width, value).id;
        let netlist = &mut self.q.module.draft().netlist;
        netlist.registers[self.index].updates.push(Update { when: when.map(|signal| signal.id), value });
        netlist.items.retain(|item| *item != Item::Update(self.index));
        netlist.items.push(Item::Update(self.index));
        self
    }
}

/// A memory under construction: words, write ports, and read ports with a registered output.
#[derive(Clone, Copy, Debug)]
pub struct Memory<'m> {
    module: &'m Module,
    index: usize,
}

impl<'m> Memory<'m> {
    #[track_caller]
    pub(super) fn new(module: &'m Module, name: &str, mut memory: netlist::Memory) -> Self {
        memory.addr_bits = module.checked_width(name, memory.addr_bits);
        memory.width = module.checked_width(name, memory.width);
        let enough = memory.words.saturating_sub(1).checked_ilog2().map_or(0, |top| top + 1);
        if enough != memory.addr_bits {
            let (words, addr_bits) = (memory.words, memory.addr_bits);
            module.fail(Fault::MemorySize { name: name.to_string(), words, addr_bits });
        }
        module.declare(name, None);
        let index = module.draft().netlist.memories.len();
        module.draft().netlist.memories.push(memory);
        module.item(Item::Memory(index));
        Memory { module, index }
    }

    /// What a word is.
    pub fn doc(self, doc: &str) -> Self {
        self.module.draft().netlist.memories[self.index].doc = doc.to_string();
        self
    }

    /// Every word at the start, but for those that [`Memory::holds`] gives. A reset does not bring them back.
    #[track_caller]
    pub fn starts(self, word: u128) -> Self {
        let (_, _, width) = self.shape();
        let word = self.module.checked_value(width, word);
        self.module.draft().netlist.memories[self.index].contents.others = Some(word);
        self
    }

    /// Word `address` at the start, and what it is (or nothing). A memory that is given all its words and no write port is a ROM.
    /// A reset does not bring them back.
    #[track_caller]
    pub fn holds(self, address: usize, word: u128, doc: &str) -> Self {
        let (name, _, width) = self.shape();
        let word = self.module.checked_value(width, word);
        let words = self.module.draft().netlist.memories[self.index].words;
        if address >= words {
            self.module.fail(Fault::NoWord { name, words, address });
            return self;
        }
        let row = Row { word, doc: doc.to_string() };
        let before = self.module.draft().netlist.memories[self.index].contents.rows.insert(address, row);
        if before.is_some() {
            self.module.fail(Fault::WordTwice { name, address });
        }
        self
    }

    /// A write port: at the clock, where `en` is 1, word `addr` := `data`. Of two ports the later wins.
    #[track_caller]
    pub fn write(self, en: Signal<'m>, addr: Signal<'m>, data: impl Operand<'m>) -> Self {
        let (name, addr_bits, width) = self.shape();
        let en = self.module.fitted(&format!("{name} write enable"), 1, en).id;
        let addr = self.module.fitted(&format!("{name} write address"), addr_bits, addr).id;
        let data = self.module.fitted(&format!("{name} write data"), width, data).id;
        let port = self.module.draft().netlist.memories[self.index].writes.len();
        self.module.draft().netlist.memories[self.index].writes.push(MemoryWrite { en, addr, data });
        self.module.item(Item::MemoryWrite { memory: self.index, port });
        self
    }

    /// A read port: at the clock, where `en` is 1, the output takes word `addr` as it was before any write of the same
    /// clock; else it holds. The output is called `<memory>_q`, that of a second port `<memory>_q2` and so on.
    #[track_caller]
    pub fn read(self, en: Signal<'m>, addr: Signal<'m>) -> Signal<'m> {
        let (name, addr_bits, width) = self.shape();
        let en = self.module.fitted(&format!("{name} read enable"), 1, en).id;
        let addr = self.module.fitted(&format!("{name} read address"), addr_bits, addr).id;
        let port = self.module.draft().netlist.memories[self.index].reads.len();
        let name = if port == 0 { format!("{name}_q") } else { format!("{name}_q{}", port + 1) };
        let node = self.module.node(width, Source::MemoryRead { memory: self.index, port });
        self.module.declare(&name, Some(node.id));
        let read = MemoryRead { name, en, addr, node: node.id };
        self.module.draft().netlist.memories[self.index].reads.push(read);
        self.module.item(Item::MemoryRead { memory: self.index, port });
        node
    }

    fn shape(self) -> (String, u32, u32) {
        let memory = &self.module.draft().netlist.memories[self.index];
        (memory.name.clone(), memory.addr_bits, memory.width)
    }
}
