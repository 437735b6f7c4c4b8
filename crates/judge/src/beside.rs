//! Golden beside a machine's picture: drawn, compared and shown a band of lines at a time, so that neither need be in memory as
//! a whole.

use crate::compare::{Bands, Comparison, compare_shaded};
use crate::report::Report;
use anyhow::{Context as _, Result};
use edgewalk_golden::Drawing;
use edgewalk_host::raster::{Raster, from_golden, golden_drawing};
use edgewalk_host::reach::Reach;
use edgewalk_host::shade::Proof;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use edgewalk_scene::Frame;
use std::borrow::Cow;
use std::ops::Range;

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

const NO_LINES: &str = "a picture without lines";

/// Golden's picture of a frame.
pub enum Golden<'g> {
    /// All of it, drawn before.
    Whole(&'g Raster),
    /// Drawn here, band by band if the frame can be compared so.
    Drawing(Drawing<'g>),
}

impl<'g> Golden<'g> {
    /// Golden's picture of a frame on the machine's screen, not drawn yet.
    #[must_use]
    pub fn of(frame: &'g Frame, machine: &Plan) -> Golden<'g> {
        Golden::Drawing(golden_drawing(frame, machine))
    }

    /// Some lines of it.
    fn lines(&self, lines: Range<u32>, machine: &Plan) -> Cow<'g, Raster> {
        match self {
            Golden::Whole(raster) => Cow::Borrowed(raster),
            Golden::Drawing(drawing) => Cow::Owned(from_golden(drawing.lines(lines), machine)),
        }
    }
}

/// Compares the picture of `frame`, which has triangles only, with golden's of the same frame and screen. `draw` gives the machine's picture
/// from the top in bands of so many lines; `see` is shown each beside golden's. The comparison is without the errors of every pixel.
///
/// # Errors
/// Those of `draw` and `see`; a picture without lines.
pub fn beside(
    machine: &Plan,
    frame: &Frame,
    golden: &Golden,
    proved: Proved,
    draw: impl FnOnce(u32, &mut dyn FnMut(Raster) -> Result<()>) -> Result<()>,
    mut see: impl FnMut(&Beside) -> Result<()>,
) -> Result<Comparison> {
    if !Bands::suit(frame) {
        let mut found = None;
        draw(machine.height, &mut |drawn| {
            let golden = golden.lines(0..machine.height, machine);
            let c = compare_shaded(machine, frame, &golden, &drawn, proved.reach, proved.shading);
            let [z_error, color_error] = [&c.errors.z.map, &c.errors.color.map];
            see(&Beside { golden: &golden, drawn: &drawn, z_error, color_error })?;
            found = Some(c.without_maps());
            Ok(())
        })?;
        return found.context(NO_LINES);
    }
    let (mut bands, mut top) = (None, 0);
    let lines = match golden {
        Golden::Whole(_) => machine.height,
        Golden::Drawing(_) => (BAND / machine.width).max(1),
    };
    draw(lines, &mut |drawn| {
        let cycles = drawn.cycles.as_ref();
        let bands: &mut Bands = bands.get_or_insert_with(|| Bands::new(machine, frame, cycles, proved.reach));
        let golden = golden.lines(top..top + drawn.height, machine);
        top += drawn.height;
        let [z_error, color_error] = bands.add(&golden, &drawn);
        see(&Beside { golden: &golden, drawn: &drawn, z_error: &z_error, color_error: &color_error })
    })?;
    bands.map(Bands::found).context(NO_LINES)
}

/// A picture that a report is to be made of.
pub struct Subject<'s> {
    /// The input.
    pub name: &'s str,
    /// The machine that draws it.
    pub machine: &'s Plan,
    /// Triangles only.
    pub frame: &'s Frame,
    /// Golden's picture.
    pub golden: &'s Golden<'s>,
    /// What is proved of the triangles.
    pub proved: Proved<'s>,
    /// The memory.
    pub waits: Waits,
}

impl Subject<'_> {
    /// What the picture tells, and its comparison with golden's; `draw` and `see` are those of [`beside`].
    ///
    /// # Errors
    /// As [`beside`].
    pub fn report(
        &self,
        draw: impl FnOnce(u32, &mut dyn FnMut(Raster) -> Result<()>) -> Result<()>,
        mut see: impl FnMut(&Beside) -> Result<()>,
    ) -> Result<Report> {
        let Subject { name, machine, frame, golden, proved, waits } = *self;
        let (triangles, mut report) = (frame.triangles.len() as u64, None::<Report>);
        let comparison = beside(machine, frame, golden, proved, draw, |lines| {
            match &mut report {
                Some(report) => report.add(lines.drawn),
                None => {
                    let mut first = Report::new(name, triangles, machine, lines.drawn, waits);
                    first.drawn.lines = frame.lines.len() as u64;
                    report = Some(first);
                }
            }
            see(lines)
        })?;
        Ok(Report { comparison: Some(comparison), ..report.context(NO_LINES)? })
    }
}
