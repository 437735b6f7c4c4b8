//! The outputs that are compared in every cycle.

use crate::bench::Slot;
use crate::ports::{Direction, Interface};

/// One of them.
#[derive(Clone, Debug)]
pub struct StatusPort {
    /// Its place among the outputs.
    pub place: usize,
    /// The port.
    pub port: String,
    /// Bits.
    pub width: u32,
    /// A flag that means something only while this other port is 1; it counts as 0 while not.
    during: Option<(&'static str, Place)>,
}

/// A place among the unit's ports.
#[derive(Clone, Copy, Debug)]
enum Place {
    Input(usize),
    Output(usize),
}

/// Readies of channels in (where they are defined without a valid), valids of channels out, status ports.
#[must_use]
pub fn status_ports(interface: &Interface) -> Vec<StatusPort> {
    let (inputs, outputs) = (interface.inputs(), interface.outputs());
    let place_of = |name: &'static str| {
        let at = |ports: &[(String, u32)]| ports.iter().position(|(port, _)| port == name);
        let place = at(&outputs).map(Place::Output).or_else(|| at(&inputs).map(Place::Input));
        place.map(|place| (name, place))
    };
    let port = |place: usize, during| {
        let (port, width) = outputs[place].clone();
        StatusPort { place, port, width, during }
    };
    let slots = Slot::of(interface);
    let handshakes = interface.channels.iter().zip(&slots);
    let handshakes =
        handshakes.filter(|(channel, _)| channel.direction == Direction::Out || channel.ready_always);
    let handshakes = handshakes.map(|(_, slot)| port(slot.output, None));
    let first_status = outputs.len() - interface.status.len();
    let status = interface.status.iter().zip(first_status..);
    let status = status.map(|(status, place)| port(place, status.during.and_then(place_of)));
    handshakes.chain(status).collect()
}

impl StatusPort {
    /// What counts of the port's value in a cycle with these values of all ports.
    #[must_use]
    pub fn value(&self, inputs: &[u128], outputs: &[u128]) -> u128 {
        let counts = match self.during {
            None => true,
            Some((_, Place::Input(place))) => inputs[place] == 1,
            Some((_, Place::Output(place))) => outputs[place] == 1,
        };
        if counts { outputs[self.place] } else { 0 }
    }

    /// The port that must be 1 for the value to mean something, if there is one.
    #[must_use]
    pub fn during(&self) -> Option<&'static str> {
        self.during.map(|(port, _)| port)
    }

    /// [`StatusPort::value`] in Verilog.
    #[must_use]
    pub fn expression(&self) -> String {
        match self.during {
            None => self.port.clone(),
            Some((other, _)) => format!("{other} && {}", self.port),
        }
    }
}
