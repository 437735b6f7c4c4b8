//! TERM.

use super::link::{Giver, Scope, Taker};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::device::terms::TermSpan;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::term::Term;
use edgewalk_model::tokens::Span;
use edgewalk_model::{Events, TermInputs};

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
    /// `read` and `data`: the links.
    pub fn find(scope: Scope, read: &str, data: &str) -> Result<Self, NoPlace> {
        WordPorts::of(scope, read, data, "word")
    }

    /// The same of a word that is called otherwise.
    pub fn of(scope: Scope, read: &str, data: &str, word: &str) -> Result<Self, NoPlace> {
        let port = |link: &str, part: &str| scope.port(&format!("{link}_{part}"));
        Ok(WordPorts {
            read_valid: port(read, "valid")?,
            read_ready: port(read, "ready")?,
            read_addr: port(read, "addr")?,
            data_valid: port(data, "valid")?,
            data_ready: port(data, "ready")?,
            word: port(data, word)?,
        })
    }

    /// The memory takes a read; the word that it offers.
    pub fn inputs(&self, ports: &PortValues) -> (bool, Option<u128>) {
        (ports.is_high(self.read_ready), ports.is_high(self.data_valid).then(|| ports[self.word]))
    }

    /// The same as TERM sees it.
    pub fn term_inputs(&self, ports: &PortValues) -> TermInputs {
        let (trd_ready, word) = self.inputs(ports);
        TermInputs { trd_ready, tdata: word.map(|word| word as u64) } // at most 64 bits
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
            memory: WordPorts::find(scope, "trd", "tdata")?,
            shown: TermPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for TermDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (span, inputs) = (self.span.token(ports), self.memory.term_inputs(ports));
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
