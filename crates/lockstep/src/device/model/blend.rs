//! BLEND.

use super::link::{Giver, Scope, Taker};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::blend::{Blend, Block};
use edgewalk_model::tokens::{ColorWrite, Fragment};
use edgewalk_model::{BlendInputs, Events};

/// What BLEND tells of itself beside its links.
pub struct BlendStatus {
    pass_ready: PortId,
    color_hazard: PortId,
    color_full: PortId,
    occupied: PortId,
}

impl BlendStatus {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(BlendStatus {
            pass_ready: scope.port("pass_ready")?,
            color_hazard: scope.port("color_hazard")?,
            color_full: scope.port("color_full")?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show<const C: usize>(
        &self,
        blend: &Blend<C>,
        pass: Option<&Fragment<C>>,
        inputs: &BlendInputs,
        ports: &mut PortValues,
    ) {
        ports.set(self.pass_ready, blend.pass_ready(pass, inputs));
        ports.set(self.color_hazard, blend.block(pass, inputs.add) == Some(Block::Hazard));
        ports.set(self.color_full, blend.full());
        ports.set(self.occupied, blend.occupied());
    }
}

/// The links to the colour memory, and the constant: ports of BLEND that are those of the machine as well.
pub struct ColorPorts<const C: usize> {
    crd_valid: PortId,
    crd_ready: PortId,
    crd_addr: PortId,
    cdata_valid: PortId,
    cdata_ready: PortId,
    cdata_rgb: PortId,
    cwr: Giver<ColorWrite<C>>,
    blend_add: PortId,
}

impl<const C: usize> ColorPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(ColorPorts {
            crd_valid: scope.port("crd_valid")?,
            crd_ready: scope.port("crd_ready")?,
            crd_addr: scope.port("crd_addr")?,
            cdata_valid: scope.port("cdata_valid")?,
            cdata_ready: scope.port("cdata_ready")?,
            cdata_rgb: scope.port("cdata_rgb")?,
            cwr: scope.giver("cwr")?,
            blend_add: scope.port("blend_add")?,
        })
    }

    /// All inputs but DEPTH's.
    pub fn inputs(&self, ports: &PortValues) -> BlendInputs {
        BlendInputs {
            color_write: false,
            add: ports.is_high(self.blend_add),
            crd_ready: ports.is_high(self.crd_ready),
            cdata: ports.is_high(self.cdata_valid).then_some(ports[self.cdata_rgb] as u64), // at most 48 bits
            cwr_ready: ports.is_high(self.cwr.ready),
        }
    }

    pub fn show(
        &self,
        read: Option<u32>,
        data_ready: bool,
        write: Option<&ColorWrite<C>>,
        ports: &mut PortValues,
    ) {
        ports.set(self.crd_valid, read.is_some());
        ports[self.crd_addr] = read.unwrap_or(0).into();
        ports.set(self.cdata_ready, data_ready);
        self.cwr.offer(write, ports);
    }
}

/// BLEND alone.
pub struct BlendDevice<const C: usize> {
    unit: Blend<C>,
    events: Events,
    pass: Taker<Fragment<C>>,
    memory: ColorPorts<C>,
    status: BlendStatus,
}

impl<const C: usize> BlendDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(BlendDevice {
            unit: Blend::new(plan),
            events: Events::default(),
            pass: scope.taker("pass")?,
            memory: ColorPorts::find(scope)?,
            status: BlendStatus::find(scope)?,
        })
    }
}

impl<const C: usize> Device for BlendDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (pass, inputs) = (self.pass.token(ports), self.memory.inputs(ports));
        let read = self.unit.read(pass.as_ref(), inputs.add);
        let data_ready = self.unit.cdata_ready(inputs.cwr_ready);
        self.memory.show(read, data_ready, self.unit.write().as_ref(), ports);
        self.status.show(&self.unit, pass.as_ref(), &inputs, ports);
        self.unit.step(pass.as_ref(), &inputs, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for BlendDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
