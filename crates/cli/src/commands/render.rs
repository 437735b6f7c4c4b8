//! `edgewalk render`: a scene or a mesh through the machine, beside the golden picture; or through a shading system of
//! the golden picture, beside the truth.

mod lights;
mod look;

use crate::Talk;
use crate::document::document;
use crate::engine::{Engine, from_golden, golden_fill};
use crate::fast_phong::{FastPhongArgs, FastPhongReport};
use crate::input::{Shading, Source};
use crate::machine_args::MachineArgs;
use crate::number::real;
use crate::pictures::{FILES, pictures};
use crate::progress::spinner;
use crate::shading_report::ShadingReport;
use crate::shadows::Shadows;
use crate::verdict::Verdict;
use anyhow::{Result, anyhow};
use edgewalk_files::{Staging, picture};
use edgewalk_golden::{HiddenLines, wireframe};
use edgewalk_judge::report::Report;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use look::Look;
use std::path::PathBuf;

/// Draw a scene or mesh by the machine and compare it with the golden picture.
///
/// With --engine golden a shading system in f64 draws, and the shading equation at each pixel is the reference.
/// Pictures: image.png, truth.png and shading_error.png, a heat map with the largest error in yellow. With
/// fast-phong also phong.png and phong_error.png, beside Phong shading. A wireframe by golden is
/// image.png alone. Any other engine draws it on a machine with polygon.lines = yes, which --adapt sets.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk render torus-knot
  edgewalk render teapot.obj --out out/teapot --set screen.width=1280 --set screen.height=960
  edgewalk render sphere --shading constant --set interpolator.adders=1 --json
  edgewalk render sphere --stalls dram:miss=10 --clock 50
  edgewalk render sphere --stalls dram --clock 50 --display 60
  edgewalk render sphere --stalls dram --profile
  edgewalk render sphere --ranges
  edgewalk render sphere --engine golden --shading phong
  edgewalk render teapot.obj --engine golden --shading constant-averaged
  edgewalk render sphere --engine golden --shading fast-phong --fit six-point --table 4096
  edgewalk render terrain --engine golden --shading phong --shadows map
  edgewalk render terrain --shadows map --adapt
  edgewalk render torus --engine golden --shading wireframe --hidden-lines
  edgewalk render torus --shading wireframe --set polygon.lines=yes")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Engine that draws the picture
    #[arg(long, value_enum, default_value_t = Engine::Fast)]
    engine: Engine,
    #[command(flatten)]
    fast_phong: FastPhongArgs,
    /// Method of shadows; engines other than golden take `map` alone. They need shadow.light = perspective and
    /// BLEND, which --adapt sets, and draw a pass and a map for each light
    #[arg(long, value_enum, default_value_t = Shadows::Off)]
    shadows: Shadows,
    /// With --shading wireframe: also draw the lines that surfaces hide
    #[arg(long)]
    hidden_lines: bool,
    /// Stalls of the memory: none, fixed, random, dram, with parameters as fixed:rd=2,data=4,wr=1,
    /// random:seed=1,rd=64,data=64,wr=64 (256ths),
    /// dram:banks=4,page=256,miss=6,turn=2,refresh=780,busy=13,word=1,line=1
    #[arg(long, value_name = "KIND", default_value = "none")]
    stalls: Waits,
    /// Clock at which the report tells the traffic in MB/s; without it, in bytes a cycle
    #[arg(long, value_name = "MHZ", value_parser = real(0.001..=100_000.0, "MHz"))]
    clock: Option<f64>,
    /// Pictures a second of a display that reads the frame; the report then tells scan-out and clearing too
    #[arg(long, value_name = "HZ", requires = "clock", value_parser = real(0.001..=100_000.0, "Hz"))]
    display: Option<f64>,
    #[command(flatten)]
    look: Look,
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/render")]
    out: PathBuf,
}

impl Args {
    /// With rates at the clock, and what a display asks of the memory, where these were asked for.
    fn at_clock(&self, report: Report, machine: &Plan) -> Report {
        match (self.clock, self.display) {
            (Some(mhz), Some(hz)) => report.at_clock(mhz).with_display(machine, self.stalls, hz, mhz),
            (Some(mhz), None) => report.at_clock(mhz),
            (None, _) => report,
        }
    }
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let maps = args.shadows == Shadows::Map && args.engine != Engine::Golden;
    let machine = args.source.machine_with_maps(machine, maps)?;
    if args.source.shading() != Shading::FastPhong {
        args.fast_phong.unused()?;
    }
    let wireframe = args.source.shading() == Shading::Wireframe;
    let lines_only = args.engine == Engine::Golden && wireframe;
    if args.hidden_lines && !wireframe {
        return Err(anyhow!(
            "--hidden-lines: permitted with --shading wireframe only; leave it out, or add --shading wireframe"
        ));
    }
    if matches!(args.engine, Engine::Golden | Engine::Scanline) && args.stalls != Waits::Never {
        return Err(anyhow!(
            "--stalls {}: the golden picture has no memory that stalls; draw with --engine fast",
            args.stalls
        ));
    }
    if let (Engine::Golden | Engine::Scanline, Some(mhz)) = (args.engine, args.clock) {
        return Err(anyhow!("--clock {mhz}: the golden picture has no clock; draw with --engine fast"));
    }
    args.look.check(args.engine)?;
    if args.engine == Engine::Golden && !lines_only && !args.source.is_triangle_file() {
        return shaded(args, &machine, talk);
    }
    if args.shadows != Shadows::Off {
        return lights::run(args, &machine, talk);
    }
    if lines_only {
        return lines(args, &machine, talk);
    }
    let (frame, order) = match wireframe {
        true => (args.source.wireframe(&machine, hidden(args))?, None),
        false => args.source.sorted(&machine)?,
    };
    let out = Staging::new(&args.out)?;
    let (mut report, verdict) =
        pictures(&args.source.input, &frame, &machine, (args.engine, args.stalls), &out, talk.quiet, |_| ())?;
    report.order = order;
    report = args.at_clock(report, &machine);
    args.look.at_frame(&frame, &machine, args.stalls, &mut report)?;
    out.write("report.json", document("report", &report)?)?;
    out.write("report.txt", report.text())?;
    out.publish(&FILES)?;
    talk.say(|| document("report", &report), || report.text())?;
    verdict.or_nothing(&args.source.input, frame.drawn() as u64, (machine.width, machine.height))
}

/// What becomes of lines behind surfaces.
fn hidden(args: &Args) -> HiddenLines {
    if args.hidden_lines { HiddenLines::Drawn } else { HiddenLines::Removed }
}

/// Draws the edges.
fn lines(args: &Args, machine: &Plan, talk: Talk) -> Result<Verdict> {
    let frame = args.source.outlined(machine)?;
    let drawn = from_golden(wireframe(&frame, golden_fill(machine), hidden(args)), machine);
    let out = Staging::new(&args.out)?;
    picture::write_rgb(&out, "image.png", drawn.width, drawn.height, &drawn.rgb)?;
    let triangles = frame.triangles.len() as u64;
    let mut report = Report::new(&args.source.input, triangles, machine, &drawn, Waits::Never);
    report.drawn.polygons = frame.polygons.len() as u64;
    report.drawn.lines = frame.lines.len() as u64;
    out.write("report.json", document("report", &report)?)?;
    out.write("report.txt", report.text())?;
    out.publish(&FILES)?;
    talk.say(|| document("report", &report), || report.text())?;
    let (size, drawn) = ((drawn.width, drawn.height), &report.drawn);
    Verdict::drew(drawn.fragments).or_nothing(&args.source.input, drawn.primitives(), size)
}

/// Draws by a shading system and writes it beside the truth.
fn shaded(args: &Args, machine: &Plan, talk: Talk) -> Result<Verdict> {
    let spinner = spinner("shading", talk.quiet);
    let (scene, surface) = args.source.surface(machine)?;
    if args.shadows != Shadows::Off && args.source.shading() == Shading::FastPhong {
        return Err(anyhow!("--shadows: not permitted with --shading fast-phong; use --shading phong"));
    }
    let fast = match args.source.shading() {
        Shading::FastPhong => Some(args.fast_phong.draw(&scene, &surface, machine)?),
        _ => None,
    };
    let rendered;
    let (drawn, order) = match &fast {
        Some(fast) => (&fast.shaded, None),
        None => {
            let (system, visibility) = (args.source.shading().golden(), args.shadows.golden(&scene));
            rendered = edgewalk_golden::render(&scene, &surface, system, golden_fill(machine), &visibility);
            (&rendered.shaded, Some(&rendered.order))
        }
    };
    let error = drawn.error();
    spinner.finish_and_clear();
    let out = Staging::new(&args.out)?;
    let (w, h) = (surface.width, surface.height);
    picture::write_rgb(&out, "image.png", w, h, &drawn.picture.rgb)?;
    picture::write_rgb(&out, "truth.png", w, h, &drawn.truth)?;
    picture::write_heat(&out, "shading_error.png", (w, h), &error.map, error.max)?;
    let mut report = ShadingReport::new(&args.source, &scene, &surface, &error);
    if let Some(order) = order {
        report = report.blended(order);
    }
    if let Some(fast) = &fast {
        let from_phong = fast.error_to_phong();
        picture::write_rgb(&out, "phong.png", w, h, &fast.phong)?;
        picture::write_heat(&out, "phong_error.png", (w, h), &from_phong.map, from_phong.max)?;
        report = report.with(FastPhongReport::new(&args.fast_phong, &scene, &surface, fast, &from_phong));
    }
    out.write("report.json", document("shading", &report)?)?;
    out.write("report.txt", report.text())?;
    out.publish(&FILES)?;
    talk.say(|| document("shading", &report), || report.text())?;
    Verdict::drew(error.pixels).or_nothing(&args.source.input, surface.triangles.len() as u64, (w, h))
}
