//! `edgewalk vectors`: stimuli, expected results and self-checking test benches.

use crate::machine_args::MachineArgs;
use crate::staging::Staging;
use crate::verdict::Verdict;
use crate::{Talk, jobs, progress};
use anyhow::{Result, anyhow};
use edgewalk_machine::Plan;
use edgewalk_model::DrawState;
use edgewalk_vectors::{SUITES, StallKind, Suite, Unit, capture, design, directory};
use std::path::{Component, Path, PathBuf};

/// Writes test vectors, a directory a suite and unit, that run as they are in Icarus and Verilator.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk vectors --out out/vectors
  edgewalk vectors --suite hazards --unit depth --stalls late --out out/v
  make -C out/v/hazards_depth icarus verilator lint")]
pub struct Args {
    /// Suites; all of them if left out: hazards, corners, random, sphere
    #[arg(long, value_name = "NAME")]
    suite: Vec<String>,
    /// Units: machine, setup, edge, span, pixel, depth; all of them if left out
    #[arg(long, value_name = "NAME", value_parser = unit)]
    unit: Vec<Unit>,
    /// How the bench makes the design wait: none, mixed, late
    #[arg(long, default_value = "none", value_parser = stalls)]
    stalls: StallKind,
    /// Seed of the random suite and of the stalls
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Triangles of the random suite
    #[arg(long, default_value_t = 100)]
    count: u64,
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/vectors")]
    out: PathBuf,
}

fn unit(name: &str) -> Result<Unit, String> {
    pick(name, Unit::ALL.into_iter().map(|u| (u.name(), u)))
}

/// Reads `--stalls`.
pub fn stalls(name: &str) -> Result<StallKind, String> {
    pick(name, StallKind::ALL.into_iter().map(|s| (s.name(), s)))
}

fn pick<T>(name: &str, mut list: impl Iterator<Item = (&'static str, T)> + Clone) -> Result<T, String> {
    let names: Vec<_> = list.clone().map(|(n, _)| n).collect();
    list.find(|(n, _)| *n == name)
        .map(|(_, value)| value)
        .ok_or_else(|| format!("one of {}", names.join(", ")))
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = machine.machine(None)?;
    let out = Staging::new(&args.out)?;
    let names: Vec<String> = if args.suite.is_empty() {
        SUITES.iter().map(|s| s.name.to_owned()).collect()
    } else {
        args.suite.clone()
    };
    let units = if args.unit.is_empty() { Unit::ALL.to_vec() } else { args.unit.clone() };
    let suites = names
        .iter()
        .map(|name| {
            Suite::named(&machine, name, args.seed, args.count).map_err(|e| anyhow!("--suite {name}: {e}"))
        })
        .collect::<Result<Vec<_>>>()?;
    let written = write(&machine, &suites, &units, args.stalls, &out, "", talk.quiet)?;
    out.publish(&own(&args.out, "", &written))?;
    talk.say(
        || Ok(serde_json::json!({ "hash": machine.hash(), "directories": written }).to_string()),
        || format!("machine {} -> {}\n    {}", machine.hash(), args.out.display(), written.join("\n    ")),
    )?;
    Ok(Verdict::Pass)
}

/// The suites that meet every corner on purpose.
pub fn directed(machine: &Plan) -> Result<Vec<Suite>> {
    ["hazards", "corners"]
        .iter()
        .map(|name| Suite::named(machine, name, 1, 0).map_err(|e| anyhow!("{e}")))
        .collect()
}

/// The files in these directories of an earlier run, as their own manifests list them.
pub fn own(out: &Path, folder: &str, directories: &[String]) -> Vec<String> {
    let mut own = Vec::new();
    for directory in directories {
        let manifest = std::fs::read(out.join(folder).join(directory).join("manifest.json"));
        // A manifest that is not there, or is not ours, lists nothing.
        let manifest: Option<serde_json::Value> =
            manifest.ok().and_then(|text| serde_json::from_slice(&text).ok());
        let files = manifest.as_ref().and_then(|manifest| manifest["files"].as_array());
        let names = files.into_iter().flatten().filter_map(|file| file["name"].as_str());
        let within =
            |name: &&str| Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
        own.extend(names.filter(within).map(|name| format!("{folder}{directory}/{name}")));
    }
    own
}

/// Writes one directory for each suite and unit under `folder` of `out`; returns their names.
pub fn write(
    machine: &Plan,
    suites: &[Suite],
    units: &[Unit],
    stalls: StallKind,
    out: &Staging,
    folder: &str,
    quiet: bool,
) -> Result<Vec<String>> {
    let work: Vec<(&Suite, Unit)> =
        suites.iter().flat_map(|suite| units.iter().map(move |unit| (suite, *unit))).collect();
    let bar = progress::bar(work.len() as u64, "vector directories", quiet);
    let written = jobs::all(&work, &bar, |(suite, unit)| {
        let trace = capture(machine, *unit, suite, DrawState::default(), stalls);
        let verilog =
            design::verilog(machine, *unit).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
        let name = format!("{}_{}", suite.name, unit.name());
        for (file, contents) in directory(suite, &trace, &verilog) {
            out.write(&format!("{folder}{name}/{file}"), contents)?;
        }
        Ok(name)
    })?;
    bar.finish_and_clear();
    Ok(written)
}
