//! What a bench can drive: the model's machine and units, and netlists, all by the same list of port values.

mod model;
mod netlist;

pub use model::model;
pub use netlist::{NetlistDevice, PortError};

/// A clocked design behind an [`crate::Interface`].
pub trait Device {
    /// One clock cycle: takes the inputs in the order of [`crate::Interface::inputs`], gives the outputs of the same
    /// cycle in the order of [`crate::Interface::outputs`], and then does the clock edge.
    fn cycle(&mut self, inputs: &[u128], outputs: &mut Vec<u128>);
}
