//! Which outputs are compared when, and the first difference told in full.
//!
//! Fields count where their valid is high, and values held beside them until they may change. A ready that depends on the
//! token counts where that is offered, all else in every cycle.

use crate::held::Kept;
use crate::interface::{Direction, Interface, Link, Port, StatusPort};
use crate::values::{PortId, PortValues};
use std::fmt;
use std::ops::Range;

/// The outputs compared in every cycle: readies of links in (where they are defined without a valid), valids of links out,
/// status ports.
#[must_use]
pub fn status_ports(interface: &Interface) -> Vec<StatusPort> {
    let handshakes = interface.links.iter().filter_map(always);
    let handshakes =
        handshakes.map(|id| StatusPort { port: interface.at(id).clone(), during: None, guard: None });
    handshakes.chain(interface.status.iter().cloned()).collect()
}

/// The output of a link's handshake, if it is compared in every cycle.
fn always(link: &Link) -> Option<PortId> {
    match (link.direction, link.ready_always) {
        (Direction::Out, _) => Some(link.valid),
        (Direction::In, true) => Some(link.ready),
        (Direction::In, false) => None,
    }
}

/// What is compared of an interface.
#[derive(Clone, Debug)]
pub struct Comparison {
    every_cycle: Vec<StatusPort>,
    /// Ports that count while the guard is high.
    guarded: Vec<(PortId, Range<usize>)>,
    kept: Vec<Kept>,
}

impl Comparison {
    /// All outputs of the interface, and those of the units inside if it has them.
    #[must_use]
    pub fn new(interface: &Interface) -> Comparison {
        let mut every_cycle = status_ports(interface);
        let inner = interface.inner.iter().filter_map(always);
        every_cycle.extend(inner.map(|id| StatusPort {
            port: interface.at(id).clone(),
            during: None,
            guard: None,
        }));
        every_cycle.extend(interface.inner_status.iter().cloned());
        let links = interface.links.iter().chain(&interface.inner);
        let guarded = links.filter_map(|link| match (link.direction, link.ready_always) {
            (Direction::Out, _) => Some((link.valid, link.range())),
            (Direction::In, false) => Some((link.valid, link.ready.0..link.ready.0 + 1)),
            (Direction::In, true) => None,
        });
        Comparison { guarded: guarded.collect(), every_cycle, kept: Kept::of(interface) }
    }

    /// Compares the next cycle; adds the number of values to `compared`, and gives the first port that differs.
    #[must_use]
    pub fn first_difference(
        &mut self,
        expected: &PortValues,
        found: &PortValues,
        compared: &mut u64,
    ) -> Option<PortId> {
        *compared += self.every_cycle.len() as u64;
        let differs = |status: &&StatusPort| status.value(expected) != status.value(found);
        let mut first = self.every_cycle.iter().find(differs).map(|status| status.port.id);
        let offered = self.guarded.iter().filter(|(guard, _)| expected.is_high(*guard));
        let ranges = offered.map(|(_, range)| range.clone());
        for range in ranges.chain(self.kept.iter().map(|kept| kept.counting(expected))) {
            *compared += range.len() as u64;
            let unlike = |place: &usize| expected[PortId(*place)] != found[PortId(*place)];
            first = first.or_else(|| range.clone().find(unlike).map(PortId));
        }
        self.kept.iter_mut().for_each(|kept| kept.clock(expected));
        first
    }
}

/// The first port that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The port, with the unit that has it.
    pub port: Port,
    /// The cycle.
    pub cycle: u64,
    /// What the reference says.
    pub expected: u128,
    /// What the device says.
    pub found: u128,
    /// The triangle whose token the reference has at that link, or had last.
    pub triangle: Option<u32>,
    /// Column and line, where the token has an address.
    pub pixel: Option<(u64, u64)>,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Difference { port, cycle, expected, found, triangle, pixel } = self;
        write!(f, "{} {}, cycle {cycle}: expected {expected:#x}, found {found:#x}", port.owner, port.name)?;
        if port.width() > 1 {
            write!(f, " ({} for {})", port.shown(*found), port.shown(*expected))?;
        }
        if let Some(triangle) = triangle {
            write!(f, ", triangle {triangle}")?;
        }
        if let Some((x, y)) = pixel {
            write!(f, ", pixel ({x}, {y})")?;
        }
        Ok(())
    }
}

/// Follows a run, so that a difference can be told with triangle and pixel.
#[derive(Clone, Debug)]
pub(crate) struct Follower {
    links: Vec<Link>,
    /// The triangle that each link had last.
    last: Vec<Option<u32>>,
    x_bits: u32,
}

impl Follower {
    /// `x_bits`: the column part of an address.
    pub fn new(interface: &Interface, x_bits: u32) -> Follower {
        let links: Vec<Link> = interface.links.iter().chain(&interface.inner).cloned().collect();
        Follower { last: vec![None; links.len()], links, x_bits }
    }

    /// Sees a cycle of the reference.
    pub fn see(&mut self, expected: &PortValues) {
        for (place, last) in self.last.iter_mut().enumerate() {
            *last = expected.triangle(place).or(*last);
        }
    }

    /// The difference at a port.
    pub fn tell(&self, port: &Port, cycle: u64, expected: &PortValues, found: &PortValues) -> Difference {
        let of_link = |link: &Link| {
            link.owner == port.owner
                && (link.ready == port.id || link.valid == port.id || link.range().contains(&port.id.0))
        };
        let place = self.links.iter().position(of_link);
        let link = place.map(|place| &self.links[place]);
        let offered = link.filter(|link| link.direction == Direction::Out && expected.is_high(link.valid));
        let address = offered.and_then(|link| Some(link.token(expected)[link.place("addr")?] as u64)); // at most 26 bits
        // A port of no link goes by the triangle that entered last.
        let triangle = self.last[place.unwrap_or(0)];
        Difference {
            port: port.clone(),
            cycle,
            expected: expected[port.id],
            found: found[port.id],
            triangle,
            pixel: address.map(|address| (address & ((1 << self.x_bits) - 1), address >> self.x_bits)),
        }
    }
}
