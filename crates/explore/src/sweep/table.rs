//! The rows of a sweep by machine: values of the objectives, bests, fronts.

use super::front::fronts;
use super::grid::Sweep;
use super::judge::{Judge, OverMemories};
use super::objective::{OBJECTIVES, Objective};
use super::require::Requirement;
use super::row::{Status, causes, is_beyond};
use serde_json::Value;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Rows in the order of the points, and what is best among them.
pub struct Table<'t> {
    /// The sweep.
    pub sweep: &'t Sweep,
    /// A row for each point that has one.
    pub rows: Vec<&'t Value>,
    /// Every machine that has a row.
    pub machines: Vec<Candidate<'t>>,
}

/// A machine, with every memory and on every input.
pub struct Candidate<'t> {
    /// A list for each memory, and in it a row for each input, as far as there are rows.
    pub rows: Vec<Vec<&'t Value>>,
    /// The value of each objective; none where one of them is not known.
    pub values: Option<Vec<f64>>,
    /// What is required and it does not keep, by the place of the first.
    pub ruled_out: Option<usize>,
    /// Which front it lies on, 1 the best; none where a value is not known.
    pub front: Option<u32>,
}

impl<'t> Candidate<'t> {
    /// The row that says what machine it is: the first with a scene, as a triangle file brings its own screen, else the
    /// first.
    #[must_use]
    pub fn row(&self) -> &'t Value {
        let scene = self.all().find(|row| !row["shading"].is_null());
        scene.or_else(|| self.all().next()).unwrap_or(&Value::Null)
    }

    /// All rows.
    pub fn all(&self) -> impl Iterator<Item = &'t Value> {
        self.rows.iter().flatten().copied()
    }

    /// Cycles with this memory as the judge counts the inputs: a weighted sum or the worst. None if an input has none.
    #[must_use]
    pub fn cycles(&self, judge: &Judge, memory: usize) -> Option<f64> {
        let [cycles, ..] = OBJECTIVES else { return None };
        judge.of_memory(cycles, &self.rows[memory])
    }

    /// The memories that decide the machine's cycles, by their places.
    #[must_use]
    pub fn deciding(&self, judge: &Judge) -> Vec<usize> {
        let all = 0..self.rows.len();
        let cycles = |memory: usize| self.cycles(judge, memory).unwrap_or(0.0);
        match judge.memories {
            OverMemories::Only(memory) => vec![memory],
            OverMemories::Sum => all.collect(),
            // Of equals the first.
            OverMemories::Worst => {
                all.rev().max_by(|a, b| cycles(*a).total_cmp(&cycles(*b))).into_iter().collect()
            }
        }
    }

    /// Cycles by cause with these memories, of the inputs as the judge counts them; causes without a cycle are left out.
    #[must_use]
    pub fn causes(&self, judge: &Judge, memories: &[usize]) -> Vec<(&'static str, f64)> {
        let rows: Vec<_> = memories.iter().flat_map(|memory| judge.counted(&self.rows[*memory])).collect();
        let of = |cause: &str| -> f64 {
            let cycles = |row: &Value| row["report"]["cycles"]["by_cause"][cause].as_f64().unwrap_or(0.0);
            rows.iter().map(|(row, weight)| weight * cycles(row)).sum()
        };
        causes().map(|cause| (cause, of(cause))).filter(|(_, cycles)| *cycles > 0.0).collect()
    }
}

impl<'t> Table<'t> {
    /// Of the rows that belong to the sweep.
    #[must_use]
    pub fn new(sweep: &'t Sweep, all: &'t BTreeMap<String, Value>) -> Self {
        let mut rows = Vec::new();
        let mut machines: Vec<Candidate> = Vec::new();
        let mut last = None;
        for (point, row) in sweep.points.iter().filter_map(|point| Some((point, all.get(&point.key)?))) {
            rows.push(row);
            if last != Some(point.number) {
                let rows = vec![Vec::new(); sweep.memories.len()];
                machines.push(Candidate { rows, values: None, ruled_out: None, front: None });
                last = Some(point.number);
            }
            if let Some(machine) = machines.last_mut() {
                machine.rows[point.memory].push(row);
            }
        }
        for machine in &mut machines {
            machine.ruled_out = Requirement::first_broken(&sweep.requirements, &sweep.judge, &machine.rows);
            machine.values = values(sweep, &machine.rows).filter(|_| machine.ruled_out.is_none());
        }
        let known: Vec<usize> = (0..machines.len()).filter(|i| machines[*i].values.is_some()).collect();
        let costs: Vec<Vec<f64>> = known
            .iter()
            .filter_map(|i| machines[*i].values.as_ref())
            .map(|values| values.iter().zip(&sweep.objectives).map(|(v, o)| o.cost(*v)).collect())
            .collect();
        for (machine, front) in known.into_iter().zip(fronts(&costs)) {
            machines[machine].front = Some(front);
        }
        Table { sweep, rows, machines }
    }

    /// The best machine for an objective: of equals the one that is better in the next objectives, then the first.
    #[must_use]
    pub fn best(&self, objective: &Objective) -> Option<&Candidate<'t>> {
        let place = self.sweep.objectives.iter().position(|other| other == objective)?;
        let costs = |candidate: &Candidate| -> Option<Vec<f64>> {
            let values = candidate.values.as_ref()?;
            let mut costs: Vec<f64> =
                values.iter().zip(&self.sweep.objectives).map(|(v, o)| o.cost(*v)).collect();
            let first = costs.remove(place);
            costs.insert(0, first);
            Some(costs)
        };
        let known = self.machines.iter().filter_map(|machine| Some((costs(machine)?, machine)));
        let best = known.min_by(|(a, _), (b, _)| {
            let pairs = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
            pairs.into_iter().find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
        });
        best.map(|(_, machine)| machine)
    }

    /// The value of an objective; no number where it is not known.
    #[must_use]
    pub fn value(&self, objective: &Objective, machine: &Candidate) -> f64 {
        self.sweep.judge.value(objective, &machine.rows).unwrap_or(f64::NAN)
    }

    /// The machines of the first front.
    pub fn first_front(&self) -> impl Iterator<Item = &Candidate<'t>> {
        self.machines.iter().filter(|machine| machine.front == Some(1))
    }

    /// How many rows have each status.
    #[must_use]
    pub fn counts(&self) -> [(Status, usize); 5] {
        Status::ALL
            .map(|status| (status, self.rows.iter().filter(|row| Status::of(row) == Some(status)).count()))
    }

    /// How many machines each requirement ruled out; a machine counts for the first that it does not keep.
    #[must_use]
    pub fn ruled_out(&self) -> Vec<(String, usize)> {
        let of =
            |place: usize| self.machines.iter().filter(|machine| machine.ruled_out == Some(place)).count();
        self.sweep
            .requirements
            .iter()
            .enumerate()
            .map(|(place, text)| (text.to_string(), of(place)))
            .collect()
    }

    /// How many rows show an error beyond what is proved: each is a fault of the program.
    #[must_use]
    pub fn faults(&self) -> usize {
        self.rows.iter().filter(|row| is_beyond(row)).count()
    }

    /// The front of each row's machine, by the row's key.
    #[must_use]
    pub fn front_of(&self) -> BTreeMap<&'t str, u32> {
        let machines = self.machines.iter().filter_map(|machine| Some((machine, machine.front?)));
        machines
            .flat_map(|(machine, front)| {
                machine.all().filter_map(move |row| Some((row["key"].as_str()?, front)))
            })
            .collect()
    }
}

/// The value of each objective, if the machine was drawn on every input with every memory that counts.
fn values(sweep: &Sweep, rows: &[Vec<&Value>]) -> Option<Vec<f64>> {
    let counted = rows.iter().enumerate().filter(|(memory, _)| sweep.judge.memories.count(*memory));
    let mut drawn = counted.map(|(_, rows)| {
        rows.len() == sweep.inputs.len() && rows.iter().all(|row| Status::of(row) == Some(Status::Ok))
    });
    if !drawn.all(|drawn| drawn) {
        return None;
    }
    sweep.objectives.iter().map(|objective| sweep.judge.value(objective, rows)).collect()
}
