//! The outputs of the units inside the machine, which are compared beside its ports.

use super::Interface;
use super::link::{Direction, Link, StatusPort, flag};
use crate::unit::Unit;
use crate::values::PortId;
use edgewalk_machine::Ports;

impl Interface {
    /// Adds what the unit gives to others: valid and fields of the link it gives, the ready of the one it takes, and its
    /// status. What is a port of the machine as well is there already.
    pub(super) fn add_inner(&mut self, unit: Unit, declared: &Ports) {
        let own = |link: &&edgewalk_machine::Link| self.link(link.name).is_none();
        let (takes, gives) = (declared.takes.iter().find(own), declared.gives.iter().find(own));
        if let Some(link) = takes {
            let mut link = Link::declared(unit.name(), Direction::In, link, &[]);
            link.ready = self.place(flag(unit.name(), link.name, "ready"));
            self.inner.push(link);
        }
        if let Some(link) = gives {
            let mut link = Link::declared(unit.name(), Direction::Out, link, &declared.held_out);
            self.place_token(&mut link);
            self.inner.push(link);
        }
        let status = self.add_status(unit, declared);
        self.inner_status.extend(status);
    }

    /// Finds the ports that say whether another counts, and of a link between units the end that belongs to the other: the
    /// unit before gives what a unit takes, whatever each of them calls it.
    pub(super) fn find_guards(&mut self) {
        for i in 0..self.inner.len() {
            match self.inner[i].direction {
                Direction::In => self.inner[i].valid = self.inner[i - 1].valid,
                Direction::Out => self.inner[i].ready = self.inner[i + 1].ready,
            }
        }
        let guard = |status: &StatusPort| {
            let found =
                |name| self.guard(status.port.owner, name).expect("a status counts during a declared port");
            status.during.map(found)
        };
        let (own, inner): (Vec<_>, Vec<_>) =
            (self.status.iter().map(guard).collect(), self.inner_status.iter().map(guard).collect());
        self.status.iter_mut().zip(own).for_each(|(status, guard)| status.guard = guard);
        self.inner_status.iter_mut().zip(inner).for_each(|(status, guard)| status.guard = guard);
    }

    /// The port that a unit calls so: its own, the valid of the link it takes, or the machine's.
    fn guard(&self, owner: &str, name: &str) -> Option<PortId> {
        let own = self.ports.iter().find(|port| port.owner == owner && port.name == name).map(|port| port.id);
        let taken = || {
            let mut links = self.inner.iter().filter(|link| link.owner == owner);
            links.find(|link| name.strip_suffix("_valid") == Some(link.name)).map(|link| link.valid)
        };
        let outside = || self.ports.iter().find(|port| port.name == name).map(|port| port.id);
        own.or_else(taken).or_else(outside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edgewalk_machine::units::{depth, pixel, tokens};
    use edgewalk_machine::{Link as Declared, Plan, Ready, UnitSpec};

    const PASS: UnitSpec = UnitSpec {
        name: "pass",
        purpose: "",
        section: 0,
        present: |_| true,
        wants: |_| Vec::new(),
        ports: |plan| {
            let link = |name| Declared {
                name,
                fields: tokens::fragment(plan),
                ready: Ready::Always,
                words: Vec::new(),
            };
            Ports { takes: Some(link("frag")), gives: Some(link("passed")), ..Ports::default() }
        },
        events: &[],
    };

    /// Between PIXEL and DEPTH, which both say `frag`, a unit that calls what it gives `passed`.
    #[test]
    fn a_link_has_its_two_ends_whatever_they_are_called() {
        let plan = Plan::default();
        let units = [&pixel::SPEC, &PASS, &depth::SPEC];
        let whole = Ports {
            takes: (pixel::SPEC.ports)(&plan).takes,
            status: Vec::new(),
            ..(depth::SPEC.ports)(&plan)
        };
        let mut interface = Interface::of_ports(Unit::MACHINE, &whole);
        for unit in units {
            interface.add_inner(Unit::of(unit), &(unit.ports)(&plan));
        }
        interface.find_guards();
        let at = |owner: &str, name: &str| interface.port(&format!("{owner}.{name}")).expect("a port").id;
        let ends: Vec<_> = interface.inner.iter().map(|link| (link.valid, link.ready)).collect();
        let (given, passed) = (at("pixel", "frag_valid"), at("pass", "passed_valid"));
        let (taken, read) = (at("pass", "frag_ready"), at("depth", "frag_ready"));
        assert_eq!(ends, [(given, taken), (given, taken), (passed, read), (passed, read)]);
        let hazard = interface.inner_status.iter().find(|status| status.port.name == "hazard");
        assert_eq!(hazard.expect("DEPTH tells it").guard, Some(passed));
    }
}
