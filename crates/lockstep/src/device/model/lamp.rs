//! LAMP.

use super::link::{Giver, Scope, Taker};
use super::normal::inputs;
use super::term::WordPorts;
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::device::terms::TermFragment;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::Events;
use edgewalk_model::lamp::Lamp;
use edgewalk_model::shade::Cosines;
use edgewalk_model::tokens::Fragment;

/// What LAMP shows of itself, beside the ports of its memory.
pub struct LampPorts<const C: usize> {
    frag_ready: PortId,
    normed: Giver<TermFragment<C>>,
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

    pub fn show(
        &self,
        lamp: &Lamp<C>,
        frag: Option<&Fragment<C>>,
        normed_ready: bool,
        ports: &mut PortValues,
    ) {
        ports.set(self.frag_ready, lamp.frag_ready(normed_ready));
        let normed =
            lamp.normed().map(|(fragment, cosines)| TermFragment { fragment: *fragment, cosines: *cosines });
        self.normed.offer(normed.as_ref(), ports);
        ports.set(self.table_wait, lamp.waits(frag));
        ports.set(self.working, lamp.working());
        ports.set(self.occupied, lamp.occupied());
    }
}

/// LAMP alone.
pub struct LampDevice<const C: usize> {
    unit: Lamp<C>,
    events: Events,
    frag: Taker<TermFragment<C>>,
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
            memory: WordPorts::find(scope, "rrd", "rdata")?,
            shown: LampPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for LampDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (token, inputs) = (self.frag.token(ports), inputs(&self.memory, ports));
        let frag = token.as_ref().map(|token| &token.fragment);
        let terms = token.as_ref().map_or_else(Cosines::default, |token| token.cosines);
        let ready = ports.is_high(self.shown.normed.ready);
        self.memory.show(self.unit.read(), self.unit.rdata_ready(), ports);
        self.shown.show(&self.unit, frag, ready, ports);
        self.unit.step(frag, &terms, &inputs, ready, &mut self.events);
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
