//! A point of a sweep, and what its row depends on.

use edgewalk_host::input::hex;
use edgewalk_machine::{Machine, Plan};
use sha2::{Digest, Sha256};

/// A machine, a memory, an input.
pub struct Point {
    /// Sixteen hex digits that stand for all that its row depends on.
    pub key: String,
    /// The machine's number.
    pub number: usize,
    /// The memory's place.
    pub memory: usize,
    /// The input's place.
    pub input: usize,
    /// The place of the way in which the input is shaded.
    pub way: usize,
    /// The machine's keys.
    pub machine: Machine,
    /// The machine, or why it cannot be built.
    pub plan: Result<Plan, String>,
}

/// What a row depends on.
pub struct Identity {
    /// Hash of the machine's keys.
    pub machine: String,
    /// Name of the input: the row tells it.
    pub input: String,
    /// Hash of the input.
    pub input_hash: String,
    /// The memory's behaviour.
    pub stalls: String,
    /// Of the program.
    pub version: String,
    /// How it was synthesised.
    pub synth: String,
    /// The bound asked for.
    pub bound: String,
    /// What the machine must keep; empty if nothing.
    pub require: String,
}

impl Identity {
    /// Each part with its name.
    #[must_use]
    pub fn parts(&self) -> [(&'static str, &str); 8] {
        [
            ("machine", &self.machine),
            ("input", &self.input),
            ("input_hash", &self.input_hash),
            ("stalls", &self.stalls),
            ("version", &self.version),
            ("synth", &self.synth),
            ("bound", &self.bound),
            ("require", &self.require),
        ]
    }

    /// Sixteen hex digits.
    #[must_use]
    pub fn key(&self) -> String {
        let mut digest = Sha256::new();
        // Rows from before there were requirements keep their keys.
        for (name, part) in
            self.parts().into_iter().filter(|(name, part)| *name != "require" || !part.is_empty())
        {
            digest.update(format!("{name}={part}\n"));
        }
        hex(&digest.finalize()[..8])
    }
}
