//! `edgewalk compare`: two machines on one input, by what differs.

mod page;

use crate::cost::{SynthArgs, Synthesiser};
use crate::input::{Source, to_port};
use crate::machine_args::MachineArgs;
use crate::staging::Staging;
use crate::verdict::Verdict;
use crate::{Talk, picture};
use anyhow::{Context, Result, anyhow};
use edgewalk_host::draw;
use edgewalk_host::raster::Raster;
use edgewalk_host::reach::reach;
use edgewalk_judge::compare::compare_shaded;
use edgewalk_judge::report::Report;
use edgewalk_judge::setup_report::SetupReport;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use page::{Page, Side};
use std::path::PathBuf;

/// Draws an input on two machines and says what differs: keys, cycles by cause, pixels, and with --synth cells and clock.
///
/// A machine is a file or preset, with settings behind commas; what --set says holds for both. Pictures: a.png, b.png, and
/// difference.png, the pixels that differ by how much, yellow at the largest. They are machines that are compared here, each with
/// golden as `edgewalk render` does; pictures of another program are not.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk compare default default,interpolator.adders=1 teapot.obj
  edgewalk compare out/sweep/best_cycles.toml out/sweep/best_word_bits.toml torus-knot --json
  edgewalk compare default textbook sphere --stalls dram --out out/compare
  edgewalk compare default default,setup.lanes=1 sphere --synth ice40-hx8k")]
pub struct Args {
    /// A machine: FILE|PRESET[,key=value...]
    #[arg(value_name = "A")]
    a: String,
    /// Another
    #[arg(value_name = "B")]
    b: String,
    #[command(flatten)]
    source: Source,
    /// How the memory makes both wait: none, fixed, random, dram, with parameters as fixed:rd=2
    #[arg(long, value_name = "KIND", default_value = "none")]
    stalls: Waits,
    #[command(flatten)]
    synth: SynthArgs,
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/compare")]
    out: PathBuf,
}

/// What a run may write.
const FILES: [&str; 5] = ["a.png", "b.png", "difference.png", "compare.json", "compare.txt"];

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let [a, b] = [args.source.named_machine(machine, &args.a)?, args.source.named_machine(machine, &args.b)?];
    if (a.width, a.height) != (b.width, b.height) {
        return Err(anyhow!(
            "the screens differ, {}x{} and {}x{}, so no pixels can be compared; set screen.width and screen.height",
            a.width,
            a.height,
            b.width,
            b.height
        ));
    }
    let out = Staging::new(&args.out)?;
    let synthesiser = match args.synth.definition(&a)? {
        Some(of) => {
            args.synth.definition(&b)?;
            let synthesiser = Synthesiser::new(&of, args.synth.tools())?;
            synthesiser.check()?;
            Some(synthesiser)
        }
        None => None,
    };
    let side = |name: &str, plan: Plan| -> Result<Side> {
        let (report, raster) = drawn(args, &plan).with_context(|| name.to_owned())?;
        let cost = synthesiser.as_ref().map(|synthesiser| synthesiser.cost(&plan));
        Ok(Side { name: name.to_owned(), plan, report, raster, cost })
    };
    let page = Page::new([side(&args.a, a)?, side(&args.b, b)?], &args.source.input, args.stalls)?;
    let [a, b] = page.rasters();
    picture::write_rgb(&out, "a.png", a.width, a.height, &a.rgb)?;
    picture::write_rgb(&out, "b.png", b.width, b.height, &b.rgb)?;
    let full = page.largest_difference().max(f64::MIN_POSITIVE);
    picture::write_heat(&out, "difference.png", (a.width, a.height), page.differences(), full)?;
    out.write("compare.json", page.json()?)?;
    out.write("compare.txt", page.text())?;
    out.publish(&FILES)?;
    talk.say(|| page.json(), || page.text())?;
    page.verdict().or_nothing(&args.source.input, page.primitives(), (a.width, a.height))
}

/// As `render` does.
fn drawn(args: &Args, plan: &Plan) -> Result<(Report, Raster)> {
    let frame = args.source.frame(plan)?;
    let port = to_port(&frame, plan)?;
    let golden = draw::golden(&frame, plan);
    let raster = draw::fast(&frame, plan, args.stalls)?;
    let proof = port.shade.as_ref().map(|feed| &feed.proof);
    let comparison = compare_shaded(plan, &frame, &golden, &raster, reach(plan, &port)?.as_ref(), proof);
    let setup = SetupReport::new(plan, &port.triangles);
    let triangles = frame.triangles.len() as u64;
    let report = Report {
        comparison: Some(comparison),
        setup: Some(setup),
        ..Report::new(&args.source.input, triangles, plan, &raster, args.stalls)
    };
    Ok((report, raster))
}
