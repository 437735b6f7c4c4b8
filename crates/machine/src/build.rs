//! Builds the checked machine from its keys and from what its units declare.

use crate::channel::Channel;
use crate::check::check;
use crate::error::MachineError;
use crate::field::Field;
use crate::link::MemoryPort;
use crate::machine::Machine;
use crate::plan::Plan;
use crate::stamp::PortStamp;
use crate::term::terms;
use crate::unit::{Event, Ports, UnitSpec};
use crate::units::{self, UNITS};

impl Machine {
    /// The machine with all that follows from its keys.
    ///
    /// # Errors
    /// The first combination of keys that cannot be built, with the reason and a value that would do.
    pub fn plan(&self) -> Result<Plan, MachineError> {
        // The depth, what the memory stores beside it, and then what only some machines have.
        let depth = (units::depth::SPEC.wants)(self).into_iter();
        let others = UNITS.iter().filter(|unit| unit.name != "depth").flat_map(|unit| (unit.wants)(self));
        let channels: Vec<Channel> = depth.chain(units::memory::wants(self)).chain(others).collect();
        check(self, &channels)?;
        let kt_bits = if self.has_triangle_kt() { self.blend.kt_bits } else { 0 };
        let port = PortStamp::of(self.guard_bits, self.subpixel_bits, &channels, kt_bits, &self.polygon);
        let terms = terms(self);
        Ok(Plan { machine: self.clone(), channels, terms, widths: self.widths(), port })
    }
}

impl Default for Plan {
    fn default() -> Self {
        #[allow(clippy::expect_used)]
        Machine::default().plan().expect("a test plans every preset")
    }
}

impl Plan {
    /// The preset of that name.
    #[must_use]
    pub fn preset(name: &str) -> Option<Plan> {
        Machine::preset(name).and_then(|machine| machine.plan().ok())
    }

    /// The units of this machine, in the order the data flows.
    pub fn units(&self) -> impl Iterator<Item = &'static UnitSpec> {
        UNITS.iter().copied().filter(|unit| (unit.present)(self))
    }

    /// What can happen in this machine: to its units in their order, then between them.
    pub fn events(&self) -> impl Iterator<Item = &'static Event> {
        let all = self.units().flat_map(|unit| unit.events).chain(units::machine::EVENTS);
        all.filter(|event| (event.can_happen)(self))
    }

    /// The memories that the host alone writes: the unit that reads each, and its ports; in the order of the
    /// units.
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
            status: units::machine::status(),
            ..Ports::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::presets::PRESETS;

    #[test]
    fn every_preset_can_be_planned() {
        for (name, _) in PRESETS {
            let machine = Machine::preset(name).expect("listed");
            assert!(machine.plan().is_ok(), "{name}");
        }
        assert_eq!(PRESETS.len(), 8);
    }
}
