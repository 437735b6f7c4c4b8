//! Values that a unit holds beside a link, in the cycles in which no token is offered there.
//!
//! From a token on they stay as they are until the next triangle is taken: `docs/machine.md`, sections 3 and 19.

use crate::interface::{Direction, Interface, Link};
use crate::values::{PortId, PortValues};
use edgewalk_machine::Until;
use std::ops::Range;

/// Values held beside a link that a unit gives, and whether they still count.
#[derive(Clone, Debug)]
pub struct Kept {
    beside: PortId,
    valid: PortId,
    ready: PortId,
    /// A flag of the token taken: only with 1 another triangle begins.
    ends: Option<PortId>,
    range: Range<usize>,
    kept: bool,
}

impl Kept {
    /// Values held by the unit that has the ports, and by the units inside.
    #[must_use]
    pub fn of(interface: &Interface) -> Vec<Kept> {
        let own = interface.links.iter().filter(|link| link.holds()).filter_map(|link| {
            let taken = interface.links_of(Direction::In).next()?;
            Kept::new(link, taken, taken)
        });
        // The unit before gives what a unit takes.
        let inner =
            interface.inner.iter().zip(0..).filter(|(link, _)| link.holds()).filter_map(|(link, i)| {
                let taken = interface
                    .inner
                    .iter()
                    .rposition(|other| other.owner == link.owner && other.direction == Direction::In)?;
                (taken < i).then_some(())?;
                Kept::new(link, &interface.inner[taken], interface.inner.get(taken.checked_sub(1)?)?)
            });
        own.chain(inner).collect()
    }

    /// `given`: the end of the link taken that has its fields.
    fn new(link: &Link, taken: &Link, given: &Link) -> Option<Kept> {
        let ends = match link.held_until? {
            Until::TakenWith(flag) => Some(given.fields[given.place(flag)?].id),
            Until::Taken | Until::Offered => None,
        };
        let all = link.range();
        let range = all.start + link.own..all.end;
        Some(Kept { beside: link.valid, valid: taken.valid, ready: taken.ready, ends, range, kept: false })
    }

    /// The values that count in this cycle though no token is offered beside them.
    #[must_use]
    pub fn counting(&self, ports: &PortValues) -> Range<usize> {
        if self.kept && !ports.rst && !ports.is_high(self.beside) { self.range.clone() } else { 0..0 }
    }

    /// The clock edge after a cycle with these values.
    pub fn clock(&mut self, ports: &PortValues) {
        let taken = ports.is_high(self.valid) && ports.is_high(self.ready);
        let next = taken && self.ends.is_none_or(|ends| ports.is_high(ends));
        self.kept = !ports.rst && !next && (self.kept || ports.is_high(self.beside));
    }
}
