//! Pictures without ticking, straight from a file.

use crate::input::{draw_state, port_triangle};
use crate::progress::bar;
use crate::triangles::TriangleFile;
use anyhow::{Context, Result};
use edgewalk_host::draw::{Drawn, draw};
use edgewalk_host::vertices::guard_band;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use edgewalk_scene::{Host, fits};
use std::cell::Cell;

/// A triangle that reaches beyond the guard band: what is made of it is not one triangle, so the file is wanted whole.
#[derive(Debug, thiserror::Error)]
#[error("a triangle reaches beyond the guard band")]
pub struct BeyondBand;

/// Draws a triangle file while it is read: the memory that takes does not grow with the file. Also gives what was done to its depths.
///
/// # Errors
/// [`BeyondBand`], a fault in the file, what the machine cannot take.
pub fn draw_file(
    file: &TriangleFile,
    header: &edgewalk_scene::Frame,
    machine: &Plan,
    quiet: bool,
) -> Result<(Drawn, Host)> {
    let named = || file.name().to_owned();
    let state = draw_state(header, &header.state(), machine).with_context(named)?;
    let (limit, host) = (guard_band(machine), Cell::new(header.host));
    let bar = bar(file.length(), "bytes", quiet);
    let drawn = draw(machine, state, Waits::Never, || {
        bar.reset();
        let (mut reader, host) = (file.reader(&bar)?, &host);
        let read = std::iter::from_fn(move || {
            let triangle = reader.next();
            host.set(reader.header().host);
            triangle
        });
        Ok(read.enumerate().map(|(index, triangle)| {
            let triangle = triangle?;
            if !fits(&triangle, limit) {
                return Err(BeyondBand.into());
            }
            port_triangle(index, &triangle, header, &header.state(), machine).with_context(named)
        }))
    })?;
    bar.finish_and_clear();
    Ok((drawn, host.get()))
}
