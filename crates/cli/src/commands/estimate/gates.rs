//! `edgewalk estimate --family osu018`: what machines cost in standard cells of 0.18 um.

use crate::Talk;
use crate::document::document;
use crate::verdict::Verdict;
use anyhow::{Result, anyhow};
use edgewalk_machine::Plan;
use edgewalk_synth::Part;
use edgewalk_synth::estimate::{GateCounts, GatesEstimate, GatesFit};
use serde::Serialize;
use std::fmt::Write as _;
use std::time::Instant;

/// Name of the family on the command line: OSU's cells.
pub const FAMILY: &str = "osu018";

/// The report, as text and as JSON.
#[derive(Serialize)]
struct Report {
    unit: String,
    family: &'static str,
    /// What was fitted, and the errors of machines held out.
    fit: GatesFit,
    machines: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    name: String,
    /// Hash of the machine.
    machine: String,
    /// A number for what the netlist computes. The text does not tell it.
    shape: Option<String>,
    #[serde(flatten)]
    estimate: GatesEstimate,
    /// What the estimate took, netlist included.
    milliseconds: f64,
}

/// Estimates the unit of each machine.
pub fn run(unit: &str, machines: &[(String, Plan)], talk: Talk) -> Result<Verdict> {
    let fit = GatesFit::known();
    let mut rows = Vec::new();
    for (name, plan) in machines {
        let part = Part::named(unit, plan).map_err(|error| anyhow!("--unit {unit}: {error}"))?;
        let built = |error| anyhow!("{name}: the netlist cannot be built: {error}");
        let since = Instant::now();
        let estimate =
            fit.estimate(&GateCounts::of(part, plan).map_err(built)?, part.name() == Part::MACHINE.name());
        let milliseconds = since.elapsed().as_secs_f64() * 1000.0;
        let shape = talk.json.then(|| part.shape(plan).map(|shape| format!("{shape:016x}"))).transpose();
        rows.push(Row {
            name: if name.is_empty() { "default".to_owned() } else { name.clone() },
            machine: plan.hash(),
            shape: shape.map_err(built)?,
            estimate,
            milliseconds,
        });
    }
    let report = Report { unit: unit.to_owned(), family: FAMILY, fit, machines: rows };
    talk.say(|| document("estimate", &report), || report.text())?;
    Ok(Verdict::Pass)
}

impl Report {
    fn text(&self) -> String {
        let width =
            self.machines.iter().map(|row| row.name.chars().count()).max().unwrap_or(0).max("machine".len());
        let mut text = format!("{:width$}  {:>16}  {:>7}  {:>5}\n", "machine", "thousand gates", "FF", "ms");
        for row in &self.machines {
            let of = &row.estimate;
            let gates = format!("{:.1} ± {:.1}", of.est_kge.value, of.est_kge.error);
            let _ = writeln!(
                text,
                "{:width$}  {gates:>16}  {:>7}  {:>5.1}",
                row.name, of.est_ff, row.milliseconds
            );
        }
        let _ = writeln!(
            text,
            "FF as Yosys counts them; gates by a model: of {} machines held out nine in ten lie within ±\n\
             memories within the machine are flip-flops; a gate is a NAND of two inputs, 24 um2",
            self.fit.machines
        );
        text
    }
}
