//! What a sweep leaves: the table, the best machines, the report; and what it says of itself.

use super::Ran;
use super::pictures::pictures;
use crate::document::document;
use crate::progress::spinner;
use crate::staging::Staging;
use crate::talk::Talk;
use crate::verdict::Verdict;
use anyhow::Result;
use edgewalk_explore::page::{number, page};
use edgewalk_explore::sweep::objective::OBJECTIVES;
use edgewalk_explore::sweep::row::Status;
use edgewalk_explore::sweep::table::{Candidate, Table};
use edgewalk_explore::sweep::{Objective, Sample, Sweep};
use edgewalk_machine::Machine;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

pub struct Outcome<'o> {
    table: Table<'o>,
    out: &'o Path,
    ran: Ran,
}

const TABLE: &str = "runs.csv";
const REPORT: &str = "report.html";

fn best_file(objective: &str) -> String {
    format!("best_{objective}.toml")
}

impl<'o> Outcome<'o> {
    /// Of the rows that belong to the sweep.
    pub fn new(sweep: &'o Sweep, rows: &'o BTreeMap<String, Value>, out: &'o Path, ran: Ran) -> Self {
        Outcome { table: Table::new(sweep, rows), out, ran }
    }

    /// Each objective with the best machine, where any is known.
    fn bests(&self) -> Vec<(&'o Objective, &Candidate<'o>)> {
        let objectives = self.table.sweep.objectives.iter();
        objectives.filter_map(|objective| Some((objective, self.table.best(objective)?))).collect()
    }

    /// Writes the files.
    pub fn publish(&self, talk: Talk) -> Result<()> {
        let spinner = spinner("report", talk.quiet);
        let staging = Staging::new(self.out)?;
        staging.write(REPORT, page(&self.table, &pictures(&self.table)?, &self.command()))?;
        staging.write(TABLE, self.table.csv())?;
        for (objective, candidate) in self.bests() {
            if let (Some(machine), Some(value)) = (self.machine(candidate), self.value(objective, candidate))
            {
                let text = format!(
                    "# machine {}, best of {} for {}: {value} ({})\n{}",
                    machine.hash(),
                    self.table.machines.len(),
                    objective.name,
                    objective.doc,
                    machine.to_toml()
                );
                staging.write(&best_file(objective.name), text)?;
            }
        }
        let bests = OBJECTIVES.iter().map(|objective| best_file(objective.name));
        staging.publish(&bests.chain([TABLE.to_owned(), REPORT.to_owned()]).collect::<Vec<_>>())?;
        spinner.finish_and_clear();
        Ok(())
    }

    /// The command that makes this sweep, but for the machine that its keys are varied in.
    fn command(&self) -> String {
        let definition = &self.table.sweep.definition;
        let mut words = vec!["edgewalk sweep".to_owned()];
        words.extend(definition.inputs.iter().cloned());
        words.extend(definition.vary.iter().map(|vary| format!("--vary {vary}")));
        words.extend(definition.stalls.iter().map(|stalls| format!("--stalls {stalls}")));
        if let Some(Sample { points, seed }) = definition.sample {
            words.push(format!("--sample {points} --seed {seed}"));
        }
        words.extend(definition.bound.map(|bound| format!("--bound {bound}")));
        words.extend(definition.objectives.iter().map(|name| format!("--objective {name}")));
        if let Some(synth) = &definition.synth {
            words.push(format!(
                "--synth {} --synth-unit {} --synth-seeds {}",
                synth.target, synth.unit, synth.seeds
            ));
        }
        words.push(format!("--out {}", self.out.display()));
        words.join(" ")
    }

    /// The keys of the machine.
    fn machine(&self, candidate: &Candidate) -> Option<&Machine> {
        let key = candidate.rows.first()?["key"].as_str()?;
        self.table.sweep.points.iter().find(|point| point.key == key).map(|point| &point.machine)
    }

    fn value(&self, objective: &Objective, candidate: &Candidate) -> Option<f64> {
        objective.of_all(&candidate.rows)
    }

    fn on_first_front(&self) -> Vec<&Candidate<'o>> {
        self.table.machines.iter().filter(|machine| machine.front == Some(1)).collect()
    }

    fn described(&self, candidate: &Candidate) -> Value {
        let row = candidate.rows.first().copied().cloned().unwrap_or_default();
        let mut of = json!({ "machine": row["machine"], "stalls": row["stalls"] });
        for axis in &self.table.sweep.axes {
            of["keys"][axis.key.name] = row["keys"][axis.key.name].clone();
        }
        for objective in &self.table.sweep.objectives {
            of["values"][objective.name] = json!(self.value(objective, candidate));
        }
        of
    }

    /// As JSON.
    pub fn json(&self) -> Result<String> {
        let counts = self.table.counts();
        let statuses: serde_json::Map<_, _> =
            counts.iter().map(|(status, count)| (status.name().to_owned(), json!(count))).collect();
        let bests: serde_json::Map<_, _> = self
            .bests()
            .into_iter()
            .map(|(objective, candidate)| {
                let mut of = self.described(candidate);
                of["file"] = json!(self.out.join(best_file(objective.name)).display().to_string());
                (objective.name.to_owned(), of)
            })
            .collect();
        let front: Vec<Value> = self.on_first_front().into_iter().map(|of| self.described(of)).collect();
        let value = json!({
            "out": self.out.display().to_string(),
            "points": self.table.sweep.points.len(),
            "rows": self.table.rows.len(),
            "made": self.ran.made,
            "status": statuses,
            "faults": self.ran.faults,
            "machines": self.table.machines.len(),
            "best": bests,
            "front": front,
        });
        document("sweep", value)
    }

    /// As text. Writing to a string cannot fail.
    pub fn text(&self) -> String {
        let mut t = String::new();
        let (points, there) =
            (self.table.sweep.points.len(), self.table.rows.len() - self.ran.made.min(self.table.rows.len()));
        let counts = self.table.counts();
        let counts = counts.iter().filter(|(_, count)| *count > 0);
        let counts: Vec<String> =
            counts.map(|(status, count)| format!("{count} {}", status.name())).collect();
        _ = writeln!(t, "{points} points, {there} of them were there: {}", counts.join(", "));
        for status in [Status::Invalid, Status::Failed, Status::Timeout, Status::Pruned] {
            let first = self.table.rows.iter().find(|row| row["status"] == status.name());
            if let Some(why) = first.and_then(|row| row["reason"].as_str()) {
                _ = writeln!(t, "first {}: {why}", status.name());
            }
        }
        for (objective, candidate) in self.bests() {
            let value = self.value(objective, candidate).unwrap_or(f64::NAN);
            let file = self.out.join(best_file(objective.name));
            _ = writeln!(t, "best {:<14} {:<12} {}", objective.name, number(value), file.display());
        }
        let front = self.on_first_front();
        let names: Vec<&str> = self.table.sweep.objectives.iter().map(|objective| objective.name).collect();
        _ = writeln!(
            t,
            "front of {}: {} of {} machines",
            names.join(", "),
            front.len(),
            self.table.machines.len()
        );
        for candidate in front.iter().take(SHOWN) {
            let row = candidate.rows.first().copied().cloned().unwrap_or_default();
            let keys = self.table.sweep.axes.iter().map(|axis| {
                let value = &row["keys"][axis.key.name];
                format!(
                    "{}={}",
                    axis.key.name,
                    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
                )
            });
            let values = candidate.values.iter().flatten().map(|value| number(*value));
            _ = writeln!(
                t,
                "    {}  {}",
                values.collect::<Vec<_>>().join("  "),
                keys.collect::<Vec<_>>().join(" ")
            );
        }
        if front.len() > SHOWN {
            _ = writeln!(t, "    and {} more, in {}", front.len() - SHOWN, self.out.join(TABLE).display());
        }
        t
    }

    /// Mismatch where an error exceeds what is proved; vacuous where nothing was drawn at all.
    pub fn verdict(&self) -> Verdict {
        let count =
            |wanted| self.table.counts().iter().find(|(s, _)| *s == wanted).map_or(0, |(_, n)| *n as u64);
        if self.ran.faults > 0 {
            return Verdict::Mismatch;
        }
        Verdict::drew(count(Status::Ok) + count(Status::Pruned))
    }
}

/// Machines of the front that are told; the table has all.
const SHOWN: usize = 20;
