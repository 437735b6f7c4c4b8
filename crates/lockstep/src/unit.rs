//! What is compared: a unit that the machine declares, or the machine as a whole.

use edgewalk_machine::{Event, Plan, Ports, UNITS, UnitSpec, Unknown};
use std::fmt;

/// A declared unit, or the whole machine.
#[derive(Clone, Copy)]
pub struct Unit(Option<&'static UnitSpec>);

impl Unit {
    /// All units of a machine together.
    pub const MACHINE: Unit = Unit(None);

    /// A declared unit.
    #[must_use]
    pub const fn of(spec: &'static UnitSpec) -> Unit {
        Unit(Some(spec))
    }

    /// The whole first, then every unit that any machine has, in the order the data flows.
    pub fn known() -> impl Iterator<Item = Unit> + Clone {
        std::iter::once(Unit::MACHINE).chain(UNITS.iter().map(|spec| Unit(Some(spec))))
    }

    /// The whole first, then the units of this machine, in the order the data flows.
    #[must_use]
    pub fn all(plan: &Plan) -> Vec<Unit> {
        std::iter::once(Unit::MACHINE).chain(plan.units().map(|spec| Unit(Some(spec)))).collect()
    }

    /// The units of this machine, without the whole.
    #[must_use]
    pub fn single(plan: &Plan) -> Vec<Unit> {
        Unit::all(plan).split_off(1)
    }

    /// The unit of that name.
    ///
    /// # Errors
    /// An unknown name.
    pub fn named(name: &str) -> Result<Unit, Unknown> {
        let unit = Unit::known().find(|unit| unit.name() == name);
        unit.ok_or_else(|| Unknown::new("unit", name, Unit::known().map(Unit::name)))
    }

    /// The word for it, in files and directories.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.0.map_or("machine", |spec| spec.name)
    }

    /// Name of its Verilog module.
    #[must_use]
    pub fn module(self) -> String {
        self.0.map_or_else(|| "edgewalk".to_owned(), |spec| format!("edgewalk_{}", spec.name))
    }

    /// What it declares.
    #[must_use]
    pub fn ports(self, plan: &Plan) -> Ports {
        self.0.map_or_else(|| plan.ports(), |spec| (spec.ports)(plan))
    }

    /// What can happen to it in this machine; to the machine all of it, and what happens between units.
    #[must_use]
    pub fn events(self, plan: &Plan) -> Vec<&'static Event> {
        let possible = |event: &&'static Event| (event.can_happen)(plan);
        match self.0 {
            None => plan.events().collect(),
            Some(spec) => spec.events.iter().filter(possible).collect(),
        }
    }
}

impl PartialEq for Unit {
    fn eq(&self, other: &Unit) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Unit {}

impl fmt::Debug for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
