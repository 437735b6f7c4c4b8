//! The engines that take part. A new one is a file with a `time`, and a line in each list here.

#[cfg(feature = "jit")]
use super::jit;
use super::job::{Job, Times};
use super::{fast, interpreter, tick, verilator};
use anyhow::{Result, anyhow};
use edgewalk_model::Waits;
use std::path::Path;

/// An engine: what draws the triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// The model without ticking
    Fast,
    /// The model, cycle by cycle
    Tick,
    /// The netlist as native code; needs edgewalk built with the feature jit
    Jit,
    /// The netlist in the interpreter
    Interpreter,
    /// The emitted Verilog under Verilator
    Verilator,
}

impl Engine {
    /// The engines of this build, in the order of the table, the fastest first.
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
            Engine::Jit => 10_000_000,
            Engine::Interpreter => 100_000,
            Engine::Verilator => 2_000_000,
        }
    }

    /// What is said of an engine that is not in [`Engine::ALL`].
    pub fn not_built(self) -> anyhow::Error {
        anyhow!(
            "--engine {0}: this edgewalk was built without the feature {0}; build one that has it with \
             `cargo build --release --features {0}`, or time --engine interpreter",
            self.name()
        )
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
            #[cfg(not(feature = "jit"))]
            Engine::Jit => Err(Engine::Jit.not_built()),
            Engine::Interpreter => interpreter::time(job).map(Ok),
            Engine::Verilator => verilator::time(job, folder).map(Ok),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_built_says_how_to_build_it() {
        let told = Engine::Jit.not_built().to_string();
        assert!(
            told.starts_with("--engine jit: this edgewalk was built without the feature jit; "),
            "{told}"
        );
        assert!(told.contains("`cargo build --release --features jit`"), "{told}");
        assert_eq!(Engine::ALL.contains(&Engine::Jit), cfg!(feature = "jit"));
    }
}
