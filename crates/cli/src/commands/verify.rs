//! `edgewalk verify`: model against netlist in every port and cycle, then the emitted Verilog in both simulators.

mod difference;

use crate::document::document;
use crate::input::{Source, to_port};
use crate::machine_args::MachineArgs;
use crate::scratch::Scratch;
use crate::staging::Staging;
use crate::suites::{directed, functions, of_input, stalls, warn_of_gaps};
use crate::verdict::Verdict;
use crate::{Talk, jobs, progress};
use anyhow::{Context, Result, anyhow};
use edgewalk_lockstep::LockstepError;
use edgewalk_machine::Plan;
use edgewalk_netlist::Netlist;
use edgewalk_vectors::{
    Outcome, Runs, Simulator, StallKind, Suite, Tables, Trace, Unit, design, directory, reached, simulate,
};
use serde::Serialize;
use serde_json::json;
use std::fmt::Write as _;
use std::iter;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Verify the machine: model against netlist at every port in every cycle, then its Verilog in Icarus and
/// Verilator.
///
/// The directed suites go through the machine and each of its units. The suites of the depth functions go through
/// the machine and DEPTH. The input's triangles go through the machine.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk verify sphere
  edgewalk verify triangles.tri --set interpolator.adders=1 --set memory.hazard=interlock
  edgewalk verify torus --stalls late --triangles 1000 --no-simulators --json")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Take this many triangles of the input, evenly spread
    #[arg(long, default_value_t = 50, value_parser = clap::value_parser!(u64).range(1..))]
    triangles: u64,
    /// Stalls by the bench: none, mixed, late; the suite's own if left out
    #[arg(long, value_parser = stalls)]
    stalls: Option<StallKind>,
    /// Seconds that a simulator may compile, and again that it may run
    #[arg(long, default_value_t = 300, value_parser = clap::value_parser!(u64).range(1..))]
    limit: u64,
    /// Compare model and netlist only
    #[arg(long)]
    no_simulators: bool,
    /// Folder of replay pages: one for each suite in which model and netlist differ, opened at the first difference
    #[arg(long, value_name = "DIR", default_value = "out/verify")]
    out: PathBuf,
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
}

impl Check {
    fn verdict(&self) -> Verdict {
        Verdict::of(self.checked, self.expected, u64::from(self.difference.is_some()))
    }
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = args.source.machine(machine)?;
    let frame = args.source.frame(&machine)?;
    let port = to_port(&frame, &machine)?;
    let input = Suite {
        name: "input".to_owned(),
        ..of_input(&args.source.input, &machine, &port, Some(args.triangles))?
    };
    let whole = (vec![Unit::MACHINE], input);
    let directed = directed(&machine)?.into_iter().map(|suite| (Unit::all(&machine), suite));
    let functions = functions(&machine)?
        .into_iter()
        .map(|suite| (Unit::all(&machine).into_iter().filter(|unit| suite.is_for(*unit)).collect(), suite));
    // A build with Verilator takes seconds: the whole machine under input and directed suites is enough for it.
    let in_both = 1 + directed.len();
    let suites: Vec<(Vec<Unit>, Suite)> = iter::once(whole).chain(directed).chain(functions).collect();
    let runs: Vec<Runs> = suites.iter().map(|(_, suite)| Runs::new(&machine, suite, suite.state)).collect();
    let work: Vec<(usize, Unit)> = suites
        .iter()
        .enumerate()
        .flat_map(|(i, (units, _))| units.iter().map(move |unit| (i, *unit)))
        .collect();
    let limit = Duration::from_secs(args.limit);
    let bar = progress::bar(work.len() as u64, "suites and units", talk.quiet);
    let done = jobs::all(&work, &bar, |(place, unit)| {
        let suite = &suites[*place].1;
        let trace = runs[*place].capture(*unit, args.stalls.unwrap_or(suite.stalls));
        let simulators =
            if *unit == Unit::MACHINE && *place < in_both { &Simulator::ALL[..] } else { &ICARUS };
        let netlist = edgewalk_lockstep::netlist(&machine, *unit)
            .map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
        let mut checks = vec![against_netlist(&netlist, suite, &trace, &args.out)?];
        if !args.no_simulators {
            let folder = write(&machine, suite, *unit, &trace)?;
            for simulator in simulators {
                checks.push(in_simulator(*simulator, folder.path(), limit, suite, &trace)?);
            }
        }
        Ok((checks, (*unit, reached(&trace))))
    })?;
    bar.finish_and_clear();
    let (checks, runs): (Vec<Vec<Check>>, Vec<_>) = done.into_iter().unzip();
    let checks = checks.concat();
    warn_of_gaps(&runs, talk);
    print(&machine, &checks, talk)?;
    Ok(checks.iter().fold(Verdict::Pass, |all, c| all.and(c.verdict())))
}

fn against_netlist(netlist: &Netlist, suite: &Suite, trace: &Trace, out: &Path) -> Result<Check> {
    // How much ought to be compared follows from the model's run alone.
    let expected = trace.port_values();
    let (checked, difference) = match trace.lockstep(netlist) {
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
    Ok(Check { suite, unit, against: "netlist", checked, expected, difference })
}

fn write(machine: &Plan, suite: &Suite, unit: Unit, trace: &Trace) -> Result<Scratch> {
    let folder = Scratch::temporary()?;
    let verilog = design::verilog(machine, unit).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    for (name, contents) in directory(suite, trace, &verilog, Tables::LeftOut) {
        let path = folder.path().join(name);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)?;
        }
        std::fs::write(&path, contents).with_context(|| path.display().to_string())?;
    }
    Ok(folder)
}

fn in_simulator(
    simulator: Simulator,
    folder: &Path,
    limit: Duration,
    suite: &Suite,
    trace: &Trace,
) -> Result<Check> {
    let (unit, expected) = (trace.interface.unit, trace.expected());
    let work = Scratch::temporary()?;
    let outcome = simulate(simulator, folder, work.path(), limit)
        .with_context(|| format!("{} {} (--no-simulators goes without)", suite.name, unit.name()))?;
    let (checked, difference) = match outcome {
        Outcome::Pass { checked } => (checked, None),
        Outcome::Mismatch { checked, lines, .. } => (checked, Some(lines.join("\n      "))),
        Outcome::Vacuous => (0, None),
    };
    let suite = suite.name.clone();
    Ok(Check { suite, unit: unit.name(), against: simulator.name(), checked, expected, difference })
}

fn print(machine: &Plan, checks: &[Check], talk: Talk) -> Result<()> {
    let json = || document("verify", json!({ "machine": machine.hash(), "checks": checks }));
    let text = || {
        let mut text = format!("machine {}\n", machine.hash());
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
        text
    };
    talk.say(json, text)
}
