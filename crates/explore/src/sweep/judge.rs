//! How the rows of a machine count together, over memories and inputs. A memory is a condition that every machine meets,
//! not a part of the machine.

use super::objective::Objective;
use super::subject::Subject;
use anyhow::{Result, anyhow};
use edgewalk_machine::Unknown;
use edgewalk_model::Waits;
use serde_json::Value;

/// A memory that every machine of a sweep is run with.
#[derive(Clone, Debug)]
pub struct Memory {
    /// As it was asked for, `dram:miss=8`.
    pub name: String,
    /// How it makes a machine wait.
    pub waits: Waits,
}

impl Memory {
    /// Reads a list; one that never waits if it is empty.
    ///
    /// # Errors
    /// An unknown memory, one that comes twice.
    pub fn list(names: &[String]) -> Result<Vec<Memory>> {
        let mut all: Vec<Memory> = Vec::new();
        for name in names {
            let waits: Waits = name.parse().map_err(|e| anyhow!("--stalls {name}: {e}"))?;
            if all.iter().any(|memory| memory.waits == waits) {
                return Err(anyhow!("--stalls {name}: is given twice; give it once"));
            }
            all.push(Memory { name: name.clone(), waits });
        }
        if all.is_empty() {
            all.push(Memory { name: Waits::Never.to_string(), waits: Waits::Never });
        }
        Ok(all)
    }
}

/// How the rows of a machine count together.
#[derive(Clone, Debug, PartialEq)]
pub struct Judge {
    /// Over the memories.
    pub memories: OverMemories,
    /// Over the inputs.
    pub inputs: OverInputs,
}

/// Which memories decide the value of an objective.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverMemories {
    /// The memory with which the machine does worst, for each objective apart.
    Worst,
    /// Cycles and bytes are summed over the memories; of everything else the worst counts.
    Sum,
    /// One memory alone, by its place among the sweep's memories.
    Only(usize),
}

/// How inputs count together.
#[derive(Clone, Debug, PartialEq)]
pub enum OverInputs {
    /// Cycles and bytes are summed, each times the weight of its input; of everything else the worst counts. Inputs
    /// that are not in the list weigh 1.
    Sum(Vec<(String, f64)>),
    /// The input on which the machine does worst, for each objective apart.
    Worst,
}

impl Judge {
    /// The word for [`OverMemories::Worst`] and [`OverInputs::Worst`].
    pub const WORST: &str = "worst";
    /// The word for [`OverMemories::Sum`] and [`OverInputs::Sum`].
    pub const SUM: &str = "sum";

    /// The value of an objective; `rows` holds a list for each memory, and in it a row for each input.
    ///
    /// None if a row that counts has no value.
    #[must_use]
    pub fn value(&self, objective: &Objective, rows: &[Vec<&Value>]) -> Option<f64> {
        if let OverMemories::Only(memory) = self.memories {
            return self.of_memory(objective, rows.get(memory)?);
        }
        let values = rows.iter().map(|rows| self.of_memory(objective, rows)).collect::<Option<Vec<f64>>>()?;
        if self.memories == OverMemories::Sum && objective.sums {
            return Some(values.iter().sum());
        }
        objective.worst(values)
    }

    /// The value of an objective with one memory; `rows` holds a row for each input.
    #[must_use]
    pub fn of_memory(&self, objective: &Objective, rows: &[&Value]) -> Option<f64> {
        let values = rows.iter().map(|row| objective.of(row)).collect::<Option<Vec<f64>>>()?;
        match self.inputs {
            OverInputs::Sum(_) if objective.sums => {
                Some(rows.iter().zip(values).map(|(row, value)| self.weight(row) * value).sum())
            }
            _ => objective.worst(values),
        }
    }

    /// The rows that make up a memory's cycles, each with its weight: all of a sum, or the first with the most cycles.
    #[must_use]
    pub fn counted<'v>(&self, rows: &[&'v Value]) -> Vec<(&'v Value, f64)> {
        match self.inputs {
            OverInputs::Sum(_) => rows.iter().map(|row| (*row, self.weight(row))).collect(),
            // Of equals the first.
            OverInputs::Worst => {
                let most = rows.iter().rev().max_by_key(|row| row.pointer("/report/cycles/total")?.as_u64());
                most.map(|row| (*row, 1.0)).into_iter().collect()
            }
        }
    }

    /// The weight of a row's input.
    #[must_use]
    pub fn weight(&self, row: &Value) -> f64 {
        let OverInputs::Sum(weights) = &self.inputs else { return 1.0 };
        weights.iter().find(|(name, _)| row["input"] == **name).map_or(1.0, |(_, weight)| *weight)
    }
}

impl OverMemories {
    /// Reads `worst`, `sum` or one of the memories.
    ///
    /// # Errors
    /// None of these.
    pub fn parse(text: &str, memories: &[Memory]) -> Result<OverMemories> {
        match text {
            Judge::WORST => return Ok(OverMemories::Worst),
            Judge::SUM => return Ok(OverMemories::Sum),
            _ => {}
        }
        let asked: Option<Waits> = text.parse().ok();
        let found = memories.iter().position(|memory| Some(memory.waits) == asked);
        found.map(OverMemories::Only).ok_or_else(|| {
            let names = memories.iter().map(|memory| memory.name.as_str());
            let permitted = [Judge::WORST, Judge::SUM].into_iter().chain(names);
            anyhow!("--judge {text}: {}", Unknown::new("judge", text, permitted))
        })
    }

    /// Whether this memory counts, by its place.
    #[must_use]
    pub fn count(self, memory: usize) -> bool {
        !matches!(self, OverMemories::Only(only) if only != memory)
    }

    /// In words, of these memories.
    #[must_use]
    pub fn words(self, memories: &[Memory]) -> String {
        let names = || memories.iter().map(|memory| memory.name.as_str()).collect::<Vec<_>>().join(", ");
        match self {
            OverMemories::Worst => format!("by the worst of the memories {}", names()),
            OverMemories::Sum => format!("by the sum over the memories {}", names()),
            OverMemories::Only(memory) => format!("by the memory {}", memories[memory].name),
        }
    }
}

/// Largest weight of an input: with it the sum of all inputs stays a number.
const MAX_WEIGHT: f64 = 1e9;

impl OverInputs {
    /// Reads `sum` or `worst`, and weights as `INPUT=NUMBER`.
    ///
    /// # Errors
    /// Another word; a weight of an unknown input, of one that has a weight already, or that is no number above 0 and at most 1e9; weights
    /// beside `worst`.
    pub fn parse(word: &str, weights: &[String], inputs: &[Subject]) -> Result<OverInputs> {
        let mut known: Vec<(String, f64)> = Vec::new();
        for text in weights {
            let says = |why: String| anyhow!("--weight {text}: {why}");
            let (name, number) =
                text.rsplit_once('=').ok_or_else(|| says("write INPUT=NUMBER, as sphere=2.5".to_owned()))?;
            if !inputs.iter().any(|input| input.name == name) {
                let names = inputs.iter().map(|input| input.name.as_str());
                return Err(says(Unknown::new("input", name, names).to_string()));
            }
            if known.iter().any(|(before, _)| before == name) {
                return Err(says(format!("{name} has a weight already; give it once")));
            }
            let weight = number.parse().ok().filter(|weight: &f64| *weight > 0.0 && *weight <= MAX_WEIGHT);
            let weight = weight.ok_or_else(|| {
                says(format!("`{number}`: permitted: a finite number above 0, at most {MAX_WEIGHT:e}"))
            })?;
            known.push((name.to_owned(), weight));
        }
        match word {
            Judge::SUM => Ok(OverInputs::Sum(known)),
            Judge::WORST if known.is_empty() => Ok(OverInputs::Worst),
            Judge::WORST => {
                Err(anyhow!("--weight: weights are those of a sum; leave them or --judge-inputs worst out"))
            }
            _ => {
                let unknown = Unknown::new("word", word, [Judge::SUM, Judge::WORST]);
                Err(anyhow!("--judge-inputs {word}: {unknown}"))
            }
        }
    }

    /// In words, of these inputs.
    #[must_use]
    pub fn words(&self, inputs: &[Subject]) -> String {
        let count = inputs.len();
        match self {
            OverInputs::Worst => format!("Of {count} inputs the worst counts, for each figure apart"),
            OverInputs::Sum(weights) => {
                let weighed: Vec<String> =
                    weights.iter().map(|(name, weight)| format!("{name} times {weight}")).collect();
                let by =
                    if weighed.is_empty() { String::new() } else { format!(" ({})", weighed.join(", ")) };
                format!(
                    "Of {count} inputs cycles and bytes are summed{by}, and the worst of every other figure counts"
                )
            }
        }
    }
}
