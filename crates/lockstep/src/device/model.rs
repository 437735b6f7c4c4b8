//! The model's machine and units as devices.
//!
//! ```text
//!  port values ─> tokens ─> unit of the model ─> tokens ─> port values
//! ```
//! Ports and fields are found by name when a device is made; one that is declared and that the model lacks is an error
//! then. A unit's outputs are shown by the same code whether it runs alone or is looked at inside the machine. No unit is
//! named here but SETUP, which takes triangles.

mod link;
mod unit;
mod machine;

use super::Device;
use crate::interface::{Interface, Port};
use crate::values::PortValues;
use edgewalk_machine::Plan;
use edgewalk_model::alone::{Visit, alone};
use edgewalk_model::ports::Ported;
use edgewalk_model::setup::Setup;
use edgewalk_model::tokens::Sourced;
use edgewalk_model::{Events, View, for_channels};
use link::{Scope, Taker, TriangleTaker};
use unit::UnitDevice;

/// A declared port that the model has no place for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoPlace {
    /// The unit is not one of the model's.
    #[error("the model has no unit {0}")]
    Unit(String),
    /// The port, or the field of a token.
    #[error("{unit} of the model has no place for {port}")]
    Port {
        /// The unit.
        unit: String,
        /// The port.
        port: String,
    },
}

impl From<Box<Port>> for NoPlace {
    fn from(port: Box<Port>) -> NoPlace {
        NoPlace::Port { unit: port.owner.to_owned(), port: port.name }
    }
}

/// A unit of the model. Events count from here on.
pub trait ModelDevice: Device {
    /// What has happened so far.
    fn events(&self) -> &Events;

    /// Shows what is inside in the cycle with these inputs, before its clock edge; false: a unit alone, which is not shown.
    fn view(&self, ports: &PortValues, view: &mut View) -> bool {
        let _ = (ports, view);
        false
    }
}

/// The unit of the interface after reset, as the model has it.
///
/// # Errors
/// A declared port or field that the model lacks.
pub fn model(plan: &Plan, interface: &Interface) -> Result<Box<dyn ModelDevice + Send>, NoPlace> {
    for_channels!(plan, C => of::<C>(plan, interface))
}

fn of<const C: usize>(plan: &Plan, interface: &Interface) -> Result<Box<dyn ModelDevice + Send>, NoPlace> {
    let scope = Scope::alone(plan, interface);
    match interface.unit.name() {
        "machine" => Ok(Box::new(machine::MachineDevice::<C>::new(plan, interface)?)),
        "setup" => {
            let (unit, taker) = (Setup::<C>::new(plan), TriangleTaker::find(scope)?);
            Ok(Box::new(UnitDevice::new(unit, taker, scope)?))
        }
        other => alone::<C, _>(plan, other, scope).unwrap_or_else(|| Err(NoPlace::Unit(other.to_owned()))),
    }
}

impl<const C: usize> Visit<C> for Scope<'_> {
    type Out = Result<Box<dyn ModelDevice + Send>, NoPlace>;

    fn visit<U: Ported<C, Takes: Sourced> + 'static>(self, unit: U) -> Self::Out {
        Ok(Box::new(UnitDevice::new(unit, Taker::find(self)?, self)?))
    }
}
