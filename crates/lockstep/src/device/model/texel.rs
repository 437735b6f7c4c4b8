//! TEXEL.

use super::link::{Giver, Scope, Taker};
use super::term::WordPorts;
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::texel::Texel;
use edgewalk_model::{Events, Lit, WordIn};

/// What TEXEL shows of itself, beside the ports of its memory.
pub struct TexelPorts<const C: usize> {
    frag_ready: PortId,
    textured: Giver<Lit<C>>,
    texel_full: PortId,
    occupied: PortId,
}

impl<const C: usize> TexelPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(TexelPorts {
            frag_ready: scope.port("frag_ready")?,
            textured: scope.giver("textured")?,
            texel_full: scope.port("texel_full")?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show(&self, texel: &Texel<C>, textures: &WordIn, ports: &mut PortValues) {
        ports.set(self.frag_ready, texel.frag_ready(textures));
        self.textured.offer(texel.textured(textures).as_ref(), ports);
        ports.set(self.texel_full, texel.full());
        ports.set(self.occupied, texel.occupied());
    }
}

/// TEXEL alone.
pub struct TexelDevice<const C: usize> {
    unit: Texel<C>,
    events: Events,
    frag: Taker<Lit<C>>,
    memory: WordPorts,
    shown: TexelPorts<C>,
}

impl<const C: usize> TexelDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(TexelDevice {
            unit: Texel::new(plan),
            events: Events::default(),
            frag: scope.taker("frag")?,
            memory: WordPorts::alone(scope)?,
            shown: TexelPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for TexelDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (token, inputs) = (self.frag.token(ports), self.memory.inputs(ports));
        let frag = token.as_ref().map(Lit::given);
        let ready = ports.is_high(self.shown.textured.ready);
        self.memory.show(self.unit.read(frag), self.unit.xdata_ready(ready), ports);
        self.shown.show(&self.unit, &inputs, ports);
        let taken = ready && self.unit.textured(&inputs).is_some();
        self.unit.step(frag, &inputs, taken, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for TexelDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
