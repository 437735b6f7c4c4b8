//! `edgewalk replay`: a page that shows the machine at work.

mod truth;

use crate::Talk;
use crate::document::document;
use crate::input::Source;
use crate::kept;
use crate::machine_args::MachineArgs;
use crate::number::whole;
use crate::shell::quoted;
use crate::verdict::Verdict;
use anyhow::{Context, Result, anyhow};
use edgewalk_files::Staging;
use edgewalk_host::input::{counted, in_triangles};
use edgewalk_machine::counted::number;
use edgewalk_machine::{Counted, Plan, PortVertex};
use edgewalk_model::{DrawState, Stalls, Waits};
use edgewalk_replay::lesson::polygon::{polygon, polygon_lesson};
use edgewalk_replay::lesson::{SCREEN, permitted, triangle};
use edgewalk_replay::{Lesson, Recording, Replay, Rules, Truth, Window, lesson, page, record, record_passes};
use serde_json::json;
use std::path::PathBuf;

/// Record the machine cycle by cycle and write one HTML file that shows it at work, without a network.
///
/// The page has every unit with its registers and queues, the causes of all cycles, and the picture as it fills. A
/// click on a pixel goes to the cycle that wrote it. A name that ends in .json gets the recording alone
/// (docs/replay.md).
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk replay sphere --set screen.width=64 --set screen.height=48 --triangles 200 --out out/sphere.html
  edgewalk replay triangles.tri --out out/t.html --set memory.hazard=drain --set memory.latency=8
  edgewalk replay --lesson --out out/lesson.html
  edgewalk replay torus-knot --triangles 12288 --from 500000 --cycles 3000 --stalls mixed --out out/part.html")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Draw the first N triangles, polygons and lines of the input
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = whole::<u64>(1..))]
    triangles: u64,
    /// First cycle shown
    #[arg(long, value_name = "C", default_value_t = 0, value_parser = whole::<u64>(..))]
    from: u64,
    /// Last cycle shown; if left out, the cycle in which the machine comes to rest
    #[arg(long, value_name = "C", value_parser = whole::<u64>(..))]
    to: Option<u64>,
    /// Number of cycles shown
    #[arg(long, conflicts_with = "to", value_parser = whole::<u64>(1..))]
    cycles: Option<u64>,
    /// Stalls of the memory: none, fixed, random, dram, with parameters as fixed:rd=2; or mixed, late
    #[arg(long, value_name = "KIND", default_value = "none", value_parser = kind)]
    stalls: Waits,
    /// Walk one triangle through all sections of the specification instead, every number beside its register; with POLY one polygon
    #[arg(long, conflicts_with_all = ["input", "shading", "triangles", "from", "to", "cycles", "stalls"])]
    lesson: bool,
    /// The page, .html, or the recording alone, .json
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// The channel that the lesson shows.
const RED: usize = 1;

/// How the memory makes the machine wait: a kind of `render`'s, or one that meets much in few cycles.
fn kind(text: &str) -> Result<Waits, String> {
    match text {
        // Reads, depths and writes each wait in a third of the cycles.
        "mixed" => Ok(Stalls { seed: 0, rd: 85, data: 85, wr: 85 }.into()),
        // Two depths of three come one to eight cycles late.
        "late" => Ok(Stalls { data: 170, ..Stalls::NONE }.into()),
        _ => text.parse().map_err(|error| format!("{error}; or mixed, late")),
    }
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let kind = args.out.extension().and_then(|e| e.to_str()).unwrap_or_default();
    if !["html", "json"].contains(&kind) {
        return Err(anyhow!("--out {}: the file must end in .html or .json", args.out.display()));
    }
    let name = kept::name_of(&args.out)?;
    let shown = if args.lesson { taught(machine)? } else { drawn(args, machine)? };
    let Shown { machine, scene, triangles, drawn, of, recording, truth, command, lesson } = &shown;
    let replay = Replay {
        plan: machine,
        scene,
        triangles,
        drawn: *drawn,
        of: *of,
        recording,
        truth,
        command: command.clone(),
        difference: None,
        lesson: lesson.as_ref(),
    };
    let json = replay.json();
    let text = if kind == "json" { json.to_string() } else { page::html(&json) };
    let folder = args.out.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(".".as_ref());
    let out = Staging::new(folder)?;
    out.write(name, &text)?;
    out.publish(&[name])?;
    let (cycles, bytes) = (recording.cycles, text.len());
    talk.say(
        || {
            let report = json!({
                "file": args.out, "cycles": cycles, "triangles": drawn.total(), "bytes": bytes, "hash": machine.hash(),
            });
            document("replay-report", report)
        },
        || {
            let what = if kind == "json" { "the recording" } else { "open it in a browser" };
            let (cycles, drawn) = (number(cycles.into(), "cycle"), drawn.part_of(*of));
            format!("{cycles}, {drawn}, {bytes} bytes -> {}: {what}", args.out.display())
        },
    )?;
    Ok(Verdict::Pass)
}

/// What goes into the page.
struct Shown {
    machine: Plan,
    scene: String,
    /// Of the lights' own passes, then of the picture.
    triangles: Vec<[PortVertex; 3]>,
    /// How many triangles, polygons and lines they are.
    drawn: Counted,
    /// How many there would be without `--triangles`.
    of: Counted,
    recording: Recording,
    truth: Vec<Truth>,
    /// What explains a pixel of it.
    command: Option<String>,
    lesson: Option<Lesson>,
}

/// The input on the machine.
fn drawn(args: &Args, asked_for: &MachineArgs) -> Result<Shown> {
    let machine = args.source.machine(asked_for)?;
    let whole = args.source.whole(&machine)?;
    let of = counted(&whole);
    let part = whole.first(usize::try_from(args.triangles).unwrap_or(usize::MAX));
    let drawn = counted(&part);
    let frame = in_triangles(part, &machine)?;
    let port = args.source.to_port(&frame, &machine)?;
    let (count, size) = (port.triangles.len() as u64, (machine.width, machine.height));
    Verdict::drew(count).or_nothing(&args.source.input, 0, size)?;
    let to = args.cycles.map(|cycles| args.from.saturating_add(cycles - 1)).or(args.to);
    let window = Window { from: args.from, to };
    // Where the machine draws the lights' maps, their triangles come first.
    let (triangles, passes, maps) = port.sent();
    let of_lights = triangles.len() - port.triangles.len();
    let rules = Rules { passes: &passes, maps: &maps, shading: port.words() };
    let recording = record_passes(&machine, &triangles, &rules, args.stalls, window)
        .with_context(|| args.source.input.clone())?;
    let ids = [vec![-1; of_lights], port.ids.clone()].concat();
    let truth = truth::truth(&machine, &frame, &ids, recording.view.tokens());
    let (scene, triangles) = (args.source.input.clone(), triangles.into_owned());
    let command = Some(explaining(args, asked_for, of.total()));
    let with_lights = |counted: Counted| Counted { triangles: counted.triangles + of_lights, ..counted };
    let (drawn, of) = (with_lights(drawn), with_lights(of));
    Ok(Shown { machine, scene, triangles, drawn, of, recording, truth, command, lesson: None })
}

/// The command that explains a pixel of what is drawn, of an input with `of` triangles, polygons and lines. It ends with `{x} {y}`.
fn explaining(args: &Args, machine: &MachineArgs, of: usize) -> String {
    let mut words: Vec<String> = ["edgewalk", "explain"].map(str::to_owned).to_vec();
    words.extend(machine.words().into_iter().map(str::to_owned));
    if args.triangles < of as u64 {
        words.extend(["--triangles".to_owned(), args.triangles.to_string()]);
    }
    words.extend(args.source.words());
    words.iter().map(|word| quoted(word)).chain(["{x} {y}".to_owned()]).collect::<Vec<_>>().join(" ")
}

/// The triangle of the lesson on its screen, or on a machine with POLY the polygon.
fn taught(machine: &MachineArgs) -> Result<Shown> {
    let machine = machine.machine(Some(SCREEN))?;
    permitted(&machine).map_err(|why| anyhow!("--lesson: {why}"))?;
    let of_polygon = machine.polygon.is_there();
    let tokens = match of_polygon {
        true => polygon(&machine).context("--lesson")?,
        false => vec![triangle(&machine).context("--lesson")?],
    };
    let state = DrawState::default();
    let recording = record(&machine, &tokens, state, Stalls::NONE, Window::default()).context("--lesson")?;
    let lesson = match of_polygon {
        true => polygon_lesson(&machine, &tokens, &recording, RED),
        false => lesson(&machine, &tokens[0], &recording, RED),
    };
    let lesson = lesson.map_err(|why| anyhow!("--lesson: {why}"))?;
    Ok(Shown {
        machine,
        scene: "lesson".to_owned(),
        drawn: Counted::of(&tokens),
        of: Counted::of(&tokens),
        triangles: tokens,
        recording,
        truth: Vec::new(),
        command: None,
        lesson: Some(lesson),
    })
}
