//! Runs the model and takes it down.

use crate::recording::{Recorder, Recording};
use edgewalk_machine::{ForeignVertex, Plan, PortVertex};
use edgewalk_model::{Cycle, DrawState, Pass, Rig, Shading, Waits, for_channels};
use std::collections::VecDeque;

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
    /// With SHADOW the words of the lights' maps.
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
    #[error("the depth memory is cleared before cycle {cycle}, which a page cannot show; end there with --to {} or begin there with --from {cycle}", .cycle - 1)]
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
/// A triangle for another machine; a window that is empty, or longer than [`LIMIT`]; a machine with SHADE.
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
    for_channels!(plan, C => run::<C>(plan, triangles, rules, waits, window))
}

fn run<const C: usize>(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    rules: &Rules,
    waits: Waits,
    window: Window,
) -> Result<Recording, RecordError> {
    let mut total = 0;
    let mut cleared = Vec::new();
    let mut dry = Run::<C>::new(plan, triangles, rules, waits);
    while !dry.ended {
        if dry.cycle() {
            cleared.push(total + 1);
        }
        total += 1;
    }
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
    let mut run = Run::<C>::new(plan, triangles, rules, waits);
    for _ in 0..window.from {
        _ = run.cycle();
    }
    let before = planes(plan, &run.rig);
    let mut recorder = Recorder::new();
    for _ in 0..asked {
        recorder.cycle(|view| run.rig.model.view(plan, &run.rig.inputs(run.offered(), true), view));
        _ = run.cycle();
    }
    Ok(recorder.finish(window.from, before))
}

/// What memory holds, by field of the tokens that are stored and by pixel, row by row. Of the light's answer, which goes
/// with a write and into no memory here, nothing is known.
fn planes<const C: usize>(plan: &Plan, rig: &Rig<C>) -> Vec<Vec<u32>> {
    let x_bits = plan.widths().x;
    let addresses = || (0..plan.height).flat_map(move |y| (0..plan.width).map(move |x| y << x_bits | x));
    let plane = |place: usize| addresses().map(|addr| rig.memories.pixel(addr)[place]).collect();
    let lit = plan.shadow.is_there().then(|| addresses().map(|_| 0).collect());
    plan.seen_channels().map(|(place, _)| plane(place)).chain(lit).collect()
}

/// Triangles that are offered one after the other; the machine is idle before and behind them.
struct Part {
    triangles: usize,
    /// Of a pass that begins with it.
    begins: Option<Pass>,
}

/// The passes, each in as many parts as its records need.
fn parts(plan: &Plan, mut triangles: usize, passes: &[Pass]) -> VecDeque<Part> {
    let at_once = if plan.shade.is_there() { 1 << plan.shade.record_bits } else { usize::MAX };
    let mut parts = VecDeque::new();
    for pass in passes {
        let (mut left, mut begins) = (pass.triangles.min(triangles), Some(*pass));
        while left > 0 || begins.is_some() {
            let part = left.min(at_once);
            parts.push_back(Part { triangles: part, begins: begins.take() });
            (left, triangles) = (left - part, triangles - part);
        }
    }
    parts
}

/// A machine that draws triangles, one cycle at a time.
struct Run<'a, const C: usize> {
    plan: &'a Plan,
    rules: &'a Rules<'a>,
    rig: Rig<C>,
    triangles: &'a [[PortVertex; 3]],
    /// How many were taken.
    taken: usize,
    /// How many of the part are left.
    left: usize,
    /// Behind the part that is drawn.
    parts: VecDeque<Part>,
    ended: bool,
}

impl<'a, const C: usize> Run<'a, C> {
    fn new(plan: &'a Plan, triangles: &'a [[PortVertex; 3]], rules: &'a Rules, waits: Waits) -> Self {
        let state = rules.passes.first().map_or_else(DrawState::default, |pass| pass.state);
        let mut rig = Rig::new(plan, state, waits);
        rig.memories.write_shading(plan, rules.shading);
        let parts = parts(plan, triangles.len(), rules.passes);
        let mut run = Run { plan, rules, rig, triangles, taken: 0, left: 0, parts, ended: false };
        run.next();
        run
    }

    /// The next part, if there is one; whether all depths were cleared.
    fn next(&mut self) -> bool {
        let Some(part) = self.parts.pop_front() else {
            self.ended = true;
            return false;
        };
        self.left = part.triangles;
        for (number, record) in
            self.rules.shading.records.iter().enumerate().skip(self.taken).take(part.triangles)
        {
            self.rig.memories.write_record(self.plan, number, record);
        }
        let Some(pass) = part.begins else { return false };
        self.rig.memories.set_state(pass.state);
        if pass.clear_depth {
            self.rig.memories.clear_depth(self.plan);
        }
        if let Some(map) = pass.map.and_then(|map| self.rules.maps.get(map)) {
            self.rig.memories.write("map", 0, map.iter().map(|word| u128::from(*word)));
        }
        pass.clear_depth
    }

    fn offered(&self) -> Option<(&'a [PortVertex; 3], u32)> {
        self.triangles[self.taken..].first().filter(|_| self.left > 0).map(|triangle| (triangle, 0))
    }

    /// Whether all depths were cleared behind it.
    fn cycle(&mut self) -> bool {
        let cycle: Cycle<C> = self.rig.cycle(self.offered(), true);
        if cycle.triangle {
            (self.taken, self.left) = (self.taken + 1, self.left - 1);
        } else if cycle.outputs.idle && self.left == 0 {
            return self.next();
        }
        false
    }
}
