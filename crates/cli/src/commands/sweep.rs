//! `edgewalk sweep`: many machines on the same frames, each a row.
//!
//! ```text
//!  --vary, --stalls, inputs ─> points ─ those without a row ─> runs.jsonl ─> runs.csv, best_*.toml, report.html
//! ```

mod chunks;
mod outcome;
mod pictures;
mod why;

use crate::commands::estimate::device;
use crate::cost::{SynthArgs, Synthesiser, ToolArgs, has_unit};
use crate::estimator::Estimator;
use crate::machine_args::MachineArgs;
use crate::number::{real, whole};
use crate::verdict::Verdict;
use crate::{Talk, progress};
use anyhow::{Context, Result, anyhow};
use edgewalk_explore::sweep::check::check;
use edgewalk_explore::sweep::evaluate::{Around, missing};
use edgewalk_explore::sweep::objective::OBJECTIVES;
use edgewalk_explore::sweep::row::Status;
use edgewalk_explore::sweep::shading::SHADINGS;
use edgewalk_explore::sweep::{Definition, Hunt, Judge, Point, Sample, Store, Sweep, run as evaluate, store};
use edgewalk_files::Staging;
use edgewalk_machine::Plan;
use outcome::Outcome;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Draw inputs on many machines and write a row for each: errors beside golden, cycles by cause, cells on request.
///
/// Machines that differ in timing keys alone share their pixels. Files in --out: runs.jsonl (a row a line, appended
/// as they come), runs.csv, best_NAME.toml for each objective, report.html, sweep.json. After an interruption the
/// same command continues; existing rows are kept. A row holds the report of `edgewalk render --json` for its
/// machine.
#[derive(clap::Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = after_help()
)]
pub struct Args {
    #[command(subcommand)]
    part: Option<Part>,
    #[command(flatten)]
    what: What,
    /// Run the points with this status once more (repeatable)
    #[arg(long, value_enum, value_name = "STATUS")]
    retry: Vec<Retry>,
}

const EXAMPLES: &str = "Examples:
  edgewalk sweep teapot.obj --vary interpolator.adders=1,2,4 --vary formats.z_fraction=6..14 --out out/sweep
  edgewalk sweep sphere torus --vary memory.latency=1..8 --stalls none --stalls dram:miss=8 --out out/stalls
  edgewalk sweep sphere torus --vary memory.latency=1..8 --weight sphere=3 --out out/weights
  edgewalk sweep teapot.obj --vary shade.kind=none,fast-phong,phong --out out/shading
  edgewalk sweep teapot.obj --vary setup.lanes=1,2,4 --synth ice40-hx8k --out out/cells
  edgewalk sweep teapot.obj --vary fifo.span=1..64 --vary fifo.inflight=1..16 --sample 100 --seed 7 --out out/some
  edgewalk sweep sphere --machine hx8k --vary formats.z_fraction=6..14 --vary setup.lanes=1,2,4 --fits ice40-hx8k --require 'z_error<=1' --out out/fit
  edgewalk sweep teapot.obj sphere --vary fifo.span=1..64 --vary fifo.inflight=1..16 --vary formats.z_fraction=0..24 \
--vary formats.color_fraction=4..16 --vary interpolator.adders=1,2,4 --search 2000 --seed 7 --out out/search
  edgewalk sweep plan teapot.obj --vary formats.z_fraction=4..24 --chunks 8 --out out/grid
  edgewalk sweep why 3f2a --out out/sweep";

/// Examples, and the names of all objectives.
fn after_help() -> String {
    let names = |synth: bool| {
        let of = OBJECTIVES.iter().filter(|objective| objective.synth == synth);
        of.map(|objective| objective.name).collect::<Vec<_>>().join(" ")
    };
    format!("{EXAMPLES}\n\nObjectives: {}\nWith --synth also: {}", names(false), names(true))
}

#[derive(clap::Subcommand)]
enum Part {
    /// Write sweep.json and job scripts for parts of the sweep, without running any
    Plan(Box<PlanArgs>),
    /// Run a part of a planned sweep
    Run(RunArgs),
    /// Merge the rows of all parts
    Merge(OutArgs),
    /// List the dependencies of a row, and those that have changed
    Why(WhyArgs),
}

/// What is swept over.
#[derive(clap::Args)]
struct What {
    /// Built-in scenes, scene files, meshes, triangle files
    #[arg(value_name = "INPUT", required = true)]
    inputs: Vec<String>,
    /// A key and its values: key=a,b,c or key=lo..hi or key=lo..hi..step (repeatable)
    #[arg(long, value_name = "KEY=VALUES", required = true)]
    vary: Vec<String>,
    /// Shading of scenes and meshes on every machine: constant, constant-averaged, gouraud; phong and fast-phong on
    /// machines with that shade.kind. If left out, the shade.kind of each machine decides, with gouraud for none
    #[arg(long, value_name = "SHADING", value_parser = clap::builder::PossibleValuesParser::new(SHADINGS.map(|of| of.0)))]
    shading: Option<String>,
    /// Stalls of a memory that every machine runs with: none, fixed, random, dram, with parameters as fixed:rd=2
    /// (repeatable)
    #[arg(long, value_name = "KIND")]
    stalls: Vec<String>,
    /// Memory that counts in bests and fronts: worst (for each objective), sum (of cycles and bytes), or one of
    /// --stalls
    #[arg(long, value_name = "WHICH", default_value = Judge::WORST)]
    judge: String,
    /// What of several inputs counts: sum (of cycles and bytes; of everything else the worst), or worst (for each objective)
    #[arg(long, value_name = "WHICH", default_value = Judge::SUM)]
    judge_inputs: String,
    /// Weight of an input in the sum of cycles and bytes (repeatable); 1 if left out
    #[arg(long, value_name = "INPUT=NUMBER")]
    weight: Vec<String>,
    /// Number of machines to take at random
    #[arg(long, value_name = "N", group = "some", value_parser = whole::<u32>(..))]
    sample: Option<u32>,
    /// Number of machines to look at in a search, for spaces that are too large to be run whole: half of them at random,
    /// the others neighbours of the best, on the first input; then the better half on twice as many inputs, and so on
    #[arg(long, value_name = "N", group = "some", value_parser = whole::<u32>(..))]
    search: Option<u32>,
    /// Seed of --sample or --search
    #[arg(long, value_name = "S", requires = "some", value_parser = whole::<u64>(..))]
    seed: Option<u64>,
    /// Skip points without a proved bound of at most this many LSB at pixels inside the input's triangles
    #[arg(long, value_name = "LSB", value_parser = real(f64::NEG_INFINITY..=f64::INFINITY, "LSB"))]
    bound: Option<f64>,
    /// What a machine must keep, NAME<=NUMBER or NAME>=NUMBER by the names of the objectives (repeatable). Cells and
    /// clock are estimated without --synth; with it, only machines that the estimate's error leaves open are built
    #[arg(long, value_name = "LIMIT")]
    require: Vec<String>,
    /// Device that a machine must fit by its estimate: ice40-hx8k, ice40-up5k, ecp5-25 (repeatable)
    #[arg(long, value_name = "DEVICE")]
    fits: Vec<String>,
    /// Estimate cells and clock of every machine (see `edgewalk estimate`)
    #[arg(long)]
    estimate: bool,
    /// Objective of bests and fronts (repeatable)
    #[arg(long, value_name = "NAME")]
    objective: Vec<String>,
    #[command(flatten)]
    synth: SynthArgs,
    /// Folder of the sweep
    #[arg(long, value_name = "DIR", required = true)]
    out: Option<PathBuf>,
}

#[derive(clap::Args)]
struct PlanArgs {
    #[command(flatten)]
    what: What,
    /// Number of parts; a part should take two minutes or more
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1..=10000))]
    chunks: u32,
}

#[derive(clap::Args)]
struct RunArgs {
    /// Folder of the sweep
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Number of the part, from 0; SLURM_ARRAY_TASK_ID or HQ_TASK_ID if left out
    #[arg(long, value_name = "I", value_parser = whole::<u32>(..))]
    chunk: Option<u32>,
    /// Run the points with this status once more (repeatable)
    #[arg(long, value_enum, value_name = "STATUS")]
    retry: Vec<Retry>,
    #[command(flatten)]
    tools: ToolArgs,
}

#[derive(clap::Args)]
struct OutArgs {
    /// Folder of the sweep
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

#[derive(clap::Args)]
struct WhyArgs {
    /// The key of a row, or its first digits
    key: String,
    /// Folder of the sweep
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// What may be tried again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Retry {
    /// Points that could not be drawn, or that a tool failed on
    Failed,
    /// Points that exceeded the time limit of a tool
    Timeout,
}

impl From<Retry> for Status {
    fn from(retry: Retry) -> Self {
        match retry {
            Retry::Failed => Status::Failed,
            Retry::Timeout => Status::Timeout,
        }
    }
}

/// Rows, and what they belong to.
const ROWS: &str = "runs.jsonl";
const DEFINITION: &str = "sweep.json";

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    if matches!(args.part, Some(Part::Run(_) | Part::Merge(_) | Part::Why(_))) {
        machine.refuse("sweep.json has the machine")?;
    }
    match &args.part {
        Some(Part::Plan(plan)) => {
            chunks::plan(&plan.what.definition(machine, Some(plan.chunks))?, plan.what.out()?, talk)
        }
        Some(Part::Run(part)) => chunks::run(part, talk),
        Some(Part::Merge(part)) => chunks::merge(&part.out, talk),
        Some(Part::Why(args)) => why::run(&args.key, &args.out, talk),
        None => {
            let out = args.what.out()?;
            let sweep = opened(args.what.definition(machine, None)?)?;
            let again = args.retry.iter().map(|retry| Status::from(*retry)).collect::<Vec<_>>();
            match Hunt::of(&sweep) {
                Some(hunt) => searched(sweep, hunt, out, &again, args.what.synth.tools(), talk),
                None => swept(&sweep, out, &again, args.what.synth.tools(), talk),
            }
        }
    }
}

impl What {
    fn out(&self) -> Result<&Path> {
        self.out.as_deref().ok_or_else(|| anyhow!("--out: name the folder of the sweep"))
    }

    fn definition(&self, machine: &MachineArgs, chunks: Option<u32>) -> Result<Definition> {
        Ok(Definition {
            inputs: self.inputs.clone(),
            shading: self.shading.clone(),
            machine: machine.keys()?.every_key_to_toml(),
            vary: self.vary.clone(),
            stalls: self.stalls.clone(),
            judge: self.judge.clone(),
            judge_inputs: self.judge_inputs.clone(),
            weights: self.weight.clone(),
            sample: self.sample.map(|points| Sample { points, seed: self.seed.unwrap_or(1) }),
            search: self.search.map(|points| Sample { points, seed: self.seed.unwrap_or(1) }),
            bound: self.bound,
            require: self.require.clone(),
            fits: self
                .fits
                .iter()
                .map(|name| device(name).map(|device| device.name.to_owned()))
                .collect::<Result<_>>()?,
            estimate: self.estimate,
            objectives: self.objective.clone(),
            synth: self.synth.asked()?,
            chunks,
            ..Definition::default()
        })
    }
}

/// Runs what is missing, then writes what follows from all rows.
fn swept(sweep: &Sweep, out: &Path, again: &[Status], tools: &ToolArgs, talk: Talk) -> Result<Verdict> {
    let (store, rows) = begun(sweep, out)?;
    let all = sweep.points.iter().collect::<Vec<_>>();
    let made = points(sweep, &all, (&store, store::by_key(rows)), again, tools, talk)?;
    finished(sweep, out, made, talk)
}

/// Runs a search round by round, then writes what follows from all its rows.
fn searched(
    mut sweep: Sweep,
    mut hunt: Hunt,
    out: &Path,
    again: &[Status],
    tools: &ToolArgs,
    talk: Talk,
) -> Result<Verdict> {
    let (store, rows) = begun(&sweep, out)?;
    let (mut rows, mut made) = (store::by_key(rows), 0);
    while let Some(places) = hunt.next(&mut sweep, &rows) {
        let of: Vec<&Point> = places.iter().map(|place| &sweep.points[*place]).collect();
        made += points(&sweep, &of, (&store, rows), again, tools, talk)?;
        rows = store::by_key(store::read(store.path())?);
    }
    finished(&sweep, out, made, talk)
}

/// Runs those of the points that have no row. Returns how many rows it made.
fn points(
    sweep: &Sweep,
    of: &[&Point],
    (store, rows): (&Store, BTreeMap<String, Value>),
    again: &[Status],
    tools: &ToolArgs,
    talk: Talk,
) -> Result<usize> {
    check(sweep, &rows).map_err(|why| anyhow!("{}: {why}", store.path().display()))?;
    let todo = missing(sweep, of, &rows, again);
    let synthesiser = sweep.definition.synth.as_ref().map(|of| Synthesiser::new(of, tools)).transpose()?;
    if let (Some(synthesiser), false) = (&synthesiser, todo.is_empty()) {
        synthesiser.check()?;
    }
    let bar = progress::bar(todo.len() as u64, "points", talk.quiet);
    let cost = synthesiser.as_ref().map(|synthesiser| |machine: &Plan| synthesiser.cost(machine));
    let cost = cost.as_ref().map(|cost| cost as &(dyn Fn(&Plan) -> _ + Sync));
    let devices = sweep.definition.fits.iter().map(|name| device(name)).collect::<Result<Vec<_>>>()?;
    let unit = sweep.definition.synth.as_ref().map_or("machine", |of| &of.unit);
    let estimator = sweep.asks_estimate().then(|| Estimator::new(unit, devices));
    let estimate = estimator.as_ref().map(|estimator| |machine: &Plan| estimator.value(machine));
    let estimate = estimate.as_ref().map(|estimate| estimate as &(dyn Fn(&Plan) -> _ + Sync));
    evaluate(sweep, &todo, &Around { store, cost, estimate, done: &|| bar.inc(1) })?;
    bar.finish_and_clear();
    Ok(todo.len())
}

/// Opens the rows, and then writes what the sweep is, before anything runs. The lock on the rows comes first: a sweep that
/// runs in the folder keeps its definition.
fn begun(sweep: &Sweep, out: &Path) -> Result<(Store, Vec<Value>)> {
    std::fs::create_dir_all(out).with_context(|| format!("--out {}", out.display()))?;
    let opened = Store::open(&out.join(ROWS))?;
    let staging = Staging::new(out)?;
    staging.accept(outcome::files())?;
    staging.write(DEFINITION, serde_json::to_string_pretty(&sweep.definition)? + "\n")?;
    staging.publish(&[DEFINITION])?;
    Ok(opened)
}

/// The sweep that a folder holds.
fn kept(out: &Path) -> Result<Sweep> {
    let path = out.join(DEFINITION);
    let named = || path.display().to_string();
    let text = std::fs::read_to_string(&path).with_context(named)?;
    let definition: Definition = serde_json::from_str(&text).with_context(named)?;
    let (format, [major, minor]) = (&definition.format, definition.version);
    if (format.as_str(), definition.version) != (Definition::FORMAT, Definition::FORMAT_VERSION) {
        let [own, own_minor] = Definition::FORMAT_VERSION;
        return Err(anyhow!(
            "{}: format {format} of version {major}.{minor}: permitted: {} of version {own}.{own_minor}; plan it anew",
            named(),
            Definition::FORMAT
        ));
    }
    let version = env!("CARGO_PKG_VERSION");
    if definition.program != version {
        return Err(anyhow!(
            "{}: planned by edgewalk {}, this is {version}; plan it anew",
            named(),
            definition.program
        ));
    }
    opened(definition).with_context(named)
}

/// The sweep with its inputs, which are read here. A unit that is synthesised is one of a machine of the sweep.
fn opened(definition: Definition) -> Result<Sweep> {
    let _reading = progress::reading();
    let sweep = Sweep::new(definition)?;
    let unit = sweep.definition.synth.as_ref().map_or("machine", |of| &of.unit);
    let plans = || sweep.points.iter().filter_map(|point| point.plan.as_ref().ok());
    match plans().next() {
        Some(first) if !plans().any(|plan| has_unit(unit, plan).is_ok()) => has_unit(unit, first)?,
        _ => {}
    }
    Ok(sweep)
}

/// Writes and tells what follows from the rows, of which this run made so many.
fn finished(sweep: &Sweep, out: &Path, made: usize, talk: Talk) -> Result<Verdict> {
    let rows = store::by_key(store::read(&out.join(ROWS))?);
    let outcome = Outcome::new(sweep, &rows, out, made);
    outcome.publish(talk)?;
    talk.say(|| outcome.json(), || outcome.text())?;
    outcome.verdict()
}
