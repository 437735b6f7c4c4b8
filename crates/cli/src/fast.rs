//! Pictures without ticking, from a list of triangles or straight from a file.

use crate::engine::{Raster, from_fast};
use crate::input::{PortFrame, draw_state, port_triangle};
use crate::progress::bar;
use crate::triangles::TriangleFile;
use anyhow::{Context, Result};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::fast::{Path, Reason, Refusal, Renderer};
use edgewalk_model::{DrawState, Frame, Stalls, render, render_passes};
use std::ops::Range;

/// A frame that was drawn.
pub enum Drawn {
    /// Without ticking; its pixels are still as the machine stores them.
    Fast(Renderer),
    /// Cycle by cycle, for this reason.
    Ticked(Frame, Reason),
}

impl Drawn {
    /// Triangles drawn.
    pub fn triangles(&self) -> u64 {
        match self {
            Drawn::Fast(renderer) => renderer.counters().triangles,
            Drawn::Ticked(frame, _) => frame.counters.triangles,
        }
    }

    /// The whole picture.
    pub fn raster(self, machine: &Plan) -> Raster {
        match self {
            Drawn::Fast(renderer) => from_fast(machine, renderer.frame(), Path::Fast),
            Drawn::Ticked(frame, reason) => from_fast(machine, frame, Path::Ticked(reason)),
        }
    }

    /// The picture from the top, in bands of so many lines; what was ticked is one band.
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

/// Draws a frame whose triangles are all there.
pub fn draw_frame(machine: &Plan, port: &PortFrame) -> Result<Drawn> {
    match &port.passes[..] {
        [pass] => draw(machine, pass.state, || Ok(port.triangles.iter().copied().map(Ok))),
        passes => {
            let triangles = port.triangles.iter().copied();
            Ok(Drawn::Ticked(
                render_passes(machine, triangles, passes, Stalls::NONE, |_| {})?,
                Reason::Passes,
            ))
        }
    }
}

/// Draws without ticking where that is exact, else cycle by cycle. `open` goes to the first triangle; it is called a
/// second time where drawing without ticking was in vain.
pub fn draw<I>(machine: &Plan, state: DrawState, mut open: impl FnMut() -> Result<I>) -> Result<Drawn>
where
    I: Iterator<Item = Result<[PortVertex; 3]>>,
{
    let mut renderer = Renderer::new(machine, true);
    match until_error(open()?, |triangles| renderer.draw(triangles, state))? {
        Ok(()) => Ok(Drawn::Fast(renderer)),
        Err(Refusal::Tick(reason)) => {
            drop(renderer);
            let frame = until_error(open()?, |triangles| render(machine, triangles, state, Stalls::NONE))??;
            Ok(Drawn::Ticked(frame, reason))
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

/// Draws a triangle file while it is read: the memory that takes does not grow with the file.
pub fn draw_file(
    file: &TriangleFile,
    header: &edgewalk_scene::Frame,
    machine: &Plan,
    quiet: bool,
) -> Result<Drawn> {
    let named = || file.name().to_owned();
    let state = draw_state(header, &header.state(), machine).with_context(named)?;
    let bar = bar(file.length(), "bytes", quiet);
    let drawn = draw(machine, state, || {
        bar.reset();
        let numbered = file.reader(&bar)?.enumerate();
        Ok(numbered.map(|(index, triangle)| {
            port_triangle(index, &triangle?, header.mode, header.blend, machine).with_context(named)
        }))
    })?;
    bar.finish_and_clear();
    Ok(drawn)
}
