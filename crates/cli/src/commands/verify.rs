//! `edgewalk verify`: model against netlist in every port and cycle, then the emitted Verilog in both simulators.

use super::vectors::{directed, stalls};
use crate::input::{Source, to_port};
use crate::machine_args::MachineArgs;
use crate::scratch::Scratch;
use crate::verdict::Verdict;
use crate::{Talk, jobs, progress};
use anyhow::{Context, Result, anyhow};
use edgewalk_machine::Plan;
use edgewalk_model::DrawState;
use edgewalk_vectors::{
    LockstepError, Outcome, Simulator, StallKind, Suite, Trace, Unit, capture, design, directory, lockstep,
    simulate,
};
use serde::Serialize;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;

/// Verifies the machine: model against netlist port by port and cycle by cycle, then its Verilog in Icarus and Verilator.
///
/// The directed suites go through the machine and each of its units, the input's triangles through the machine.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk verify sphere
  edgewalk verify triangles.tri --set interpolator.adders=1 --set memory.hazard=interlock
  edgewalk verify torus --stalls late --triangles 1000 --no-simulators --json")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Takes this many triangles of the input, spread over it evenly
    #[arg(long, default_value_t = 50, value_parser = clap::value_parser!(u64).range(1..))]
    triangles: u64,
    /// How the bench makes the design wait: none, mixed, late
    #[arg(long, default_value = "mixed", value_parser = stalls)]
    stalls: StallKind,
    /// Seconds that a simulator may compile, and again that it may run
    #[arg(long, default_value_t = 300, value_parser = clap::value_parser!(u64).range(1..))]
    limit: u64,
    /// Compares model and netlist only
    #[arg(long)]
    no_simulators: bool,
}

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
    let machine = machine.machine(None)?;
    let frame = args.source.frame(&machine)?;
    let port = to_port(&frame, &machine)?;
    let every = port.triangles.len().div_ceil(args.triangles as usize).max(1);
    let scene =
        Suite::of_triangles("input", &args.source.input, port.triangles.into_iter().step_by(every).collect());
    let mut work: Vec<(Suite, Unit)> = vec![(scene, Unit::Machine)];
    for suite in directed(&machine)? {
        work.extend(Unit::ALL.map(|unit| (suite.clone(), unit)));
    }
    let state = DrawState {
        depth_func: port.state.depth_func,
        depth_write: port.state.depth_write,
        ..DrawState::default()
    };
    let limit = Duration::from_secs(args.limit);
    let bar = progress::bar(work.len() as u64, "suites and units", talk.quiet);
    let checks = jobs::all(&work, &bar, |(suite, unit)| {
        let trace = capture(&machine, *unit, suite, state, args.stalls);
        let mut checks = vec![against_netlist(&machine, suite, *unit, &trace)?];
        if !args.no_simulators {
            let folder = write(&machine, suite, *unit, &trace)?;
            // A build with Verilator takes seconds: the whole machine is enough for it.
            let simulators: &[Simulator] =
                if *unit == Unit::Machine { &Simulator::ALL } else { &[Simulator::Icarus] };
            for simulator in simulators {
                checks.push(in_simulator(*simulator, folder.path(), limit, suite, &trace)?);
            }
        }
        Ok(checks)
    })?
    .concat();
    bar.finish_and_clear();
    print(&machine, &checks, talk)?;
    Ok(checks.iter().fold(Verdict::Pass, |all, c| all.and(c.verdict())))
}

fn against_netlist(machine: &Plan, suite: &Suite, unit: Unit, trace: &Trace) -> Result<Check> {
    let netlist = design::netlist(machine, unit).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    // How much ought to be compared follows from the model's run alone.
    let expected = trace.port_values();
    let (checked, difference) = match lockstep(trace, &netlist) {
        Ok(agreement) => (agreement.compared, None),
        Err(LockstepError::Vacuous) => (0, None),
        Err(LockstepError::Differs { difference, compared }) => (compared, Some(difference.to_string())),
        Err(LockstepError::Ports(error)) => return Err(anyhow!("the netlist's ports: {error}")),
    };
    let suite = suite.name.clone();
    Ok(Check { suite, unit: unit.name(), against: "netlist", checked, expected, difference })
}

fn write(machine: &Plan, suite: &Suite, unit: Unit, trace: &Trace) -> Result<Scratch> {
    let folder = Scratch::temporary()?;
    let verilog = design::verilog(machine, unit).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    for (name, contents) in directory(suite, trace, &verilog) {
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
    let json = || {
        let report = serde_json::json!({ "machine": machine.hash(), "checks": checks });
        Ok(serde_json::to_string_pretty(&report)?)
    };
    let text = || {
        let mut text = format!("machine {}\n", machine.hash());
        for c in checks {
            let word = if c.verdict() == Verdict::Pass { "pass" } else { "FAIL" };
            // Writing to a string cannot fail.
            _ = writeln!(
                text,
                "{word}  {:<8} {:<8} model = {:<10} checked {} / {}",
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
