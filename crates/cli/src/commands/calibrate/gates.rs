//! `edgewalk calibrate --family osu018`: maps machines onto standard cells, and fits areas to them.

use super::plan;
use crate::Talk;
use crate::document::document;
use crate::progress;
use crate::verdict::Verdict;
use anyhow::{Context, Result, anyhow};
use edgewalk_synth::estimate::{GateCounts, GatesFit, MeasuredUnit};
use edgewalk_synth::{Cache, Design, Library, Part, gates};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

/// Where machines are mapped.
pub struct Bench<'b> {
    pub cache: &'b Cache,
    /// For each run of a tool.
    pub limit: Duration,
}

#[derive(serde::Serialize)]
struct Report {
    /// Units that were fitted to or held out.
    rows: usize,
    /// Rows of netlists that have changed since, which count for nothing.
    stale: usize,
    fit: GatesFit,
}

/// Maps the machines of these lines on the bench, if there is one, and fits to all rows of the table. The files are the table and
/// the fit.
pub fn run(lines: &[&str], bench: Option<&Bench>, [data, fitted]: [&Path; 2], talk: Talk) -> Result<Verdict> {
    let table = if data.exists() { super::read(data)? } else { String::new() };
    let mut rows = MeasuredUnit::rows(&table).map_err(|why| anyhow!("{}: {why}", data.display()))?;
    let bar = progress::bar(lines.len() as u64, "machines", talk.quiet);
    if let Some(bench) = bench {
        for (place, line) in lines.iter().enumerate() {
            if bench.add(line, place % 2 == 1, &mut rows)? {
                std::fs::write(data, MeasuredUnit::table(&rows))
                    .with_context(|| data.display().to_string())?;
            }
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let all = rows.len();
    let samples = samples(rows)?;
    if samples.is_empty() {
        return Err(anyhow!("{}: no row is of a netlist as it is today; add --count N", data.display()));
    }
    let held_out = samples.iter().filter(|(row, _)| row.held_out).count();
    super::both(data, held_out, held_out == samples.len())?;
    let fit = GatesFit::to(&samples);
    std::fs::write(fitted, document("fit", &fit)?).with_context(|| fitted.display().to_string())?;
    let report = Report { rows: samples.len(), stale: all - samples.len(), fit };
    talk.say(|| document("calibrate", &report), || report.text())?;
    Ok(Verdict::Pass)
}

impl Report {
    fn text(&self) -> String {
        format!(
            "{} rows, {} of netlists that have changed since\nheld out: {} machines; nine in ten within {:.1} %, of their \
             units within {:.1} %\n",
            self.rows,
            self.stale,
            self.fit.machines,
            100.0 * self.fit.error,
            100.0 * self.fit.error_of_unit
        )
    }
}

impl Bench<'_> {
    /// Maps a machine, unless there are rows of the same netlist. Whether there are new rows.
    fn add(&self, line: &str, held_out: bool, rows: &mut Vec<MeasuredUnit>) -> Result<bool> {
        let plan = plan(line)?;
        let built = |error| anyhow!("{line}: the netlist cannot be built: {error}");
        let shape = Part::MACHINE.shape(&plan).map_err(built)?;
        if rows.iter().any(|row| row.machine == line && row.shape == shape) {
            return Ok(false);
        }
        let design = Design::new(&plan, Part::MACHINE).map_err(built)?;
        let found = gates(&design, &Library::installed()?, self.cache, self.limit)?.placeless;
        rows.retain(|row| row.machine != line);
        rows.extend(found.units.iter().map(|unit| MeasuredUnit {
            machine: line.to_owned(),
            shape,
            held_out,
            unit: unit.unit.clone(),
            ff: unit.flip_flops,
            area_um2: unit.area_um2,
            yosys: super::field(Some(found.tools[0].clone())),
        }));
        Ok(true)
    }
}

/// Rows of netlists as they are today, with what their units come to.
fn samples(rows: Vec<MeasuredUnit>) -> Result<Vec<(MeasuredUnit, GateCounts)>> {
    let machines: BTreeMap<String, u64> = rows.iter().map(|row| (row.machine.clone(), row.shape)).collect();
    let units = |(line, shape): (&String, &u64)| -> Result<Option<(String, BTreeMap<String, GateCounts>)>> {
        let plan = plan(line)?;
        let built = |error| anyhow!("{line}: the netlist cannot be built: {error}");
        if Part::MACHINE.shape(&plan).map_err(built)? != *shape {
            return Ok(None);
        }
        Ok(Some((line.clone(), GateCounts::of(Part::MACHINE, &plan).map_err(built)?)))
    };
    let found = machines.par_iter().map(units).collect::<Result<Vec<_>>>()?;
    let found: BTreeMap<String, BTreeMap<String, GateCounts>> = found.into_iter().flatten().collect();
    let of = |row: &MeasuredUnit| Some(*found.get(&row.machine)?.get(&row.unit)?);
    Ok(rows.into_iter().filter_map(|row| of(&row).map(|counts| (row, counts))).collect())
}
