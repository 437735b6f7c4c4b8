//! A netlist as a device: in the interpreter, or whatever else runs it.

use super::Device;
use crate::interface::{Interface, Port};
use crate::rig::bits;
use crate::unit::Unit;
use crate::values::PortValues;
use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildErrors, Netlist, Simulate, Simulator};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

/// The netlist of the machine or of one of its units. It has a clock and a reset: DITHER alone may need none.
///
/// # Errors
/// None for a unit of the machine.
pub fn netlist(plan: &Plan, unit: Unit) -> Result<Arc<Netlist>, BuildErrors> {
    if unit == Unit::MACHINE {
        return edgewalk_rtl::machine(plan);
    }
    let build = edgewalk_rtl::units::builder(unit.name());
    Ok(build.expect("a test of rtl finds a builder for every declared unit")(plan)?.clocked())
}

/// A netlist whose ports are those of an interface, after a clock of reset.
#[derive(Clone, Debug)]
pub struct NetlistDevice<S: Simulate = Simulator> {
    simulator: S,
    rst: Option<S::Input>,
    /// Each with the number of its port.
    inputs: Vec<(usize, S::Input)>,
    /// Bits of the inputs.
    widths: Vec<u32>,
    outputs: Vec<(usize, S::Signal)>,
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
        /// Width of the port.
        found: u32,
        /// The width it should have.
        wanted: u32,
    },
    /// Of the netlist, but not of the interface.
    #[error("module {module} has a port {port} that nobody declares")]
    Undeclared {
        /// The netlist.
        module: String,
        /// The port.
        port: String,
    },
}

impl NetlistDevice {
    /// The netlist in the interpreter.
    ///
    /// # Errors
    /// As [`NetlistDevice::run_by`].
    pub fn new(netlist: &Netlist, interface: &Interface) -> Result<Self, PortError> {
        NetlistDevice::run_by(Simulator::new(netlist), netlist, interface)
    }
}

impl<S: Simulate> NetlistDevice<S> {
    /// Finds every port of a netlist that `simulator` runs, and resets it.
    ///
    /// # Errors
    /// A port that is missing, of another width, or too much.
    pub fn run_by(simulator: S, netlist: &Netlist, interface: &Interface) -> Result<Self, PortError> {
        let module = || netlist.name.clone();
        let known =
            |name: &str| interface.inputs().iter().chain(interface.outputs()).any(|port| port.name == name);
        let names =
            netlist.inputs.iter().map(|input| &input.name).chain(netlist.outputs.iter().map(|o| &o.name));
        if let Some(port) = names.into_iter().find(|name| !known(name)) {
            return Err(PortError::Undeclared { module: module(), port: port.clone() });
        }
        let missing =
            |direction, port: &str| PortError::Missing { module: module(), direction, port: port.to_owned() };
        let check = |port: &Port, found: u32| match port.width() {
            wanted if wanted == found => Ok(()),
            wanted => Err(PortError::Width { module: module(), port: port.name.clone(), found, wanted }),
        };
        let mut inputs = Vec::new();
        for port in interface.inputs() {
            let place = netlist.inputs.iter().find(|input| input.name == port.name);
            let found = place.ok_or_else(|| missing("input", &port.name))?;
            check(port, netlist.width(found.node))?;
            let input = simulator.input(&port.name).map_err(|_| missing("input", &port.name))?;
            inputs.push((port.id.0, input));
        }
        let mut outputs = Vec::new();
        let inner = |port: &Port| format!("u_{}.{}", port.owner, port.name);
        let own = interface.outputs().iter().map(|port| (port, port.name.clone()));
        for (port, path) in own.chain(interface.inner_outputs().iter().map(|port| (port, inner(port)))) {
            let signal = simulator.signal(&path).map_err(|_| missing("output", &path))?;
            check(port, simulator.width(signal))?;
            outputs.push((port.id.0, signal));
        }
        let rst = simulator.input("rst").ok();
        let widths = interface.inputs().iter().map(Port::width).collect();
        let mut device = NetlistDevice { simulator, rst, inputs, widths, outputs };
        device.reset();
        Ok(device)
    }

    /// A clock with `rst` high.
    pub fn reset(&mut self) {
        self.set_reset(true);
        self.simulator.tick();
        self.set_reset(false);
    }

    fn set_reset(&mut self, rst: bool) {
        if let Some(input) = self.rst {
            self.simulator.set(input, rst.into());
        }
    }

    /// So many cycles of random inputs: registers are left in one state or another.
    pub fn disturb(&mut self, cycles: u64) {
        let mut random = Pcg64Mcg::seed_from_u64(cycles);
        for _ in 0..cycles {
            for ((_, input), width) in self.inputs.iter().zip(&self.widths) {
                self.simulator.set(*input, bits(&mut random, *width));
            }
            self.simulator.tick();
        }
    }

    /// Drives the inputs and gives the outputs of this cycle, before the clock edge.
    pub fn settle(&mut self, ports: &mut PortValues) {
        self.set_reset(ports.rst);
        self.simulator.exchange(&self.inputs, &self.outputs, ports.all_mut());
    }

    /// The clock edge.
    pub fn clock(&mut self) {
        self.simulator.tick();
    }

    /// The running netlist, for a look inside.
    pub fn simulator(&mut self) -> &mut S {
        &mut self.simulator
    }
}

impl<S: Simulate> Device for NetlistDevice<S> {
    fn cycle(&mut self, ports: &mut PortValues) {
        self.settle(ports);
        self.clock();
    }
}
