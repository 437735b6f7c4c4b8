//! `edgewalk triangles`: a scene or a mesh as a triangle file.

use crate::document::line;
use crate::input::{Shading, Source};
use crate::machine_args::MachineArgs;
use crate::verdict::Verdict;
use crate::{Talk, kept, talk};
use anyhow::{Context as _, Result, anyhow, ensure};
use edgewalk_files::Staging;
use edgewalk_scene::{InputKind, TJoint, triangle_file};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Write a scene or a mesh as a triangle file: its triangles on the screen, as the machine takes them.
///
/// Screen and guard band are those of the machine, colours those of --shading. `edgewalk raster`, and every other command
/// that takes the file, draws the picture of the scene bit by bit. What a file cannot say is refused. With --shading phong that
/// is a light at a point, coloured light or highlights, emission, and a relief; with fast-phong every scene, as it is seen from a
/// point. T-joints of the mesh are counted, and the first is named.
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
    let to_output = args.out == Path::new(InputKind::STANDARD_INPUT);
    ensure!(
        !to_output || !talk.json,
        "--out - --json: the standard output takes one of the triangle file and the JSON document; give --out a file, or leave \
         --json out"
    );
    let machine = args.source.machine(machine)?;
    let (frame, joints) = if args.source.is_triangle_file() {
        (args.source.frame(&machine)?, Vec::new())
    } else {
        let (scene, surface) = args.source.surface(&machine)?;
        (args.source.frame_of(&scene, &surface, &machine)?.0, scene.mesh.t_joints())
    };
    let mut text = Vec::new();
    triangle_file::write(&frame, &mut text).map_err(|error| refused(error, args))?;
    let (triangles, size) = (frame.triangles.len(), (machine.width, machine.height));
    let lines = match frame.lines.len() {
        0 => String::new(),
        count => format!(" and {count} lines"),
    };
    if to_output {
        talk::print(&String::from_utf8(text).context("a triangle file is ASCII")?)?;
    } else {
        let name = kept::name_of(&args.out)?;
        let folder = args.out.parent().filter(|path| !path.as_os_str().is_empty()).unwrap_or(".".as_ref());
        let out = Staging::new(folder)?;
        out.write(name, text)?;
        out.publish(&[name])?;
        let at = args.out.display().to_string();
        talk.say(
            || {
                let (width, height) = size;
                let found = json!({
                    "file": at, "triangles": triangles, "width": width, "height": height, "t_joints": joints.len(),
                });
                line("triangles", found)
            },
            || {
                let drawn = format!("{at}: {triangles} triangles{lines} on {} x {} pixels", size.0, size.1);
                format!("{drawn}{}", told(&joints))
            },
        )?;
    }
    Verdict::drew(frame.drawn() as u64).or_nothing(&args.source.input, frame.drawn() as u64, size)
}

/// A file cannot say the frame's shading: the error with a way to the picture.
fn refused(error: std::io::Error, args: &Args) -> anyhow::Error {
    let input = &args.source.input;
    if error.kind() != std::io::ErrorKind::Unsupported {
        return anyhow::Error::new(error).context(input.clone());
    }
    let name = args.source.shading().name();
    let other = if args.source.shading() == Shading::FastPhong {
        "--shading phong or gouraud"
    } else {
        "--shading gouraud"
    };
    anyhow!(
        "{input}: {error}; take {other}, or draw the scene without a file: edgewalk render {input} --shading {name} --engine golden"
    )
}

/// How many T-joints there are, and where the first is.
fn told(joints: &[TJoint]) -> String {
    let place = |[x, y, z]: &[f64; 3]| format!("({x} {y} {z})");
    let Some(TJoint { vertex, edge: [from, to] }) = joints.first() else { return String::new() };
    format!(
        "\nT-joints: {}, the first at {} on the edge from {} to {}; permitted, but shading breaks there and pixels may be \
         missed or drawn twice: let both faces share the vertex",
        joints.len(),
        place(vertex),
        place(from),
        place(to)
    )
}
