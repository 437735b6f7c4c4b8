//! `edgewalk estimate --family osu018`: what machines cost in standard cells of 0.18 um.

use super::rows::{Row, rows};
use crate::Talk;
use crate::document::document;
use crate::verdict::Verdict;
use anyhow::Result;
use edgewalk_machine::Plan;
use edgewalk_synth::Part;
use edgewalk_synth::estimate::{GateCounts, GatesEstimate, GatesFit};
use serde::Serialize;
use std::fmt::Write as _;

/// Name of the family on the command line: OSU's cells.
pub const FAMILY: &str = "osu018";

/// The report, as text and as JSON.
#[derive(Serialize)]
struct Report {
    unit: String,
    family: &'static str,
    /// What was fitted, and the errors of machines held out.
    fit: GatesFit,
    machines: Vec<Row<GatesEstimate>>,
}

/// Estimates the unit of each machine.
pub fn run(unit: &str, machines: &[(String, Plan)], talk: Talk) -> Result<Verdict> {
    let fit = GatesFit::known();
    let rows = rows(unit, machines, talk, |part, plan| {
        Ok(fit.estimate(&GateCounts::of(part, plan)?, part == Part::MACHINE))
    })?;
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
            "FF by Yosys' rules; gates by a model: of {} machines held out nine in ten lie within ±\n\
             memories within the machine are flip-flops; a gate is a NAND of two inputs, 24 um2",
            self.fit.machines
        );
        text
    }
}
