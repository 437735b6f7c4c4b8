//! What a unit of the machine declares.

use crate::channel::Channel;
use crate::field::Field;
use crate::link::{Held, Link, MemoryPort, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::units::{self, UNITS};

/// A corner or hazard that a unit can meet, and that a suite has to.
#[derive(Clone, Copy)]
pub struct Event {
    /// Name in reports and manifests.
    pub name: &'static str,
    /// What happens.
    pub doc: &'static str,
    /// It can happen in this machine.
    pub can_happen: fn(&Plan) -> bool,
}

/// All ports of a unit but `clk` and `rst`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ports {
    /// Where its tokens come from.
    pub takes: Option<Link>,
    /// Where its tokens go.
    pub gives: Option<Link>,
    /// What else it gives, out of the machine: writes of a memory that the link it gives does not write.
    pub writes: Vec<Link>,
    /// Values of another unit that hold beside the tokens it takes.
    pub held_in: Vec<Held>,
    /// Values that it holds beside the tokens it gives.
    pub held_out: Vec<Held>,
    /// Memories behind it.
    pub memory: Vec<MemoryPort>,
    /// Inputs that hold one value over a whole run.
    pub constants: Vec<Field>,
    /// Inputs of one bit that may change in any cycle.
    pub levels: Vec<Field>,
    /// Outputs that mean something in every cycle.
    pub status: Vec<Status>,
}

/// One unit of the machine, said once.
pub struct UnitSpec {
    /// Its name in files, modules, suites and documents.
    pub name: &'static str,
    /// What it does, in a line.
    pub purpose: &'static str,
    /// Its section of `docs/machine.md`.
    pub section: u32,
    /// The machine has it.
    pub present: fn(&Plan) -> bool,
    /// The channels it wants interpolated.
    pub wants: fn(&Machine) -> Vec<Channel>,
    /// Its ports.
    pub ports: fn(&Plan) -> Ports,
    /// What can happen to it.
    pub events: &'static [Event],
}

impl Plan {
    /// The units of this machine, in the order the data flows.
    pub fn units(&self) -> impl Iterator<Item = &'static UnitSpec> {
        UNITS.iter().copied().filter(|unit| (unit.present)(self))
    }

    /// What can happen in this machine: to its units in their order, then between them.
    pub fn events(&self) -> impl Iterator<Item = &'static Event> {
        let all = self.units().flat_map(|unit| unit.events).chain(units::EVENTS);
        all.filter(|event| (event.can_happen)(self))
    }

    /// The memories that the host alone writes: the unit that reads each, and its ports; in the order of the units.
    #[must_use]
    pub fn word_memories(&self) -> Vec<(&'static str, MemoryPort)> {
        let of_unit = |unit: &'static UnitSpec| {
            let memories = (unit.ports)(self).memory.into_iter();
            memories.filter(|memory| memory.write.is_empty()).map(|memory| (unit.name, memory))
        };
        self.units().flat_map(of_unit).collect()
    }

    /// The ports of the whole machine: what its units have and do not join among themselves.
    #[must_use]
    pub fn ports(&self) -> Ports {
        let all: Vec<Ports> = self.units().map(|unit| (unit.ports)(self)).collect();
        let mut constants: Vec<Field> = Vec::new();
        for field in all.iter().flat_map(|ports| &ports.constants) {
            // An input that several units have is one of the machine.
            if !constants.contains(field) {
                constants.push(field.clone());
            }
        }
        Ports {
            takes: all.first().and_then(|ports| ports.takes.clone()),
            gives: all.last().and_then(|ports| ports.gives.clone()),
            writes: all.iter().flat_map(|ports| ports.writes.clone()).collect(),
            memory: all.iter().flat_map(|ports| ports.memory.clone()).collect(),
            constants,
            status: units::machine_status(),
            ..Ports::default()
        }
    }
}
