//! A case: a machine or one of its units, what it is fed with, how the rig makes it wait. All that is needed to see a
//! failure again, as a file.

mod file;

mod words;

pub use file::CaseError;
pub use words::words_at_start;

use crate::Token;
use crate::device::{ModelDevice, NetlistDevice, model, netlist};
use crate::interface::{Interface, Link};
use crate::lockstep::{Lockstep, LockstepError};
use crate::rig::{Setting, bits};
use crate::stalls::{LENGTHS, Pattern};
use crate::unit::Unit;
use edgewalk_machine::{DrawState, Events, Plan};
use edgewalk_netlist::{Netlist, Simulate, Simulator};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::collections::BTreeMap;

/// What is run, and how.
#[derive(Clone, Debug)]
pub struct Case {
    /// What it is for, or what it has found.
    pub about: String,
    /// A fault of the netlist that it finds: unit or module, and the change as [`edgewalk_netlist::mutate`] says it.
    pub fault: Option<String>,
    /// The machine.
    pub plan: Plan,
    /// The whole, its units compared inside, or one unit alone.
    pub unit: Unit,
    /// Tokens of the first link in.
    pub tokens: Vec<Token>,
    /// The rules; of `clear` nothing is used, the colours at the start are random.
    pub state: DrawState,
    /// Every stored depth at the start, LSB; the largest if `None`.
    pub clear_z: Option<u64>,
    /// By link or level: in so many of 256 cycles the rig is not willing.
    pub unwilling: BTreeMap<String, u8>,
    /// Clocks that every memory takes beyond its least.
    pub late: u64,
    /// Cycles with reset.
    pub resets: Vec<u64>,
    /// Cycles of random inputs before the first reset.
    pub disturbed: u64,
    /// Cycles that a unit alone runs; the machine runs until it is idle.
    pub cycles: u64,
    /// Seed of the patterns, of the colour at the start, of the light's map, of the memories of terms and tables, and of what stands in fields without a token.
    pub seed: u64,
}

/// What a run has compared.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// Clocks.
    pub cycles: u64,
    /// Tokens taken in.
    pub tokens: u64,
    /// Values of ports.
    pub compared: u64,
    /// Tokens that moved, in or out, by link.
    pub moved: BTreeMap<&'static str, u64>,
    /// Events met.
    pub events: Events,
}

impl Checked {
    /// Adds another run.
    pub fn merge(&mut self, other: &Checked) {
        self.cycles += other.cycles;
        self.tokens += other.tokens;
        self.compared += other.compared;
        for (link, moved) in &other.moved {
            *self.moved.entry(link).or_default() += moved;
        }
        self.events.merge(&other.events);
    }
}

/// Cycles for each triangle after which a machine will never come to rest.
const PATIENCE: u64 = 100_000;

impl Case {
    /// A machine or unit that nothing keeps waiting, without tokens.
    #[must_use]
    pub fn new(plan: &Plan, unit: Unit) -> Case {
        Case {
            about: String::new(),
            fault: None,
            plan: plan.clone(),
            unit,
            tokens: Vec::new(),
            state: DrawState::default(),
            clear_z: None,
            unwilling: BTreeMap::new(),
            late: 0,
            resets: Vec::new(),
            disturbed: 0,
            cycles: 2000,
            seed: 0,
        }
    }

    /// Ports of the unit; of the whole machine also those of the units inside.
    #[must_use]
    pub fn interface(&self) -> Interface {
        match self.unit == Unit::MACHINE {
            true => Interface::with_units(&self.plan),
            false => Interface::new(&self.plan, self.unit),
        }
    }

    /// Runs model and netlist side by side, the netlist in the interpreter.
    ///
    /// # Errors
    /// The first difference, or a machine that does not come to rest.
    pub fn run(&self) -> Result<Checked, LockstepError> {
        self.run_by(Simulator::new)
    }

    /// Like `run`, the netlist in another simulator.
    ///
    /// # Errors
    /// The first difference, or a machine that does not come to rest.
    pub fn run_by<S: Simulate>(
        &self,
        simulator: impl FnOnce(&Netlist) -> S,
    ) -> Result<Checked, LockstepError> {
        let interface = self.interface();
        let netlist = netlist(&self.plan, self.unit)?;
        let mut device = NetlistDevice::run_by(simulator(&netlist), &netlist, &interface)?;
        device.disturb(self.disturbed);
        device.reset();
        let mut reference = model(&self.plan, &interface)?;
        self.run_devices(&interface, &mut *reference, &mut device)
    }

    /// Like `run_by`, with devices from elsewhere, both behind a reset.
    ///
    /// # Errors
    /// The first difference, or a machine that does not come to rest.
    pub fn run_devices(
        &self,
        interface: &Interface,
        reference: &mut dyn ModelDevice,
        device: &mut dyn crate::Device,
    ) -> Result<Checked, LockstepError> {
        let mut pair = Lockstep::new(&self.plan, interface, self.setting(interface)?);
        let mut checked = Checked::default();
        let idle = interface.port("idle").filter(|_| self.unit == Unit::MACHINE).map(|port| port.id);
        let last = self.resets.iter().max().map_or(0, |cycle| cycle + 1);
        let longest = PATIENCE * (1 + self.tokens.len() as u64);
        loop {
            // In the cycle in which it takes the last triangle the machine is still idle.
            let exhausted = pair.rig.exhausted();
            pair.cycle(reference, device)?;
            for link in interface.links.iter().filter(|link| !pair.ports().rst && link.fires(pair.ports())) {
                *checked.moved.entry(link.name).or_default() += 1;
            }
            let cycle = pair.rig.cycle();
            let done = match idle {
                Some(idle) => cycle > last && exhausted && pair.ports().is_high(idle),
                None => cycle >= self.cycles,
            };
            if done {
                break;
            }
            if cycle > longest {
                return Err(LockstepError::Busy(cycle));
            }
        }
        checked.cycles = pair.rig.cycle();
        checked.tokens = pair.rig.sent().into();
        checked.compared = pair.compared;
        checked.events = reference.events().clone();
        if checked.moved.is_empty() {
            return Err(LockstepError::Vacuous);
        }
        Ok(checked)
    }

    /// What the rig does.
    fn setting(&self, interface: &Interface) -> Result<Setting, LockstepError> {
        let mut setting = Setting::willing(interface, &self.state.constants())?;
        setting.tokens.clone_from(&self.tokens);
        let mut random = Pcg64Mcg::seed_from_u64(self.seed);
        // Lengths that repeat together only after very long; long ones, so that many cases are met.
        let lengths = LENGTHS.iter().map(|length| length * 7).cycle();
        let patterns = interface.waits().zip(lengths).map(|(name, length)| match self.unwilling.get(name) {
            None | Some(0) => Pattern::always(),
            Some(share) => Pattern::random(&mut random, length, *share),
        });
        setting.patterns = patterns.collect();
        for (memory, declared) in setting.memories.iter_mut().zip(&interface.memories) {
            memory.latency += self.late;
            memory.clear = match declared.name {
                "depth" => self.clear_z.map_or(memory.clear, u128::from),
                _ => bits(&mut random, declared.word_bits),
            };
            memory.start = words_at_start(&self.plan, declared, &mut random);
        }
        setting.resets.clone_from(&self.resets);
        setting.noise = Some(self.seed);
        Ok(setting)
    }
}

/// The first link in.
pub(crate) fn fed(interface: &Interface) -> &Link {
    interface.links.first().expect("every unit takes tokens")
}
