//! How a command ends: the exit codes every subcommand shares.

use edgewalk_vectors::{SimulateError, Stop};
use std::io::Write as _;
use std::process::ExitCode;

/// What a command found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All that was asked for was done, all that was compared agrees.
    Pass,
    /// Something compared differs.
    Mismatch,
    /// A check compared nothing at all.
    Vacuous,
}

/// A simulator or synthesis tool that is absent or broken.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ToolError(pub String);

impl Verdict {
    /// The verdict of a comparison: `expected` things should have been checked, `checked` were, `wrong` of them differ.
    pub fn of(checked: u64, expected: u64, wrong: u64) -> Self {
        match (checked, wrong) {
            (0, _) => Verdict::Vacuous,
            (n, 0) if n == expected => Verdict::Pass,
            _ => Verdict::Mismatch,
        }
    }

    /// The worse of two.
    pub fn and(self, other: Verdict) -> Self {
        match (self, other) {
            (Verdict::Pass, v) | (v, Verdict::Pass) => v,
            (Verdict::Mismatch, _) | (_, Verdict::Mismatch) => Verdict::Mismatch,
            _ => Verdict::Vacuous,
        }
    }

    /// 0 pass, 1 mismatch, 2 vacuous (and bad input). That nothing was compared is an error, and said even by a quiet program.
    pub fn exit_code(self) -> ExitCode {
        if self == Verdict::Vacuous {
            // Where standard error is closed the code has to do.
            _ = writeln!(std::io::stderr(), "edgewalk: nothing was compared");
        }
        ExitCode::from(match self {
            Verdict::Pass => 0,
            Verdict::Mismatch => 1,
            Verdict::Vacuous => 2,
        })
    }
}

/// The exit code of what could not be done: 2 bad input, 3 tool missing or broken, 4 time limit.
pub fn of_error(error: &anyhow::Error) -> ExitCode {
    ExitCode::from(match error.downcast_ref::<SimulateError>() {
        Some(SimulateError::Tool(Stop::TimeLimit { .. })) => 4,
        Some(SimulateError::Tool(_)) => 3,
        _ if error.is::<ToolError>() => 3,
        _ => 2,
    })
}
