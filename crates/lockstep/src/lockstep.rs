//! Model against netlist, every port in every cycle, and the first difference told in full.

use crate::bench::{Bench, Slot};
use crate::capture::Trace;
use crate::device::{Device, NetlistDevice, PortError, model};
use crate::ports::{Direction, Interface, Unit};
use crate::status::{StatusPort, status_ports};
use edgewalk_netlist::Netlist;
use std::fmt;

/// Two descriptions agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Agreement {
    /// Cycles compared.
    pub cycles: u64,
    /// Port values compared: fields where their valid is high, handshakes and status in every cycle.
    pub compared: u64,
}

/// The first port that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// What was compared.
    pub unit: Unit,
    /// The port.
    pub port: String,
    /// The cycle.
    pub cycle: u64,
    /// What the model says.
    pub expected: u128,
    /// What the netlist says.
    pub found: u128,
    /// The triangle whose token the model moves there, or moved last at this channel.
    pub triangle: Option<u32>,
    /// Column and line, where the token has an address.
    pub pixel: Option<(u64, u64)>,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Difference { unit, port, cycle, expected, found, triangle, pixel } = self;
        write!(f, "{} {port}, cycle {cycle}: expected {expected:#x}, found {found:#x}", unit.name())?;
        if let Some(triangle) = triangle {
            write!(f, ", triangle {triangle}")?;
        }
        if let Some((x, y)) = pixel {
            write!(f, ", pixel ({x}, {y})")?;
        }
        Ok(())
    }
}

/// How a comparison ends without agreement.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LockstepError {
    /// The netlist does not have the ports.
    #[error(transparent)]
    Ports(#[from] PortError),
    /// A port differs.
    #[error("{difference}")]
    Differs {
        /// Where and how.
        difference: Box<Difference>,
        /// Port values compared until then, in this run.
        compared: u64,
    },
    /// Nothing would be compared.
    #[error("nothing to compare: the model gives no token")]
    Vacuous,
}

/// Cycles that follow the last event of the model: what comes too much would come here.
const AFTER: u64 = 64;
/// Cycles of the runs that a reset ends, before the one that counts.
const CUT_SHORT: [u64; 6] = [2, 13, 40, 113, 290, 611];

impl Trace {
    /// The port values that a lock-step over the whole trace has to compare.
    #[must_use]
    pub fn port_values(&self) -> u64 {
        let always = (self.cycles + AFTER) * status_ports(&self.interface).len() as u64;
        let channels = self.interface.channels.iter().zip(&self.valid_cycles);
        let values = channels.map(|(channel, valid)| match (channel.direction, channel.ready_always) {
            (Direction::Out, _) => channel.fields.len() as u64 * valid,
            (Direction::In, true) => 0,
            (Direction::In, false) => *valid,
        });
        always + values.sum::<u64>()
    }
}

/// Runs the netlist of the trace's unit beside the model, under the bench of the trace.
///
/// Before the run that counts come some that a reset cuts short, in the midst of the trace and of random inputs: so that
/// nothing is taken for reset that only was 0 before.
///
/// # Errors
/// The first difference.
pub fn lockstep(trace: &Trace, netlist: &Netlist) -> Result<Agreement, LockstepError> {
    if trace.tokens_out() == 0 {
        return Err(LockstepError::Vacuous);
    }
    let mut device = NetlistDevice::new(netlist, &trace.interface)?;
    for cycles in CUT_SHORT {
        device.disturb(cycles);
        device.reset();
        compare(trace, &mut device, cycles)?;
        device.reset();
    }
    compare(trace, &mut device, trace.cycles + AFTER)
}

/// A device after reset beside a fresh model, for so many cycles.
fn compare(trace: &Trace, device: &mut NetlistDevice, cycles: u64) -> Result<Agreement, LockstepError> {
    let interface = &trace.interface;
    let ports = Ports::of(interface);
    let mut reference = model(&trace.machine, interface.unit);
    let mut bench = Bench::new(interface, trace.setting.clone());
    let (mut expected, mut found) = (Vec::new(), Vec::new());
    let mut compared = 0;
    while bench.cycle() < cycles {
        let inputs = bench.inputs();
        reference.cycle(inputs, &mut expected);
        device.cycle(inputs, &mut found);
        compared += ports.always.len() as u64;
        let differs =
            ports.always.iter().find(|port| port.value(inputs, &expected) != port.value(inputs, &found));
        let mut differs = differs.map(|port| port.place);
        let offers = |slot: &&Slot| slot.direction == Direction::Out && slot.valid(inputs, &expected);
        for slot in ports.slots.iter().filter(offers) {
            let fields = slot.output + 1..=slot.output + slot.fields;
            compared += slot.fields as u64;
            differs = differs.or_else(|| fields.into_iter().find(|place| expected[*place] != found[*place]));
        }
        for (slot, valid) in &ports.while_valid {
            if inputs[*valid] == 1 {
                compared += 1;
                differs = differs.or_else(|| (expected[*slot] != found[*slot]).then_some(*slot));
            }
        }
        if let Some(place) = differs {
            let at = bench.cycle();
            let difference = Box::new(difference(trace, place, at, &expected, &found));
            return Err(LockstepError::Differs { difference, compared });
        }
        bench.clock(&expected);
    }
    Ok(Agreement { cycles: bench.cycle(), compared })
}

/// Which outputs are compared when.
struct Ports {
    /// In every cycle.
    always: Vec<StatusPort>,
    /// Readies that count only while the valid at the second place, among the inputs, is high.
    while_valid: Vec<(usize, usize)>,
    slots: Vec<Slot>,
}

impl Ports {
    fn of(interface: &Interface) -> Ports {
        let slots = Slot::of(interface);
        let sometimes = interface.channels.iter().zip(&slots).filter(|(c, _)| !c.ready_always);
        Ports {
            always: status_ports(interface),
            while_valid: sometimes.map(|(_, slot)| (slot.output, slot.input)).collect(),
            slots,
        }
    }
}

fn difference(trace: &Trace, place: usize, cycle: u64, expected: &[u128], found: &[u128]) -> Difference {
    let interface = &trace.interface;
    let slots = Slot::of(interface);
    let channel = slots.iter().rposition(|slot| slot.output <= place).unwrap_or(0);
    let moved = &trace.channels[channel];
    // The first token that moves in this cycle or later, else the last there is.
    let token = moved.cycles.partition_point(|moved| *moved < cycle);
    let triangle = moved.triangles.get(token).or(moved.triangles.last()).copied();
    let address = interface.channels[channel].field("addr").map(|field| slots[channel].output + 1 + field);
    let x_bits = trace.machine.widths().x;
    let offered = slots[channel].direction == Direction::Out && expected[slots[channel].output] == 1;
    let pixel = address.filter(|_| offered).map(|place| {
        let address = expected[place] as u64; // at most 26 bits
        (address & ((1 << x_bits) - 1), address >> x_bits)
    });
    Difference {
        unit: interface.unit,
        port: interface.outputs()[place].0.clone(),
        cycle,
        expected: expected[place],
        found: found[place],
        triangle,
        pixel,
    }
}
