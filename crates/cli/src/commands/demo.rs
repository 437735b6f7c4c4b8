//! `edgewalk demo`: the main job on a built-in scene, from pictures to Verilog and vectors.

use crate::design;
use crate::document::document;
use crate::engine::Engine;
use crate::input::{Source, to_port};
use crate::machine_args::MachineArgs;
use crate::pictures::{FILES, pictures};
use crate::shell::quoted;
use crate::suites;
use crate::talk::{self, Talk};
use crate::verdict::Verdict;
use anyhow::Result;
use edgewalk_explain::accumulators::depth_error_over_bound;
use edgewalk_files::{Staging, picture};

use edgewalk_model::Waits;
use edgewalk_scene::InputKind;
use edgewalk_vectors::{Tables, Unit};
use std::path::PathBuf;

/// Draw a built-in scene by golden and by the model, compare them, and write the machine's Verilog and vectors.
///
/// z_error.png and color_error.png show the error of the rounded outputs: blue to yellow up to 1 LSB, red above.
/// z_accumulator.png shows the error of the depth's accumulator before rounding, over the bound of the additions
/// behind the pixel. Blue is below, orange above; the scale is in the picture. Lines are black in it. It needs exact fill
/// and exact edges. A machine with POLY has no such picture.
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

/// The depth's error before rounding.
const ACCUMULATOR: &str = "z_accumulator.png";

/// Runs the command.
pub fn run(args: &Args, asked_for: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = args.source.machine(asked_for)?;
    let frame = args.source.frame(&machine)?;
    let out = Staging::new(&args.out)?;
    let mut ids = Vec::new();
    let (report, verdict) = pictures(
        &args.source.input,
        &frame,
        &machine,
        (Engine::Model, Waits::Never),
        &out,
        talk.quiet,
        |band| ids.extend_from_slice(&band.id),
    )?;
    let port = to_port(&frame, &machine)?;
    let dda = depth_error_over_bound(&machine, &port, &ids);
    if let Some(map) = &dda {
        picture::write_signed(&out, ACCUMULATOR, (machine.width, machine.height), map)?;
    }
    let modules = design::write_design(&machine, &out, "hdl/")?;
    let directed = suites::directed(&machine)?;
    let set = suites::Set {
        suites: &directed,
        units: &Unit::all(&machine),
        stalls: None,
        tables: Tables::Written,
        own: None,
    };
    let written = set.write(&machine, &out, "vectors/", talk)?;
    out.write("report.json", document("report", &report)?)?;
    out.write("report.txt", report.text())?;
    let own = [design::own("hdl/"), suites::own(&args.out, "vectors/", &written)].concat();
    let pictures = FILES.map(str::to_owned);
    out.publish(&[&own[..], &pictures, &[ACCUMULATOR.to_owned()]].concat())?;
    talk.say(|| document("report", &report), || report.text())?;
    if !talk.quiet && !talk.json {
        let at = args.out.display();
        let dda = if dda.is_some() { " z_accumulator.png" } else { "" };
        talk::print(&format!(
            "pictures  {at}/golden.png image.png z_error.png color_error.png{dda}\n\
             report    {at}/report.txt report.json\n\
             verilog   {at}/hdl, {} modules\n\
             vectors   {at}/vectors: {}",
            modules.len(),
            written.join(" "),
        ))?;
        if args.source.input != InputKind::STANDARD_INPUT {
            talk::print(&format!("at work   {}", replaying(args, asked_for)))?;
        }
    }
    verdict.or_nothing(&args.source.input, frame.triangles.len() as u64, (machine.width, machine.height))
}

/// The command that shows the demo's input on its machine, cycle by cycle.
fn replaying(args: &Args, machine: &MachineArgs) -> String {
    let mut words: Vec<String> = ["edgewalk", "replay"].map(str::to_owned).to_vec();
    words.extend(machine.words().into_iter().map(str::to_owned));
    words.extend(args.source.words());
    words.extend(["--out".to_owned(), args.out.join("replay.html").display().to_string()]);
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}
