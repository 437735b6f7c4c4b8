//! One picture, whichever engine drew it.

#[cfg(feature = "jit")]
mod native;

use crate::input::{PortFrame, to_port};
use crate::progress::bar;
use anyhow::{Result, anyhow};
use edgewalk_host::draw;
use edgewalk_host::port::of_port;
use edgewalk_host::raster::golden_drawing;
pub use edgewalk_host::raster::{Raster, from_golden, golden_fill};
use edgewalk_host::raster::{from_machine, from_model};
use edgewalk_lockstep::StallKind;
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::{Frame as Drawn, Pass, Shading, Waits, render_passes};
use edgewalk_scene::Frame;
use std::ops::Range;

/// An engine: what draws the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// Exact coverage by integers, depth and colour in f64
    Golden,
    /// Golden's picture of an opaque frame by scan lines: one active list of all edges, no depth buffer, each pixel shaded once
    Scanline,
    /// The machine's pictures and cycles without ticking; ticks where that is not exact, with a note
    Fast,
    /// The machine, cycle by cycle, with counts of hazards and corners
    Model,
    /// The machine's netlist in the interpreter
    Rtl,
    /// The machine's netlist as native code; needs edgewalk built with the feature jit
    Jit,
}

/// Draws the frame, with a memory that makes the machine wait.
pub fn draw_waiting(
    engine: Engine,
    frame: &Frame,
    machine: &Plan,
    waits: Waits,
    quiet: bool,
) -> Result<Raster> {
    match engine {
        Engine::Golden | Engine::Scanline if waits != Waits::Never => Err(anyhow!(
            "--stalls {waits}: the golden picture has no memory that stalls; draw with --engine fast"
        )),
        Engine::Golden => Ok(draw::golden(frame, machine)),
        Engine::Scanline => draw::scan_lines(frame, machine),
        _ => draw_port(engine, &to_port(frame, machine)?, machine, waits, quiet),
    }
}

/// Draws the frame.
pub fn draw(engine: Engine, frame: &Frame, machine: &Plan, quiet: bool) -> Result<Raster> {
    draw_waiting(engine, frame, machine, Waits::Never, quiet)
}

/// Draws what is at the port, by an engine that has one.
pub fn draw_port(
    engine: Engine,
    port: &PortFrame,
    machine: &Plan,
    waits: Waits,
    quiet: bool,
) -> Result<Raster> {
    if waits != Waits::Never && matches!(engine, Engine::Rtl | Engine::Jit) {
        return Err(anyhow!(
            "--stalls {waits}: the netlist, --engine rtl or jit, has a memory that is always ready; draw with --engine fast"
        ));
    }
    if matches!(engine, Engine::Fast | Engine::Golden | Engine::Scanline) {
        return Ok(of_port(draw::draw_frame(machine, port, waits)?.raster(machine), port));
    }
    let (triangles, passes, maps) = port.sent();
    let bar = bar(triangles.len() as u64, "triangles", quiet || waits != Waits::Never);
    let triangles = bar.wrap_iter(triangles.iter().copied());
    let sent = (&*passes, &*maps, port.words());
    let drawn = match engine {
        Engine::Jit => native(machine, triangles, sent)?,
        Engine::Rtl => interpreted(machine, triangles, sent)?,
        _ => render_passes(machine, triangles, &passes, &maps, waits, port.words())?,
    };
    bar.finish_and_clear();
    let (drawn, lights) = port.apart(drawn);
    let raster = match engine {
        Engine::Jit | Engine::Rtl => from_machine(machine, drawn),
        _ => from_model(machine, drawn),
    };
    Ok(of_port(Raster { lights, ..raster }, port))
}

/// Passes, maps that are there, and what the memories behind TERM and SHADE hold.
type Sent<'a> = (&'a [Pass], &'a [Vec<u32>], &'a Shading);

/// The netlist's frame, by the interpreter.
fn interpreted(
    machine: &Plan,
    triangles: impl Iterator<Item = [PortVertex; 3]>,
    (passes, maps, words): Sent,
) -> Result<Drawn> {
    let drawn =
        edgewalk_lockstep::render_rtl_passes(machine, triangles, passes, maps, StallKind::None, words);
    Ok(drawn?)
}

/// The netlist's frame, by native code.
#[cfg(feature = "jit")]
fn native(
    machine: &Plan,
    triangles: impl Iterator<Item = [PortVertex; 3]>,
    (passes, maps, words): Sent,
) -> Result<Drawn> {
    let mut device = native::Native::new(&machine.tagged())?;
    let drawn =
        edgewalk_lockstep::render_on(&mut device, machine, triangles, passes, maps, StallKind::None, words);
    Ok(drawn?)
}

#[cfg(not(feature = "jit"))]
fn native(_: &Plan, _: impl Iterator<Item = [PortVertex; 3]>, _: Sent) -> Result<Drawn> {
    Err(anyhow!(
        "--engine jit: this edgewalk was built without the feature jit; \
         build one that has it with `cargo build --release --features jit`, or draw with --engine rtl"
    ))
}

/// Draws the frame and gives it from the top, a band of lines at a time where the engine can do so: a whole picture in
/// f64 may not fit into memory.
pub fn draw_bands(
    engine: Engine,
    frame: &Frame,
    machine: &Plan,
    quiet: bool,
    mut take: impl FnMut(Raster) -> Result<()>,
) -> Result<()> {
    match engine {
        Engine::Golden => {
            let drawing = golden_drawing(frame, machine);
            let mut bands = draw::bands(frame.height, lines(frame.width, GOLDEN_BAND));
            bands.try_for_each(|lines| {
                take(Raster { host: frame.host, ..from_golden(drawing.lines(lines), machine) })
            })
        }
        Engine::Fast => {
            let port = to_port(frame, machine)?;
            draw::in_bands(machine, &port, Waits::Never, lines(machine.width, FAST_BAND), take)
        }
        Engine::Scanline | Engine::Model | Engine::Rtl | Engine::Jit => {
            take(draw(engine, frame, machine, quiet)?)
        }
    }
}

/// Pixels of a band: golden goes through all triangles for each, so a few large ones.
const GOLDEN_BAND: u32 = 1 << 22;
const FAST_BAND: u32 = 1 << 18;

/// The bands in which what the fast engine drew is taken from it.
pub fn fast_bands(machine: &Plan) -> impl Iterator<Item = Range<u32>> {
    draw::bands(machine.height, lines(machine.width, FAST_BAND))
}

/// Lines of about so many pixels together.
fn lines(width: u32, pixels: u32) -> u32 {
    (pixels / width).max(1)
}
