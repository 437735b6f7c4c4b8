//! `edgewalk verify`: model against netlist in every port and cycle, then the emitted Verilog in both simulators.

mod difference;
mod events;
mod netlists;
mod nothing;
mod own;

use crate::document::document;
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::number::whole;
use crate::suites::{directed, functions, of_input, only, stalls, warn_of_gaps};
use crate::verdict::Verdict;
use crate::{Talk, jobs, junit, progress};
use anyhow::{Context, Result, anyhow};
use edgewalk_files::{Scratch, Staging};
use edgewalk_lockstep::{Agreement, LockstepError};
use edgewalk_machine::{Plan, Unknown};
use edgewalk_vectors::dut::Wiring;
use edgewalk_vectors::{
    Files, Outcome, Runs, Simulator, StallKind, Suite, Tables, Trace, Unit, design, directory, reached,
    simulate,
};
use events::Events;
use netlists::Netlists;
use serde::Serialize;
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Verify the machine: model against netlist at every port in every cycle, then its Verilog in Icarus and
/// Verilator.
///
/// The directed suites go through the machine and each of its units. The suites of the depth functions go through
/// the machine and DEPTH. The input's triangles go through the machine.
///
/// With --dut your own design is verified in place of ours: it replays the suites of its unit, and the input's triangles,
/// in the simulators (docs/own_rtl.md).
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk verify sphere
  edgewalk verify triangles.tri --set interpolator.adders=1 --set memory.hazard=interlock
  edgewalk verify torus --stalls late --triangles 1000 --no-simulators --json
  edgewalk verify --dut dut.toml --junit out/verify.xml
  edgewalk verify --dut dut.toml --simulator icarus --only knee_line_of_one_pixel")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Take this many triangles, polygons and lines of the input, evenly spread
    #[arg(long, default_value_t = 50, value_parser = whole::<u64>(1..))]
    triangles: u64,
    /// Stalls by the bench: none, mixed, late; the suite's own if left out
    #[arg(long, value_parser = stalls)]
    stalls: Option<StallKind>,
    /// Seconds that a simulator may compile, and again that it may run
    #[arg(long, default_value_t = 300, value_parser = whole::<u64>(1..))]
    limit: u64,
    /// Compare model and netlist only
    #[arg(long)]
    no_simulators: bool,
    /// Your own design in place of ours, described by this file (docs/own_rtl.md)
    #[arg(long, value_name = "FILE.toml", conflicts_with = "no_simulators")]
    dut: Option<PathBuf>,
    /// Simulators for --dut: icarus, verilator [default: both; Verilator takes all directed suites as one]
    #[arg(long, value_name = "NAME", requires = "dut", conflicts_with = "no_simulators", value_parser = simulator)]
    simulator: Vec<Simulator>,
    /// Cases: of every suite those of these names; all of them if left out
    #[arg(long, value_name = "CASE")]
    only: Vec<String>,
    /// Write the results as JUnit to this file too
    #[arg(long, value_name = "FILE.xml")]
    junit: Option<PathBuf>,
    /// Folder of replay pages: one for each suite in which model and netlist differ, opened at the first difference
    #[arg(long, value_name = "DIR", default_value = "out/verify")]
    out: PathBuf,
}

fn simulator(name: &str) -> Result<Simulator, String> {
    let names = Simulator::ALL.map(Simulator::name);
    let found = Simulator::ALL.into_iter().find(|simulator| simulator.name() == name);
    found.ok_or_else(|| Unknown::new("simulator", name, names).to_string())
}

const ICARUS: [Simulator; 1] = [Simulator::Icarus];

/// One comparison.
#[derive(Clone, Serialize)]
struct Check {
    suite: String,
    unit: &'static str,
    against: &'static str,
    checked: u64,
    expected: u64,
    /// What differs first.
    #[serde(skip_serializing_if = "Option::is_none")]
    difference: Option<String>,
    /// How often the run met the events that the bench of a user's design counts.
    #[serde(skip)]
    met: BTreeMap<String, u64>,
}

impl Check {
    fn verdict(&self) -> Verdict {
        Verdict::of(self.checked, self.expected, u64::from(self.difference.is_some()))
    }
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = args.source.machine(machine)?;
    // Whatever is wrong with the design is said first.
    let wiring = args.dut.as_deref().map(|file| crate::own::design(file, &machine)).transpose()?;
    let frame = args.source.whole(&machine)?;
    let port = args.source.to_port(&frame, &machine)?;
    let input = Suite {
        name: "input".to_owned(),
        ..of_input(&args.source.input, &machine, &port, Some(args.triangles))?
    };
    let taken = input.triangles().count();
    let suites = [vec![input], directed(&machine)?, functions(&machine)?].concat();
    let suites = only(suites, &args.only)?;
    let (checks, events) = match &wiring {
        Some(wiring) => {
            let (checks, events) = own::checks(args, &machine, wiring, suites, talk)?;
            (checks, Some(events))
        }
        None => (ours(args, &machine, suites, talk)?, None),
    };
    if let Some(file) = &args.junit {
        write_junit(file, &checks)?;
    }
    print(&machine, wiring.as_ref().zip(events.as_ref()), &checks, talk)?;
    nothing::verdict(args, &machine, taken, &checks)
}

/// The names of the suites that Verilator runs too: a build with it takes seconds, and the whole machine under input and
/// directed suites is enough for it.
const IN_BOTH: [&str; 3] = ["input", "hazards", "corners"];

/// Our own machine, and each of its units.
fn ours(args: &Args, machine: &Plan, suites: Vec<Suite>, talk: Talk) -> Result<Vec<Check>> {
    let runs: Vec<Runs> = suites.iter().map(|suite| Runs::new(machine, suite, suite.state)).collect();
    let units = |suite: &Suite| match suite.name.as_str() {
        "input" => vec![Unit::MACHINE],
        _ => Unit::all(machine).into_iter().filter(|unit| suite.is_for(*unit)).collect(),
    };
    let of = |(i, suite)| units(suite).into_iter().map(move |unit| (i, unit));
    let work: Vec<(usize, Unit)> = suites.iter().enumerate().flat_map(of).collect();
    let netlists = Netlists::of(machine, work.iter().map(|(_, unit)| *unit))?;
    let limit = Duration::from_secs(args.limit);
    let bar = progress::bar(work.len() as u64, "suites and units", talk.quiet);
    let done = jobs::all(&work, &bar, |(place, unit)| {
        let suite = &suites[*place];
        let trace = runs[*place].capture(*unit, args.stalls.unwrap_or(suite.stalls));
        let simulators = if *unit == Unit::MACHINE && IN_BOTH.contains(&suite.name.as_str()) {
            &Simulator::ALL[..]
        } else {
            &ICARUS
        };
        let mut checks = vec![against_netlist(netlists.beside(&trace), suite, &trace, &args.out)?];
        if !args.no_simulators {
            let verilog =
                design::verilog(machine, *unit).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
            let folder = write(directory(suite, &trace, &verilog, Tables::LeftOut))?;
            for simulator in simulators {
                let due = Due { tokens: trace.tokens_out(), all: trace.expected() };
                let check = in_simulator(*simulator, folder.path(), limit, suite, *unit, due);
                checks.push(check.context("a simulator did not do its work; --no-simulators goes without")?);
            }
        }
        Ok((checks, (*unit, reached(&trace))))
    })?;
    bar.finish_and_clear();
    let (checks, runs): (Vec<Vec<Check>>, Vec<_>) = done.into_iter().unzip();
    warn_of_gaps(&runs, talk);
    Ok(checks.concat())
}

/// The check of a netlist's run beside the model. The replay of a difference goes into the folder `out`.
fn against_netlist(
    run: Result<Agreement, LockstepError>,
    suite: &Suite,
    trace: &Trace,
    out: &Path,
) -> Result<Check> {
    // How much ought to be compared follows from the model's run alone.
    let expected = trace.port_values();
    let (checked, difference) = match run {
        Ok(agreement) => (agreement.compared, None),
        Err(LockstepError::Vacuous) => (0, None),
        Err(LockstepError::Differs { difference, compared }) => {
            let mut told = difference.to_string();
            if let Some(page) = difference::page(suite, trace, &difference)? {
                let (out, name) = (Staging::new(out)?, format!("{}.html", suite.name));
                out.write(&name, page)?;
                told += &format!("\n      replay: {}", out.name(&name));
                out.publish(&[name])?;
            }
            (compared, Some(told))
        }
        Err(error) => return Err(error.into()),
    };
    let (suite, unit) = (suite.name.clone(), trace.interface.unit.name());
    Ok(Check { suite, unit, against: "netlist", checked, expected, difference, met: BTreeMap::new() })
}

fn write(files: Files) -> Result<Scratch> {
    let folder = Scratch::temporary()?;
    for (name, contents) in files {
        let name = Path::new(&name);
        let written = folder.create(name).and_then(|mut file| file.write_all(&contents));
        written.with_context(|| folder.path().join(name).display().to_string())?;
    }
    Ok(folder)
}

/// What a bench has to compare.
#[derive(Clone, Copy)]
struct Due {
    /// Tokens that the design has to give.
    tokens: u64,
    /// Tokens and changes of the status.
    all: u64,
}

fn in_simulator(
    simulator: Simulator,
    folder: &Path,
    limit: Duration,
    suite: &Suite,
    unit: Unit,
    due: Due,
) -> Result<Check> {
    let work = Scratch::temporary()?;
    let outcome = simulate(simulator, folder, work.path(), limit)
        .with_context(|| format!("{} {}", suite.name, unit.name()))?;
    let (checked, difference, met) = match outcome {
        Outcome::Pass { checked, met } => (checked, None, met),
        Outcome::Mismatch { checked, lines, .. } => (checked, Some(lines.join("\n      ")), BTreeMap::new()),
        Outcome::Vacuous => {
            let none = (due.tokens > 0).then(|| format!("no token came: expected {}, found 0", due.all));
            (0, none, BTreeMap::new())
        }
    };
    let (suite, expected) = (suite.name.clone(), due.all);
    Ok(Check { suite, unit: unit.name(), against: simulator.name(), checked, expected, difference, met })
}

fn write_junit(file: &Path, checks: &[Check]) -> Result<()> {
    let case = |check: &Check| junit::Case {
        name: format!("{} {} {}", check.suite, check.unit, check.against),
        failure: (check.verdict() != Verdict::Pass).then(|| {
            let line = format!("checked {} / {}", check.checked, check.expected);
            (line, check.difference.clone().unwrap_or_default())
        }),
    };
    let cases: Vec<junit::Case> = checks.iter().map(case).collect();
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = file.file_name().ok_or_else(|| anyhow!("--junit {}: is no file", file.display()))?;
    let name = name.to_string_lossy().into_owned();
    let out = Staging::new(folder)?;
    out.write(&name, junit::document("edgewalk verify", "edgewalk.verify", &cases))?;
    out.publish(&[name])
}

fn print(machine: &Plan, own: Option<(&Wiring, &Events)>, checks: &[Check], talk: Talk) -> Result<()> {
    let not_compared = own.map(|(wiring, _)| wiring.not_compared());
    let json = || {
        let mut report = json!({ "machine": machine.hash(), "checks": checks });
        if let Some((Wiring { dut, .. }, events)) = own {
            report["dut"] =
                json!({ "file": dut.file, "top": dut.top, "not_compared": not_compared, "events": events });
        }
        document("verify", report)
    };
    let text = || {
        let mut text = format!("machine {}\n", machine.hash());
        if let Some((Wiring { dut, .. }, _)) = own {
            text = format!(
                "{} of {} beside {} of machine {}\n",
                dut.top,
                dut.file,
                dut.unit.name(),
                machine.hash()
            );
        }
        if let Some(names) = not_compared.as_ref().filter(|names| !names.is_empty()) {
            _ = writeln!(text, "not compared: {}", names.join(", "));
        }
        for c in checks {
            let word = if c.verdict() == Verdict::Pass { "pass" } else { "FAIL" };
            // Writing to a string cannot fail.
            _ = writeln!(
                text,
                "{word}  {:<15} {:<8} model = {:<10} checked {} / {}",
                c.suite, c.unit, c.against, c.checked, c.expected
            );
            if let Some(d) = &c.difference {
                _ = writeln!(text, "      {d}");
            }
        }
        text + &own.map(|(_, events)| events.lines()).unwrap_or_default()
    };
    talk.say(json, text)
}
