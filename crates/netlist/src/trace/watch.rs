//! What both formats need: the signals in their scopes, and which of them changed.

use std::collections::HashMap;

use crate::simulate::{SignalId, Simulator};

/// Nanoseconds of a cycle.
pub(super) const CYCLE: u64 = 10;

/// A module or instance with its signals, given by their place in [`Watch::signals`].
#[derive(Debug, Default)]
pub(super) struct Scope {
    pub name: String,
    pub variables: Vec<(String, usize)>,
    pub scopes: Vec<Scope>,
}

/// Signals with the value they were last seen with.
#[derive(Debug)]
pub(super) struct Watch {
    signals: Vec<(SignalId, Option<u128>)>,
    widths: Vec<u32>,
    cycles: u64,
}

/// All signals of a simulator; a signal of several names is one signal.
pub(super) fn everything(sim: &Simulator, top: &str) -> (Scope, Watch) {
    let mut scope = Scope { name: top.to_string(), ..Scope::default() };
    let mut watch = Watch { signals: Vec::new(), widths: Vec::new(), cycles: 0 };
    let mut places: HashMap<SignalId, usize> = HashMap::new();
    for (path, signal) in sim.signals() {
        let place = *places.entry(signal).or_insert_with(|| {
            watch.signals.push((signal, None));
            watch.widths.push(sim.width(signal));
            watch.signals.len() - 1
        });
        let (scopes, name) = path.rsplit_once('.').unwrap_or(("", path));
        let mut inner = &mut scope;
        for part in scopes.split('.').filter(|part| !part.is_empty()) {
            // The paths are sorted: a scope already there is the last one.
            if inner.scopes.last().is_none_or(|last| last.name != part) {
                inner.scopes.push(Scope { name: part.to_string(), ..Scope::default() });
            }
            let last = inner.scopes.len() - 1;
            inner = &mut inner.scopes[last];
        }
        inner.variables.push((name.to_string(), place));
    }
    (scope, watch)
}

impl Watch {
    /// Bits of each signal.
    pub fn widths(&self) -> &[u32] {
        &self.widths
    }

    /// The time at which the next sample begins, in ns.
    pub fn now(&self) -> u64 {
        self.cycles * CYCLE
    }

    /// Takes a sample: the signals that changed since the last, with their bits as `0` and `1`, the highest first.
    pub fn changes(&mut self, sim: &mut Simulator) -> Vec<(usize, String)> {
        self.cycles += 1;
        let mut changes = Vec::new();
        for (place, (signal, last)) in self.signals.iter_mut().enumerate() {
            let value = sim.value(*signal);
            if last.replace(value) != Some(value) {
                changes.push((place, format!("{value:0width$b}", width = self.widths[place] as usize)));
            }
        }
        changes
    }
}
