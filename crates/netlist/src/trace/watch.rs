//! What both formats need: the signals in their scopes, and which of them changed.

use std::collections::HashMap;

use crate::simulate::{SignalId, Simulator};

/// Nanoseconds of a cycle.
pub(super) const CYCLE: u64 = 10;

/// Names of a signal's values.
#[derive(Clone, Copy, Debug)]
pub struct Labels<'a> {
    /// Path of the signal.
    pub signal: &'a str,
    /// The name of each value from 0 on; a value beyond has none.
    pub names: &'a [&'a str],
}

/// A module or instance with its signals, given by their place in [`Watch::signals`].
#[derive(Debug, Default)]
pub(super) struct Scope {
    pub name: String,
    pub variables: Vec<(String, usize)>,
    /// Signals with named values: the name of the text, and the place in [`Watch::labels`].
    pub texts: Vec<(String, usize)>,
    pub scopes: Vec<Scope>,
}

/// Signals with the value they were last seen with.
#[derive(Debug)]
pub(super) struct Watch {
    signals: Vec<(SignalId, Option<u128>)>,
    widths: Vec<u32>,
    /// Signals with named values, by place, and the names.
    labels: Vec<(usize, Vec<String>)>,
    cycles: u64,
}

/// A signal whose value is another than in the last sample.
pub(super) struct Change {
    /// Place of the signal.
    pub place: usize,
    /// None in the first sample.
    pub from: Option<u128>,
    pub to: u128,
}

/// What changed in a sample.
pub(super) struct Changes {
    /// Signals by place, with their bits as `0` and `1`, the highest first.
    pub bits: Vec<(usize, String)>,
    /// Texts by place.
    pub texts: Vec<(usize, String)>,
}

/// All signals of a simulator that can change; a signal of several names is one signal.
pub(super) fn everything(sim: &Simulator, top: &str, labels: &[Labels]) -> (Scope, Watch) {
    let mut scope = Scope { name: top.to_string(), ..Scope::default() };
    let mut watch = Watch { signals: Vec::new(), widths: Vec::new(), labels: Vec::new(), cycles: 0 };
    let mut places: HashMap<SignalId, usize> = HashMap::new();
    for (path, signal) in sim.signals().filter(|(_, signal)| !sim.is_constant(*signal)) {
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
        if let Some(labels) = labels.iter().find(|labels| labels.signal == path) {
            inner.texts.push((format!("{name}_name"), watch.labels.len()));
            watch.labels.push((place, labels.names.iter().map(ToString::to_string).collect()));
        }
    }
    (scope, watch)
}

impl Watch {
    /// Bits of each signal.
    pub fn widths(&self) -> &[u32] {
        &self.widths
    }

    /// The signals, by place.
    pub fn signals(&self) -> impl Iterator<Item = SignalId> {
        self.signals.iter().map(|(signal, _)| *signal)
    }

    /// Samples taken.
    pub fn cycles(&self) -> u64 {
        self.cycles
    }

    /// The time at which the next sample begins, in ns.
    pub fn now(&self) -> u64 {
        self.cycles * CYCLE
    }

    /// A cycle of which no sample is taken.
    pub fn pass(&mut self) {
        self.cycles += 1;
    }

    /// Characters of the longest name of each text.
    pub fn text_widths(&self) -> Vec<usize> {
        let longest = |names: &Vec<String>| names.iter().map(String::len).max().unwrap_or(0).max(1);
        self.labels.iter().map(|(_, names)| longest(names)).collect()
    }

    /// Takes a sample: the signals with another value than in the last.
    pub fn changed(&mut self, sim: &mut Simulator) -> Vec<Change> {
        self.cycles += 1;
        let signals = self.signals.iter_mut().enumerate();
        let change = |(place, (signal, last)): (usize, &mut (SignalId, Option<u128>))| {
            let to = sim.value(*signal);
            let from = last.replace(to);
            (from != Some(to)).then_some(Change { place, from, to })
        };
        signals.filter_map(change).collect()
    }

    /// Takes a sample: what changed since the last, as text.
    pub fn changes(&mut self, sim: &mut Simulator) -> Changes {
        let mut changes = Changes { bits: Vec::new(), texts: Vec::new() };
        for Change { place, to: value, .. } in self.changed(sim) {
            changes.bits.push((place, format!("{value:0width$b}", width = self.widths[place] as usize)));
            for (text, (of, names)) in self.labels.iter().enumerate() {
                if *of == place {
                    let name = usize::try_from(value).ok().and_then(|value| names.get(value));
                    changes.texts.push((text, name.cloned().unwrap_or_else(|| "?".to_owned())));
                }
            }
        }
        changes
    }
}
