//! `edgewalk triangles`: a scene or a mesh as a triangle file.

use crate::document::line;
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::staging::Staging;
use crate::verdict::Verdict;
use crate::{Talk, talk};
use anyhow::{Context as _, Result};
use edgewalk_scene::{InputKind, triangle_file};
use std::path::{Path, PathBuf};

/// Write a scene or a mesh as a triangle file: its triangles on the screen, as the machine takes them.
///
/// Screen and guard band are those of the machine, colours those of --shading. `edgewalk raster`, and every other command
/// that takes the file, draws the picture of the scene bit by bit.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk triangles teapot.obj --out teapot.tri
  edgewalk triangles scene.toml --out small.tri --set screen.width=160 --set screen.height=120
  edgewalk triangles sphere --out - | edgewalk raster - --out out/sphere")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Output file; - for the standard output
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let (machine, frame) = args.source.on_its_screen(machine)?;
    let mut text = Vec::new();
    triangle_file::write(&frame, &mut text).with_context(|| args.source.input.clone())?;
    let (triangles, size) = (frame.triangles.len(), (machine.width, machine.height));
    let lines = match frame.lines.len() {
        0 => String::new(),
        count => format!(" and {count} lines"),
    };
    if args.out == Path::new(InputKind::STANDARD_INPUT) {
        talk::print(&String::from_utf8(text).context("a triangle file is ASCII")?)?;
    } else {
        let name = args.out.file_name().and_then(|name| name.to_str()).context("--out: no file name")?;
        let folder = args.out.parent().filter(|path| !path.as_os_str().is_empty()).unwrap_or(".".as_ref());
        let out = Staging::new(folder)?;
        out.write(name, text)?;
        out.publish(&[name])?;
        let at = args.out.display().to_string();
        talk.say(
            || line("triangles", serde_json::json!({ "file": at, "triangles": triangles, "width": size.0, "height": size.1 })),
            || format!("{at}: {triangles} triangles{lines} on {} x {} pixels", size.0, size.1),
        )?;
    }
    Verdict::drew(frame.drawn() as u64).or_nothing(&args.source.input, frame.drawn() as u64, size)
}
