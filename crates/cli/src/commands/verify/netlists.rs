//! The netlists of a machine, each built once and run beside the model in every suite: as native code in a program that was
//! built with the feature jit, else in the interpreter.

use anyhow::{Result, anyhow};
use edgewalk_lockstep::{Agreement, Interface, LockstepError, NetlistDevice, Unit};
use edgewalk_machine::Plan;
use edgewalk_vectors::Trace;
use std::collections::BTreeMap;

#[cfg(feature = "jit")]
use edgewalk_jit::Simulator;
#[cfg(not(feature = "jit"))]
use edgewalk_netlist::Simulator;

/// By name of the unit, in the state before the first clock.
pub struct Netlists(BTreeMap<&'static str, NetlistDevice<Simulator>>);

impl Netlists {
    /// Builds the netlists of these units.
    pub fn of(machine: &Plan, units: impl Iterator<Item = Unit>) -> Result<Self> {
        let mut netlists = BTreeMap::new();
        for unit in units {
            if !netlists.contains_key(unit.name()) {
                netlists.insert(unit.name(), device(machine, unit)?);
            }
        }
        Ok(Netlists(netlists))
    }

    /// Runs the unit of the trace beside the model.
    ///
    /// # Panics
    /// If the unit is none of those given.
    pub fn beside(&self, trace: &Trace) -> Result<Agreement, LockstepError> {
        trace.lockstep_of(&mut self.0[trace.interface.unit.name()].clone())
    }
}

fn device(machine: &Plan, unit: Unit) -> Result<NetlistDevice<Simulator>> {
    let netlist =
        edgewalk_lockstep::netlist(machine, unit).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    #[cfg(feature = "jit")]
    let simulator = Simulator::new(&netlist)?;
    #[cfg(not(feature = "jit"))]
    let simulator = Simulator::new(&*netlist);
    Ok(NetlistDevice::run_by(simulator, &netlist, &Interface::new(machine, unit))?)
}
