//! BUMP.

use super::link::{Giver, Scope, Taker};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::bump::Bump;
use edgewalk_model::{Events, Lit};

/// What BUMP shows of itself.
pub struct BumpPorts<const C: usize> {
    frag_ready: PortId,
    bumped: Giver<Lit<C>>,
    occupied: PortId,
}

impl<const C: usize> BumpPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(BumpPorts {
            frag_ready: scope.port("frag_ready")?,
            bumped: scope.giver("bumped")?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show(&self, bump: &Bump<C>, bumped_ready: bool, ports: &mut PortValues) {
        ports.set(self.frag_ready, bump.frag_ready(bumped_ready));
        self.bumped.offer(bump.bumped(), ports);
        ports.set(self.occupied, bump.occupied());
    }
}

/// BUMP alone.
pub struct BumpDevice<const C: usize> {
    unit: Bump<C>,
    events: Events,
    frag: Taker<Lit<C>>,
    shown: BumpPorts<C>,
}

impl<const C: usize> BumpDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(BumpDevice {
            unit: Bump::new(plan),
            events: Events::default(),
            frag: scope.taker("frag")?,
            shown: BumpPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for BumpDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let token = self.frag.token(ports);
        let frag = token.as_ref().map(Lit::given);
        let ready = ports.is_high(self.shown.bumped.ready);
        self.shown.show(&self.unit, ready, ports);
        self.unit.step(frag, ready, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for BumpDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
