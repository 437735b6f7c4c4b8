//! EDGE, or POLY in its place.

use crate::Events;
use crate::edge::Edge;
use crate::poly::Poly;
use crate::ports::Held;
use crate::tokens::{FEW, Line, Prim, Words};
use edgewalk_machine::Plan;

/// What walks the edges that SETUP gives. A machine of few channels has no POLY: nothing of it is built for those.
#[derive(Clone, Debug)]
pub enum Walker<const C: usize> {
    /// Of triangles.
    Edge(Edge<C>),
    /// Of polygons.
    Poly(Box<Poly<C>>),
}

/// The same of both units.
macro_rules! either {
    ($walker:expr, $unit:ident => $body:expr) => {
        match $walker {
            Walker::Poly($unit) if C > FEW => $body,
            Walker::Edge($unit) => $body,
            Walker::Poly(_) => unreachable!("for_channels! takes more channels for POLY"),
        }
    };
}

impl<const C: usize> Walker<C> {
    /// The unit of this machine, at rest.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        if plan.polygon.is_there() {
            Walker::Poly(Box::new(Poly::new(plan)))
        } else {
            Walker::Edge(Edge::new(plan))
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        either!(self, unit => unit.reset());
    }

    /// A triangle or polygon is being walked.
    #[inline(always)]
    #[must_use]
    pub fn running(&self) -> bool {
        match self {
            Walker::Edge(edge) => edge.running(),
            Walker::Poly(poly) => C > FEW && poly.walking(),
        }
    }

    /// The prim offered can be taken.
    #[inline(always)]
    #[must_use]
    pub fn prim_ready(&self, prim: Option<&Prim<C>>, fresh_queued: bool) -> bool {
        match self {
            Walker::Edge(edge) => edge.prim_ready(fresh_queued),
            Walker::Poly(poly) => C > FEW && prim.is_some_and(|prim| poly.prim_ready(prim, fresh_queued)),
        }
    }

    /// The line offered to SPAN.
    #[inline(always)]
    #[must_use]
    pub fn line(&self) -> Option<&Line<C>> {
        either!(self, unit => unit.line())
    }

    /// g of the last prim, for PIXEL.
    #[inline(always)]
    #[must_use]
    pub fn gradient(&self) -> &Words<C> {
        either!(self, unit => unit.gradient())
    }

    /// k_t of the last prim, for PIXEL; 0 where it is a channel.
    #[inline(always)]
    #[must_use]
    pub fn kt(&self) -> u32 {
        either!(self, unit => unit.kt())
    }

    /// The record of the last prim, for TERM.
    #[inline(always)]
    #[must_use]
    pub fn record(&self) -> u32 {
        either!(self, unit => unit.record())
    }

    /// All three.
    #[must_use]
    pub fn held(&self) -> Held<C> {
        Held { gradient: *self.gradient(), kt: self.kt(), record: self.record() }
    }

    /// Clock edge; `line_taken`: the line offered is taken.
    #[inline(always)]
    pub fn step(
        &mut self,
        prim: Option<&Prim<C>>,
        fresh_queued: bool,
        line_taken: bool,
        light_pass: bool,
        events: &mut Events,
    ) {
        match self {
            Walker::Edge(edge) => edge.step(prim, fresh_queued, line_taken, events),
            Walker::Poly(poly) if C > FEW => poly.step(prim, fresh_queued, line_taken, light_pass, events),
            Walker::Poly(_) => {}
        }
    }

    /// Clock edge while SPAN takes nothing; false if there is more to do than to wait with a line.
    #[inline(always)]
    pub(crate) fn waits(&self, events: &mut Events) -> bool {
        match self {
            Walker::Edge(edge) if edge.running() => {
                edge.wait(events);
                true
            }
            _ => false,
        }
    }
}
