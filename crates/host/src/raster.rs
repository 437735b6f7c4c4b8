//! One picture, whoever drew it, in the units of the golden one.

use crate::extra::{self, Values};
use edgewalk_machine::{Fill, Plan};
use edgewalk_model::fast::Path;
use edgewalk_model::{Activity, Counters, Events};
use edgewalk_scene::Host;

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
    /// Scan lines drew: a pixel is written once, however often a depth buffer writes it.
    pub written_once: bool,
    /// Triangle or polygon last written, by its place in the list, -1 none.
    pub id: Vec<i32>,
    /// Depth in 0 to 1.
    pub z: Vec<f64>,
    /// Colour in 0 to 1.
    pub rgb: Vec<[f64; 3]>,
    /// Channels of the user's own.
    pub extra: Vec<Values>,
    /// 0 nothing written, 1 in shadow, 2 lit, by the last write; where golden or a machine with SHADOW drew.
    pub lit: Option<Vec<u8>>,
    /// What was done to the triangles before they were drawn.
    pub host: Host,
    /// Where the cycles went, where a machine drew.
    pub cycles: Option<Cycles>,
    /// Like `cycles`, by pass, where there is more than one.
    pub passes: Vec<Cycles>,
    /// The lights' own passes, before.
    pub lights: Vec<LightPass>,
    /// Hazards and corners met, where a machine drew.
    pub corners: Option<Events>,
}

/// A light's own pass.
#[derive(Clone, Debug)]
pub struct LightPass {
    /// Where its cycles went.
    pub cycles: Cycles,
    /// The words of its map, by address.
    pub words: Vec<u32>,
}

/// Cycles by cause, the codes of the `activity` port.
#[derive(Clone, Debug)]
pub struct Cycles {
    /// All cycles, counted apart from their causes.
    pub total: u64,
    /// How the fast engine came to them.
    pub path: Option<Path>,
    /// What the units held, where a model counted it.
    pub held: Option<Held>,
    /// The causes, and what passed at the memories' ports; the other counters may be 0.
    pub counters: Counters,
}

/// What the units held, summed over the cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Held {
    /// Clocks of SETUP's lanes for edges and for channels.
    pub setup: [u64; 2],
    /// Spans in the FIFO.
    pub spans: u64,
    /// Fragments between read and compare.
    pub fragments: u64,
}

impl Cycles {
    /// As a model counted them.
    #[must_use]
    pub fn of(counters: &Counters, path: Option<Path>) -> Self {
        let Counters { setup_clocks, queued_spans, inflight, .. } = *counters;
        let held = Held { setup: setup_clocks, spans: queued_spans, fragments: inflight };
        Cycles { total: counters.cycles, path, held: Some(held), counters: counters.clone() }
    }

    /// The cycles of two runs, one after the other.
    #[must_use]
    pub fn and(mut self, other: Cycles) -> Self {
        self.total += other.total;
        self.counters = self.counters.and(&other.counters);
        self.held = None;
        self
    }

    /// How many cycles have no cause, or more than one.
    #[must_use]
    pub fn unexplained(&self) -> u64 {
        self.total.abs_diff(self.counters.activity.iter().sum())
    }

    /// Cycles spent on this.
    #[must_use]
    pub fn spent(&self, activity: Activity) -> u64 {
        self.counters.spent(activity)
    }
}

/// A frame of the fast engine; the corners are counted only where it ticked.
#[must_use]
pub fn from_fast(machine: &Plan, drawn: edgewalk_model::Frame, path: Path) -> Raster {
    let cycles = Some(Cycles::of(&drawn.counters, Some(path)));
    let raster = if path == Path::Fast { from_machine(machine, drawn) } else { from_model(machine, drawn) };
    Raster { cycles, ..raster }
}

/// A frame of the model, which counts the corners that it meets.
#[must_use]
pub fn from_model(machine: &Plan, drawn: edgewalk_model::Frame) -> Raster {
    let (cycles, corners) = (Some(Cycles::of(&drawn.counters, None)), Some(drawn.events.clone()));
    Raster { cycles, corners, ..from_machine(machine, drawn) }
}

/// The machine's rule for pixels, as the golden picture knows it.
#[must_use]
pub fn golden_fill(machine: &Plan) -> edgewalk_golden::Fill {
    match machine.fill {
        Fill::Exact => edgewalk_golden::Fill::Exact { subpixel_bits: machine.subpixel_bits },
        Fill::Textbook => edgewalk_golden::Fill::Textbook,
    }
}

/// Golden's drawing of a frame by the rules of this machine, with its screen door.
#[must_use]
pub fn golden_drawing<'a>(frame: &'a edgewalk_scene::Frame, machine: &Plan) -> edgewalk_golden::Drawing<'a> {
    golden_drawing_by(frame, machine, golden_fill(machine))
}

/// Likewise, by another rule of coverage.
#[must_use]
pub fn golden_drawing_by<'a>(
    frame: &'a edgewalk_scene::Frame,
    machine: &Plan,
    fill: edgewalk_golden::Fill,
) -> edgewalk_golden::Drawing<'a> {
    let drawing = edgewalk_golden::Drawing::new(frame, fill);
    if machine.dither.drops() { drawing.with_screen_door(machine.blend.kt_bits) } else { drawing }
}

/// A golden picture, on the screen of this machine and with its channels.
#[must_use]
pub fn from_golden(picture: edgewalk_golden::Picture, machine: &Plan) -> Raster {
    let extra = extra::channels(machine).iter().zip(picture.extra);
    Raster {
        width: picture.width,
        height: picture.height,
        coverage: picture.coverage,
        writes: picture.writes,
        written_once: false,
        id: picture.id,
        z: picture.z,
        rgb: picture.rgb,
        extra: extra.map(|(channel, values)| Values::exact(channel, values)).collect(),
        lit: Some(picture.lit.into_iter().map(|lit| lit as u8).collect()),
        host: Host::default(),
        cycles: None,
        passes: Vec::new(),
        lights: Vec::new(),
        corners: None,
    }
}

/// Without the corners and what the units hold, which only the model sees.
#[must_use]
pub fn from_machine(machine: &Plan, drawn: edgewalk_model::Frame) -> Raster {
    Raster {
        width: machine.width,
        height: drawn.coverage.len() as u32 / machine.width,
        coverage: drawn.coverage,
        writes: drawn.writes,
        written_once: false,
        id: drawn.id,
        z: unorm(&drawn.z, machine.z.max()),
        rgb: drawn.rgb.iter().map(|c| c.map(|v| v as f64 / machine.stored_color().max() as f64)).collect(),
        extra: drawn.extra.into_iter().map(Values::Stored).collect(),
        lit: (!drawn.lit.is_empty()).then_some(drawn.lit),
        host: Host::default(),
        cycles: Some(Cycles { held: None, ..Cycles::of(&drawn.counters, None) }),
        passes: match &drawn.passes[..] {
            [] | [_] => Vec::new(),
            passes => passes.iter().map(|pass| Cycles::of(pass, None)).collect(),
        },
        lights: Vec::new(),
        corners: None,
    }
}

fn unorm(stored: &[u64], max: u64) -> Vec<f64> {
    stored.iter().map(|v| *v as f64 / max as f64).collect()
}
