//! What the rig can drive: the model's machine and units, netlists, and whatever else has the same ports.

mod tokens;
mod triangles;
mod model;
mod netlist;

pub use model::{ModelDevice, NoPlace, model};
pub use netlist::{NetlistDevice, PortError, netlist};
pub use triangles::Triangles;

use crate::values::PortValues;

/// A clocked design behind an [`crate::Interface`].
pub trait Device {
    /// One clock cycle: takes the inputs, gives the outputs of the same cycle, and then does the clock edge.
    fn cycle(&mut self, ports: &mut PortValues);
}
