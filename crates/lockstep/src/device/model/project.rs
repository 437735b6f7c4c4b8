//! PROJECT.

use super::link::{Giver, Scope, Taker};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::Events;
use edgewalk_model::project::Project;
use edgewalk_model::tokens::Fragment;

/// What PROJECT shows of itself.
pub struct ProjectPorts<const C: usize> {
    frag_ready: PortId,
    projected: Giver<Fragment<C>>,
    /// Of the serial one.
    dividing: Option<PortId>,
    occupied: PortId,
}

impl<const C: usize> ProjectPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        let serial = scope.plan.shadow.project == edgewalk_machine::Project::Serial;
        Ok(ProjectPorts {
            frag_ready: scope.port("frag_ready")?,
            projected: scope.giver("projected")?,
            dividing: serial.then(|| scope.port("dividing")).transpose()?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show(&self, project: &Project<C>, projected_ready: bool, ports: &mut PortValues) {
        ports.set(self.frag_ready, project.frag_ready(projected_ready));
        self.projected.offer(project.projected(), ports);
        if let Some(dividing) = self.dividing {
            ports.set(dividing, project.dividing());
        }
        ports.set(self.occupied, project.occupied());
    }
}

/// PROJECT alone.
pub struct ProjectDevice<const C: usize> {
    unit: Project<C>,
    events: Events,
    frag: Taker<Fragment<C>>,
    shown: ProjectPorts<C>,
}

impl<const C: usize> ProjectDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(ProjectDevice {
            unit: Project::new(plan),
            events: Events::default(),
            frag: scope.taker("frag")?,
            shown: ProjectPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for ProjectDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let frag = self.frag.token(ports);
        let ready = ports.is_high(self.shown.projected.ready);
        self.shown.show(&self.unit, ready, ports);
        self.unit.step(frag.as_ref(), ready, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for ProjectDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
