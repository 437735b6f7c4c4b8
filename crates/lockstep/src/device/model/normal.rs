//! NORMAL.

use super::link::{Giver, Scope, Taker};
use super::term::WordPorts;
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::normal::Normal;
use edgewalk_model::{Events, Given, Lit};

/// What NORMAL shows of itself, beside the ports of its memory.
pub struct NormalPorts<const C: usize> {
    frag_ready: PortId,
    normed: Giver<Lit<C>>,
    table_wait: PortId,
    occupied: PortId,
}

impl<const C: usize> NormalPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(NormalPorts {
            frag_ready: scope.port("frag_ready")?,
            normed: scope.giver("normed")?,
            table_wait: scope.port("table_wait")?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show(
        &self,
        normal: &Normal<C>,
        frag: Option<Given<C>>,
        normed_ready: bool,
        ports: &mut PortValues,
    ) {
        ports.set(self.frag_ready, normal.frag_ready(normed_ready));
        self.normed.offer(normal.normed(), ports);
        ports.set(self.table_wait, normal.waits(frag));
        ports.set(self.occupied, normal.occupied());
    }
}

/// NORMAL alone.
pub struct NormalDevice<const C: usize> {
    unit: Normal<C>,
    events: Events,
    frag: Taker<Lit<C>>,
    memory: WordPorts,
    shown: NormalPorts<C>,
}

impl<const C: usize> NormalDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(NormalDevice {
            unit: Normal::new(plan),
            events: Events::default(),
            frag: scope.taker("frag")?,
            memory: WordPorts::alone(scope)?,
            shown: NormalPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for NormalDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (token, inputs) = (self.frag.token(ports), self.memory.inputs(ports));
        let frag = token.as_ref().map(Lit::given);
        let ready = ports.is_high(self.shown.normed.ready);
        self.memory.show(self.unit.read(), self.unit.rdata_ready(), ports);
        self.shown.show(&self.unit, frag, ready, ports);
        self.unit.step(frag, &inputs, ready, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for NormalDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
