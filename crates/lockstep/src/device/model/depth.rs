//! DEPTH.

use super::link::{Giver, Scope, Taker};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::Events;
use edgewalk_model::depth::{Block, Depth, DepthInputs};
use edgewalk_model::tokens::{Fragment, Write};

/// What DEPTH tells of itself beside its links.
pub struct DepthStatus {
    frag_ready: PortId,
    hazard: PortId,
    full: PortId,
    occupied: PortId,
}

impl DepthStatus {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(DepthStatus {
            frag_ready: scope.port("frag_ready")?,
            hazard: scope.port("hazard")?,
            full: scope.port("full")?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show<const C: usize>(
        &self,
        depth: &Depth<C>,
        frag: Option<&Fragment<C>>,
        rd_ready: bool,
        depth_write: bool,
        ports: &mut PortValues,
    ) {
        let block = depth.block(frag, depth_write);
        ports.set(self.frag_ready, rd_ready && block.is_none());
        ports.set(self.hazard, block == Some(Block::Hazard));
        // Without a fragment only a full queue blocks.
        ports.set(self.full, depth.block(None, depth_write).is_some());
        ports.set(self.occupied, depth.occupied());
    }
}

/// The links to the depth memory, and the constants: ports of DEPTH that are those of the machine as well.
pub struct MemoryPorts<const C: usize> {
    rd_valid: PortId,
    rd_ready: PortId,
    rd_addr: PortId,
    data_valid: PortId,
    data_ready: PortId,
    data_z: PortId,
    /// `wr`, with BLEND `zwr`.
    wr: Giver<Write<C>>,
    depth_func: PortId,
    depth_write: PortId,
    color_write: Option<PortId>,
}

impl<const C: usize> MemoryPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        let forks = scope.plan.blend.is_there();
        Ok(MemoryPorts {
            rd_valid: scope.port("rd_valid")?,
            rd_ready: scope.port("rd_ready")?,
            rd_addr: scope.port("rd_addr")?,
            data_valid: scope.port("data_valid")?,
            data_ready: scope.port("data_ready")?,
            data_z: scope.port("data_z")?,
            wr: scope.giver(if forks { "zwr" } else { "wr" })?,
            depth_func: scope.port("depth_func")?,
            depth_write: scope.port("depth_write")?,
            color_write: forks.then(|| scope.port("color_write")).transpose()?,
        })
    }

    /// All inputs but whether BLEND takes a fragment.
    pub fn inputs(&self, ports: &PortValues) -> DepthInputs {
        DepthInputs {
            depth_func: ports[self.depth_func] as u8, // 3 bits
            depth_write: ports.is_high(self.depth_write),
            rd_ready: ports.is_high(self.rd_ready),
            data: ports.is_high(self.data_valid).then_some(ports[self.data_z] as u64), // at most 32 bits
            wr_ready: ports.is_high(self.wr.ready),
            color_write: self.color_write.is_some_and(|port| ports.is_high(port)),
            pass_ready: false,
        }
    }

    pub fn show(
        &self,
        read: Option<u32>,
        data_ready: bool,
        write: Option<&Write<C>>,
        ports: &mut PortValues,
    ) {
        ports.set(self.rd_valid, read.is_some());
        ports[self.rd_addr] = read.unwrap_or(0).into();
        ports.set(self.data_ready, data_ready);
        self.wr.offer(write, ports);
    }
}

/// DEPTH alone.
pub struct DepthDevice<const C: usize> {
    unit: Depth<C>,
    events: Events,
    frag: Taker<Fragment<C>>,
    memory: MemoryPorts<C>,
    pass: Option<Giver<Fragment<C>>>,
    status: DepthStatus,
}

impl<const C: usize> DepthDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(DepthDevice {
            unit: Depth::new(plan),
            events: Events::default(),
            frag: scope.taker("frag")?,
            memory: MemoryPorts::find(scope)?,
            pass: plan.blend.is_there().then(|| scope.giver("pass")).transpose()?,
            status: DepthStatus::find(scope)?,
        })
    }
}

impl<const C: usize> Device for DepthDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let frag = self.frag.token(ports);
        let pass_ready = self.pass.as_ref().is_some_and(|pass| ports.is_high(pass.ready));
        let inputs = DepthInputs { pass_ready, ..self.memory.inputs(ports) };
        if let Some(pass) = &self.pass {
            pass.offer(self.unit.pass(), ports);
        }
        let block = self.unit.block(frag.as_ref(), inputs.depth_write);
        let read = frag.filter(|_| block.is_none()).map(|frag| frag.addr);
        let write = self.unit.write();
        self.memory.show(read, self.unit.data_ready(inputs.wr_ready, pass_ready), write.as_ref(), ports);
        self.status.show(&self.unit, frag.as_ref(), inputs.rd_ready, inputs.depth_write, ports);
        self.unit.step(frag.as_ref(), block, &inputs, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for DepthDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
