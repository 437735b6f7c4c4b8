//! `edgewalk render`: a scene or a mesh through the machine, beside the golden picture.

use crate::compare::compare;
use crate::engine::{Engine, draw};
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::report::Report;
use crate::staging::Staging;
use crate::verdict::Verdict;
use crate::{Talk, picture};
use anyhow::Result;
use std::path::PathBuf;

/// Renders a scene or mesh through the machine and compares it with the golden picture.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk render torus-knot
  edgewalk render teapot.obj --out out/teapot --set screen.width=1280 --set screen.height=960
  edgewalk render sphere --shading constant --set interpolator.adders=1 --json")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Who draws the picture that is compared with the golden one
    #[arg(long, value_enum, default_value_t = Engine::Fast)]
    engine: Engine,
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/render")]
    out: PathBuf,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = machine.machine(None)?;
    let frame = args.source.frame(&machine)?;
    let out = Staging::new(&args.out)?;
    let (report, verdict) = pictures(&args.source.input, &frame, &machine, args.engine, &out, talk.quiet)?;
    out.write("report.json", report.json()?)?;
    out.write("report.txt", report.text())?;
    out.publish()?;
    report.print(talk)?;
    Ok(verdict)
}

/// Draws, compares, and writes golden.png, the engine's picture and the two heat maps.
pub fn pictures(
    name: &str,
    frame: &edgewalk_scene::Frame,
    machine: &edgewalk_numerics::Machine,
    engine: Engine,
    out: &Staging,
    quiet: bool,
) -> Result<(Report, Verdict)> {
    let golden = draw(Engine::Golden, frame, machine, quiet)?;
    let drawn = draw(engine, frame, machine, quiet)?;
    let comparison = compare(machine, &golden, &drawn);
    let (w, h) = (drawn.width, drawn.height);
    picture::write_rgb(out, "golden.png", w, h, &golden.rgb)?;
    picture::write_rgb(out, "image.png", w, h, &drawn.rgb)?;
    picture::write_heat(out, "z_error.png", w, h, &comparison.z_map)?;
    picture::write_heat(out, "color_error.png", w, h, &comparison.color_map)?;
    let verdict = comparison.verdict();
    let report = Report::new(name, frame.triangles.len() as u64, machine, &drawn).with(comparison);
    Ok((report, verdict))
}
