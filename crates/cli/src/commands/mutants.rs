//! `edgewalk mutants`: how many single faults of a unit's Verilog a user's own bench finds.
//!
//! ```text
//!  netlist ─> faults ─> sample by seed ─ those without a verdict ─> Verilog ─> the user's command ─> verdicts.jsonl, report
//! ```

mod bench;
mod survivor;
mod verdicts;

use crate::document::document;
use crate::machine_args::MachineArgs;
use crate::number::whole;
use crate::suites::check_unit;
use crate::verdict::Verdict;
use crate::{Talk, jobs, own, progress};
use anyhow::{Context as _, Result, anyhow};
use bench::{Bench, Ended};
use edgewalk_machine::Plan;
use edgewalk_netlist::Netlist;
use edgewalk_netlist::mutate::{Mutant, mutants};
use edgewalk_vectors::{Interface, Unit, dut};
use rand::SeedableRng;
use rand::seq::index;
use rand_pcg::Pcg64Mcg;
use serde::Serialize;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use survivor::{Look, Survivor};
use verdicts::{Row, Store};

/// Score your own bench: single faults of a unit's Verilog, one at a time, through your command.
///
/// The command runs in a shell, in a folder of its own. Exit code 0 says that the design passes. A fault is found if
/// the command ends with another code, or exceeds --limit. {hdl} in the command stands for the design's files. The
/// design without a fault must pass first.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk vectors --suite hazards --suite corners --unit pixel --out out/v
  edgewalk mutants --unit pixel --in out/v/hazards_pixel --bench 'make icarus HDL=\"{hdl}\"' --sample 40
  edgewalk mutants --dut dut.toml --in my_bench --bench './run.sh {hdl}' --sample 100 --seed 2 --least 95

A run that was cut short goes on where it ended: --out keeps a verdict for each fault. A verdict holds for the same version
of edgewalk, machine, design, command and folder of --in. A fault found by time is tried again under a longer --limit.")]
pub struct Args {
    /// Command of your bench, for the shell
    #[arg(long, value_name = "CMD")]
    bench: String,
    /// Unit whose faults are tried
    #[arg(long, value_name = "NAME", value_parser = unit, required_unless_present = "dut")]
    unit: Option<Unit>,
    /// Give the design the names and ports of your own, as this file describes them (docs/own_rtl.md)
    #[arg(long, value_name = "FILE.toml", conflicts_with = "unit")]
    dut: Option<PathBuf>,
    /// Folder that your bench needs; the command runs in a copy of it. A link to a folder outside names that folder in the
    /// copy too; what is in there counts for no verdict
    #[arg(long = "in", value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Faults to try, drawn by the seed; all of them if left out
    #[arg(long, value_parser = whole::<u64>(1..))]
    sample: Option<u64>,
    /// Seed of the sample
    #[arg(long, default_value_t = 1, value_parser = whole::<u64>(..))]
    seed: u64,
    /// Seconds that the command may take for a design
    #[arg(long, default_value_t = 60, value_parser = whole::<u64>(1..))]
    limit: u64,
    /// Ask the prover (Yosys) about faults that neither your bench nor a suite shows; those that it proves to change
    /// nothing are not counted
    #[arg(long)]
    prove: bool,
    /// End with exit code 1 if less than this share of the faults is found, percent
    #[arg(long, value_name = "PERCENT", value_parser = whole::<u8>(0..=100))]
    least: Option<u8>,
    /// Folder of verdicts.jsonl
    #[arg(long, value_name = "DIR", default_value = "out/mutants")]
    out: PathBuf,
}

fn unit(name: &str) -> Result<Unit, String> {
    Unit::named(name).map_err(|e| e.to_string())
}

/// What is told at the end.
#[derive(Serialize)]
struct Report {
    machine: String,
    unit: &'static str,
    bench: String,
    /// Faults that the unit's Verilog can have.
    faults: usize,
    /// Faults of the sample.
    tried: usize,
    found: usize,
    /// Of the found ones those at which the command took too long.
    found_by_time: usize,
    /// Of those tried the ones that were proved to change nothing.
    proved_equivalent: usize,
    /// Percent of those tried that were not proved to change nothing.
    share: f64,
    survivors: Vec<Survivor>,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = machine.machine(None)?;
    let wiring = args.dut.as_deref().map(|file| own::design(file, &machine)).transpose()?;
    let unit = wiring.as_ref().map(|wiring| wiring.dut.unit).or(args.unit);
    let unit = unit.ok_or_else(|| anyhow!("--unit or --dut is needed"))?;
    check_unit(&machine, unit)?;
    let around = match &wiring {
        None => None,
        Some(wiring) => {
            if let Some(memory) = wiring.dut.memories.keys().next() {
                return Err(anyhow!(
                    "{}: memories: {memory} is inside the design; permitted with mutants: memories that the bench keeps",
                    wiring.dut.file
                ));
            }
            let found = wiring.found.as_ref().ok_or_else(|| {
                anyhow!("{}: widths = \"unchecked\"; permitted with mutants: equal, extend", wiring.dut.file)
            })?;
            Some(dut::stand_in(&Interface::new(&machine, unit), wiring, found))
        }
    };
    let netlist = edgewalk_lockstep::netlist(&machine, unit)
        .map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    let faults = mutants(&netlist);
    let wanted =
        args.sample.map_or(faults.len(), |n| usize::try_from(n).unwrap_or(usize::MAX).min(faults.len()));
    let mut sample = index::sample(&mut Pcg64Mcg::seed_from_u64(args.seed), faults.len(), wanted).into_vec();
    sample.sort_unstable();
    let around = around.as_deref();
    let design = sources(&netlist, around);
    let file = verdicts::file(&args.out);
    let bench = Bench::new(&args.bench, args.folder.as_deref(), &file, Duration::from_secs(args.limit))?;
    // Within the folder of --in it is a part of the first key too.
    fs::create_dir_all(&args.out).with_context(|| format!("--out {}", file.display()))?;
    let store = Store::open(&file, &bench.key(&machine.hash(), &design)?, args.limit)?;
    match bench.run(&design)? {
        Ended::Passed => {}
        Ended::Failed(lines) => {
            let lines = lines.join("\n    ");
            return Err(anyhow!(
                "--bench: the design without a fault does not pass, so no fault can be found:\n    {lines}"
            ));
        }
        Ended::Late => {
            return Err(anyhow!(
                "--bench: the design without a fault takes longer than --limit {} s",
                args.limit
            ));
        }
    }
    let todo: Vec<usize> = sample.iter().copied().filter(|place| store.of(*place).is_none()).collect();
    let bar = progress::bar(todo.len() as u64, "faults", talk.quiet);
    jobs::all(&todo, &bar, |place| {
        let ended = bench.run(&sources(&faults[*place].apply(&netlist), around))?;
        store.add(Row { fault: *place, verdict: ended.word().to_owned(), limit: args.limit })
    })?;
    bar.finish_and_clear();
    let report = report(args, &machine, unit, &netlist, &faults, &sample, &store, talk)?;
    let least = f64::from(args.least.unwrap_or(0));
    let verdict = if report.share < least { Verdict::Mismatch } else { Verdict::Pass };
    talk.say(|| document("mutants", &report), || report.text(args.prove))?;
    Ok(verdict)
}

/// The Verilog of the design, name and text, with what gives it other ports.
fn sources(netlist: &Arc<Netlist>, around: Option<&str>) -> Vec<(String, String)> {
    let mut files = edgewalk_verilog::print(netlist);
    files.extend(around.map(|text| ("stand_in.v".to_owned(), text.to_owned())));
    files
}

#[allow(clippy::too_many_arguments, reason = "all that a run was about")]
fn report(
    args: &Args,
    machine: &Plan,
    unit: Unit,
    netlist: &Arc<Netlist>,
    faults: &[Mutant],
    sample: &[usize],
    store: &Store,
    talk: Talk,
) -> Result<Report> {
    let ended = |word: &str| {
        sample.iter().copied().filter(|place| store.of(*place).as_deref() == Some(word)).collect::<Vec<_>>()
    };
    let (failed, late, passed) = (ended("found"), ended("found by time"), ended("survived"));
    let survivors = if passed.is_empty() {
        Vec::new()
    } else {
        let look = Look::new(machine, unit, netlist, args.prove)?;
        let bar = progress::bar(passed.len() as u64, "survivors", talk.quiet);
        let survivors = jobs::all(&passed, &bar, |place| look.at(&faults[*place]))?;
        bar.finish_and_clear();
        survivors
    };
    let proved_equivalent = survivors.iter().filter(|survivor| survivor.proved_equivalent).count();
    let counted = sample.len() - proved_equivalent;
    Ok(Report {
        machine: machine.hash(),
        unit: unit.name(),
        bench: args.bench.clone(),
        faults: faults.len(),
        tried: sample.len(),
        found: failed.len() + late.len(),
        found_by_time: late.len(),
        proved_equivalent,
        share: 100.0 * (failed.len() + late.len()) as f64 / counted.max(1) as f64,
        survivors,
    })
}

impl Report {
    fn text(&self, proved: bool) -> String {
        let Report { machine, unit, bench, faults, tried, found, found_by_time, share, .. } = self;
        let mut text = format!("{unit} of machine {machine}, bench: {bench}\n");
        let counted = tried - self.proved_equivalent;
        // Writing to a string cannot fail.
        _ = writeln!(
            text,
            "found {found} / {counted} ({share:.1} %), {found_by_time} of them by time; the unit has {faults} faults"
        );
        if proved {
            _ = writeln!(text, "not counted, as proved to change nothing: {}", self.proved_equivalent);
        }
        self.survivors.iter().for_each(|survivor| text += &survivor.lines(proved));
        text
    }
}
