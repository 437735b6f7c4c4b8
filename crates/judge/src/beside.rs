//! Golden beside a machine's picture: drawn, compared and shown a band of lines at a time, so that neither need be in memory as
//! a whole.

use crate::compare::{Bands, Comparison, compare_shaded};
use anyhow::{Context as _, Result};
use edgewalk_host::draw;
use edgewalk_host::raster::{Raster, from_golden, golden_drawing};
use edgewalk_host::reach::Reach;
use edgewalk_host::shade::Proof;
use edgewalk_machine::Plan;
use edgewalk_scene::Frame;

/// Pixels of a band, about. Both pictures and their errors take some 120 bytes each.
const BAND: u32 = 1 << 19;

/// Some lines of both pictures.
pub struct Beside<'b> {
    /// Golden's.
    pub golden: &'b Raster,
    /// The machine's.
    pub drawn: &'b Raster,
    /// Depth error of every pixel, LSB.
    pub z_error: &'b [f64],
    /// Largest colour error of every pixel, LSB.
    pub color_error: &'b [f64],
}

/// What is proved of the frame's triangles.
#[derive(Clone, Copy)]
pub struct Proved<'p> {
    /// How far they reach, where that is known.
    pub reach: Option<&'p Reach>,
    /// Of colours that are made at each pixel.
    pub shading: Option<&'p Proof>,
}

/// Compares the picture of `frame`, which has triangles only. `draw` gives the machine's picture from the top in bands of so many
/// lines; `see` is shown each beside golden's. The comparison is without the errors of every pixel.
///
/// # Errors
/// Those of `draw` and `see`.
pub fn beside(
    machine: &Plan,
    frame: &Frame,
    proved: Proved,
    draw: impl FnOnce(u32, &mut dyn FnMut(Raster) -> Result<()>) -> Result<()>,
    mut see: impl FnMut(&Beside) -> Result<()>,
) -> Result<Comparison> {
    let no_lines = "a picture without lines";
    if !Bands::suit(frame) {
        let (golden, mut found) = (draw::golden(frame, machine), None);
        draw(machine.height, &mut |drawn| {
            let c = compare_shaded(machine, frame, &golden, &drawn, proved.reach, proved.shading);
            let [z_error, color_error] = [&c.errors.z.map, &c.errors.color.map];
            see(&Beside { golden: &golden, drawn: &drawn, z_error, color_error })?;
            found = Some(c.without_maps());
            Ok(())
        })?;
        return found.context(no_lines);
    }
    let drawing = golden_drawing(frame, machine);
    let (mut bands, mut top) = (None, 0);
    draw((BAND / machine.width).max(1), &mut |drawn| {
        let cycles = drawn.cycles.as_ref();
        let bands: &mut Bands = bands.get_or_insert_with(|| Bands::new(machine, frame, cycles, proved.reach));
        let lines = top..top + drawn.height;
        top = lines.end;
        let golden = from_golden(drawing.lines(lines), machine);
        let [z_error, color_error] = bands.add(&golden, &drawn);
        see(&Beside { golden: &golden, drawn: &drawn, z_error: &z_error, color_error: &color_error })
    })?;
    bands.map(Bands::found).context(no_lines)
}
