//! Time on the processor and on the wall.

use cpu_time::ThreadTime;
use std::time::{Duration, Instant};

/// Milliseconds.
#[derive(Clone, Copy, Debug)]
pub struct Time {
    /// On the processor: other programs do not count.
    pub cpu: f64,
    /// On the wall.
    pub wall: f64,
}

/// Runs from its making.
pub struct Stopwatch {
    cpu: ThreadTime,
    wall: Instant,
}

impl Stopwatch {
    /// Starts.
    pub fn start() -> Self {
        Stopwatch { cpu: ThreadTime::now(), wall: Instant::now() }
    }

    /// Time since the start.
    pub fn read(&self) -> Time {
        Time { cpu: milliseconds(self.cpu.elapsed()), wall: milliseconds(self.wall.elapsed()) }
    }
}

/// As a number.
pub fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
