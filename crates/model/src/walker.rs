//! EDGE, or POLY in its place.

use crate::Events;
use crate::edge::Edge;
use crate::poly::Poly;
use crate::ports::Held;
use crate::tokens::{FEW, Line, Prim, Words};
use edgewalk_machine::Plan;

/// What walks the edges that SETUP gives: EDGE, or POLY where the machine has it. A machine of few channels has no POLY:
/// nothing of it is built for those.
#[derive(Clone, Debug)]
pub struct Walker<const C: usize> {
    edge: Edge<C>,
    poly: Option<Box<Poly<C>>>,
}

/// The same of the unit that the machine has.
macro_rules! either {
    ($walker:expr, $unit:ident => $body:expr) => {
        if let Some($unit) = $walker.poly() {
            $body
        } else {
            let $unit = &$walker.edge;
            $body
        }
    };
}

impl<const C: usize> Walker<C> {
    /// The unit of this machine, at rest.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let poly = plan.polygon.is_there().then(|| Box::new(Poly::new(plan)));
        assert!(C > FEW || poly.is_none(), "for_channels! takes more channels for POLY");
        Walker { edge: Edge::new(plan), poly }
    }

    /// POLY, if the machine has it.
    #[inline(always)]
    #[must_use]
    pub fn poly(&self) -> Option<&Poly<C>> {
        if C > FEW { self.poly.as_deref() } else { None }
    }

    /// EDGE, at rest where the machine has POLY.
    pub(crate) fn edge(&self) -> &Edge<C> {
        &self.edge
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.edge.reset();
        if let Some(poly) = &mut self.poly {
            poly.reset();
        }
    }

    /// A triangle or polygon is being walked.
    #[inline(always)]
    #[must_use]
    pub fn running(&self) -> bool {
        self.poly().map_or_else(|| self.edge.running(), Poly::walking)
    }

    /// The prim offered can be taken.
    #[inline(always)]
    #[must_use]
    pub fn prim_ready(&self, prim: Option<&Prim<C>>, fresh_queued: bool) -> bool {
        match self.poly() {
            None => self.edge.prim_ready(fresh_queued),
            Some(poly) => prim.is_some_and(|prim| poly.prim_ready(prim, fresh_queued)),
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
        match &mut self.poly {
            Some(poly) if C > FEW => poly.step(prim, fresh_queued, line_taken, light_pass, events),
            _ => self.edge.step(prim, fresh_queued, line_taken, events),
        }
    }

    /// Clock edge while SPAN takes nothing; false if there is more to do than to wait with a line.
    #[inline(always)]
    pub(crate) fn waits(&self, events: &mut Events) -> bool {
        let waits = self.edge.running();
        if waits {
            self.edge.wait(events);
        }
        waits
    }
}
