//! SPAN.

use super::link::{Giver, LightPass, Scope, Taker};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::Events;
use edgewalk_model::span::Span;
use edgewalk_model::tokens::{self, Line};

/// What SPAN shows of itself.
pub struct SpanPorts<const C: usize> {
    line_ready: PortId,
    span: Giver<tokens::Span<C>>,
    fresh_queued: PortId,
    line_held: PortId,
}

impl<const C: usize> SpanPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(SpanPorts {
            line_ready: scope.port("line_ready")?,
            span: scope.giver("span")?,
            fresh_queued: scope.port("fresh_queued")?,
            line_held: scope.port("line_held")?,
        })
    }

    pub fn show(&self, span: &Span<C>, ports: &mut PortValues) {
        ports.set(self.line_ready, span.line_ready());
        self.span.offer(span.span(), ports);
        ports.set(self.fresh_queued, span.fresh_queued());
        ports.set(self.line_held, span.line_held());
    }
}

/// SPAN alone.
pub struct SpanDevice<const C: usize> {
    unit: Span<C>,
    events: Events,
    line: Taker<Line<C>>,
    light_pass: LightPass,
    shown: SpanPorts<C>,
}

impl<const C: usize> SpanDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(SpanDevice {
            unit: Span::new(plan),
            events: Events::default(),
            line: scope.taker("line")?,
            light_pass: scope.light_pass()?,
            shown: SpanPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for SpanDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let line = self.line.token(ports);
        self.shown.show(&self.unit, ports);
        let (ready, light_pass) = (ports.is_high(self.shown.span.ready), self.light_pass.is_high(ports));
        self.unit.step(line.as_ref(), ready, light_pass, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for SpanDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
