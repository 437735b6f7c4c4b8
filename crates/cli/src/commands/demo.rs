//! `edgewalk demo`: the main job on a built-in scene, from pictures to Verilog and vectors.

use super::{emit, render, vectors};
use crate::engine::Engine;
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::staging::Staging;
use crate::talk::{self, Talk};
use crate::verdict::Verdict;
use anyhow::Result;
use edgewalk_vectors::{StallKind, Unit};
use std::path::PathBuf;

/// Renders a built-in scene through golden picture and model, compares them, and writes the machine's Verilog and vectors.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk demo
  edgewalk demo terrain --out out/terrain
  edgewalk demo --set interpolator.adders=1 --set interpolator.segments=4")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/demo")]
    out: PathBuf,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = machine.machine(None)?;
    let frame = args.source.frame(&machine)?;
    let out = Staging::new(&args.out)?;
    let (report, verdict) =
        render::pictures(&args.source.input, &frame, &machine, Engine::Model, &out, talk.quiet)?;
    let modules = emit::write_design(&machine, &out, "hdl/")?;
    let suites = vectors::directed(&machine)?;
    let suites =
        vectors::write(&machine, &suites, &Unit::ALL, StallKind::Mixed, &out, "vectors/", talk.quiet)?;
    out.write("report.json", report.json()?)?;
    out.write("report.txt", report.text())?;
    let own = [emit::own("hdl/"), vectors::own(&args.out, "vectors/", &suites)].concat();
    let pictures = render::FILES.map(str::to_owned);
    out.publish(&[&own[..], &pictures].concat())?;
    report.print(talk)?;
    if !talk.quiet && !talk.json {
        let at = args.out.display();
        talk::print(&format!(
            "pictures  {at}/golden.png image.png z_error.png color_error.png\n\
             report    {at}/report.txt report.json\n\
             verilog   {at}/hdl, {} modules\n\
             vectors   {at}/vectors: {}",
            modules.len(),
            suites.join(" ")
        ))?;
    }
    verdict.or_nothing(&args.source.input, frame.triangles.len() as u64, (machine.width, machine.height))
}
