//! What every engine is given, and what it gives back.

use super::stopwatch::{Stopwatch, Time};
use anyhow::{Result, anyhow};
use edgewalk_lockstep::{Interface, Setting, Unit};
use edgewalk_machine::{Counted, Plan, PortVertex, wholes};
use edgewalk_model::fast::Renderer;
use edgewalk_model::{Counters, DrawState, Pass, Shading, Waits, render_passes};
use serde::Serialize;

/// What the machine does for a frame, whoever says so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Work {
    /// Clocks of the machine.
    pub cycles: u64,
    /// Writes to the frame memory.
    pub writes: u64,
}

impl Work {
    /// As counted.
    pub fn of(counters: &Counters) -> Self {
        Work { cycles: counters.cycles, writes: counters.writes }
    }
}

/// Triangles to draw a number of times.
pub struct Job<'a> {
    /// On this machine.
    pub machine: &'a Plan,
    /// Triangles, lines and parts of polygons in this order, each a token.
    pub triangles: &'a [[PortVertex; 3]],
    /// What the memories hold that nobody writes; a record for each triangle.
    pub shading: &'a Shading,
    /// In this state.
    pub state: DrawState,
    /// How the memory makes the machine wait.
    pub waits: Waits,
    /// Frames that are timed.
    pub repeat: u32,
    /// Pixels inside the triangles.
    pub fragments: u64,
    /// What must come of it.
    pub work: Work,
}

/// What an engine needed.
pub struct Times {
    /// Milliseconds on the wall from the changed parameter to the end of the first frame: building included.
    pub first: f64,
    /// Of each frame that is timed.
    pub frames: Vec<Time>,
    /// Of the first frame that differs from the machine's, or of all.
    pub work: Work,
}

impl<'a> Job<'a> {
    /// The values of the machine's constants, in the order of its ports.
    pub fn constants(&self) -> Result<Vec<u128>> {
        let interface = Interface::new(self.machine, Unit::MACHINE);
        Ok(Setting::willing(&interface, &self.state.constants())?.constants)
    }

    /// A job with what must come of it, which is worked out here.
    pub fn new(
        machine: &'a Plan,
        triangles: &'a [[PortVertex; 3]],
        shading: &'a Shading,
        (state, waits): (DrawState, Waits),
        repeat: u32,
    ) -> Result<Self> {
        let records = 1usize << machine.shade.record_bits;
        if machine.shade.is_there() && triangles.len() > records {
            return Err(anyhow!(
                "{} triangles with a record each, and the memory of the terms, which is filled once a frame, has {records}; add --set \
                 term.record_bits={} (at most 20)",
                triangles.len(),
                triangles.len().next_power_of_two().ilog2()
            ));
        }
        let mut renderer = Renderer::new(machine, false);
        let drawn = waits == Waits::Never && renderer.draw(triangles.iter().copied(), state).is_ok();
        let counters = if drawn {
            renderer.counters().clone()
        } else {
            let passes = [Pass::all(state)];
            render_passes(machine, triangles.iter().copied(), &passes, &[], waits, shading)?.counters
        };
        let (fragments, work) = (counters.fragments, Work::of(&counters));
        Ok(Job { machine, triangles, shading, state, waits, repeat, fragments, work })
    }

    /// The first triangles, polygons and lines, that take about `cycles`, at least one.
    pub fn part(&self, cycles: u64) -> Result<Job<'a>> {
        let share = cycles as f64 / self.work.cycles.max(1) as f64;
        let count = (self.counted().total() as f64 * share).ceil() as usize;
        let tokens: usize = wholes(self.triangles).take(count).map(<[_]>::len).sum();
        let part = &self.triangles[..tokens];
        Job::new(self.machine, part, self.shading, (self.state, self.waits), self.repeat)
    }

    /// How many triangles, polygons and lines it draws.
    pub fn counted(&self) -> Counted {
        Counted::of(self.triangles)
    }

    /// The words of a memory from address 0 on; none of one that the machine writes.
    pub fn words(&self, memory: &str) -> Vec<u128> {
        let records = || self.shading.records.iter().take(self.triangles.len());
        match memory {
            "terms" => {
                records().flat_map(|record| self.machine.record_words(record)).map(u128::from).collect()
            }
            "tables" => self.shading.tables.clone(),
            "roots" => self.shading.roots.clone(),
            "textures" => self.shading.textures.clone(),
            _ => Vec::new(),
        }
    }

    /// Some memory has words of more than 64 bits. The drivers keep shorter ones in 64, which takes less time.
    pub fn has_wide_words(&self) -> bool {
        Interface::new(self.machine, Unit::MACHINE).memories.iter().any(|memory| memory.word_bits > 64)
    }

    /// Draws the first frame, with `start` from before the engine was built, and then those that are timed.
    pub fn time(&self, start: &Stopwatch, mut draw: impl FnMut() -> Result<Work>) -> Result<Times> {
        let mut work = draw()?;
        let first = start.read().wall;
        let mut frames = Vec::new();
        for _ in 0..self.repeat {
            let start = Stopwatch::start();
            let next = draw()?;
            frames.push(start.read());
            work = if work == self.work { next } else { work };
        }
        Ok(Times { first, frames, work })
    }
}
