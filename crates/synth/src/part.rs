//! What is synthesised: the machine, the units that draw, or one unit.

use edgewalk_machine::{Plan, UNITS, Unknown};
use edgewalk_netlist::{BuildErrors, Netlist};
use std::sync::Arc;

/// A part of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part(&'static str);

/// Why a part is not to be had.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UnknownPart {
    /// There is none of that name.
    #[error(transparent)]
    Name(#[from] Unknown),
    /// Other machines have it.
    #[error("this machine has no unit {0}")]
    Absent(&'static str),
}

/// Parts of more than one unit.
const WHOLE: &str = "machine";
const ENGINE: &str = "engine";

impl Part {
    /// All units.
    pub const MACHINE: Part = Part(WHOLE);

    /// Every name there is.
    pub fn names() -> impl Iterator<Item = &'static str> {
        [WHOLE, ENGINE].into_iter().chain(UNITS.iter().map(|unit| unit.name))
    }

    /// The part of that name.
    ///
    /// # Errors
    /// An unknown name, or a unit that this machine has not.
    pub fn named(name: &str, plan: &Plan) -> Result<Part, UnknownPart> {
        let Some(known) = Part::names().find(|known| *known == name) else {
            return Err(Unknown::new("unit", name, Part::names()).into());
        };
        match UNITS.iter().any(|unit| unit.name == known && !(unit.present)(plan)) {
            true => Err(UnknownPart::Absent(known)),
            false => Ok(Part(known)),
        }
    }

    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.0
    }

    /// Whether the part has several units.
    #[must_use]
    pub fn has_units(self) -> bool {
        [WHOLE, ENGINE].contains(&self.0)
    }

    pub(crate) fn netlist(self, plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
        match self.0 {
            ENGINE => edgewalk_rtl::engine(plan),
            name => edgewalk_rtl::units::builder(name).unwrap_or(edgewalk_rtl::machine)(plan),
        }
    }
}
