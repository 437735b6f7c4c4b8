//! PIXEL.

use super::link::{Giver, HeldWords, LightPass, Scope, Taker};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::device::terms::TermSpan;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::pixel::Pixel;
use edgewalk_model::term::Walked;
use edgewalk_model::{Events, Lit};

/// What PIXEL shows of itself.
pub struct PixelPorts<const C: usize> {
    span_ready: PortId,
    frag: Giver<Lit<C>>,
    active: PortId,
    visible: PortId,
    advance: PortId,
    occupied: PortId,
}

impl<const C: usize> PixelPorts<C> {
    pub fn find(scope: Scope) -> Result<Self, NoPlace> {
        Ok(PixelPorts {
            span_ready: scope.port("span_ready")?,
            frag: scope.giver("frag")?,
            active: scope.port("active")?,
            visible: scope.port("visible")?,
            advance: scope.port("advance")?,
            occupied: scope.port("occupied")?,
        })
    }

    pub fn show(&self, pixel: &Pixel<C>, frag_ready: bool, ports: &mut PortValues) {
        ports.set(self.span_ready, pixel.span_ready(frag_ready));
        self.frag.offer(pixel.given().map(|given| given.lit()).as_ref(), ports);
        ports.set(self.active, pixel.active());
        ports.set(self.visible, pixel.on_screen());
        ports.set(self.advance, pixel.advance(frag_ready));
        ports.set(self.occupied, pixel.occupied());
    }
}

/// PIXEL alone.
pub struct PixelDevice<const C: usize> {
    unit: Pixel<C>,
    events: Events,
    span: Taker<TermSpan<C>>,
    inc: HeldWords,
    light_pass: LightPass,
    shown: PixelPorts<C>,
}

impl<const C: usize> PixelDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        Ok(PixelDevice {
            unit: Pixel::new(plan),
            events: Events::default(),
            span: scope.taker("span")?,
            inc: scope.held("span")?,
            light_pass: scope.light_pass()?,
            shown: PixelPorts::find(scope)?,
        })
    }
}

impl<const C: usize> Device for PixelDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let ready = ports.is_high(self.shown.frag.ready);
        self.shown.show(&self.unit, ready, ports);
        let (span, (gradient, kt)) = (self.span.token(ports), self.inc.read(ports));
        let walked = || span.as_ref().map_or_else(Walked::default, |span| span.walked);
        let plain = span.as_ref().map(|span| &span.span);
        let light_pass = self.light_pass.is_high(ports);
        self.unit.step(plain, (&gradient, kt), walked, ready, light_pass, &mut self.events);
        if ports.rst {
            self.unit.reset();
        }
    }
}

impl<const C: usize> ModelDevice for PixelDevice<C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
