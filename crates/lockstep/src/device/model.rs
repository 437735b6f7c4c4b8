//! The model's machine and units as devices.
//!
//! ```text
//!  port values ─> tokens ─> unit of the model ─> tokens ─> port values
//! ```
//! Ports and fields are found by name when a device is made; one that is declared and that the model lacks is an error
//! then. A unit's outputs are shown by the same code whether it runs alone or is looked at inside the machine.

mod link;
mod setup;
mod edge;
mod span;
mod term;
mod pixel;
mod texel;
mod bump;
mod normal;
mod lamp;
mod shade;
mod project;
mod shadow;
mod depth;
mod blend;
mod machine;

use super::Device;
use crate::interface::{Interface, Port};
use crate::values::PortValues;
use edgewalk_machine::Plan;
use edgewalk_model::{Events, View, for_channels};

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
pub fn model(plan: &Plan, interface: &Interface) -> Result<Box<dyn ModelDevice>, NoPlace> {
    for_channels!(plan, C => of::<C>(plan, interface))
}

fn of<const C: usize>(plan: &Plan, interface: &Interface) -> Result<Box<dyn ModelDevice>, NoPlace> {
    Ok(match interface.unit.name() {
        "machine" => Box::new(machine::MachineDevice::<C>::new(plan, interface)?),
        "setup" => Box::new(setup::SetupDevice::<C>::new(plan, interface)?),
        "edge" => Box::new(edge::EdgeDevice::<C>::new(plan, interface)?),
        "span" => Box::new(span::SpanDevice::<C>::new(plan, interface)?),
        "pixel" => Box::new(pixel::PixelDevice::<C>::new(plan, interface)?),
        "term" => Box::new(term::TermDevice::<C>::new(plan, interface)?),
        "texel" => Box::new(texel::TexelDevice::<C>::new(plan, interface)?),
        "bump" => Box::new(bump::BumpDevice::<C>::new(plan, interface)?),
        "normal" => Box::new(normal::NormalDevice::<C>::new(plan, interface)?),
        "lamp" => Box::new(lamp::LampDevice::<C>::new(plan, interface)?),
        "shade" => Box::new(shade::ShadeDevice::<C>::new(plan, interface)?),
        "project" => Box::new(project::ProjectDevice::<C>::new(plan, interface)?),
        "shadow" => Box::new(shadow::ShadowDevice::<C>::new(plan, interface)?),
        "depth" => Box::new(depth::DepthDevice::<C>::new(plan, interface)?),
        "blend" => Box::new(blend::BlendDevice::<C>::new(plan, interface)?),
        other => return Err(NoPlace::Unit(other.to_owned())),
    })
}
