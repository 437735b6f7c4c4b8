//! What a sweep leaves: the table, the best machines, the report; and what it says of itself.

use super::pictures::pictures;
use crate::document::document;
use crate::machine_args::MachineArgs;
use crate::progress::spinner;
use crate::shell::quoted;
use crate::talk::Talk;
use crate::verdict::{NoFigures, Verdict};
use anyhow::Result;
use edgewalk_explore::page::{number, page, rule, ruled_out};
use edgewalk_explore::sweep::csv::csv;
use edgewalk_explore::sweep::judge::Memory;
use edgewalk_explore::sweep::objective::OBJECTIVES;
use edgewalk_explore::sweep::row::Status;
use edgewalk_explore::sweep::search::extent;
use edgewalk_explore::sweep::table::{Candidate, Table};
use edgewalk_explore::sweep::{Judge, Objective, Sample, Sweep};
use edgewalk_files::Staging;
use edgewalk_machine::Machine;
use edgewalk_model::Waits;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

pub struct Outcome<'o> {
    table: Table<'o>,
    out: &'o Path,
    /// Rows that this run made.
    made: usize,
}

const TABLE: &str = "runs.csv";
const REPORT: &str = "report.html";

fn best_file(objective: &str) -> String {
    format!("best_{objective}.toml")
}

/// What a sweep writes at its end.
pub fn files() -> Vec<String> {
    let bests = OBJECTIVES.iter().map(|objective| best_file(objective.name));
    bests.chain([TABLE.to_owned(), REPORT.to_owned()]).collect()
}

impl<'o> Outcome<'o> {
    /// Of the rows that belong to the sweep.
    pub fn new(sweep: &'o Sweep, rows: &'o BTreeMap<String, Value>, out: &'o Path, made: usize) -> Self {
        Outcome { table: Table::new(sweep, rows), out, made }
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
        staging.write(TABLE, csv(&self.table))?;
        for (objective, candidate) in self.bests() {
            if let Some(machine) = self.machine(candidate) {
                let of = match extent(self.table.sweep) {
                    Some(_) => format!("{} looked at, not of all,", self.table.machines.len()),
                    None => self.table.machines.len().to_string(),
                };
                let about = format!(
                    "machine {}, best of {of} for {}: {} ({}{})",
                    machine.hash(),
                    objective.name,
                    self.table.value(objective, candidate),
                    objective.doc,
                    together(self.table.sweep)
                );
                // A name of an input may hold a line break, and a comment may not.
                let about = about.replace(char::is_control, " ");
                staging.write(&best_file(objective.name), format!("# {about}\n{}", machine.to_toml()))?;
            }
        }
        staging.publish(&files())?;
        spinner.finish_and_clear();
        Ok(())
    }

    /// The command that makes this sweep.
    fn command(&self) -> String {
        let definition = &self.table.sweep.definition;
        let mut words = vec!["edgewalk".to_owned(), "sweep".to_owned()];
        words.extend(definition.inputs.iter().cloned());
        words.extend(MachineArgs::words_for(&self.table.sweep.base));
        let mut flag = |name: &str, values: &[String]| {
            values.iter().for_each(|value| words.extend([format!("--{name}"), value.clone()]));
        };
        flag("vary", &definition.vary);
        flag("shading", definition.shading.as_slice());
        flag("stalls", &definition.stalls);
        if definition.judge != Judge::WORST {
            flag("judge", std::slice::from_ref(&definition.judge));
        }
        if definition.judge_inputs != Judge::SUM {
            flag("judge-inputs", std::slice::from_ref(&definition.judge_inputs));
        }
        flag("weight", &definition.weights);
        if let Some(Sample { points, seed }) = definition.sample {
            flag("sample", &[points.to_string()]);
            flag("seed", &[seed.to_string()]);
        }
        if let Some(Sample { points, seed }) = definition.search {
            flag("search", &[points.to_string()]);
            flag("seed", &[seed.to_string()]);
        }
        flag("bound", definition.bound.map(|bound| bound.to_string()).as_slice());
        flag("require", &definition.require);
        flag("fits", &definition.fits);
        flag("objective", &definition.objectives);
        if let Some(synth) = &definition.synth {
            flag("synth", std::slice::from_ref(&synth.target));
            flag("synth-unit", std::slice::from_ref(&synth.unit));
            flag("synth-seeds", &[synth.seeds.to_string()]);
        }
        if definition.estimate {
            words.push("--estimate".to_owned());
        }
        let mut flag = |name: &str, value: &str| words.extend([format!("--{name}"), value.to_owned()]);
        flag("out", &self.out.display().to_string());
        words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
    }

    /// The keys of the machine.
    fn machine(&self, candidate: &Candidate) -> Option<&Machine> {
        let key = candidate.row()["key"].as_str()?;
        self.table.sweep.points.iter().find(|point| point.key == key).map(|point| &point.machine)
    }

    fn described(&self, candidate: &Candidate) -> Value {
        let row = candidate.row();
        let mut of = json!({ "machine": row["machine"] });
        for axis in &self.table.sweep.axes {
            of["keys"][axis.key.name] = row["keys"][axis.key.name].clone();
        }
        for objective in &self.table.sweep.objectives {
            of["values"][objective.name] = json!(self.table.value(objective, candidate));
        }
        for (place, memory) in self.table.sweep.memories.iter().enumerate() {
            let cycles = candidate.cycles(&self.table.sweep.judge, place);
            of["cycles"][memory.waits.to_string()] = json!(cycles);
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
        let front: Vec<Value> = self.table.first_front().map(|of| self.described(of)).collect();
        let value = json!({
            "out": self.out.display().to_string(),
            "points": self.table.sweep.points.len(),
            "rows": self.table.rows.len(),
            "made": self.made,
            "status": statuses,
            "faults": self.table.faults(),
            "machines": self.table.machines.len(),
            "extent": self.extent(),
            "ruled_out": self.table.ruled_out().into_iter().map(|(text, machines)| json!({ "required": text, "machines": machines })).collect::<Vec<_>>(),
            "judge": self.table.sweep.definition.judge,
            "judge_inputs": self.table.sweep.definition.judge_inputs,
            "weights": self.table.sweep.definition.weights,
            "best": bests,
            "front": front,
        });
        document("sweep", value)
    }

    /// Which of all machines were looked at.
    fn extent(&self) -> Value {
        let Sweep { definition, whole, rounds, .. } = self.table.sweep;
        let kind = match (definition.search, definition.sample) {
            (Some(_), _) => "search",
            (None, Some(_)) => "sample",
            (None, None) => "whole",
        };
        json!({
            "kind": kind,
            "exhaustive": extent(self.table.sweep).is_none(),
            "machines_of_space": whole,
            "seed": definition.search.or(definition.sample).map(|of| of.seed),
            "rounds": rounds,
        })
    }

    /// As text. Writing to a string cannot fail.
    pub fn text(&self) -> String {
        let mut t = String::new();
        let (points, there) =
            (self.table.sweep.points.len(), self.table.rows.len() - self.made.min(self.table.rows.len()));
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
        if self.table.faults() > 0 {
            let faults = self.table.faults();
            _ = writeln!(t, "{faults} rows show an error beyond what is proved: a fault of edgewalk");
        }
        for line in extent(self.table.sweep).into_iter().chain(rule(self.table.sweep)) {
            _ = writeln!(t, "{line}");
        }
        for line in ruled_out(&self.table) {
            _ = writeln!(t, "{line}");
        }
        for (objective, candidate) in self.bests() {
            let value = self.table.value(objective, candidate);
            let file = self.out.join(best_file(objective.name));
            _ = writeln!(t, "best {:<14} {:<12} {}", objective.name, number(value), file.display());
        }
        let front: Vec<&Candidate> = self.table.first_front().collect();
        let names: Vec<&str> = self.table.sweep.objectives.iter().map(|objective| objective.name).collect();
        _ = writeln!(
            t,
            "front of {}: {} of {} machines",
            names.join(", "),
            front.len(),
            self.table.machines.len()
        );
        for candidate in front.iter().take(SHOWN) {
            let row = candidate.row();
            // A key of a unit that the machine has not is not told.
            let keys = self.table.sweep.axes.iter().filter_map(|axis| {
                let value = row["keys"].get(axis.key.name)?;
                let shown = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
                Some(format!("{}={shown}", axis.key.name))
            });
            let values = candidate.values.iter().flatten().map(|value| number(*value));
            _ = writeln!(
                t,
                "    {}  {}{}",
                values.collect::<Vec<_>>().join("  "),
                keys.collect::<Vec<_>>().join(" "),
                self.by_memory(candidate)
            );
        }
        if front.len() > SHOWN {
            _ = writeln!(t, "    and {} more, in {}", front.len() - SHOWN, self.out.join(TABLE).display());
        }
        t
    }

    /// The machine's cycles with each memory, unless there is one that never waits.
    fn by_memory(&self, candidate: &Candidate) -> String {
        let memories = &self.table.sweep.memories;
        if matches!(&memories[..], [memory] if memory.waits == Waits::Never) {
            return String::new();
        }
        let of = |(place, memory): (usize, &Memory)| {
            let cycles =
                candidate.cycles(&self.table.sweep.judge, place).map_or_else(|| "-".to_owned(), number);
            format!("{} {cycles}", memory.name)
        };
        format!("  cycles: {}", memories.iter().enumerate().map(of).collect::<Vec<_>>().join(", "))
    }

    /// Mismatch where an error exceeds what is proved; vacuous where nothing was drawn at all.
    ///
    /// # Errors
    /// Machines were drawn, and of none the tools gave figures.
    pub fn verdict(&self) -> Result<Verdict> {
        let of = |wanted: Status| self.table.rows.iter().filter(move |row| row["status"] == wanted.name());
        if self.table.faults() > 0 {
            return Ok(Verdict::Mismatch);
        }
        let known = of(Status::Ok).chain(of(Status::Pruned)).count();
        // A row that was drawn and compared, and failed in a tool.
        let broken = of(Status::Failed).find(|row| row["report"].is_object() && row["verdict"] != "open");
        match of(Status::Timeout).next().or(broken) {
            Some(row) if known == 0 => Err(NoFigures {
                why: row["reason"].as_str().unwrap_or_default().to_owned(),
                late: row["status"] == Status::Timeout.name(),
            }
            .into()),
            _ => Ok(Verdict::drew(known as u64)),
        }
    }
}

/// How the inputs and memories of a sweep count together, where there are several.
fn together(sweep: &Sweep) -> String {
    rule(sweep).iter().map(|line| format!("; {line}")).collect()
}

/// Machines of the front that are told; the table has all.
const SHOWN: usize = 20;
