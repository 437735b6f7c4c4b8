//! How the memories of a sweep count together: a memory is a condition that every machine meets, not a part of the machine.

use super::objective::Objective;
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

/// Which memories decide the value of an objective.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judge {
    /// The memory with which the machine does worst, for each objective apart.
    Worst,
    /// Cycles are summed over the memories; of everything else the worst counts.
    Sum,
    /// One memory alone, by its place among the sweep's memories.
    Only(usize),
}

impl Judge {
    /// The word for [`Judge::Worst`].
    pub const WORST: &str = "worst";
    const SUM: &str = "sum";

    /// Reads `worst`, `sum` or one of the memories.
    ///
    /// # Errors
    /// None of these.
    pub fn parse(text: &str, memories: &[Memory]) -> Result<Judge> {
        match text {
            Judge::WORST => return Ok(Judge::Worst),
            Judge::SUM => return Ok(Judge::Sum),
            _ => {}
        }
        let asked: Option<Waits> = text.parse().ok();
        let found = memories.iter().position(|memory| Some(memory.waits) == asked);
        found.map(Judge::Only).ok_or_else(|| {
            let names = memories.iter().map(|memory| memory.name.as_str());
            let permitted = [Judge::WORST, Judge::SUM].into_iter().chain(names);
            anyhow!("--judge {text}: {}", Unknown::new("judge", text, permitted))
        })
    }

    /// The value of an objective; `rows` holds a list for each memory, and in it a row for each input.
    ///
    /// None if a row that counts has no value.
    #[must_use]
    pub fn value(self, objective: &Objective, rows: &[Vec<&Value>]) -> Option<f64> {
        if let Judge::Only(memory) = self {
            return objective.of_all(rows.get(memory)?);
        }
        let values = rows.iter().map(|rows| objective.of_all(rows)).collect::<Option<Vec<f64>>>()?;
        if self == Judge::Sum && objective.sums {
            return Some(values.iter().sum());
        }
        objective.worst(values)
    }

    /// In words, of these memories.
    #[must_use]
    pub fn words(self, memories: &[Memory]) -> String {
        let names = || memories.iter().map(|memory| memory.name.as_str()).collect::<Vec<_>>().join(", ");
        match self {
            Judge::Worst => format!("by the worst of the memories {}", names()),
            Judge::Sum => format!("by the sum over the memories {}", names()),
            Judge::Only(memory) => format!("by the memory {}", memories[memory].name),
        }
    }
}
