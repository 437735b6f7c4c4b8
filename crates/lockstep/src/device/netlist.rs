//! A netlist in the interpreter as a device.

use super::Device;
use crate::ports::Interface;
use edgewalk_netlist::{InputId, Netlist, SignalId, Simulator};
use rand::{RngCore, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A netlist whose ports are those of an interface, after a clock of reset.
#[derive(Clone, Debug)]
pub struct NetlistDevice {
    simulator: Simulator,
    rst: Option<InputId>,
    inputs: Vec<InputId>,
    outputs: Vec<SignalId>,
}

/// A port of the interface that the netlist does not have so.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PortError {
    /// Missing.
    #[error("module {module} has no {direction} {port}")]
    Missing {
        /// The netlist.
        module: String,
        /// `input` or `output`.
        direction: &'static str,
        /// The port.
        port: String,
    },
    /// Of another width.
    #[error("module {module}: {port} has {found} bits, the interface {wanted}")]
    Width {
        /// The netlist.
        module: String,
        /// The port.
        port: String,
        /// Its width.
        found: u32,
        /// The width it should have.
        wanted: u32,
    },
}

impl NetlistDevice {
    /// Finds every port and resets the netlist.
    ///
    /// # Errors
    /// A port that is missing or of another width.
    pub fn new(netlist: &Netlist, interface: &Interface) -> Result<Self, PortError> {
        let simulator = Simulator::new(netlist);
        let missing = |direction, port: &str| PortError::Missing {
            module: netlist.name.clone(),
            direction,
            port: port.to_owned(),
        };
        let check = |port: &str, found: u32, wanted: u32| {
            if found == wanted {
                return Ok(());
            }
            Err(PortError::Width { module: netlist.name.clone(), port: port.to_owned(), found, wanted })
        };
        let mut inputs = Vec::new();
        for (port, width) in interface.inputs() {
            let place = netlist.inputs.iter().find(|input| input.name == port);
            let found = place.ok_or_else(|| missing("input", &port))?;
            check(&port, netlist.width(found.node), width)?;
            inputs.push(simulator.input(&port).map_err(|_| missing("input", &port))?);
        }
        let mut outputs = Vec::new();
        for (port, width) in interface.outputs() {
            let place = netlist.outputs.iter().find(|output| output.name == port);
            let found = place.ok_or_else(|| missing("output", &port))?;
            check(&port, netlist.width(found.driver), width)?;
            outputs.push(simulator.signal(&port).map_err(|_| missing("output", &port))?);
        }
        let rst = simulator.input("rst").ok();
        let mut device = NetlistDevice { simulator, rst, inputs, outputs };
        device.reset();
        Ok(device)
    }

    /// A clock with `rst` high.
    pub fn reset(&mut self) {
        if let Some(rst) = self.rst {
            self.simulator.set(rst, 1);
            self.simulator.tick();
            self.simulator.set(rst, 0);
        }
    }

    /// So many cycles of random inputs.
    pub fn disturb(&mut self, cycles: u64) {
        let mut random = Pcg64Mcg::seed_from_u64(cycles);
        for _ in 0..cycles {
            for input in &self.inputs {
                let value = u128::from(random.next_u64()) << 64 | u128::from(random.next_u64());
                self.simulator.set(*input, value);
            }
            self.simulator.tick();
        }
    }

    /// Drives the inputs and gives the outputs of this cycle, before the clock edge.
    pub fn settle(&mut self, inputs: &[u128], outputs: &mut Vec<u128>) {
        for (input, value) in self.inputs.iter().zip(inputs) {
            self.simulator.set(*input, *value);
        }
        outputs.clear();
        outputs.extend(self.outputs.iter().map(|output| self.simulator.value(*output)));
    }

    /// The clock edge.
    pub fn clock(&mut self) {
        self.simulator.tick();
    }

    /// The running netlist, for a look inside.
    pub fn simulator(&mut self) -> &mut Simulator {
        &mut self.simulator
    }
}

impl Device for NetlistDevice {
    fn cycle(&mut self, inputs: &[u128], outputs: &mut Vec<u128>) {
        self.settle(inputs, outputs);
        self.clock();
    }
}
