//! SHADOW.

use super::link::{Giver, LightPass, Scope, Taker};
use super::term::WordPorts;
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::shadow::Shadow;
use edgewalk_model::tokens::Fragment;
use edgewalk_model::{Events, ShadowInputs, WordIn};

/// What SHADOW shows of itself, beside the ports of the map.
pub struct ShadowPorts<const C: usize> {
    frag_ready: PortId,
    shaded: Giver<Fragment<C>>,
    shadow_full: PortId,
    occupied: PortId,
}

impl<const C: usize> ShadowPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(ShadowPorts {
            frag_ready: scope.port("frag_ready")?,
            shaded: scope.giver("shaded")?,
            shadow_full: scope.port("shadow_full")?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show(
        &self,
        shadow: &Shadow<C>,
        frag: Option<&Fragment<C>>,
        inputs: &ShadowInputs,
        map: &WordIn,
        ports: &mut PortValues,
    ) {
        ports.set(self.frag_ready, shadow.frag_ready(frag, inputs, map));
        self.shaded.offer(shadow.shaded(inputs, map).as_ref(), ports);
        ports.set(self.shadow_full, shadow.full());
        ports.set(self.occupied, shadow.occupied());
    }
}

/// The constants of SHADOW, which are ports of the machine as well.
pub struct MapRules {
    shadow_on: PortId,
    light_pass: LightPass,
    ambient: Option<PortId>,
}

impl MapRules {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        let scales = scope.plan.shadow.gate == edgewalk_machine::Gate::Scale;
        Ok(MapRules {
            shadow_on: scope.port("shadow_on")?,
            light_pass: scope.light_pass()?,
            ambient: scales.then(|| scope.port("ambient")).transpose()?,
        })
    }

    pub fn inputs(&self, ports: &PortValues) -> ShadowInputs {
        ShadowInputs {
            on: ports.is_high(self.shadow_on),
            light_pass: self.light_pass.is_high(ports),
            ambient: self.ambient.map_or(0, |port| ports[port] as u32), // at most 16 bits
        }
    }
}

/// SHADOW alone.
pub struct ShadowDevice<const C: usize> {
    unit: Shadow<C>,
    events: Events,
    frag: Taker<Fragment<C>>,
    shaded_ready: PortId,
    map: WordPorts,
    rules: MapRules,
    shown: ShadowPorts<C>,
}

impl<const C: usize> ShadowDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(ShadowDevice {
            unit: Shadow::new(plan),
            events: Events::default(),
            frag: scope.taker("frag")?,
            shaded_ready: scope.port("shaded_ready")?,
            map: WordPorts::alone(scope)?,
            rules: MapRules::find(scope)?,
            shown: ShadowPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for ShadowDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (frag, map, inputs) = (self.frag.token(ports), self.map.inputs(ports), self.rules.inputs(ports));
        let ready = ports.is_high(self.shaded_ready);
        self.map.show(self.unit.read(frag.as_ref(), &inputs), self.unit.mdata_ready(ready), ports);
        self.shown.show(&self.unit, frag.as_ref(), &inputs, &map, ports);
        let taken = ready && self.unit.shaded(&inputs, &map).is_some();
        self.unit.step(frag.as_ref(), &inputs, &map, taken, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for ShadowDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
