//! `edgewalk compare`: two machines on one input, by what differs; or any number of both, by what their features cost.

mod features;
mod page;

use crate::Talk;
use crate::cost::{SynthArgs, Synthesiser};
use crate::machine_args::{MachineArgs, no_needs};
use crate::number::whole;
use crate::progress::reading;
use crate::verdict::Verdict;
use anyhow::{Context, Result, anyhow};
use edgewalk_explore::sweep::equation::{Equation, Measure};
use edgewalk_explore::sweep::shading::{SHADINGS, named, of_machine};
use edgewalk_files::difference::First;
use edgewalk_files::{Png, Staging};
use edgewalk_golden::Shading;
use edgewalk_host::draw;
use edgewalk_host::input::{Input, Shaded};
use edgewalk_host::port::to_port;
use edgewalk_host::raster::Raster;
use edgewalk_host::reach::reach;
use edgewalk_judge::beside::{Golden, Proved, Subject};
use edgewalk_judge::compare::Comparison;
use edgewalk_judge::report::Report;
use edgewalk_judge::setup_report::SetupReport;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use page::{Page, Side};
use std::path::PathBuf;

/// Draw an input on two machines and list the differences: keys, cycles by cause, pixels, with --synth cells and
/// clock.
///
/// A machine is a file or preset, with settings behind commas and its shading behind a colon; --set holds for both.
/// Without a shading, the machine's shade.kind decides. Where the shadings differ, each picture is also compared
/// with the shading equation at each pixel. Pictures: a.png, b.png, and difference.png, with the largest difference
/// in yellow. The command compares machines, each beside golden as in `edgewalk render`. Its verdict, and so the exit
/// code, is the worse of those that `render` has. It does not take pictures of other programs.
///
/// With several inputs, --with, --table, --page or --energy the command prints what features cost, as one table: estimated cells by
/// unit, clock and memory of each machine; cycles, bytes and distance from the shading equation of each machine on each
/// input. There the shading `shadows` stands for gouraud with a map for each light.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk compare default default,interpolator.adders=1 teapot.obj
  edgewalk compare out/sweep/best_cycles.toml out/sweep/best_word_bits.toml torus-knot --json
  edgewalk compare default default,shade.kind=fast-phong teapot.obj
  edgewalk compare default:constant default:gouraud torus
  edgewalk compare default textbook sphere --stalls dram --out out/compare
  edgewalk compare default default,setup.lanes=1 sphere --synth ice40-hx8k
  edgewalk compare default default,shade.kind=phong sphere torus --with small --page features.html
  edgewalk compare default default,shadow.light=perspective,blend.kind=constant:shadows sphere --table
  edgewalk compare default default,setup.lanes=1 sphere --energy 100")]
pub struct Args {
    /// A machine: `FILE|PRESET[,key=value...][:SHADING]`
    #[arg(value_name = "A")]
    a: String,
    /// Another machine, in the same form
    #[arg(value_name = "B")]
    b: String,
    /// Built-in scenes, scene files (.toml), meshes (.obj, .gltf, .glb) or triangle files (.tri)
    #[arg(value_name = "SCENE|MESH", default_value = DEFAULT_INPUT)]
    inputs: Vec<String>,
    /// A further machine of the table, in the same form (repeatable)
    #[arg(long, value_name = "MACHINE")]
    with: Vec<String>,
    /// Print the table for two machines on one input too
    #[arg(long)]
    table: bool,
    /// Also write the table as a page (HTML) that needs no network
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    /// Shading of a machine without one of its own: constant, constant-averaged, gouraud, phong, fast-phong
    #[arg(long, value_name = "SHADING", value_parser = clap::builder::PossibleValuesParser::new(SHADINGS.map(|of| of.0)))]
    shading: Option<String>,
    /// Set the keys of both machines that the input asks for; a machine's settings and --set have the last word
    #[arg(long)]
    adapt: bool,
    /// Stalls of both memories: none, fixed, random, dram, with parameters as fixed:rd=2
    #[arg(long, value_name = "KIND", default_value = "none")]
    stalls: Waits,
    /// In the table: energy of the first N triangles, polygons and lines of each input in standard cells, by unit, with the
    /// tools of `edgewalk energy`; not with --stalls
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1..))]
    energy: Option<u32>,
    /// With --energy: a library of cells in the Liberty format, instead of OSU's for 0.18 um
    #[arg(long, value_name = "FILE.lib", requires = "energy")]
    library: Option<PathBuf>,
    #[command(flatten)]
    synth: SynthArgs,
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/compare")]
    out: PathBuf,
}

/// The input where none is asked for.
const DEFAULT_INPUT: &str = "torus-knot";

impl Args {
    /// The input of two machines; none where a table is asked for.
    fn one_input(&self) -> Option<&str> {
        match &self.inputs[..] {
            [input]
                if self.with.is_empty() && !self.table && self.page.is_none() && self.energy.is_none() =>
            {
                Some(input)
            }
            _ => None,
        }
    }
}

/// What a run may write.
const FILES: [&str; 5] = ["a.png", "b.png", "difference.png", "compare.json", "compare.txt"];

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let Some(name) = args.one_input() else { return features::run(args, machine, talk) };
    // Opened once: it may be a pipe.
    let being_read = reading();
    let input = Input::open(name, Shaded::Corners(Shading::Gouraud))?;
    drop(being_read);
    let asked = |name: &str| Asked::new(name, &input, args, machine);
    let [a, b] = [asked(&args.a)?, asked(&args.b)?];
    if (a.plan.width, a.plan.height) != (b.plan.width, b.plan.height) {
        return Err(anyhow!(
            "the screens differ, {}x{} and {}x{}, so no pixels can be compared; set screen.width and screen.height",
            a.plan.width,
            a.plan.height,
            b.plan.width,
            b.plan.height
        ));
    }
    let out = Staging::new(&args.out)?;
    let synthesiser = match args.synth.definition(&a.plan)? {
        Some(of) => {
            args.synth.definition(&b.plan)?;
            let synthesiser = Synthesiser::new(&of, args.synth.tools())?;
            synthesiser.check()?;
            Some(synthesiser)
        }
        None => None,
    };
    // One measure for both: the screens are the same, and all ways of shading show the same triangles.
    let equation = if a.shading == b.shading { None } else { Equation::of(&a.input, &a.plan) };
    let (width, height) = (a.plan.width, a.plan.height);
    // The picture goes into a file and is shown to `see`, from the top in bands.
    let side = |of: Asked, file: &str, see: &mut dyn FnMut(&Raster) -> Result<()>| -> Result<Side> {
        let mut measure = equation.as_ref().map(Equation::measure);
        let mut image = Png::create(&out, file, width, height)?;
        let report = drawn(&of, args.stalls, |raster| {
            measure.iter_mut().for_each(|measure| measure.add(raster));
            image.extend_rgb(&raster.rgb)?;
            see(raster)
        });
        let report = report.with_context(|| of.name.clone())?;
        image.finish()?;
        let cost = synthesiser.as_ref().map(|synthesiser| synthesiser.cost(&of.plan));
        let distance = measure.map(Measure::distance);
        let verdict = verdict(&report);
        Ok(Side { name: of.name, plan: of.plan, shading: of.shading, report, verdict, distance, cost })
    };
    let mut first = First::new(&out)?;
    let a = side(a, "a.png", &mut |raster| first.add(raster))?;
    let mut differences = first.beside(&out)?;
    let b = side(b, "b.png", &mut |raster| differences.add(raster))?;
    let pixels = differences.write(&out, "difference.png", (width, height))?;
    let page = Page::new([a, b], name, args.stalls, pixels)?;
    out.write("compare.json", page.json()?)?;
    out.write("compare.txt", page.text())?;
    out.publish(&FILES)?;
    talk.say(|| page.json(), || page.text())?;
    synthesiser.iter().try_for_each(Synthesiser::check_any)?;
    page.verdict().or_nothing(name, page.primitives(), (width, height))
}

/// A machine, and what it draws.
struct Asked {
    /// As it was asked for.
    name: String,
    plan: Plan,
    input: Input,
    /// None of a triangle file, which says itself how it is shaded.
    shading: Option<&'static str>,
    /// Where a scene's colours are made.
    shaded: Shaded,
}

impl Asked {
    fn new(name: &str, input: &Input, args: &Args, machine: &MachineArgs) -> Result<Asked> {
        let (text, own) = apart(name)?;
        let common = args.shading.as_deref().map(named).transpose()?;
        let screen = input.size();
        if let (Some(mode), Some((shading, _))) = (input.own_shading(), own.or(common))
            && mode != shading
        {
            let (given, out) = match own {
                Some(_) => (name.to_owned(), format!(":{shading}")),
                None => (format!("--shading {shading}"), "--shading".to_owned()),
            };
            return Err(anyhow!(
                "{given}: {} says itself how it is shaded: {mode}; leave {out} out",
                input.name()
            ));
        }
        let mut plan = machine.named(text, screen, no_needs)?;
        let (shading, shaded) = match own.or(common) {
            Some(asked) => asked,
            None => named(of_machine(&plan))?,
        };
        let input = input.shaded(shaded);
        if args.adapt {
            plan = machine.named(text, screen, |machine: &Plan| Ok(input.needs(machine)))?;
        }
        let shading = screen.is_none().then_some(shading);
        Ok(Asked { name: name.to_owned(), plan, input, shading, shaded })
    }
}

/// The machine and its shading: what stands behind the last colon, unless it is a part of a path or of a setting.
fn apart(name: &str) -> Result<(&str, Option<(&'static str, Shaded)>)> {
    match name.rsplit_once(':') {
        Some((machine, shading)) if !shading.contains(['/', '.', ',', '=']) => {
            Ok((machine, Some(named(shading).with_context(|| name.to_owned())?)))
        }
        _ => Ok((name, None)),
    }
}

/// What `render` says of the picture.
fn verdict(report: &Report) -> Verdict {
    report.comparison.as_ref().map_or(Verdict::Vacuous, Comparison::verdict)
}

/// The picture with the places in the input for those in the frame.
fn of_input(drawn: &Raster, places: &[i32]) -> Raster {
    // Where nothing was drawn the id is negative.
    let of = |id: &i32| usize::try_from(*id).map_or(*id, |place| places[place]);
    Raster { id: drawn.id.iter().map(of).collect(), ..drawn.clone() }
}

/// Draws as `render` does; `see` is shown the picture from the top in bands, with the places of things in the input.
fn drawn(of: &Asked, waits: Waits, mut see: impl FnMut(&Raster) -> Result<()>) -> Result<Report> {
    let Asked { plan, input, .. } = of;
    let (frame, places) = input.placed(plan)?;
    let port = to_port(&frame, plan).with_context(|| input.name().to_owned())?;
    let reach = reach(plan, &port)?;
    let shading = port.shade.as_ref().map(|feed| &feed.proof);
    let proved = Proved { reach: reach.as_ref(), shading };
    let golden = Golden::of(&frame, plan);
    let subject =
        Subject { name: input.name(), machine: plan, frame: &frame, golden: &golden, proved, waits };
    let draw = |lines, take: &mut dyn FnMut(_) -> _| draw::in_bands(plan, &port, waits, lines, take);
    let is_own = places.iter().zip(0..).all(|(place, own)| *place == own);
    let report = subject.report(draw, |lines| match is_own {
        true => see(lines.drawn),
        // The other machine may have other parts of the same things.
        false => see(&of_input(lines.drawn, &places)),
    })?;
    Ok(Report { setup: Some(SetupReport::new(plan, &port.triangles)), ..report })
}
