//! Runs the model and takes it down.

use crate::recording::{Recorder, Recording};
use edgewalk_machine::{ForeignVertex, Plan, PortVertex};
use edgewalk_model::{Cycle, DrawState, Rig, Shading, Stalls, for_channels};

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

/// Why there is no recording.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RecordError {
    /// A machine with SHADOW.
    #[error("a replay does not show SHADOW; set shadow.light = none")]
    Shadow,
    /// A machine with TERM and SHADE, and not a record for each triangle, or more than its memory holds.
    #[error(
        "{triangles} triangles and {records} records of their terms: permitted: as many, and at most {most}; or set shade.kind = none"
    )]
    Records {
        /// Triangles to be drawn.
        triangles: usize,
        /// Records there are.
        records: usize,
        /// Records that the memory holds.
        most: usize,
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

/// Draws the triangles in order, as [`edgewalk_model::render`] does, and takes down the cycles of the window. The run ends
/// with the cycle in which the machine is at rest again.
///
/// # Errors
/// A triangle for another machine; a window that is empty, or longer than [`LIMIT`].
pub fn record(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    state: DrawState,
    stalls: Stalls,
    window: Window,
) -> Result<Recording, RecordError> {
    record_shaded(plan, triangles, &Shading::default(), state, stalls, window)
}

/// As [`record`], on a machine with TERM and SHADE.
///
/// # Errors
/// As those, and a number of records that is not that of the triangles.
pub fn record_shaded(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    shading: &Shading,
    state: DrawState,
    stalls: Stalls,
    window: Window,
) -> Result<Recording, RecordError> {
    if plan.shadow.is_there() {
        return Err(RecordError::Shadow);
    }
    let (records, most) = (shading.records.len(), 1 << plan.shade.record_bits);
    if plan.shade.is_there() && (records != triangles.len() || records > most) {
        return Err(RecordError::Records { triangles: triangles.len(), records, most });
    }
    for (triangle, number) in triangles.iter().zip(0..) {
        plan.accept(triangle, number)?;
    }
    for_channels!(plan, C => run::<C>(plan, triangles, shading, state, stalls, window))
}

fn run<const C: usize>(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    shading: &Shading,
    state: DrawState,
    stalls: Stalls,
    window: Window,
) -> Result<Recording, RecordError> {
    let mut total = 0;
    let mut dry = Run::<C>::new(plan, triangles, shading, state, stalls);
    while !dry.ended {
        dry.cycle();
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
    let mut run = Run::<C>::new(plan, triangles, shading, state, stalls);
    for _ in 0..window.from {
        run.cycle();
    }
    let before = planes(plan, &run.rig);
    let mut recorder = Recorder::new();
    for _ in 0..asked {
        recorder.cycle(|view| run.rig.model.view(plan, &run.rig.inputs(run.offered(), true), view));
        run.cycle();
    }
    Ok(recorder.finish(window.from, before))
}

/// What memory holds, by channel and pixel, row by row.
fn planes<const C: usize>(plan: &Plan, rig: &Rig<C>) -> Vec<Vec<u32>> {
    let x_bits = plan.widths().x;
    let addresses = || (0..plan.height).flat_map(|y| (0..plan.width).map(move |x| y << x_bits | x));
    (0..plan.channels().len()).map(|i| addresses().map(|addr| rig.pixel(addr)[i]).collect()).collect()
}

/// A machine that draws triangles, one cycle at a time.
struct Run<'a, const C: usize> {
    rig: Rig<C>,
    waiting: &'a [[PortVertex; 3]],
    ended: bool,
}

impl<'a, const C: usize> Run<'a, C> {
    fn new(
        plan: &Plan,
        triangles: &'a [[PortVertex; 3]],
        shading: &Shading,
        state: DrawState,
        stalls: Stalls,
    ) -> Self {
        let mut rig = Rig::new(plan, state, stalls);
        rig.write_shading(plan, shading);
        Run { rig, waiting: triangles, ended: false }
    }

    fn offered(&self) -> Option<(&'a [PortVertex; 3], u32)> {
        self.waiting.first().map(|triangle| (triangle, 0))
    }

    fn cycle(&mut self) {
        let cycle: Cycle<C> = self.rig.cycle(self.offered(), true);
        if cycle.triangle {
            self.waiting = &self.waiting[1..];
        } else {
            self.ended = cycle.outputs.idle && self.waiting.is_empty();
        }
    }
}
