//! How often and how long each bit of each signal was 1.

use std::collections::BTreeMap;

use super::watch::{Scope, Watch, everything};
use crate::simulate::Simulator;

/// A count of the transitions of every named signal that can change.
///
/// Signals are seen once a cycle, so glitches within a cycle are not counted.
pub struct Transitions {
    pub(super) scope: Scope,
    watch: Watch,
    pub(super) nets: Vec<Net>,
    /// The instance of the top module that computes each signal, by place; empty for the top module.
    units: Vec<String>,
}

/// What was counted of a signal.
#[derive(Clone, Debug, Default)]
pub(super) struct Net {
    /// Transitions of each bit, the lowest first.
    pub transitions: Vec<u64>,
    /// Cycles at 1 of each bit, up to `since`.
    pub high: Vec<u64>,
    value: u128,
    /// The cycle in which the value appeared.
    since: u64,
}

/// Transitions of the signals that one unit computes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitTransitions {
    /// The instance in the top module; empty for the top module itself.
    pub unit: String,
    /// Bits of its named signals that can change.
    pub bits: u64,
    /// Transitions of all these bits, in the whole run.
    pub transitions: u64,
}

impl Transitions {
    /// Counts nothing yet; `top` is the name of the outermost instance in a SAIF file.
    pub fn new(sim: &Simulator, top: &str) -> Self {
        let (scope, watch) = everything(sim, top, &[]);
        let net = |width: &u32| {
            let zeros = vec![0; *width as usize];
            Net { transitions: zeros.clone(), high: zeros, ..Net::default() }
        };
        let nets = watch.widths().iter().map(net).collect();
        let units = watch.signals().map(|signal| sim.unit(signal).to_owned()).collect();
        Transitions { scope, watch, nets, units }
    }

    /// Counts the changes since the last sample; to be called once a cycle, before the tick.
    pub fn sample(&mut self, sim: &mut Simulator) {
        let cycle = self.watch.cycles();
        for change in self.watch.changed(sim) {
            self.nets[change.place].change(change.from, change.to, cycle);
        }
    }

    /// Samples taken.
    pub fn cycles(&self) -> u64 {
        self.watch.cycles()
    }

    /// The sums by unit, in alphabetical order.
    pub fn units(&self) -> Vec<UnitTransitions> {
        let mut sums: BTreeMap<&str, (u64, u64)> = BTreeMap::new();
        for (unit, net) in self.units.iter().zip(&self.nets) {
            let (bits, transitions) = sums.entry(unit).or_default();
            *bits += net.transitions.len() as u64;
            *transitions += net.transitions.iter().sum::<u64>();
        }
        let sum = |(unit, (bits, transitions)): (&str, (u64, u64))| UnitTransitions {
            unit: unit.to_owned(),
            bits,
            transitions,
        };
        sums.into_iter().map(sum).collect()
    }
}

impl Net {
    /// The first value of a run comes `from` none: no transition.
    fn change(&mut self, from: Option<u128>, to: u128, cycle: u64) {
        if let Some(from) = from {
            self.high = self.high_until(cycle).collect();
            let bits = self.transitions.iter_mut().enumerate();
            bits.for_each(|(bit, count)| *count += ((from ^ to) >> bit & 1) as u64);
        }
        (self.value, self.since) = (to, cycle);
    }

    /// Cycles at 1 of each bit, up to `cycle`.
    pub fn high_until(&self, cycle: u64) -> impl Iterator<Item = u64> + '_ {
        let last = move |bit: usize| (self.value >> bit & 1) as u64 * (cycle - self.since);
        self.high.iter().enumerate().map(move |(bit, high)| high + last(bit))
    }
}
