//! `edgewalk raster`: screen-space triangles of any program, through any engine, into numpy arrays.

use crate::engine::{Engine, Raster, draw, from_fast};
use crate::machine_args::MachineArgs;
use crate::report::Report;
use crate::staging::Staging;
use crate::verdict::Verdict;
use crate::{Talk, arrays, fast, picture};
use anyhow::{Context, Result};
use edgewalk_scene::{InputError, triangle_file};
use std::path::{Path, PathBuf};

/// Draws a file of screen-space triangles and writes what every pixel got.
///
/// Writes coverage.npy, writes.npy (u32), id.npy (i32), z.npy (H,W) and rgb.npy (H,W,3) (f64 in [0,1]), image.png and
/// report.json; row 0 on top. Golden does not quantise z and rgb, and adds lit.npy (u8: 0 nothing written, 1 in shadow, 2 lit).
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk raster triangles.tri --out out/r
  edgewalk raster triangles.tri --engine golden --out out/g --json
  edgewalk raster triangles.tri --engine rtl --out out/n --set interpolator.adders=1

The triangle file (docs/triangle_file.md), one item a line, # comments:
  size W H                                                first
  mode gouraud|flat
  depth less|lequal|always|off|...
  depth_write 0|1
  blend 0|1                                               1: (1-kt) I + kt I_back; golden only
  clear r g b
  shadow SIZE BIAS AMBIENT m00 m01 .. m33                 a light's depth map, matrix by rows; golden only
  L x y z  x y z  x y z                                   a triangle of that map, in texels
  T x y z r g b kt  x y z r g b kt  x y z r g b kt        a triangle, pixels
  P n  x y z r g b kt ..                                  a polygon of n vertices; the machine draws it as triangles
  H n  x y z r g b kt ..                                  one more contour of the polygon on the line before")]
pub struct Args {
    /// The triangle file
    file: PathBuf,
    /// Who draws
    #[arg(long, value_enum, default_value_t = Engine::Fast)]
    engine: Engine,
    /// Output directory
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let (drawn, report) = match args.engine {
        Engine::Fast => while_it_is_read(&args.file, machine, talk)?,
        engine => whole(&args.file, engine, machine, talk)?,
    };
    let out = Staging::new(&args.out)?;
    write_arrays(&out, &drawn)?;
    picture::write_rgb(&out, "image.png", drawn.width, drawn.height, &drawn.rgb)?;
    out.write("report.json", report.json()?)?;
    out.publish()?;
    report.print(talk)?;
    let size = (drawn.width, drawn.height);
    Verdict::drew(report.covered()).or_nothing(&args.file.display().to_string(), report.primitives(), size)
}

fn while_it_is_read(file: &Path, machine: &MachineArgs, talk: Talk) -> Result<(Raster, Report)> {
    let (machine, frame, path) = match fast::draw_file(file, machine, talk.quiet) {
        Err(error) if matches!(error.downcast_ref(), Some(InputError::Polygon(_))) => {
            return whole(file, Engine::Fast, machine, talk);
        }
        drawn => drawn?,
    };
    let triangles = frame.counters.triangles;
    let drawn = from_fast(&machine, frame, path);
    let report = Report::new(&file.display().to_string(), triangles, &machine, &drawn);
    Ok((drawn, report))
}

fn whole(file: &Path, engine: Engine, machine: &MachineArgs, talk: Talk) -> Result<(Raster, Report)> {
    let name = file.display().to_string();
    let frame = triangle_file::read(file)?;
    let machine = machine.machine(Some((frame.width, frame.height)))?;
    let drawn = draw(engine, &frame, &machine, talk.quiet).with_context(|| name.clone())?;
    let report = Report::new(&name, frame.triangles.len() as u64, &machine, &drawn)
        .with_polygons(frame.polygons.len() as u64);
    Ok((drawn, report))
}

fn write_arrays(out: &Staging, drawn: &Raster) -> Result<()> {
    let shape = [u64::from(drawn.height), u64::from(drawn.width)];
    arrays::write(out, "coverage.npy", &shape, &drawn.coverage)?;
    arrays::write(out, "writes.npy", &shape, &drawn.writes)?;
    arrays::write(out, "id.npy", &shape, &drawn.id)?;
    arrays::write(out, "z.npy", &shape, &drawn.z)?;
    arrays::write(out, "rgb.npy", &[shape[0], shape[1], 3], drawn.rgb.as_flattened())?;
    drawn.lit.as_ref().map_or(Ok(()), |lit| arrays::write(out, "lit.npy", &shape, lit))
}
