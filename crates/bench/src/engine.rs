//! The engines that take part. A new one is a file with a `time`, and a line in each list here.

#[cfg(feature = "jit")]
use super::jit;
use super::job::{Job, Times};
use super::{fast, interpreter, tick, verilator};
use anyhow::Result;
use edgewalk_model::Waits;
use std::path::Path;

/// Who draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// The model without ticking
    Fast,
    /// The model, cycle by cycle
    Tick,
    /// The netlist as native code
    #[cfg(feature = "jit")]
    Jit,
    /// The netlist in the interpreter
    Interpreter,
    /// The emitted Verilog under Verilator
    Verilator,
}

impl Engine {
    /// In the order of the table, the fastest first.
    pub const ALL: &[Engine] = &[
        Engine::Fast,
        Engine::Tick,
        #[cfg(feature = "jit")]
        Engine::Jit,
        Engine::Interpreter,
        Engine::Verilator,
    ];

    /// As on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Fast => "fast",
            Engine::Tick => "tick",
            #[cfg(feature = "jit")]
            Engine::Jit => "jit",
            Engine::Interpreter => "interpreter",
            Engine::Verilator => "verilator",
        }
    }

    /// Cycles of a frame that take about a second, at most.
    pub fn budget(self) -> u64 {
        match self {
            Engine::Fast => u64::MAX,
            Engine::Tick => 20_000_000,
            #[cfg(feature = "jit")]
            Engine::Jit => 10_000_000,
            Engine::Interpreter => 100_000,
            Engine::Verilator => 2_000_000,
        }
    }

    /// Times the engine, which may write into `folder`, or says why it cannot take part.
    pub fn time(self, job: &Job, folder: &Path) -> Result<Result<Times, String>> {
        if job.waits != Waits::Never && self != Engine::Tick {
            return Ok(Err("its memory never makes the machine wait".to_owned()));
        }
        match self {
            Engine::Fast => fast::time(job),
            Engine::Tick => tick::time(job).map(Ok),
            #[cfg(feature = "jit")]
            Engine::Jit => jit::time(job).map(Ok),
            Engine::Interpreter => interpreter::time(job).map(Ok),
            Engine::Verilator => verilator::time(job, folder),
        }
    }
}
