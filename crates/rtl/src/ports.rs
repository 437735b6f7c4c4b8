//! The ports of a unit as `machine` declares them: names, widths and docs come from the declaration, a method a kind of port.
//!
//! ```text
//!  takes, held_in, memory, gives_ready, constant, level ─> [unit] ─> take_ready, give, hold, read, status
//! ```

use edgewalk_machine::{Field, Link, MemoryPort, Ports};
use edgewalk_netlist::{Module, Operand, Signal};

use crate::wires::{Token, parts};

/// The ports of a unit on a module: on its own, or, for those that lead out of the machine, on that of the machine.
pub(crate) struct Interface<'m> {
    m: &'m Module,
    pub ports: Ports,
}

/// What comes from a memory.
pub(crate) struct FromMemory<'m> {
    /// An address is taken.
    pub read_ready: Signal<'m>,
    /// A word is there.
    pub data_valid: Signal<'m>,
    pub data: Token<'m>,
}

impl<'m> Interface<'m> {
    /// None of them is made yet.
    pub fn new(m: &'m Module, ports: Ports) -> Interface<'m> {
        Interface { m, ports }
    }

    /// Valid and token of the link it takes from.
    pub fn takes(&self) -> (Signal<'m>, Token<'m>) {
        let link = self.takes_link();
        let valid = self.m.input(&format!("{}_valid", link.name), 1);
        (valid, Token::inputs(self.m, link.name, parts(&link.fields)))
    }

    /// Values held beside the tokens it takes.
    pub fn held_in(&self, name: &str) -> Token<'m> {
        let held = declared(self.ports.held_in.iter().find(|held| held.name == name), name);
        Token::inputs(self.m, held.name, parts(&held.fields))
    }

    /// What comes from a memory behind it.
    pub fn memory(&self, name: &str) -> FromMemory<'m> {
        let MemoryPort { read, data, .. } = self.memory_port(name);
        FromMemory {
            read_ready: self.m.input(&format!("{}_ready", read.name), 1),
            data_valid: self.m.input(&format!("{}_valid", data.name), 1),
            data: Token::inputs(self.m, data.name, parts(&data.fields)),
        }
    }

    /// Ready of the link it gives to.
    pub fn gives_ready(&self) -> Signal<'m> {
        let link = self.gives_link();
        self.m.input(&format!("{}_ready", link.name), 1)
    }

    /// Ready of another link that leads to a memory.
    pub fn writes_ready(&self, name: &str) -> Signal<'m> {
        self.m.input(&format!("{}_ready", self.writes_link(name).name), 1)
    }

    /// An input that holds one value over a run.
    pub fn constant(&self, name: &str) -> Signal<'m> {
        self.input(declared(self.ports.constants.iter().find(|field| field.name == name), name))
    }

    /// An input that may change in any cycle.
    pub fn level(&self, name: &str) -> Signal<'m> {
        self.input(declared(self.ports.levels.iter().find(|field| field.name == name), name))
    }

    /// The link it takes from.
    pub fn takes_link(&self) -> &Link {
        declared(self.ports.takes.as_ref(), "a link to take from")
    }

    /// The link it gives to.
    pub fn gives_link(&self) -> &Link {
        declared(self.ports.gives.as_ref(), "a link to give to")
    }

    fn writes_link(&self, name: &str) -> &Link {
        declared(self.ports.writes.iter().find(|link| link.name == name), name)
    }

    /// A memory behind it.
    pub fn memory_port(&self, name: &str) -> &MemoryPort {
        declared(self.ports.memory.iter().find(|memory| memory.name == name), name)
    }

    /// Ready of the link it takes from.
    pub fn take_ready(&self, ready: impl Operand<'m>) {
        let link = self.takes_link();
        self.m.output(&format!("{}_ready", link.name), ready);
    }

    /// Address for a memory, and ready for its words.
    pub fn read(&self, name: &str, valid: Signal<'m>, address: Signal<'m>, data_ready: Signal<'m>) {
        let MemoryPort { read, data, .. } = self.memory_port(name);
        self.m.output(&format!("{}_valid", read.name), valid);
        Token::new(parts(&read.fields), |_| address).output(self.m, read.name);
        self.m.output(&format!("{}_ready", data.name), data_ready);
    }

    /// Valid and token of the link it gives to.
    pub fn give(&self, valid: impl Operand<'m>, field: impl Fn(&str) -> Signal<'m>) {
        let link = self.gives_link();
        self.m.output(&format!("{}_valid", link.name), valid);
        Token::new(parts(&link.fields), field).output(self.m, link.name);
    }

    /// Like `give`, of another link that leads to a memory.
    pub fn write(&self, name: &str, valid: impl Operand<'m>, field: impl Fn(&str) -> Signal<'m>) {
        let link = self.writes_link(name);
        self.m.output(&format!("{}_valid", link.name), valid);
        Token::new(parts(&link.fields), field).output(self.m, link.name);
    }

    /// Values held beside the tokens it gives.
    pub fn hold(&self, name: &str, field: impl Fn(&str) -> Signal<'m>) {
        let held = declared(self.ports.held_out.iter().find(|held| held.name == name), name);
        Token::new(parts(&held.fields), field).output(self.m, held.name);
    }

    /// An output that means something in every cycle.
    pub fn status(&self, name: &str, signal: impl Operand<'m>) {
        let status = declared(self.ports.status.iter().find(|status| status.field.name == name), name);
        self.m.output_doc(name, signal, &status.meaning());
    }

    fn input(&self, field: &Field) -> Signal<'m> {
        self.m.input_doc(&field.name, field.width(), &field.to_string())
    }
}

/// What a unit asks of its own declaration depends on no input.
fn declared<'a, T>(found: Option<&'a T>, what: &str) -> &'a T {
    found.unwrap_or_else(|| panic!("a unit asks for a port that it does not declare: {what}"))
}
