//! A frame through golden, or through a machine.

use crate::port::{PortFrame, of_port, to_port};
use crate::raster::{LightPass, Raster, from_fast, from_golden, golden_drawing, golden_fill};
use anyhow::{Result, anyhow};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::fast::{Path, Reason, Refusal, Renderer};
use edgewalk_model::{DrawState, Frame, Shading, Waits, render, render_passes};
use std::ops::Range;

/// The golden picture on the machine's screen.
#[must_use]
pub fn golden(frame: &edgewalk_scene::Frame, machine: &Plan) -> Raster {
    let picture = golden_drawing(frame, machine).lines(0..frame.height);
    Raster { host: frame.host, ..from_golden(picture, machine) }
}

/// Golden's picture of an opaque frame, by one active list of all edges.
///
/// # Errors
/// The machine's fill is not exact, or the frame is not opaque.
pub fn scan_lines(frame: &edgewalk_scene::Frame, machine: &Plan) -> Result<Raster> {
    let edgewalk_golden::Fill::Exact { subpixel_bits } = golden_fill(machine) else {
        return Err(anyhow!(
            "--engine scanline: edge.fill = textbook: permitted: exact; draw with --engine golden, or --set edge.fill=exact"
        ));
    };
    let drawn = edgewalk_golden::scan_lines(frame, subpixel_bits);
    let (picture, _) = drawn.map_err(|why| {
        anyhow!(
            "--engine scanline: {why}: permitted: opaque surfaces under one rule, depth less or lequal; draw with --engine golden"
        )
    })?;
    Ok(Raster { host: frame.host, written_once: true, ..from_golden(picture, machine) })
}

/// The machine's picture and cycles, without ticking where that is exact.
///
/// # Errors
/// What of the frame the machine cannot take.
pub fn fast(frame: &edgewalk_scene::Frame, machine: &Plan, waits: Waits) -> Result<Raster> {
    let port = to_port(frame, machine)?;
    Ok(of_port(draw_frame(machine, &port, waits)?.raster(machine), &port))
}

/// Draws a frame whose triangles are all there.
///
/// # Errors
/// None but of triangles of another machine.
pub fn draw_frame(machine: &Plan, port: &PortFrame, waits: Waits) -> Result<Drawn> {
    if port.shade.is_some() {
        let triangles = port.triangles.iter().copied();
        let frame = render_passes(machine, triangles, &port.passes, &[], waits, port.words())?;
        return Ok(Drawn::Ticked(frame, Reason::Shade, Vec::new()));
    }
    match &port.passes[..] {
        [pass] if port.lights.is_empty() => {
            draw(machine, pass.state, waits, || Ok(port.triangles.iter().copied().map(Ok)))
        }
        _ => {
            let why = if port.lights.is_empty() { Reason::Passes } else { Reason::Shadow };
            let (triangles, passes, maps) = port.sent();
            let triangles = triangles.iter().copied();
            let (drawn, lights) =
                port.apart(render_passes(machine, triangles, &passes, &maps, waits, &Shading::default())?);
            Ok(Drawn::Ticked(drawn, why, lights))
        }
    }
}

/// Draws a frame whose triangles are all there, and gives its picture from the top in bands of so many lines.
///
/// # Errors
/// Of triangles of another machine, and the first that `take` gives.
pub fn in_bands(
    machine: &Plan,
    port: &PortFrame,
    waits: Waits,
    lines: u32,
    mut take: impl FnMut(Raster) -> Result<()>,
) -> Result<()> {
    let drawn = draw_frame(machine, port, waits)?;
    drawn.bands(machine, bands(machine.height, lines), |band| take(of_port(band, port)))
}

/// A picture of this height in bands of so many lines.
pub fn bands(height: u32, lines: u32) -> impl Iterator<Item = Range<u32>> {
    (0..height).step_by(lines as usize).map(move |top| top..height.min(top.saturating_add(lines)))
}

/// The words of the machine's memories at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pixel {
    /// Number at the port of the triangle that wrote the pixel last, -1 for none.
    pub id: i32,
    /// Stored depth, LSB.
    pub z: u64,
    /// Stored colour, LSB each.
    pub rgb: [u64; 3],
}

/// A frame that was drawn.
pub enum Drawn {
    /// Without ticking; its pixels are still as the machine stores them.
    Fast(Renderer),
    /// Cycle by cycle, for this reason; with the maps that the machine drew before.
    Ticked(Frame, Reason, Vec<LightPass>),
}

impl Drawn {
    /// Triangles drawn.
    #[must_use]
    pub fn triangles(&self) -> u64 {
        match self {
            Drawn::Fast(renderer) => renderer.counters().triangles,
            Drawn::Ticked(frame, ..) => frame.counters.triangles,
        }
    }

    /// Pixel (x, y) as the machine stores it.
    #[must_use]
    pub fn pixel(&self, machine: &Plan, (x, y): (u32, u32)) -> Pixel {
        let of = |frame: &Frame, y: u32| {
            let at = (y * machine.width + x) as usize;
            Pixel { id: frame.id[at], z: frame.z[at], rgb: frame.rgb[at] }
        };
        match self {
            Drawn::Fast(renderer) => of(&renderer.lines(y..y + 1), 0),
            Drawn::Ticked(frame, ..) => of(frame, y),
        }
    }

    /// The whole picture.
    #[must_use]
    pub fn raster(self, machine: &Plan) -> Raster {
        match self {
            Drawn::Fast(renderer) => from_fast(machine, renderer.frame(), Path::Fast),
            Drawn::Ticked(frame, reason, lights) => {
                Raster { lights, ..from_fast(machine, frame, Path::Ticked(reason)) }
            }
        }
    }

    /// The picture from the top, in bands of so many lines; what was ticked is one band.
    ///
    /// # Errors
    /// The first that `take` gives.
    pub fn bands(
        self,
        machine: &Plan,
        bands: impl Iterator<Item = Range<u32>>,
        mut take: impl FnMut(Raster) -> Result<()>,
    ) -> Result<()> {
        match self {
            Drawn::Fast(renderer) => {
                let mut bands = bands.map(|lines| from_fast(machine, renderer.lines(lines), Path::Fast));
                bands.try_for_each(take)
            }
            ticked => take(ticked.raster(machine)),
        }
    }
}

/// Draws without ticking where that is exact, else cycle by cycle, as with a memory that stalls. `open` goes to the first triangle; it is called a
/// second time where drawing without ticking was in vain.
///
/// # Errors
/// The first that `open` or what it opens gives.
pub fn draw<I>(
    machine: &Plan,
    state: DrawState,
    waits: Waits,
    mut open: impl FnMut() -> Result<I>,
) -> Result<Drawn>
where
    I: Iterator<Item = Result<[PortVertex; 3]>>,
{
    let ticked = |open: &mut dyn FnMut() -> Result<I>, reason| {
        let frame = until_error(open()?, |triangles| render(machine, triangles, state, waits))??;
        Ok(Drawn::Ticked(frame, reason, Vec::new()))
    };
    if waits != Waits::Never {
        return ticked(&mut open, Reason::Memory);
    }
    let mut renderer = Renderer::new(machine, true);
    match until_error(open()?, |triangles| renderer.draw(triangles, state))? {
        Ok(()) => Ok(Drawn::Fast(renderer)),
        Err(Refusal::Tick(reason)) => {
            drop(renderer);
            ticked(&mut open, reason)
        }
        Err(Refusal::Foreign(foreign)) => Err(foreign.into()),
    }
}

/// Draws what comes before the first error, and returns the error if there is one.
fn until_error<I, T>(
    triangles: I,
    draw: impl FnOnce(&mut dyn Iterator<Item = [PortVertex; 3]>) -> T,
) -> Result<T>
where
    I: Iterator<Item = Result<[PortVertex; 3]>>,
{
    let mut failure = None;
    let drawn = draw(&mut triangles.map_while(|triangle| triangle.map_err(|e| failure = Some(e)).ok()));
    failure.map_or(Ok(drawn), Err)
}
