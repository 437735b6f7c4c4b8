//! What a unit of the machine declares.

use crate::channel::Channel;
use crate::field::Field;
use crate::link::{Held, Link, MemoryPort, Status};
use crate::machine::Machine;
use crate::plan::Plan;

/// A corner or hazard that a unit can meet, and that a suite has to.
#[derive(Clone, Copy)]
pub struct Event {
    /// Name in reports and manifests.
    pub name: &'static str,
    /// What happens.
    pub doc: &'static str,
    /// Whether the event can happen in this machine.
    pub can_happen: fn(&Plan) -> bool,
}

/// Declares the events of a unit, each with what it counts and the machines in which it can happen, and the
/// struct that counts them.
macro_rules! events {
    ($($name:ident = $doc:literal if $can_happen:expr;)*) => {
        pub(crate) const EVENTS: &[crate::unit::Event] =
            &[$(crate::unit::Event { name: stringify!($name), doc: $doc, can_happen: $can_happen }),*];

        /// How often each event of the unit was met.
        #[derive(Clone, Debug, Default, PartialEq, Eq)]
        pub struct Events { $(#[doc = $doc] pub $name: u64,)* }

        impl Events {
            pub(super) fn counts(&self) -> Vec<(&'static str, u64)> {
                vec![$((stringify!($name), self.$name)),*]
            }

            pub(super) fn merge(&mut self, other: &Events) {
                $(self.$name += other.$name;)*
                let _ = other; // a unit may have no event
            }
        }
    };
}
pub(crate) use events;

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
    /// Name of the unit in files, modules, suites and documents.
    pub name: &'static str,
    /// What it does, in a line.
    pub purpose: &'static str,
    /// Section of `docs/machine.md`.
    pub section: u32,
    /// The machine has it.
    pub present: fn(&Plan) -> bool,
    /// The channels it wants interpolated.
    pub wants: fn(&Machine) -> Vec<Channel>,
    /// Ports of the unit.
    pub ports: fn(&Plan) -> Ports,
    /// What can happen to it.
    pub events: &'static [Event],
}

/// The input by which a pass is the light's own, of the units that ask for it.
pub(crate) fn light_pass(plan: &Plan) -> Option<Field> {
    let doc = "1: draw the light's map, 0: draw the picture";
    plan.shadow.draws_map().then(|| Field::count("light_pass", 1, doc))
}

/// For what every machine has, or can meet.
pub(crate) fn always(_: &Plan) -> bool {
    true
}
