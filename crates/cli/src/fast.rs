//! Pictures without ticking, from a list of triangles or straight from a file.

use crate::input::{draw_state, header, open, port_triangle};
use crate::machine_args::MachineArgs;
use crate::progress::bar;
use anyhow::{Context, Result};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::fast::{self, Renderer};
use edgewalk_model::{DrawState, Frame, Stalls, render};
use std::path::Path;

/// Draws without ticking where that is exact, else cycle by cycle. `open` goes to the first triangle; it is called a
/// second time where drawing without ticking was in vain.
pub fn draw<I>(
    machine: &Plan,
    state: DrawState,
    mut open: impl FnMut() -> Result<I>,
) -> Result<(Frame, fast::Path)>
where
    I: Iterator<Item = Result<[PortVertex; 3]>>,
{
    let mut renderer = Renderer::new(machine, true);
    match until_error(open()?, |triangles| renderer.draw(triangles, state))? {
        Ok(()) => Ok((renderer.frame(), fast::Path::Fast)),
        Err(reason) => {
            let frame = until_error(open()?, |triangles| render(machine, triangles, state, Stalls::NONE))?;
            Ok((frame, fast::Path::Ticked(reason)))
        }
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

/// Draws a triangle file on its own screen while it is read: the memory that takes does not grow with the file.
pub fn draw_file(file: &Path, args: &MachineArgs, quiet: bool) -> Result<(Plan, Frame, fast::Path)> {
    let header = header(file)?;
    let machine = args.machine(Some((header.width, header.height)))?;
    let named = || file.display().to_string();
    let state = draw_state(&header, &machine).with_context(named)?;
    let bar = bar(std::fs::metadata(file).map_or(0, |data| data.len()), "bytes", quiet);
    let (frame, path) = draw(&machine, state, || {
        bar.reset();
        let numbered = open(file, &bar)?.enumerate();
        Ok(numbered.map(|(index, triangle)| {
            port_triangle(index, &triangle?, header.mode, &machine).with_context(named)
        }))
    })?;
    bar.finish_and_clear();
    Ok((machine, frame, path))
}
