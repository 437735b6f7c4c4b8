//! SHADE.

use super::link::{Giver, Scope, Taker};
use super::term::WordPorts;
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::shade::Shade;
use edgewalk_model::tokens::Fragment;
use edgewalk_model::{Events, Given, Lit};

/// What SHADE shows of itself, beside the ports of its memory.
pub struct ShadePorts<const C: usize> {
    frag_ready: PortId,
    tinted: Giver<Fragment<C>>,
    table_wait: PortId,
    occupied: PortId,
}

impl<const C: usize> ShadePorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(ShadePorts {
            frag_ready: scope.port("frag_ready")?,
            tinted: scope.giver("tinted")?,
            table_wait: scope.port("table_wait")?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show(&self, shade: &Shade<C>, frag: Option<Given<C>>, tinted_ready: bool, ports: &mut PortValues) {
        ports.set(self.frag_ready, shade.frag_ready(frag, tinted_ready));
        self.tinted.offer(shade.tinted(), ports);
        ports.set(self.table_wait, shade.waits(frag));
        ports.set(self.occupied, shade.occupied());
    }
}

/// SHADE alone.
pub struct ShadeDevice<const C: usize> {
    unit: Shade<C>,
    events: Events,
    frag: Taker<Lit<C>>,
    memory: WordPorts,
    shown: ShadePorts<C>,
}

impl<const C: usize> ShadeDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(ShadeDevice {
            unit: Shade::new(plan),
            events: Events::default(),
            frag: scope.taker("frag")?,
            memory: WordPorts::alone(scope)?,
            shown: ShadePorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for ShadeDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (token, inputs) = (self.frag.token(ports), self.memory.inputs(ports));
        let frag = token.as_ref().map(Lit::given);
        let ready = ports.is_high(self.shown.tinted.ready);
        self.memory.show(self.unit.read(), self.unit.sdata_ready(), ports);
        self.shown.show(&self.unit, frag, ready, ports);
        self.unit.step(frag, &inputs, ready, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for ShadeDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
