//! `edgewalk render`: a scene or a mesh through the machine, beside the golden picture; or through a shading system of
//! the golden picture, beside the truth.

use crate::compare::compare;
use crate::engine::{Engine, draw, golden_fill};
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::progress::spinner;
use crate::report::Report;
use crate::shading_report::ShadingReport;
use crate::staging::Staging;
use crate::verdict::Verdict;
use crate::{Talk, picture};
use anyhow::Result;
use edgewalk_numerics::Machine;
use edgewalk_scene::Frame;
use std::path::PathBuf;

/// Renders a scene or mesh through the machine and compares it with the golden picture.
///
/// With --engine golden it is drawn by a shading system in f64 and compared with the shading equation at each pixel:
/// image.png, truth.png and shading_error.png, a heat map whose yellow is the largest error.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk render torus-knot
  edgewalk render teapot.obj --out out/teapot --set screen.width=1280 --set screen.height=960
  edgewalk render sphere --shading constant --set interpolator.adders=1 --json
  edgewalk render sphere --engine golden --shading phong
  edgewalk render teapot.obj --engine golden --shading constant-averaged")]
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
    if args.engine == Engine::Golden && !args.source.is_triangle_file() {
        return shaded(args, &machine, talk);
    }
    let frame = args.source.frame(&machine)?;
    let out = Staging::new(&args.out)?;
    let (report, verdict) = pictures(&args.source.input, &frame, &machine, args.engine, &out, talk.quiet)?;
    out.write("report.json", report.json()?)?;
    out.write("report.txt", report.text())?;
    out.publish()?;
    report.print(talk)?;
    Ok(verdict)
}

/// Draws by a shading system and writes it beside the truth.
fn shaded(args: &Args, machine: &Machine, talk: Talk) -> Result<Verdict> {
    let spinner = spinner("shading", talk.quiet);
    let (scene, surface) = args.source.surface(machine)?;
    let drawn = edgewalk_golden::shade(&scene, &surface, args.source.shading.golden(), golden_fill(machine));
    let error = drawn.error();
    spinner.finish_and_clear();
    let out = Staging::new(&args.out)?;
    let (w, h) = (surface.width, surface.height);
    picture::write_rgb(&out, "image.png", w, h, &drawn.picture.rgb)?;
    picture::write_rgb(&out, "truth.png", w, h, &drawn.truth)?;
    // Without an error any scale does.
    let full = if error.max > 0.0 { error.max } else { 1.0 };
    picture::write_heat(&out, "shading_error.png", (w, h), &error.map, full)?;
    let report = ShadingReport::new(&args.source, &scene, &surface, &error);
    out.write("report.json", report.json()?)?;
    out.write("report.txt", report.text())?;
    out.publish()?;
    report.print(talk)?;
    Ok(Verdict::of(error.pixels, error.pixels, 0))
}

/// Draws, compares, and writes golden.png, the engine's picture and the two heat maps.
pub fn pictures(
    name: &str,
    frame: &Frame,
    machine: &Machine,
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
    picture::write_heat(out, "z_error.png", (w, h), &comparison.z_map, 1.0)?;
    picture::write_heat(out, "color_error.png", (w, h), &comparison.color_map, 1.0)?;
    let verdict = comparison.verdict();
    let report = Report::new(name, frame.triangles.len() as u64, machine, &drawn).with(comparison);
    Ok((report, verdict))
}
