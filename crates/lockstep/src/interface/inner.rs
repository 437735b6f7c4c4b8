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

    /// Finds the ports that say whether another counts, and of a link between units the end that belongs to the other.
    pub(super) fn find_guards(&mut self) {
        for i in 0..self.inner.len() {
            let (owner, name) = (self.inner[i].owner, self.inner[i].name);
            let end =
                |what: &str| self.anywhere(owner, &format!("{name}_{what}")).expect("a link has two ends");
            (self.inner[i].valid, self.inner[i].ready) = (end("valid"), end("ready"));
        }
        let guard = |status: &StatusPort| {
            let found = |name| {
                self.anywhere(status.port.owner, name).expect("a status counts during a declared port")
            };
            status.during.map(found)
        };
        let (own, inner): (Vec<_>, Vec<_>) =
            (self.status.iter().map(guard).collect(), self.inner_status.iter().map(guard).collect());
        self.status.iter_mut().zip(own).for_each(|(status, guard)| status.guard = guard);
        self.inner_status.iter_mut().zip(inner).for_each(|(status, guard)| status.guard = guard);
    }

    /// The port of that name: of the unit itself, of another, or of the machine.
    fn anywhere(&self, owner: &str, name: &str) -> Option<PortId> {
        let named = |port: &&super::Port| port.name == name;
        let own = self.ports.iter().filter(named).find(|port| port.owner == owner);
        own.or_else(|| self.ports.iter().rfind(named)).map(|port| port.id)
    }
}
