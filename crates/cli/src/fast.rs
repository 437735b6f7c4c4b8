//! Pictures without ticking, straight from a file.

use crate::input::{draw_state, port_triangle};
use crate::progress::bar;
use crate::triangles::TriangleFile;
use anyhow::{Context, Result};
use edgewalk_explore::draw::{Drawn, draw};
use edgewalk_machine::Plan;
use edgewalk_model::Waits;

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
    let drawn = draw(machine, state, Waits::Never, || {
        bar.reset();
        let numbered = file.reader(&bar)?.enumerate();
        Ok(numbered.map(|(index, triangle)| {
            port_triangle(index, &triangle?, header, header.blend, machine).with_context(named)
        }))
    })?;
    bar.finish_and_clear();
    Ok(drawn)
}
