//! Runs the model and takes it down.

use crate::recording::{Plane, Recorder, Recording};
use edgewalk_machine::{
    DrawState, ForeignVertex, Maps, Pass, Plan, PortVertex, Shading, Step, first_of_picture, steps,
};
use edgewalk_model::tokens::MAX_CHANNELS;
use edgewalk_model::{Cycle, Memories, Rig, Waits};

/// The most cycles that a replay holds: about 200 MB in a browser and two seconds until they can be seen.
pub const LIMIT: u64 = 200_000;

/// Which cycles are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Window {
    /// The first.
    pub from: u64,
    /// The last; `None`: that in which the machine is at rest.
    pub to: Option<u64>,
}

/// The rules by which triangles are drawn, and what the memories that nobody writes hold.
#[derive(Clone, Copy, Debug)]
pub struct Rules<'a> {
    /// Rules that change between triangles; at least one pass.
    pub passes: &'a [Pass],
    /// With SHADOW the words of the lights' maps that the host makes.
    pub maps: &'a [Vec<u32>],
    /// With TERM and SHADE records, tables, roots and textures.
    pub shading: &'a Shading,
}

/// Why there is no recording.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RecordError {
    /// A machine with TERM and SHADE, and not a record for each triangle.
    #[error(
        "{triangles} triangles and {records} records of their terms; draw with mode phong or fast-phong, or set shade.kind = none"
    )]
    Records {
        /// Triangles to be drawn.
        triangles: usize,
        /// Records there are.
        records: usize,
    },
    /// All depths change at once, which is no write.
    #[error("the depth memory or the map is cleared before cycle {cycle}, which a page cannot show; end there with --to {} or begin there with --from {cycle}", .cycle - 1)]
    Cleared {
        /// The first cycle behind it.
        cycle: u64,
    },
    /// The triangles are for another machine.
    #[error(transparent)]
    Vertex(#[from] ForeignVertex),
    /// More than a page can hold.
    #[error(
        "{asked} cycles: permitted: at most {LIMIT}; draw fewer with --triangles, or take a part of the {total} with --from and --to or --cycles"
    )]
    TooLong {
        /// Cycles wanted.
        asked: u64,
        /// Cycles of the whole run.
        total: u64,
    },
    /// The window is empty.
    #[error("--from {from}: permitted: 0 to {last}; the run has {total} cycles")]
    Outside {
        /// First cycle wanted.
        from: u64,
        /// The last there is, or that is wanted.
        last: u64,
        /// Cycles of the whole run.
        total: u64,
    },
}

/// Draws the triangles in order by the same rules, as [`edgewalk_model::render`] does, and takes down the cycles of the
/// window. The run ends with the cycle in which the machine is at rest again.
///
/// # Errors
/// A triangle for another machine; a window that is empty, or longer than [`LIMIT`]; a machine with SHADE, which needs
/// records.
pub fn record(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    state: DrawState,
    waits: impl Into<Waits>,
    window: Window,
) -> Result<Recording, RecordError> {
    let rules = Rules { passes: &[Pass::all(state)], maps: &[], shading: &Shading::default() };
    record_passes(plan, triangles, &rules, waits, window)
}

/// As [`record`], pass by pass, as [`edgewalk_model::render_passes`] draws.
///
/// # Errors
/// As those, and a number of records that is not that of the triangles.
pub fn record_passes(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    rules: &Rules,
    waits: impl Into<Waits>,
    window: Window,
) -> Result<Recording, RecordError> {
    let (records, waits) = (rules.shading.records.len(), waits.into());
    if plan.shade.is_there() && records != triangles.len() {
        return Err(RecordError::Records { triangles: triangles.len(), records });
    }
    for (triangle, number) in triangles.iter().zip(0..) {
        plan.accept(triangle, number)?;
    }
    run(plan, triangles, rules, waits, window)
}

fn run(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    rules: &Rules,
    waits: Waits,
    window: Window,
) -> Result<Recording, RecordError> {
    let (total, cleared) = dry_run(Run::new(plan, triangles, rules, waits));
    let last = window.to.unwrap_or(u64::MAX).min(total - 1);
    if window.from > last {
        return Err(RecordError::Outside { from: window.from, last, total });
    }
    let asked = last - window.from + 1;
    if asked > LIMIT {
        return Err(RecordError::TooLong { asked, total });
    }
    if let Some(cycle) = cleared.into_iter().find(|cycle| (window.from + 1..=last).contains(cycle)) {
        return Err(RecordError::Cleared { cycle });
    }
    let mut run = Run::new(plan, triangles, rules, waits);
    for _ in 0..window.from {
        _ = run.cycle();
    }
    let before = memory(plan, &run.rig.memories);
    let mut recorder = Recorder::new();
    for _ in 0..asked {
        recorder.cycle(|view| run.rig.model.view(plan, &run.rig.inputs(run.offered(), true), view));
        _ = run.cycle();
    }
    Ok(recorder.finish(window.from, before))
}

/// How many cycles a run takes, and the first cycle behind each clearing of a memory.
fn dry_run(mut run: Run<'_>) -> (u64, Vec<u64>) {
    let (mut total, mut cleared) = (0, Vec::new());
    while !run.ended {
        if run.cycle() {
            cleared.push(total + 1);
        }
        total += 1;
    }
    (total, cleared)
}

/// What memory holds, by field of the tokens that are stored and by pixel, row by row; then, in a machine that draws its
/// map, the words of the map. Of the light's answer, which goes with a write and into no memory here, nothing is known.
fn memory(plan: &Plan, memories: &Memories<MAX_CHANNELS>) -> Vec<Plane> {
    let plane = |of_map: bool, [width, height]: [u32; 2], x_bits: u32, place: usize, bits: u32| {
        let addresses = (0..height).flat_map(|y| (0..width).map(move |x| y << x_bits | x));
        Plane::new(bits, addresses.map(|addr| memories.stored(of_map, addr)[place]))
    };
    let (screen, x_bits) = ([plan.width, plan.height], plan.widths().x);
    let channels = plan.seen_channels();
    let mut planes: Vec<_> =
        channels.map(|(place, channel)| plane(false, screen, x_bits, place, channel.bits)).collect();
    let pixels = plan.width as usize * plan.height as usize;
    planes.extend(plan.shadow.is_there().then(|| Plane::new(1, std::iter::repeat_n(0, pixels))));
    if plan.shadow.draws_map() {
        let (size, x_bits) = ([plan.shadow.size; 2], plan.shadow.side_bits());
        planes.extend(map_channels(plan).map(|place| plane(true, size, x_bits, place, u32::BITS)));
    }
    planes
}

/// The channels that are kept in the map: depth, and where surfaces transmit, what is left of the light, which is red.
pub(crate) fn map_channels(plan: &Plan) -> std::ops::Range<usize> {
    0..if plan.shadow.transmits() { 2 } else { 1 }
}

/// A machine that draws triangles, one cycle at a time. One of most channels serves any plan.
struct Run<'a> {
    plan: &'a Plan,
    rig: Rig<MAX_CHANNELS>,
    triangles: &'a [[PortVertex; 3]],
    /// How many were taken.
    taken: usize,
    /// How many are left that may be offered now.
    left: usize,
    /// What the host does behind them.
    steps: Box<dyn Iterator<Item = Step<'a>> + 'a>,
    maps: Maps<'a>,
    ended: bool,
}

impl<'a> Run<'a> {
    fn new(plan: &'a Plan, triangles: &'a [[PortVertex; 3]], rules: &Rules<'a>, waits: Waits) -> Self {
        let mut rig = Rig::new(plan, first_of_picture(rules.passes), waits);
        rig.memories.write_shading(plan, rules.shading);
        let steps = Box::new(steps(plan, rules.passes, rules.shading));
        let maps = Maps::of_host(rules.maps);
        let mut run = Run { plan, rig, triangles, taken: 0, left: 0, steps, maps, ended: false };
        run.next();
        run
    }

    /// Goes to the next triangles, if there are any; whether a memory was cleared before them.
    fn next(&mut self) -> bool {
        let mut cleared = false;
        for step in self.steps.by_ref() {
            cleared |= matches!(step, Step::ClearDepth | Step::ClearMap);
            if let Some(count) = self.rig.memories.take_step(self.plan, step, &mut self.maps) {
                self.left = count.min(self.triangles.len() - self.taken);
                return cleared;
            }
        }
        self.ended = true;
        false
    }

    fn offered(&self) -> Option<(&'a [PortVertex; 3], u32)> {
        self.triangles[self.taken..].first().filter(|_| self.left > 0).map(|triangle| (triangle, 0))
    }

    /// Whether a memory was cleared behind it.
    fn cycle(&mut self) -> bool {
        let cycle: Cycle<MAX_CHANNELS> = self.rig.cycle(self.offered(), true);
        if cycle.outputs.triangle {
            (self.taken, self.left) = (self.taken + 1, self.left - 1);
        } else if cycle.outputs.idle && self.left == 0 {
            return self.next();
        }
        false
    }
}
