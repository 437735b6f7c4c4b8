//! SETUP.

use super::link::{Giver, LightPass, Scope};
use super::{ModelDevice, NoPlace};
use crate::device::{Device, Triangles};
use crate::interface::{Interface, Link};
use crate::values::{PortId, PortValues};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::Events;
use edgewalk_model::setup::Setup;
use edgewalk_model::tokens::Prim;

/// What SETUP shows of itself.
pub struct SetupPorts<const C: usize> {
    prim: Giver<Prim<C>>,
}

impl<const C: usize> SetupPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(SetupPorts { prim: scope.giver("prim")? })
    }

    pub fn show(&self, setup: &Setup<C>, ports: &mut PortValues) {
        self.prim.offer(setup.prim(), ports);
    }
}

/// Where triangles come in.
pub struct TriangleTaker {
    link: Link,
    triangles: Triangles,
}

impl TriangleTaker {
    pub fn find(plan: &Plan, interface: &Interface) -> Result<TriangleTaker, NoPlace> {
        let missing =
            |port: &str| NoPlace::Port { unit: interface.unit.name().to_owned(), port: port.to_owned() };
        let link = interface.link("tri").ok_or_else(|| missing("tri"))?;
        let triangles = Triangles::of(plan, link).ok_or_else(|| missing("a field of tri"))?;
        Ok(TriangleTaker { link: link.clone(), triangles })
    }

    /// The triangle that is offered, and its tag. In a reset none is taken.
    pub fn token(&self, ports: &PortValues) -> Option<([PortVertex; 3], u32)> {
        let offered = ports.is_high(self.link.valid) && !ports.rst;
        offered.then(|| self.triangles.unpack(self.link.token(ports)))
    }

    pub fn ready(&self) -> PortId {
        self.link.ready
    }
}

/// SETUP alone.
pub struct SetupDevice<const C: usize> {
    unit: Setup<C>,
    events: Events,
    tri: TriangleTaker,
    light_pass: LightPass,
    shown: SetupPorts<C>,
}

impl<const C: usize> SetupDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(SetupDevice {
            unit: Setup::new(plan),
            events: Events::default(),
            tri: TriangleTaker::find(plan, interface)?,
            light_pass: scope.light_pass()?,
            shown: SetupPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for SetupDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        ports.set(self.tri.ready(), self.unit.tri_ready());
        self.shown.show(&self.unit, ports);
        let triangle = self.tri.token(ports);
        let triangle = triangle.as_ref().map(|(vertices, tag)| (vertices, *tag));
        let (ready, light_pass) = (ports.is_high(self.shown.prim.ready), self.light_pass.is_high(ports));
        self.unit.step(triangle, ready, light_pass, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for SetupDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
