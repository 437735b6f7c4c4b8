//! The machine's netlist as native code, behind the ports that the rig drives.

use anyhow::{Result, anyhow};
use edgewalk_jit::{InputId, OutputId, Simulator};
use edgewalk_lockstep::{Device, Interface, PortId, PortValues, Unit};
use edgewalk_machine::Plan;

/// A compiled netlist after a clock of reset. The outputs inside the machine are not given: no picture needs them.
pub struct Native {
    simulator: Simulator,
    rst: InputId,
    inputs: Vec<(PortId, InputId)>,
    outputs: Vec<(PortId, OutputId)>,
}

impl Native {
    /// Compiles the machine.
    pub fn new(machine: &Plan) -> Result<Self> {
        let netlist =
            edgewalk_rtl::machine(machine).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
        let mut simulator = Simulator::new(&netlist)?;
        let interface = Interface::new(machine, Unit::MACHINE);
        let inputs = interface.inputs().iter().map(|port| Ok((port.id, simulator.input(&port.name)?)));
        let inputs = inputs.collect::<Result<_>>()?;
        let outputs = interface.outputs().iter().map(|port| Ok((port.id, simulator.output(&port.name)?)));
        let outputs = outputs.collect::<Result<_>>()?;
        let rst = simulator.input("rst")?;
        simulator.set(rst, 1);
        simulator.tick();
        Ok(Native { simulator, rst, inputs, outputs })
    }
}

impl Device for Native {
    fn cycle(&mut self, ports: &mut PortValues) {
        self.simulator.set(self.rst, ports.rst.into());
        for (port, input) in &self.inputs {
            self.simulator.set(*input, ports[*port]);
        }
        self.simulator.tick();
        for (port, output) in &self.outputs {
            ports[*port] = self.simulator.sampled(*output);
        }
    }
}
