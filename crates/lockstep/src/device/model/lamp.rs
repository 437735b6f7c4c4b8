//! LAMP.

use super::link::{Giver, Scope, Taker};
use super::term::WordPorts;
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::lamp::Lamp;
use edgewalk_model::{Events, Given, Lit};

/// What LAMP shows of itself, beside the ports of its memory.
pub struct LampPorts<const C: usize> {
    frag_ready: PortId,
    normed: Giver<Lit<C>>,
    table_wait: PortId,
    working: PortId,
    occupied: PortId,
}

impl<const C: usize> LampPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(LampPorts {
            frag_ready: scope.port("frag_ready")?,
            normed: scope.giver("normed")?,
            table_wait: scope.port("table_wait")?,
            working: scope.port("working")?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show(&self, lamp: &Lamp<C>, frag: Option<Given<C>>, normed_ready: bool, ports: &mut PortValues) {
        ports.set(self.frag_ready, lamp.frag_ready(normed_ready));
        self.normed.offer(lamp.normed(), ports);
        ports.set(self.table_wait, lamp.waits(frag));
        ports.set(self.working, lamp.working());
        ports.set(self.occupied, lamp.occupied());
    }
}

/// LAMP alone.
pub struct LampDevice<const C: usize> {
    unit: Lamp<C>,
    events: Events,
    frag: Taker<Lit<C>>,
    memory: WordPorts,
    shown: LampPorts<C>,
}

impl<const C: usize> LampDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(LampDevice {
            unit: Lamp::new(plan),
            events: Events::default(),
            frag: scope.taker("frag")?,
            memory: WordPorts::alone(scope)?,
            shown: LampPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for LampDevice<C> {
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

impl<const C: usize> ModelDevice for LampDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
