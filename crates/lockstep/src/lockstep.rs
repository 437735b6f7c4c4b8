//! Two devices under one rig, every port in every cycle.

use crate::UnknownConstant;
use crate::compare::{Comparison, Difference, Follower};
use crate::device::{Device, NetlistDevice, NoPlace, PortError, model};
use crate::interface::Interface;
use crate::rig::{Rig, Setting};
use crate::values::PortValues;
use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildErrors, Simulate};

/// Two descriptions agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Agreement {
    /// Cycles compared.
    pub cycles: u64,
    /// Port values compared: fields where their valid is high, handshakes and status in every cycle.
    pub compared: u64,
}

/// How a comparison ends without agreement.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LockstepError {
    /// The netlist cannot be built.
    #[error("the netlist cannot be built: {0}")]
    Build(#[from] BuildErrors),
    /// The netlist does not have the ports.
    #[error(transparent)]
    Ports(#[from] PortError),
    /// The model does not.
    #[error(transparent)]
    Model(#[from] NoPlace),
    /// A constant that nobody sets.
    #[error(transparent)]
    Constant(#[from] UnknownConstant),
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
    /// The device did not come to rest.
    #[error("still busy after {0} cycles")]
    Busy(u64),
}

/// A reference and a device in the middle of a run.
pub struct Lockstep<'a> {
    interface: &'a Interface,
    /// What drives both.
    pub rig: Rig,
    comparison: Comparison,
    follower: Follower,
    expected: PortValues,
    found: PortValues,
    /// Port values compared so far.
    pub compared: u64,
}

impl<'a> Lockstep<'a> {
    /// Before cycle 0.
    #[must_use]
    pub fn new(plan: &Plan, interface: &'a Interface, setting: Setting) -> Lockstep<'a> {
        Lockstep {
            interface,
            rig: Rig::new(interface, setting),
            comparison: Comparison::new(interface),
            follower: Follower::new(interface, plan.widths().x),
            expected: interface.values(),
            found: interface.values(),
            compared: 0,
        }
    }

    /// One cycle of both; true if any token moved.
    ///
    /// # Errors
    /// The first port that differs.
    pub fn cycle(
        &mut self,
        reference: &mut dyn Device,
        device: &mut dyn Device,
    ) -> Result<bool, LockstepError> {
        self.rig.drive(&mut self.expected);
        self.found.copy_inputs(&self.expected);
        reference.cycle(&mut self.expected);
        device.cycle(&mut self.found);
        self.follower.see(&self.expected);
        let differs = self.comparison.first_difference(&self.expected, &self.found, &mut self.compared);
        if let Some(port) = differs {
            let (port, cycle) = (self.interface.at(port), self.rig.cycle());
            let difference = self.follower.tell(port, cycle, &self.expected, &self.found);
            return Err(LockstepError::Differs { difference: Box::new(difference), compared: self.compared });
        }
        Ok(self.rig.clock(&self.expected))
    }

    /// What the reference had at its ports in the last cycle.
    #[must_use]
    pub fn ports(&self) -> &PortValues {
        &self.expected
    }
}

/// Cycles of random inputs and of a run behind them, each ended by a reset, before the run that counts: long ones behind short ones, so
/// that a run is there to see what the inputs left half done.
const CUT_SHORT: [(u64, u64); 6] = [(611, 2), (290, 13), (113, 40), (40, 113), (13, 290), (2, 611)];

/// Like `CUT_SHORT`, of one more where LAMP is: only behind its 1024 words it has work that a reset can end.
const CUT_SHORT_OF_LAMP: (u64, u64) = (290, 1327);

/// Runs a netlist beside the model for so many cycles.
///
/// Before the run that counts come some that a reset cuts short, in the midst of the work and of random inputs: so that
/// nothing is taken for reset that only was 0 before.
///
/// # Errors
/// The first difference.
pub fn lockstep(
    plan: &Plan,
    interface: &Interface,
    setting: &Setting,
    cycles: u64,
    device: &mut NetlistDevice<impl Simulate>,
) -> Result<Agreement, LockstepError> {
    let run = |device: &mut NetlistDevice<_>, cycles: u64| {
        let mut reference = model(plan, interface)?;
        let mut pair = Lockstep::new(plan, interface, setting.clone());
        while pair.rig.cycle() < cycles {
            pair.cycle(&mut *reference, device)?;
        }
        Ok(Agreement { cycles, compared: pair.compared })
    };
    let late = plan.shade.is_positional().then_some(CUT_SHORT_OF_LAMP);
    for (disturbed, cycles) in CUT_SHORT.into_iter().chain(late) {
        device.disturb(disturbed);
        device.reset();
        run(device, cycles)?;
        device.reset();
    }
    run(device, cycles)
}
