//! `edgewalk explain`: why a pixel looks as it does.

use crate::Talk;
use crate::document::document;
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::number::whole;
use crate::verdict::Verdict;
use anyhow::{Result, anyhow};
use edgewalk_explain::{Input, explain};
use edgewalk_host::input::placed;

/// Explain a pixel: the triangles over it, the parts of its light, and every addition of the machine behind it.
///
/// Each addition is shown with its error and its proved bound.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk explain torus-knot 320 240
  edgewalk explain docs/scenes/lights.toml 200 300 --json
  edgewalk explain sphere 30 20 --set screen.width=64 --set screen.height=48 --triangles 300
  edgewalk explain triangles.tri 10 10")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Draws the first N triangles, polygons and lines of the input; all of them if left out
    #[arg(long, value_name = "N", value_parser = whole::<u64>(1..))]
    triangles: Option<u64>,
    /// Column, from the left
    #[arg(value_name = "X", value_parser = whole::<u32>(..))]
    x: u32,
    /// Line, from the top
    #[arg(value_name = "Y", value_parser = whole::<u32>(..))]
    y: u32,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = args.source.machine(machine)?;
    // A file is opened once: it may be a pipe.
    let scene = if args.source.is_triangle_file() { None } else { Some(args.source.surface(&machine)?) };
    let first = args.triangles.map_or(usize::MAX, |most| usize::try_from(most).unwrap_or(usize::MAX));
    let (frame, order, places, outlined) = match &scene {
        Some((scene, surface)) => {
            let (frame, order) = args.source.frame_of(scene, surface, &machine)?;
            (frame.first(first), order, Vec::new(), None)
        }
        None => {
            let whole = args.source.whole(&machine)?.first(first);
            let (frame, places) = placed(whole.clone(), &machine)?;
            (frame, None, places, Some(whole))
        }
    };
    let (x, y) = (args.x, args.y);
    if x >= machine.width || y >= machine.height {
        let (w, h) = (machine.width - 1, machine.height - 1);
        return Err(anyhow!("explain: `{x} {y}`: permitted: X from 0 to {w}, Y from 0 to {h}"));
    }
    let input = Input {
        machine: &machine,
        frame: &frame,
        scene: scene.as_ref().map(|(scene, surface)| (scene, surface)),
        order: order.as_ref(),
        outlined: outlined.as_ref(),
        places: &places,
    };
    let explanation = explain(&input, (x, y))?;
    talk.say(|| document("explain", &explanation), || explanation.text(machine.color.bits))?;
    // A pixel may be empty, but not the whole picture.
    Verdict::drew(explanation.covered).or_nothing(
        &args.source.input,
        frame.drawn() as u64,
        (machine.width, machine.height),
    )
}
