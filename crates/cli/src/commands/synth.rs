//! `edgewalk synth`: what the machine, or a part of it, costs on FPGAs.
//!
//! ```text
//!  machine ─> part ─> Verilog with a harness ─> yosys, nextpnr (target by target, seed by seed) ─> table, JSON
//! ```

mod table;

use crate::cost::cache_folder;
use crate::document::document;
use crate::machine_args::MachineArgs;
use crate::number::whole;
use crate::verdict::Verdict;
use crate::{Talk, progress};
use anyhow::{Context, Result, anyhow};
use edgewalk_files::{Scratch, Staging};
use edgewalk_machine::{Plan, Unknown};
use edgewalk_synth::{Cache, Design, Flow, Part, Target};
use rayon::prelude::*;
use std::path::PathBuf;
use std::time::Duration;
use table::Report;

/// Synthesise the machine, or a part of it, for FPGAs: cells by unit, packed cells, clock over seeds, critical
/// path.
///
/// Yosys and nextpnr see the emitted Verilog in a harness that leaves clk, rst and two serial pins. The cells of
/// the harness are counted apart. A figure that a target cannot give is null in the JSON, with the reason: the
/// design does not fit, or a tool is missing. The command fails only if no target gives any figure. Results of the
/// tools are cached by Verilog, versions and seed; the cache may be removed at any time.
///
/// Tools for ice40: apt-get install yosys nextpnr-ice40. Tools for ecp5 are two wheels; the command prints how to
/// install them.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk synth
  edgewalk synth --unit engine --target ice40-hx8k --target ice40-up5k --json
  edgewalk synth --unit span --seeds 1 --set interpolator.adders=1
  edgewalk synth --target ecp5-25 --out out/synth")]
pub struct Args {
    /// machine, engine (all units but setup), or the name of a unit of this machine
    #[arg(long, value_name = "UNIT", default_value = "machine")]
    unit: String,
    /// Device: ice40-hx8k, ice40-up5k, ecp5-25 (repeatable)
    #[arg(long, value_name = "TARGET", default_value = "ice40-hx8k", value_parser = target)]
    target: Vec<Target>,
    /// Place and route with the seeds 1 to N
    #[arg(long, default_value_t = 5, value_name = "N", value_parser = whole::<u32>(1..=1000))]
    seeds: u32,
    /// Do not count the cells of each unit: one synthesis instead of two
    #[arg(long)]
    whole: bool,
    /// Tools that run at once; the number of cores if left out
    #[arg(long, value_name = "N", value_parser = whole::<u16>(1..))]
    jobs: Option<u16>,
    /// Time limit of each run of a tool, seconds
    #[arg(long, default_value_t = 3600, value_name = "SECONDS", value_parser = whole::<u64>(1..))]
    limit: u64,
    /// Folder of the cache; $XDG_CACHE_HOME/edgewalk/synth or ~/.cache/edgewalk/synth if left out
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
    /// Folder for synthesis.json and the Verilog that the tools saw
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

fn target(name: &str) -> Result<Target, Unknown> {
    Target::named(name)
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = machine.machine(None)?;
    let part = Part::named(&args.unit, &machine).map_err(|error| anyhow!("--unit {}: {error}", args.unit))?;
    let design = design(&machine, part)?;
    let out = args.out.as_deref().map(Staging::new).transpose()?;
    let folder = cache_folder(args.cache.as_deref())?;
    // Where results move from: in the same file system, and gone even where a signal ends the program.
    let scratch = Scratch::within(&folder).with_context(|| format!("--cache {}", folder.display()))?;
    let cache = Cache::new(folder, scratch.path().to_owned());

    let mut targets = args.target.clone();
    targets.dedup();
    let seeds: Vec<u32> = (1..=args.seeds).collect();
    let bar = progress::bar(0, "runs of tools", talk.quiet);
    let flow = Flow {
        cache: &cache,
        limit: Duration::from_secs(args.limit),
        seeds: &seeds,
        by_unit: !args.whole,
        done: &|| bar.inc(1),
    };
    bar.set_length(flow.steps() * targets.len() as u64);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(args.jobs.map_or(0, usize::from)).build()?;
    let outcomes: Vec<_> =
        pool.install(|| targets.par_iter().with_max_len(1).map(|target| flow.run(&design, target)).collect());
    bar.finish_and_clear();

    if let Some(stop) = outcomes.iter().map(|outcome| outcome.stop.clone()).collect::<Option<Vec<_>>>() {
        return Err(stop.into_iter().next().map_or_else(|| anyhow!("no target"), Into::into));
    }
    let report = Report::new(&machine, &design, &cache, outcomes);
    if let Some(out) = out {
        for (name, text) in &design.files {
            out.write(&format!("hdl/{name}"), format!("{}\n{text}", machine.stamp("//")))?;
        }
        out.write("synthesis.json", document("synthesis", &report)?)?;
        out.publish(&own(&machine)?)?;
    }
    talk.say(|| document("synthesis", &report), || report.text())?;
    Ok(Verdict::Pass)
}

fn design(machine: &Plan, part: Part) -> Result<Design> {
    Design::new(machine, part).map_err(|e| anyhow!("the netlist cannot be built: {e}"))
}

/// The files that the command may write for some part of this machine.
fn own(machine: &Plan) -> Result<Vec<String>> {
    let mut own = crate::design::own("hdl/");
    own.push("hdl/edgewalk_engine.v".to_owned());
    own.extend(design(machine, Part::MACHINE)?.files.into_iter().map(|(name, _)| format!("hdl/{name}")));
    Ok(own)
}
