//! NORMAL.

use super::link::{Giver, Scope, Taker};
use super::term::WordPorts;
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::device::terms::TermFragment;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::normal::Normal;
use edgewalk_model::shade::Cosines;
use edgewalk_model::tokens::Fragment;
use edgewalk_model::{Events, NormalInputs};

/// What NORMAL shows of itself, beside the ports of its memory.
pub struct NormalPorts<const C: usize> {
    frag_ready: PortId,
    normed: Giver<TermFragment<C>>,
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
        frag: Option<&Fragment<C>>,
        normed_ready: bool,
        ports: &mut PortValues,
    ) {
        ports.set(self.frag_ready, normal.frag_ready(normed_ready));
        let normed = normal
            .normed()
            .map(|(fragment, cosines)| TermFragment { fragment: *fragment, cosines: *cosines });
        self.normed.offer(normed.as_ref(), ports);
        ports.set(self.table_wait, normal.waits(frag));
        ports.set(self.occupied, normal.occupied());
    }
}

/// The memory's ports as NORMAL sees them, and LAMP.
pub fn inputs(memory: &WordPorts, ports: &PortValues) -> NormalInputs {
    let (rrd_ready, rdata) = memory.inputs(ports);
    NormalInputs { rrd_ready, rdata }
}

/// NORMAL alone.
pub struct NormalDevice<const C: usize> {
    unit: Normal<C>,
    events: Events,
    frag: Taker<TermFragment<C>>,
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
            memory: WordPorts::find(scope, "rrd", "rdata")?,
            shown: NormalPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for NormalDevice<C> {
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

impl<const C: usize> ModelDevice for NormalDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
