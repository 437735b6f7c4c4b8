//! One picture, whichever engine drew it.

use crate::extra::{self, Values};
use crate::fast;
use crate::input::to_port;
use crate::progress::bar;
use anyhow::{Result, anyhow};
use edgewalk_golden::Drawing;
use edgewalk_lockstep::StallKind;
use edgewalk_machine::{Fill, Plan};
use edgewalk_model::fast::Path;
use edgewalk_model::{Activity, Counters, Events, Stalls, render_passes};
use edgewalk_scene::Frame;
use std::ops::Range;

/// Who draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// Exact coverage by integers, depth and colour in f64
    Golden,
    /// The machine's pictures and cycles without ticking; ticks where that is not exact, and says so
    Fast,
    /// The machine, cycle by cycle, with counts of hazards and corners
    Model,
    /// The machine's netlist in the interpreter
    Rtl,
}

/// A picture: row 0 on top, `[y][x]`.
#[derive(Clone)]
pub struct Raster {
    /// Columns.
    pub width: u32,
    /// Lines.
    pub height: u32,
    /// Triangles and polygons over the pixel, depth test off.
    pub coverage: Vec<u32>,
    /// Writes to the pixel.
    pub writes: Vec<u32>,
    /// Triangle or polygon last written, by its place in the list, -1 none.
    pub id: Vec<i32>,
    /// Depth in 0 to 1.
    pub z: Vec<f64>,
    /// Colour in 0 to 1.
    pub rgb: Vec<[f64; 3]>,
    /// Channels of the user's own.
    pub extra: Vec<Values>,
    /// 0 nothing written, 1 in shadow, 2 lit, by the last write; where golden drew.
    pub lit: Option<Vec<u8>>,
    /// Where the cycles went, where a machine drew.
    pub cycles: Option<Cycles>,
    /// The same by pass, where there is more than one.
    pub passes: Vec<Cycles>,
    /// Hazards and corners met, where a machine drew.
    pub corners: Option<Events>,
}

/// Cycles by cause, the codes of the `activity` port.
#[derive(Clone, Copy, Debug)]
pub struct Cycles {
    /// All cycles, counted apart from their causes.
    pub total: u64,
    /// How the fast engine came to them.
    pub path: Option<Path>,
    spent: [u64; Activity::ALL.len()],
}

impl Cycles {
    /// As the machine counted them.
    fn of(counters: &Counters) -> Self {
        Cycles { total: counters.cycles, path: None, spent: counters.activity }
    }

    /// How many cycles have no cause, or more than one.
    pub fn unexplained(&self) -> u64 {
        self.total.abs_diff(self.spent.iter().sum())
    }

    /// Cycles spent on this.
    pub fn spent(&self, activity: Activity) -> u64 {
        self.spent[activity as usize]
    }
}

/// Draws the frame.
pub fn draw(engine: Engine, frame: &Frame, machine: &Plan, quiet: bool) -> Result<Raster> {
    match engine {
        Engine::Golden => Ok(from_golden(edgewalk_golden::draw(frame, golden_fill(machine)), machine)),
        Engine::Fast => {
            let port = to_port(frame, machine)?;
            let drawn = fast::draw_frame(machine, &port)?;
            Ok(of_primitives(drawn.raster(machine), &port.ids))
        }
        Engine::Model | Engine::Rtl => {
            let port = to_port(frame, machine)?;
            let bar = bar(port.triangles.len() as u64, "triangles", quiet);
            let triangles = bar.wrap_iter(port.triangles.iter().copied());
            let raster = if engine == Engine::Model {
                from_model(machine, render_passes(machine, triangles, &port.passes, Stalls::NONE, |_| {})?)
            } else {
                let drawn = edgewalk_lockstep::render_rtl(machine, triangles, port.state()?, StallKind::None);
                from_machine(machine, drawn.map_err(|e| anyhow!("{e}"))?)
            };
            bar.finish_and_clear();
            Ok(of_primitives(raster, &port.ids))
        }
    }
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
            let drawing = Drawing::new(frame, golden_fill(machine));
            let mut bands = bands(frame.width, frame.height, GOLDEN_BAND);
            bands.try_for_each(|lines| take(from_golden(drawing.lines(lines), machine)))
        }
        Engine::Fast => {
            let port = to_port(frame, machine)?;
            let drawn = fast::draw_frame(machine, &port)?;
            drawn.bands(machine, fast_bands(machine), |band| take(of_primitives(band, &port.ids)))
        }
        Engine::Model | Engine::Rtl => take(draw(engine, frame, machine, quiet)?),
    }
}

/// Pixels of a band: golden goes through all triangles for each, so a few large ones.
const GOLDEN_BAND: u32 = 1 << 22;
const FAST_BAND: u32 = 1 << 18;

/// The bands in which what the fast engine drew is taken from it.
pub fn fast_bands(machine: &Plan) -> impl Iterator<Item = Range<u32>> + use<> {
    bands(machine.width, machine.height, FAST_BAND)
}

/// Bands of whole lines, about so many pixels each.
fn bands(width: u32, height: u32, pixels: u32) -> impl Iterator<Item = Range<u32>> + use<> {
    let lines = (pixels / width).max(1);
    (0..height).step_by(lines as usize).map(move |top| top..height.min(top + lines))
}

/// The ids of the frame's triangles and polygons for those of the triangles the machine drew.
fn of_primitives(mut raster: Raster, ids: &[i32]) -> Raster {
    for id in &mut raster.id {
        // Where nothing was drawn the id is negative.
        *id = usize::try_from(*id).map_or(*id, |triangle| ids[triangle]);
    }
    raster
}

/// A frame of the fast engine; the corners are counted only where it ticked.
pub fn from_fast(machine: &Plan, drawn: edgewalk_model::Frame, path: Path) -> Raster {
    let raster = if path == Path::Fast { from_machine(machine, drawn) } else { from_model(machine, drawn) };
    Raster { cycles: raster.cycles.map(|cycles| Cycles { path: Some(path), ..cycles }), ..raster }
}

fn from_model(machine: &Plan, drawn: edgewalk_model::Frame) -> Raster {
    Raster { corners: Some(drawn.events.clone()), ..from_machine(machine, drawn) }
}

/// The machine's rule for pixels, as the golden picture knows it.
pub fn golden_fill(machine: &Plan) -> edgewalk_golden::Fill {
    match machine.fill {
        Fill::Exact => edgewalk_golden::Fill::Exact { subpixel_bits: machine.subpixel_bits },
        Fill::Textbook => edgewalk_golden::Fill::Textbook,
    }
}

/// A golden picture, on the screen of this machine and with its channels.
pub fn from_golden(picture: edgewalk_golden::Picture, machine: &Plan) -> Raster {
    let extra = extra::channels(machine).iter().zip(picture.extra);
    Raster {
        width: picture.width,
        height: picture.height,
        coverage: picture.coverage,
        writes: picture.writes,
        id: picture.id,
        z: picture.z,
        rgb: picture.rgb,
        extra: extra.map(|(channel, values)| Values::exact(channel, values)).collect(),
        lit: Some(picture.lit.into_iter().map(|lit| lit as u8).collect()),
        cycles: None,
        passes: Vec::new(),
        corners: None,
    }
}

/// Without the corners, which only the model sees.
fn from_machine(machine: &Plan, drawn: edgewalk_model::Frame) -> Raster {
    Raster {
        width: machine.width,
        height: drawn.coverage.len() as u32 / machine.width,
        coverage: drawn.coverage,
        writes: drawn.writes,
        id: drawn.id,
        z: unorm(&drawn.z, machine.z.max()),
        rgb: drawn.rgb.iter().map(|c| c.map(|v| v as f64 / machine.color.max() as f64)).collect(),
        extra: drawn.extra.into_iter().map(Values::Stored).collect(),
        lit: None,
        cycles: Some(Cycles::of(&drawn.counters)),
        passes: if drawn.passes.len() > 1 {
            drawn.passes.iter().map(Cycles::of).collect()
        } else {
            Vec::new()
        },
        corners: None,
    }
}

fn unorm(stored: &[u64], max: u64) -> Vec<f64> {
    stored.iter().map(|v| *v as f64 / max as f64).collect()
}
