//! EDGE.

use super::link::{Giver, HeldWords, Scope, Taker};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::Events;
use edgewalk_model::edge::Edge;
use edgewalk_model::tokens::{Line, Prim};

/// What EDGE shows of itself.
pub struct EdgePorts<const C: usize> {
    prim_ready: PortId,
    line: Giver<Line<C>>,
    inc: HeldWords,
    record: Option<PortId>,
}

impl<const C: usize> EdgePorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(EdgePorts {
            prim_ready: scope.port("prim_ready")?,
            line: scope.giver("line")?,
            inc: scope.held("line")?,
            record: scope.plan.shade.is_there().then(|| scope.port("inc_record")).transpose()?,
        })
    }

    pub fn show(&self, edge: &Edge<C>, fresh_queued: bool, ports: &mut PortValues) {
        ports.set(self.prim_ready, edge.prim_ready(fresh_queued));
        self.line.offer(edge.line(), ports);
        self.inc.show(edge.gradient(), edge.kt(), ports);
        if let Some(port) = self.record {
            ports[port] = edge.record().into();
        }
    }
}

/// EDGE alone.
pub struct EdgeDevice<const C: usize> {
    unit: Edge<C>,
    events: Events,
    prim: Taker<Prim<C>>,
    fresh_queued: PortId,
    shown: EdgePorts<C>,
}

impl<const C: usize> EdgeDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(EdgeDevice {
            unit: Edge::new(plan),
            events: Events::default(),
            prim: scope.taker("prim")?,
            fresh_queued: scope.port("fresh_queued")?,
            shown: EdgePorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for EdgeDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let fresh_queued = ports.is_high(self.fresh_queued);
        self.shown.show(&self.unit, fresh_queued, ports);
        let fires = ports.is_high(self.shown.line.ready) && self.unit.line().is_some();
        self.unit.step(self.prim.token(ports).as_ref(), fresh_queued, fires, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for EdgeDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
