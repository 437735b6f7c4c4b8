//! `edgewalk vectors`: stimuli, expected results and self-checking test benches.

use crate::document::document;
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::number::whole;
use crate::suites::{self, Set, check_unit, of_input, only, stalls};
use crate::verdict::Verdict;
use crate::{Talk, own};
use anyhow::{Result, anyhow, ensure};
use edgewalk_files::Staging;
use edgewalk_vectors::dut::Wiring;
use edgewalk_vectors::{MAX_COUNT, SUITES, StallKind, Suite, Tables, Unit};
use serde_json::json;
use std::path::PathBuf;

/// Write test vectors with benches for Icarus and Verilator, a directory for each suite and unit.
///
/// With an input, its triangles are the suite. `make HDL=mine.v` in a directory replays the vectors into another
/// design with the same ports. `make CHECK_CYCLES=0` is for a design with other timing: order and values count,
/// cycles and status do not. With --dut the benches are wired to a design with other port names, as its file says
/// (docs/own_rtl.md); ports and widths are checked first.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk vectors --out out/vectors
  edgewalk vectors --suite hazards --unit depth --stalls late --out out/v
  edgewalk vectors triangles.tri --unit pixel --no-csv --out out/mine
  make -C out/v/hazards_depth icarus verilator lint
  make -C out/mine/triangles_pixel icarus HDL=mine.v CHECK_CYCLES=0
  edgewalk vectors --dut dut.toml --suite hazards --suite corners --out out/own
  make -C out/own/hazards_pixel icarus verilator lint
  edgewalk vectors --suite hazards --only knee_line_of_one_pixel --unit pixel --out out/one")]
pub struct Args {
    /// A built-in scene, a scene file (.toml), a mesh (.obj, .gltf, .glb) or a triangle file (.tri) whose triangles are a suite
    #[arg(value_name = "SCENE|MESH|FILE.tri")]
    input: Option<String>,
    /// Set the keys of the machine that the input asks for; --set has the last word
    #[arg(long, requires = "input")]
    adapt: bool,
    /// Take this many triangles, polygons and lines of the input, evenly spread; all of them if left out
    #[arg(long, requires = "input", value_parser = whole::<u64>(1..))]
    triangles: Option<u64>,
    // The help is made from the list of suites.
    #[arg(long, value_name = "NAME", help = suites_help())]
    suite: Vec<String>,
    /// Units: machine, setup, edge, poly, span, term, pixel, texel, bump, normal, lamp, shade, project, shadow,
    /// dither, depth, blend; all units of the suite if left out
    #[arg(long, value_name = "NAME", value_parser = unit)]
    unit: Vec<Unit>,
    /// Cases: of every suite those of these names; all of them if left out
    #[arg(long, value_name = "CASE")]
    only: Vec<String>,
    /// Your own design in place of ours, described by this file (docs/own_rtl.md)
    #[arg(long, value_name = "FILE.toml", conflicts_with = "unit")]
    dut: Option<PathBuf>,
    /// Stalls by the bench: none, mixed, late; the suite's own if left out
    #[arg(long, value_parser = stalls)]
    stalls: Option<StallKind>,
    /// Seed of the random suite and of the stalls
    #[arg(long, default_value_t = 1, value_parser = whole::<u64>(..))]
    seed: u64,
    /// Triangles of the random suite, at most 10000; another seed draws others
    #[arg(long, default_value_t = 100, value_parser = whole::<u64>(1..=MAX_COUNT))]
    count: u64,
    /// Omit the tables for people, *.csv, which are more than half of the bytes
    #[arg(long)]
    no_csv: bool,
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/vectors")]
    out: PathBuf,
}

/// The suites by name, and what a machine must have for them.
fn suites_help() -> String {
    let mut groups: Vec<(Option<&str>, Vec<&str>)> = Vec::new();
    for suite in &SUITES {
        match groups.last_mut().filter(|(needs, _)| *needs == suite.needs()) {
            Some((_, names)) => names.push(suite.name),
            None => groups.push((suite.needs(), vec![suite.name])),
        }
    }
    let lists = groups.into_iter().map(|(needs, names)| match needs {
        Some(needs) => format!("with {needs} {}", names.join(", ")),
        None => names.join(", "),
    });
    format!("Suites: {}; all suites of the units if left out", lists.collect::<Vec<_>>().join("; "))
}

fn unit(name: &str) -> Result<Unit, String> {
    Unit::named(name).map_err(|e| e.to_string())
}

/// The list, with each of its entries once.
fn once<T: Clone + PartialEq>(list: &[T]) -> Vec<T> {
    let mut kept: Vec<T> = Vec::new();
    for entry in list {
        if !kept.contains(entry) {
            kept.push(entry.clone());
        }
    }
    kept
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let (machine, input) = match &args.input {
        Some(input) => {
            let source = Source::new(input, args.adapt);
            let machine = source.machine(machine)?;
            let port = source.to_port(&source.whole(&machine)?, &machine)?;
            let suite = of_input(input, &machine, &port, args.triangles)?;
            (machine, Some(Suite { seed: args.seed, ..suite }))
        }
        None => (machine.machine(None)?, None),
    };
    let wiring = args.dut.as_deref().map(|file| own::design(file, &machine)).transpose()?;
    let units = match &wiring {
        Some(Wiring { dut, .. }) => vec![dut.unit],
        None if args.unit.is_empty() => Unit::all(&machine),
        None => {
            args.unit.iter().try_for_each(|unit| check_unit(&machine, *unit))?;
            once(&args.unit)
        }
    };
    let all = args.input.is_none() && args.suite.is_empty();
    let named = once(&args.suite);
    let names: Vec<&str> = match all {
        true => SUITES.iter().filter(|suite| suite.is_for(&machine)).map(|suite| suite.name).collect(),
        false => named.iter().map(String::as_str).collect(),
    };
    if let (Some(input), Some(suite)) = (&args.input, &input) {
        ensure!(
            !names.contains(&suite.name.as_str()),
            "--suite {0}: {input} is a suite named {0} too; permitted: suites of different names; rename the file, or \
             write it into another --out",
            suite.name
        );
    }
    let built_in = names.iter().map(|name| {
        Suite::named(&machine, name, args.seed, args.count).map_err(|e| anyhow!("--suite {name}: {e}"))
    });
    let suites = input.into_iter().map(Ok).chain(built_in).collect::<Result<Vec<_>>>()?;
    // Of the suites that are not named those that say something about one of the units.
    let fits = |suite: &Suite| !all || units.iter().any(|unit| suite.is_for(*unit));
    let suites = only(suites.into_iter().filter(fits).collect(), &args.only)?;
    let out = Staging::new(&args.out)?;
    let set = Set {
        suites: &suites,
        units: &units,
        stalls: args.stalls,
        tables: if args.no_csv { Tables::LeftOut } else { Tables::Written },
        own: wiring.as_ref(),
    };
    let written = set.write(&machine, &out, "", talk)?;
    out.publish(&suites::own(&args.out, "", &written))?;
    talk.say(
        || document("vector-folders", json!({ "hash": machine.hash(), "directories": written })),
        || format!("machine {} -> {}\n    {}", machine.hash(), args.out.display(), written.join("\n    ")),
    )?;
    Ok(Verdict::Pass)
}
