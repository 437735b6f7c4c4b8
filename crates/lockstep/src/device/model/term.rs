//! TERM.

use super::link::{Giver, Scope, Taker};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::device::terms::TermSpan;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::{MemoryPort, Plan};
use edgewalk_model::term::Term;
use edgewalk_model::tokens::Span;
use edgewalk_model::{Events, WordIn};

/// What TERM shows of itself, beside the ports of its memory. `pixel_ready`: PIXEL takes a span.
pub struct TermPorts<const C: usize> {
    span_ready: PortId,
    walked: Giver<TermSpan<C>>,
    term_wait: PortId,
}

impl<const C: usize> TermPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(TermPorts {
            span_ready: scope.port("span_ready")?,
            walked: scope.giver("walked")?,
            term_wait: scope.port("term_wait")?,
        })
    }

    pub fn show(&self, term: &Term, span: Option<&Span<C>>, pixel_ready: bool, ports: &mut PortValues) {
        let there = term.there(span);
        ports.set(self.span_ready, there && pixel_ready);
        let walked = span.filter(|_| there).map(|span| TermSpan { span: *span, walked: term.walked() });
        self.walked.offer(walked.as_ref(), ports);
        ports.set(self.term_wait, term.waits(span));
    }
}

/// The links to a memory that is only read: ports of a unit that are those of the machine as well.
pub struct WordPorts {
    read_valid: PortId,
    read_ready: PortId,
    read_addr: PortId,
    data_valid: PortId,
    data_ready: PortId,
    word: PortId,
}

impl WordPorts {
    /// The ports of a memory that the host alone writes, by its declaration.
    pub fn find(scope: Scope, memory: &MemoryPort) -> Result<Self, NoPlace> {
        let port = |link: &str, part: &str| scope.port(&format!("{link}_{part}"));
        let (read, data) = (memory.read.name, memory.data.name);
        Ok(WordPorts {
            read_valid: port(read, "valid")?,
            read_ready: port(read, "ready")?,
            read_addr: port(read, "addr")?,
            data_valid: port(data, "valid")?,
            data_ready: port(data, "ready")?,
            word: port(data, &memory.data.fields[0].name)?,
        })
    }

    /// The ports of the memory of a unit alone.
    pub fn alone(scope: Scope) -> Result<Self, NoPlace> {
        let memories = scope.plan.word_memories();
        let own = memories.iter().find(|(unit, _)| *unit == scope.owner);
        let (_, memory) = own.ok_or_else(|| NoPlace::Unit(scope.owner.to_owned()))?;
        WordPorts::find(scope, memory)
    }

    /// The memory takes a read; the word that it offers.
    pub fn inputs(&self, ports: &PortValues) -> WordIn {
        let word = ports.is_high(self.data_valid).then(|| ports[self.word]);
        WordIn { ready: ports.is_high(self.read_ready), word }
    }

    pub fn show(&self, read: Option<u32>, data_ready: bool, ports: &mut PortValues) {
        ports.set(self.read_valid, read.is_some());
        ports[self.read_addr] = read.unwrap_or(0).into();
        ports.set(self.data_ready, data_ready);
    }
}

/// TERM alone.
pub struct TermDevice<const C: usize> {
    unit: Term,
    events: Events,
    span: Taker<Span<C>>,
    record: PortId,
    memory: WordPorts,
    shown: TermPorts<C>,
}

impl<const C: usize> TermDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(TermDevice {
            unit: Term::new(plan),
            events: Events::default(),
            span: scope.taker("span")?,
            record: scope.port("inc_record")?,
            memory: WordPorts::alone(scope)?,
            shown: TermPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for TermDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (span, inputs) = (self.span.token(ports), self.memory.inputs(ports));
        let ready = ports.is_high(self.shown.walked.ready);
        let record = ports[self.record] as u32; // at most 20 bits
        self.memory.show(self.unit.read(record), self.unit.tdata_ready(), ports);
        self.shown.show(&self.unit, span.as_ref(), ready, ports);
        let taken = ready && self.unit.there(span.as_ref());
        self.unit.step(span.as_ref(), &inputs, taken, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for TermDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
