//! A search through a space of machines that is too large to be run whole.
//!
//! ```text
//!  half at random ─> first input ─> neighbours of the best ─> first input ─> ... ─> the better half ─> twice the inputs ─> ...
//! ```
//! The same seed gives the same machines wherever the search runs. A search never tells that it has seen all machines.

use super::definition::Sample;
use super::front::fronts;
use super::grid::{Round, Sweep};
use super::require::Requirement;
use super::row::Status;
use super::space::first_alike;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Of the machines of a search the first half is drawn at random; a further round takes one in sixteen.
const STEP: usize = 16;
/// Draws after which a machine is taken at random, as the neighbours are known.
const TRIES: usize = 32;
/// Draws after which no other machine is looked for: of a space that is not listed many combinations may be the same machine.
const DRAWS: usize = 1 << 14;

/// A search that goes on.
pub struct Hunt {
    /// How many machines it looks at.
    budget: usize,
    random: Pcg64Mcg,
    /// By machine of the sweep: its index among all.
    indices: Vec<u64>,
    seen: BTreeSet<u64>,
    /// The machines that are still in it.
    kept: Vec<usize>,
}

impl Hunt {
    /// The search of a sweep, if it is one.
    #[must_use]
    pub fn of(sweep: &Sweep) -> Option<Hunt> {
        let Sample { points, seed } = sweep.definition.search?;
        Some(Hunt {
            budget: points as usize,
            random: Pcg64Mcg::seed_from_u64(seed),
            indices: Vec::new(),
            seen: BTreeSet::new(),
            kept: Vec::new(),
        })
    }

    /// Begins the next round, after the rows of the last one are there. Returns the places of its points; none at the end.
    pub fn next(&mut self, sweep: &mut Sweep, rows: &BTreeMap<String, Value>) -> Option<Vec<usize>> {
        let reach = sweep.rounds.last().map_or(1, |round| round.inputs);
        let before = self.indices.len();
        if before < self.budget {
            let best = ranked(sweep, &self.kept, reach, rows);
            self.grow(sweep, &best);
        }
        if before < self.indices.len() {
            self.kept = (0..self.indices.len()).collect();
            sweep.rounds.push(Round { inputs: 1, machines: self.indices.len() - before });
            return Some(self.points(sweep, &self.kept[before..], 0, 1));
        }
        let inputs = sweep.inputs.len();
        if reach >= inputs {
            return None;
        }
        let mut best = ranked(sweep, &self.kept, reach, rows);
        best.truncate(self.kept.len().div_ceil(2));
        self.kept = best;
        let to = (2 * reach).min(inputs);
        sweep.rounds.push(Round { inputs: to, machines: self.kept.len() });
        Some(self.points(sweep, &self.kept, reach, to))
    }

    /// Points of machines on the inputs from one to before another, with every memory.
    fn points(&self, sweep: &Sweep, machines: &[usize], from: usize, to: usize) -> Vec<usize> {
        let of = |machine: usize| {
            (0..sweep.memories.len())
                .flat_map(move |memory| (from..to).map(move |input| (machine, memory, input)))
        };
        machines
            .iter()
            .flat_map(|machine| of(*machine))
            .map(|(m, memory, i)| sweep.place(m, memory, i))
            .collect()
    }

    /// Adds machines: at random at first, then neighbours of the best.
    fn grow(&mut self, sweep: &mut Sweep, best: &[usize]) {
        let step = self.budget.div_ceil(STEP);
        let wanted = if self.indices.is_empty() { self.budget.div_ceil(2) } else { step };
        let parents = &best[..best.len().min(step)];
        for _ in 0..wanted.min(self.budget - self.indices.len()) {
            let mut index = None;
            for _ in 0..TRIES {
                if parents.is_empty() {
                    break;
                }
                // The better ones more often.
                let place = (self.random.random::<f64>().powi(2) * parents.len() as f64) as usize;
                let near = self.neighbour(sweep, self.indices[parents[place.min(parents.len() - 1)]]);
                let near = first_alike(&sweep.base, &sweep.axes, near);
                if !self.seen.contains(&near) {
                    index = Some(near);
                    break;
                }
            }
            let mut any = || sweep.index(self.random.random_range(0..sweep.whole));
            let index = index.or_else(|| {
                std::iter::repeat_with(&mut any).take(DRAWS).find(|any| !self.seen.contains(any))
            });
            let Some(index) = index else {
                self.budget = self.indices.len();
                return;
            };
            self.seen.insert(index);
            self.indices.push(index);
            sweep.add(index);
        }
    }

    /// A machine that differs in one key, with a chance of one half in another, and so on. A key goes to the value beside it or
    /// to any.
    fn neighbour(&mut self, sweep: &Sweep, index: u64) -> u64 {
        let varied: Vec<usize> =
            (0..sweep.axes.len()).filter(|at| sweep.axes[*at].values.len() > 1).collect();
        let mut index = index;
        loop {
            let axis = varied[self.random.random_range(0..varied.len())];
            let below: u64 = sweep.axes[axis + 1..].iter().map(|axis| axis.values.len() as u64).product();
            let count = sweep.axes[axis].values.len() as u64;
            let now = index / below % count;
            let value = match self.random.random_range(0..4) {
                0 if now > 0 => now - 1,
                1 if now + 1 < count => now + 1,
                _ => (now + self.random.random_range(1..count)) % count,
            };
            index = index - now * below + value * below;
            if self.random.random() {
                return index;
            }
        }
    }
}

/// Machines from the best to the worst by their rows of the first inputs: in turn the next of each objective and the next of
/// the fronts. Those that break a requirement, or whose values are not known, come last.
fn ranked(sweep: &Sweep, machines: &[usize], reach: usize, rows: &BTreeMap<String, Value>) -> Vec<usize> {
    let mut known: Vec<usize> = Vec::new();
    let mut costs: Vec<Vec<f64>> = Vec::new();
    let mut rest = Vec::new();
    for machine in machines {
        match costs_of(sweep, *machine, reach, rows) {
            Some(own) => {
                known.push(*machine);
                costs.push(own);
            }
            None => rest.push(*machine),
        }
    }
    let by = |costs: &dyn Fn(usize) -> Vec<f64>| {
        let mut order: Vec<(Vec<f64>, usize)> = (0..known.len()).map(|at| (costs(at), at)).collect();
        order.sort_by(|(a, at), (b, other)| {
            let pairs = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
            pairs.into_iter().find(|order| order.is_ne()).unwrap_or(at.cmp(other))
        });
        order.into_iter().map(|(_, at)| at).collect::<Vec<usize>>()
    };
    let mut orders: Vec<Vec<usize>> = (0..sweep.objectives.len())
        .map(|first| {
            by(&|at| {
                let mut own = costs[at].clone();
                own[..=first].rotate_right(1);
                own
            })
        })
        .collect();
    let fronts = fronts(&costs);
    orders.push(by(&|at| vec![f64::from(fronts[at])]));
    let mut taken = vec![false; known.len()];
    let mut ranked = Vec::new();
    for place in 0..known.len() {
        for order in &orders {
            if !std::mem::replace(&mut taken[order[place]], true) {
                ranked.push(known[order[place]]);
            }
        }
    }
    ranked.extend(rest);
    ranked
}

/// The cost of a machine in each objective on the first inputs.
fn costs_of(sweep: &Sweep, machine: usize, reach: usize, rows: &BTreeMap<String, Value>) -> Option<Vec<f64>> {
    let row = |memory: usize, input: usize| {
        let row = rows.get(&sweep.points[sweep.place(machine, memory, input)].key)?;
        (Status::of(row) == Some(Status::Ok)).then_some(row)
    };
    let own = (0..sweep.memories.len())
        .map(|memory| (0..reach).map(|input| row(memory, input)).collect::<Option<Vec<_>>>())
        .collect::<Option<Vec<_>>>()?;
    if Requirement::first_broken(&sweep.requirements, &sweep.judge, &own).is_some() {
        return None;
    }
    let value = |objective: &super::Objective| Some(objective.cost(sweep.judge.value(objective, &own)?));
    sweep.objectives.iter().map(value).collect()
}

/// Which of all machines the sweep looks at, in words; none where it looks at all of them.
#[must_use]
pub fn extent(sweep: &Sweep) -> Option<String> {
    let Sweep { definition, machines, whole, rounds, .. } = sweep;
    let unit = sweep.space.unit();
    if let Some(Sample { seed, .. }) = definition.search {
        let mut reached: Vec<Round> = Vec::new();
        for round in rounds {
            match reached.last_mut() {
                Some(last) if last.inputs == round.inputs => last.machines += round.machines,
                _ => reached.push(*round),
            }
        }
        let reached = reached.iter().map(|round| format!("{} on {}", round.machines, round.inputs));
        return Some(format!(
            "A search, not exhaustive: {machines} of {whole} {unit}, seed {seed}; machines on inputs: {}",
            reached.collect::<Vec<_>>().join(", ")
        ));
    }
    let Sample { seed, .. } = definition.sample.filter(|_| (*machines as u64) < *whole)?;
    Some(format!("A sample, not exhaustive: {machines} of {whole} {unit}, seed {seed}"))
}
