//! SHADE.

use super::link::{Giver, Scope, Taker};
use super::term::WordPorts;
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::device::terms::TermFragment;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::shade::{Cosines, Shade};
use edgewalk_model::tokens::Fragment;
use edgewalk_model::{Events, ShadeInputs};

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

    pub fn show(
        &self,
        shade: &Shade<C>,
        (frag, cosines): (Option<&Fragment<C>>, &Cosines),
        tinted_ready: bool,
        ports: &mut PortValues,
    ) {
        ports.set(self.frag_ready, shade.frag_ready(cosines, tinted_ready));
        self.tinted.offer(shade.tinted(), ports);
        ports.set(self.table_wait, shade.waits(frag, cosines));
        ports.set(self.occupied, shade.occupied());
    }
}

/// The memory's ports as SHADE sees them.
pub fn inputs(memory: &WordPorts, ports: &PortValues) -> ShadeInputs {
    let (srd_ready, sdata) = memory.inputs(ports);
    ShadeInputs { srd_ready, sdata }
}

/// SHADE alone.
pub struct ShadeDevice<const C: usize> {
    unit: Shade<C>,
    events: Events,
    frag: Taker<TermFragment<C>>,
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
            memory: WordPorts::find(scope, "srd", "sdata")?,
            shown: ShadePorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for ShadeDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (token, inputs) = (self.frag.token(ports), inputs(&self.memory, ports));
        let frag = token.as_ref().map(|token| &token.fragment);
        let cosines = token.as_ref().map_or_else(Cosines::default, |token| token.cosines);
        let ready = ports.is_high(self.shown.tinted.ready);
        self.memory.show(self.unit.read(), self.unit.sdata_ready(), ports);
        self.shown.show(&self.unit, (frag, &cosines), ready, ports);
        self.unit.step(frag, &cosines, &inputs, ready, &mut self.events);
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
