//! `edgewalk raster`: screen-space triangles of any program, through any engine, into numpy arrays.

mod page;

use crate::document::document;
use crate::engine::{Engine, Raster, draw_bands, fast_bands};
use crate::fast::BeyondBand;
use crate::machine_args::MachineArgs;
use crate::triangles::TriangleFile;
use crate::verdict::Verdict;
use crate::{Talk, fast};
use anyhow::{Context, Result, anyhow};
use edgewalk_files::Staging;
use edgewalk_host::extra;
use edgewalk_host::input::as_large;
use edgewalk_host::needs::{self, needs};
use edgewalk_judge::report::Report;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use edgewalk_scene::{Frame, InputError, InputKind};
use page::Page;
use std::path::{Path, PathBuf};

/// Draw a file of screen-space triangles and write the values of every pixel as arrays.
///
/// Files: coverage.npy, writes.npy (u32), id.npy (i32), z.npy (H,W) and rgb.npy (H,W,3) (f64 in 0 to 1), image.png
/// and report.json; row 0 is on top. Golden does not quantise z and rgb. Golden and machines with SHADOW add
/// lit.npy (u8: 0 nothing written, 1 in shadow, 2 lit). With channels.extra = n also e0.npy and so on, in LSB of
/// the channel's output: i64, or f64 for golden's plane; 0 at pixels that no triangle covers.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk raster triangles.tri --out out/r
  edgewalk raster triangles.tri --engine golden --out out/g --json
  edgewalk raster triangles.tri --engine rtl --out out/n --set interpolator.adders=1
  edgewalk raster triangles.tri --engine jit --out out/n     the same, as native code; needs cargo build --features jit
  edgewalk raster textured.tri --out out/t --set channels.extra=2

The triangle file (docs/triangle_file.md), one item a line, # comments:
  size W H                                                before the first triangle, as the header's other lines
  mode gouraud|flat|phong|fast-phong
  view x y z   sun x y z i   specular halfway|blinn       of phong and fast-phong: to the viewer, to a light
  ambient i                                               of phong and fast-phong: ambient light, 1 unless given
  material ka kd ks n                                     of the triangles behind it
  texture W H  rrggbb ..                                  texels of the material before it, lines from the top; texture.kind=nearest
  depth less|lequal|always|off|...
  depth_write 0|1
  blend 0|1|add                                           1: (1-kt) I + kt I_back; add: I + I_back; needs blend.kind
  colour_write 0|1                                        0: depth only; needs blend.kind
  clear_depth                                             depth to blend and this also between triangles
  clear r g b
  light N                                                 the number of a shadow line, from 1; 0: none
  extra N                                                 values of your own at a vertex, 0 to 4: channels.extra = N
  shadow SIZE BIAS AMBIENT m00 m01 .. m33                 a light's depth map, matrix by rows; shadow.light = parallel, perspective or golden
  L x y z  x y z  x y z                                   a triangle of that map, in texels
  T x y z r g b kt  x y z r g b kt  x y z r g b kt        a triangle, pixels
  X e0 .. e0 .. e0 ..                                     N values of vertex 1, of 2, of 3: unorm [0,1], else LSB
  N nx ny nz  nx ny nz  nx ny nz                          normals of a triangle in mode phong or fast-phong
  UV u v  u v  u v                                        its texture coordinates, v up, where its material has a texture
  S x y z r g b kt  x y z r g b kt                        a line of one pixel's width; polygon.lines = yes
  P n  x y z r g b kt ..                                  a polygon of n vertices; without polygon.edges drawn as triangles
  H n  x y z r g b kt ..                                  one more contour of the polygon on the line before")]
pub struct Args {
    /// The triangle file; - for the standard input
    file: PathBuf,
    /// Set the keys of the machine that the file asks for, as channels.extra, blend.kind, shadow.size or
    /// shade.kind; --set has the last word
    #[arg(long)]
    adapt: bool,
    /// Engine that draws
    #[arg(long, value_enum, default_value_t = Engine::Fast)]
    engine: Engine,
    /// Output directory
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// What a run may write.
const FILES: [&str; 12] = [
    "coverage.npy",
    "writes.npy",
    "id.npy",
    "z.npy",
    "rgb.npy",
    "e0.npy",
    "e1.npy",
    "e2.npy",
    "e3.npy",
    "lit.npy",
    "image.png",
    "report.json",
];

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let out = Staging::new(&args.out)?;
    let name = args.file.display().to_string();
    no_mesh(&name)?;
    let file = TriangleFile::open(&args.file)?;
    let header = file.header()?;
    let screen = Some((header.width, header.height));
    let asked = |frame: &Frame, machine: &Plan| match args.engine {
        Engine::Golden | Engine::Scanline => Vec::from_iter(needs::of_golden(frame, machine)),
        _ => needs(frame, machine),
    };
    let machine = if args.adapt {
        let frame = file.whole()?;
        machine.adapted(screen, |machine: &Plan| Ok(asked(&frame, machine)))?
    } else {
        machine.machine(screen)?
    };
    as_large(&name, &header, &machine)?;
    if header.extra != extra::channels(&machine).len() {
        needs::met(&asked(&file.whole()?, &machine)).with_context(|| name.clone())?;
    }
    let report = match args.engine {
        // Of a light all triangles are needed before the first pixel; of what the machine lacks, to name all of it.
        Engine::Fast if header.shadows.is_empty() && needs(&header, &machine).is_empty() => {
            while_it_is_read(&file, &header, &machine, &out, talk)?
        }
        engine => whole(&file, engine, &machine, &out, talk)?,
    };
    out.write("report.json", document("report", &report)?)?;
    out.publish(&FILES)?;
    talk.say(|| document("report", &report), || report.text())?;
    let size = (machine.width, machine.height);
    Verdict::drew(report.drawn.fragments).or_nothing(&name, report.drawn.primitives(), size)
}

/// Refuses what is no triangle file by its name.
fn no_mesh(name: &str) -> Result<()> {
    let kind = match InputKind::of(name) {
        Some(InputKind::Mesh) => "a mesh",
        Some(InputKind::Scene) if !Path::new(name).exists() || name.contains('.') => "a scene",
        _ => return Ok(()),
    };
    Err(anyhow!(
        "{name}: {kind}: permitted: a triangle file (.tri); draw it with `edgewalk render {name}`, or make a triangle file of it with \
         `edgewalk triangles {name} --out FILE.tri`"
    ))
}

fn while_it_is_read(
    file: &TriangleFile,
    header: &Frame,
    machine: &Plan,
    out: &Staging,
    talk: Talk,
) -> Result<Report> {
    let (drawn, host) = match fast::draw_file(file, header, machine, talk.quiet) {
        Err(error)
            if matches!(error.downcast_ref(), Some(InputError::NeedsWhole(_)))
                || error.is::<BeyondBand>() =>
        {
            return whole(file, Engine::Fast, machine, out, talk);
        }
        drawn => drawn?,
    };
    let triangles = drawn.triangles();
    let report = |band: &Raster| {
        let mut report = Report::new(file.name(), triangles, machine, band, Waits::Never);
        report.drawn.host = host;
        report
    };
    let mut page = Page::new(out, machine, report);
    let bands = fast_bands(machine);
    drawn.bands(machine, bands, |band| page.add(&band))?;
    page.finish()
}

fn whole(file: &TriangleFile, engine: Engine, machine: &Plan, out: &Staging, talk: Talk) -> Result<Report> {
    let frame = file.whole()?;
    let (triangles, polygons) = (frame.triangles.len() as u64, frame.polygons.len() as u64);
    let lines = frame.lines.len() as u64;
    let report = |band: &Raster| {
        let mut report = Report::new(file.name(), triangles, machine, band, Waits::Never);
        (report.drawn.polygons, report.drawn.lines) = (polygons, lines);
        report
    };
    let mut page = Page::new(out, machine, report);
    draw_bands(engine, &frame, machine, talk.quiet, |band| page.add(&band))
        .with_context(|| file.name().to_owned())?;
    page.finish()
}
