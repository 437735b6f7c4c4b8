//! `edgewalk verify`: model against netlist in every port and cycle, then the emitted Verilog in both simulators.

use super::vectors::{directed, stalls};
use crate::input::{Source, to_port};
use crate::machine_args::MachineArgs;
use crate::verdict::{ToolError, Verdict};
use crate::{Talk, jobs, progress};
use anyhow::{Context, Result, anyhow};
use edgewalk_model::DrawState;
use edgewalk_numerics::Machine;
use edgewalk_vectors::{StallKind, Suite, Trace, Unit, capture, design, directory, lockstep};
use serde::Serialize;
use std::path::Path;
use std::process::Command;

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
    let bar = progress::bar(work.len() as u64, "suites and units", talk.quiet);
    let checks = jobs::all(&work, &bar, |(suite, unit)| {
        let trace = capture(&machine, *unit, suite, state, args.stalls);
        let mut checks = vec![against_netlist(&machine, suite, *unit, &trace)?];
        if !args.no_simulators {
            let folder = write(&machine, suite, *unit, &trace)?;
            // A build with Verilator takes seconds: the whole machine is enough for it.
            let tools: &[&'static str] =
                if *unit == Unit::Machine { &["icarus", "verilator"] } else { &["icarus"] };
            for tool in tools {
                checks.push(simulate(tool, folder.path(), suite, *unit, trace.expected())?);
            }
        }
        Ok(checks)
    })?
    .concat();
    bar.finish_and_clear();
    print(&machine, &checks, talk)?;
    Ok(checks.iter().fold(Verdict::Pass, |all, c| all.and(c.verdict())))
}

fn against_netlist(machine: &Machine, suite: &Suite, unit: Unit, trace: &Trace) -> Result<Check> {
    let netlist = design::netlist(machine, unit).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    let (checked, difference) = match lockstep(trace, &netlist) {
        Ok(agreement) => (agreement.compared, None),
        Err(error) => (1, Some(error.to_string())),
    };
    let suite = suite.name.clone();
    Ok(Check { suite, unit: unit.name(), against: "netlist", checked, expected: checked, difference })
}

fn write(machine: &Machine, suite: &Suite, unit: Unit, trace: &Trace) -> Result<tempfile::TempDir> {
    let folder = tempfile::tempdir().context("a folder for the simulators")?;
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

/// Runs the directory's own Makefile and reads `checked n / n` from what the bench prints.
fn simulate(tool: &'static str, folder: &Path, suite: &Suite, unit: Unit, expected: u64) -> Result<Check> {
    let program = if tool == "icarus" { "iverilog" } else { "verilator" };
    for needed in [program, "make"] {
        Command::new(needed).arg("-V").output().map_err(|_| {
            let package = needed;
            ToolError(format!("{needed} is not installed: apt-get install {package}, or add --no-simulators"))
        })?;
    }
    let output = Command::new("make").arg("-s").arg(tool).current_dir(folder).output().context("make")?;
    let text = String::from_utf8_lossy(&output.stdout);
    let checked = text.lines().find_map(|l| l.strip_prefix("checked ")?.split(' ').next()?.parse().ok());
    let Some(checked) = checked else {
        let why = String::from_utf8_lossy(&output.stderr);
        let line =
            why.lines().find(|l| l.to_lowercase().contains("error")).unwrap_or("the bench printed nothing");
        return Err(ToolError(format!("{tool}, {} {}: {line}", suite.name, unit.name())).into());
    };
    let difference = (!output.status.success())
        .then(|| text.lines().find(|l| l.contains("expected")).unwrap_or("the bench failed").to_owned());
    Ok(Check { suite: suite.name.clone(), unit: unit.name(), against: tool, checked, expected, difference })
}

fn print(machine: &Machine, checks: &[Check], talk: Talk) -> Result<()> {
    if talk.json {
        println!(
            "{}",
            serde_json::to_string_pretty(
                &serde_json::json!({ "machine": machine.hash(), "checks": checks })
            )?
        );
    } else if !talk.quiet {
        println!("machine {}", machine.hash());
        for c in checks {
            let word = if c.verdict() == Verdict::Pass { "pass" } else { "FAIL" };
            println!(
                "{word}  {:<8} {:<8} model = {:<10} checked {} / {}",
                c.suite, c.unit, c.against, c.checked, c.expected
            );
            if let Some(d) = &c.difference {
                println!("      {d}");
            }
        }
    }
    Ok(())
}
