//! The frame memory behind the machine, outside the datapath (`docs/machine.md`, section 7).

use crate::channel::{Channel, Kind};
use crate::machine::Machine;

/// Names of the channels that the user adds.
pub const EXTRA: [&str; 4] = ["e0", "e1", "e2", "e3"];

/// The channels it stores beside the depth: red, green, blue, then the user's own.
pub(crate) fn wants(machine: &Machine) -> Vec<Channel> {
    let colours = ["r", "g", "b"].map(|name| Channel { name, kind: Kind::Unorm, precision: machine.color });
    let extras = EXTRA.into_iter().zip(machine.extras).take(machine.extra as usize);
    let extras = extras.map(|(name, e)| Channel { name, kind: e.kind, precision: e.precision });
    colours.into_iter().chain(extras).collect()
}
