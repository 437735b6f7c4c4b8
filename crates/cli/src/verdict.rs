//! How a command ends: the exit codes every subcommand shares.

pub use edgewalk_judge::Verdict;
use edgewalk_tool::Stop;
use edgewalk_vectors::SimulateError;

/// What a tool said of a machine, where it gave figures of none.
#[derive(Debug, thiserror::Error)]
#[error("the tools gave figures of no machine; the first reason: {why}")]
pub struct NoFigures {
    pub why: String,
    /// The tool was ended at its time limit.
    pub late: bool,
}

/// 0 pass, 1 mismatch, 2 nothing compared.
pub fn exit_code(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Pass => 0,
        Verdict::Mismatch => 1,
        Verdict::Vacuous | Verdict::Open => 2,
    }
}

/// The exit code of what could not be done: 2 bad input, 3 tool missing or broken, 4 time limit.
pub fn of_error(error: &anyhow::Error) -> u8 {
    if let Some(NoFigures { late, .. }) = error.downcast_ref() {
        return if *late { 4 } else { 3 };
    }
    let of_simulator = error.downcast_ref::<SimulateError>().and_then(|error| match error {
        SimulateError::Tool(stop) => Some(stop),
        SimulateError::Read(_) | SimulateError::Design { .. } => None,
    });
    match of_simulator.or_else(|| error.downcast_ref::<Stop>()) {
        Some(Stop::TimeLimit { .. }) => 4,
        Some(Stop::File { .. }) | None => 2,
        Some(_) => 3,
    }
}
