//! `edgewalk estimate`: what machines cost on an FPGA, without tools.
//!
//! ```text
//!  machine ─> netlist ─> structure ─> factors and delays of the fit ─> table, JSON
//! ```

mod rows;
mod gates;

pub use gates::FAMILY;

use rows::{Row, rows};

use crate::Talk;
use crate::document::document;
use crate::machine_args::{MachineArgs, no_needs};
use crate::verdict::Verdict;
use anyhow::{Result, anyhow};
use edgewalk_machine::{Plan, Unknown};
use edgewalk_synth::estimate::{Estimate, Figure, Fit, Fits, Kept, fits};
use edgewalk_synth::{Fpga, Part, Target, memories};
use serde::Serialize;
use std::fmt::Write as _;

/// Estimate cells and clock of machines on an iCE40 or ECP5, or area in standard cells, from
/// their netlists, in milliseconds, without tools.
///
/// Flip-flops, carry cells, memories and multipliers follow Yosys' rules; docs/estimate.md says how exactly. Look-up tables, packed
/// cells and the clock (HX8K, ECP5-25) come from a model that was fitted to synthesised machines; nine in ten of the machines that
/// were held out lie within the error that stands behind each figure; of a part, nine in ten of the parts that were
/// measured. `edgewalk calibrate` makes the fit anew.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk estimate
  edgewalk estimate default small ecp5,setup.lanes=2
  edgewalk estimate --unit engine --set interpolator.adders=1
  edgewalk estimate small up5k --fits ice40-up5k
  edgewalk estimate small default --family ecp5 --fits ecp5-25
  edgewalk estimate default --family osu018
  edgewalk estimate default,shade.kind=fast-phong --json")]
pub struct Args {
    /// Machines: `FILE|PRESET[,key=value...]`; --set holds for all. The machine of --machine if none is named
    #[arg(value_name = "MACHINE")]
    machines: Vec<String>,
    /// machine, engine (all units but setup), or the name of a unit
    #[arg(long, value_name = "UNIT", default_value = "machine")]
    unit: String,
    /// Family of the device: ice40, ecp5; osu018 for standard cells of 0.18 um
    #[arg(long, value_name = "FAMILY", default_value = "ice40")]
    family: String,
    /// Say whether each fits a device of the family: ice40-hx8k, ice40-up5k, ecp5-25 (repeatable)
    #[arg(long, value_name = "DEVICE")]
    fits: Vec<String>,
}

/// The report, as text and as JSON.
#[derive(Serialize)]
struct Report {
    unit: String,
    family: &'static str,
    /// The device whose clock is estimated.
    device: &'static str,
    /// What the errors are those of.
    errors: edgewalk_synth::estimate::Errors,
    machines: Vec<Row<OnFpga>>,
}

/// The estimate for an FPGA.
#[derive(Serialize)]
struct OnFpga {
    #[serde(flatten)]
    figures: Estimate,
    /// Devices of --fits.
    fits: Vec<Fits>,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let devices = args.fits.iter().map(|name| device(name)).collect::<Result<Vec<_>>>()?;
    let machines: Vec<(String, Plan)> = match args.machines.is_empty() {
        true => vec![(machine.words().join(" "), machine.machine(None)?)],
        false => {
            let named = |name: &String| Ok((name.clone(), machine.named(name, None, no_needs)?));
            args.machines.iter().map(named).collect::<Result<_>>()?
        }
    };
    if args.family == FAMILY && devices.is_empty() {
        return gates::run(&args.unit, &machines, talk);
    }
    let family = family(&args.family)?;
    if let Some(other) = devices.iter().find(|device| device.family != family) {
        let [name, own] = [other.name, other.family.name()];
        return Err(anyhow!(
            "--fits {name}: found a device of the family {own}, the estimate is of {}; use --family {own}",
            family.name()
        ));
    }
    let fit = Fit::known(family);
    let kept = Kept::new(fit.delays, family);
    let rows = rows(&args.unit, &machines, talk, |part, plan| {
        let figures = fit.estimate(&part.structure(plan, &kept)?);
        let fits = devices.iter().map(|device| fits(&figures, memories(plan, part), device)).collect();
        Ok(OnFpga { figures, fits })
    })?;
    let report = Report {
        unit: args.unit.clone(),
        family: family.name(),
        device: family.device(),
        errors: fit.errors,
        machines: rows,
    };
    talk.say(|| document("estimate", &report), || report.text())?;
    Ok(Verdict::Pass)
}

/// A family of FPGAs.
pub fn family(name: &str) -> Result<Fpga> {
    let names = Fpga::ALL.map(Fpga::name).into_iter().chain([FAMILY]);
    let found = Fpga::ALL.into_iter().find(|family| family.name() == name);
    found.ok_or_else(|| match name == FAMILY {
        true => anyhow!("--fits: standard cells have no device; leave --fits or --family {name} out"),
        false => anyhow!("--family {name}: {}", Unknown::new("family", name, names)),
    })
}

/// A device that estimates can be held against.
pub fn device(name: &str) -> Result<Target> {
    Target::named(name).map_err(|error| anyhow!("--fits {name}: {error}"))
}

impl Report {
    fn text(&self) -> String {
        let width =
            self.machines.iter().map(|row| row.name.chars().count()).max().unwrap_or(0).max("machine".len());
        let mut text = format!(
            "{:width$}  {:>14}  {:>6}  {:>6}  {:>4}  {:>4}  {:>14}  {:>14}  {:>5}\n",
            "machine",
            "LUT4",
            "carry",
            "FF",
            "RAM",
            "DSP",
            "cells",
            format!("MHz on {}", self.device),
            "ms"
        );
        for row in &self.machines {
            let of = &row.estimate.figures;
            let _ = writeln!(
                text,
                "{:width$}  {:>14}  {:>6}  {:>6}  {:>4}  {:>4}  {:>14}  {:>14}  {:>5.1}",
                row.name,
                whole(of.est_lut4),
                of.est_carry,
                of.est_ff,
                of.est_ram,
                of.est_dsp,
                whole(of.est_cells),
                format!("{:.1} ± {:.1}", of.est_mhz.value, of.est_mhz.error),
                row.milliseconds
            );
        }
        for row in &self.machines {
            for fits in &row.estimate.fits {
                let _ = writeln!(text, "{:width$}  {}: {}", row.name, fits.device, fits.text);
            }
        }
        let errors = &self.errors;
        let _ = writeln!(
            text,
            "carry, FF, RAM and DSP by Yosys' rules; LUT4, cells and MHz by a model: of {} machines held out ({} of them \
             placed) nine in ten lie within ±",
            errors.machines, errors.placed
        );
        if self.unit != Part::MACHINE.name() {
            let _ = writeln!(text, "of a part: of {} parts nine in ten lie within ±", errors.parts);
        }
        text
    }
}

fn whole(figure: Figure) -> String {
    format!("{:.0} ± {:.0}", figure.value, figure.error.ceil())
}
