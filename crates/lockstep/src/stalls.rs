//! When the bench makes the design wait: for every channel a pattern that repeats, the same in Rust and in Verilog.

use crate::ports::Interface;
use sha2::{Digest, Sha256};

/// Bit `n mod length` says whether the bench is willing in cycle n: to offer a new token, or to take one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern(Vec<bool>);

impl Pattern {
    /// Willing in every cycle.
    #[must_use]
    pub fn always() -> Pattern {
        Pattern(vec![true])
    }

    /// Whether the bench is willing in the cycle.
    #[must_use]
    pub fn at(&self, cycle: u64) -> bool {
        self.0[(cycle % self.0.len() as u64) as usize]
    }

    /// The bits, that of cycle 0 first.
    #[must_use]
    pub fn bits(&self) -> &[bool] {
        &self.0
    }
}

/// How a bench behaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum StallKind {
    /// Never makes the design wait.
    #[default]
    None,
    /// Every channel waits in about a third of the cycles.
    Mixed,
    /// Depths come in bursts with long waits between, writes are taken in bursts: pixels of many triangles pile up.
    Late,
}

impl StallKind {
    /// All, the gentlest first.
    pub const ALL: [StallKind; 3] = [StallKind::None, StallKind::Mixed, StallKind::Late];

    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["none", "mixed", "late"][self as usize]
    }
}

/// Lengths of the patterns, different primes, so that the patterns of a bench together repeat only after very long.
const LENGTHS: [usize; 6] = [61, 67, 53, 71, 59, 73];
/// The same for the long waits of [`StallKind::Late`].
const LATE_LENGTHS: [usize; 6] = [61, 397, 53, 421, 59, 73];

/// A pattern for every channel and level of an interface, in their order.
#[must_use]
pub fn patterns(interface: &Interface, kind: StallKind, seed: u64) -> Vec<Pattern> {
    let names =
        interface.channels.iter().map(|c| c.name).chain(interface.levels.iter().map(|f| f.port.as_str()));
    let late = |name: &str| ["data", "wr"].contains(&name);
    names
        .enumerate()
        .map(|(i, name)| match kind {
            StallKind::None => Pattern::always(),
            StallKind::Late if late(name) => {
                let length = LATE_LENGTHS[i % LATE_LENGTHS.len()];
                // Nothing in the first three quarters, then most cycles.
                let draws = draws(seed, name, length);
                Pattern((0..length).map(|n| n * 4 >= length * 3 && draws[n] >= 32).collect())
            }
            StallKind::Late => Pattern::always(),
            StallKind::Mixed => {
                let length = LENGTHS[i % LENGTHS.len()];
                Pattern(draws(seed, name, length).into_iter().map(|d| d % 3 != 0).collect())
            }
        })
        .collect()
}

/// Random bytes that depend only on seed and channel.
fn draws(seed: u64, channel: &str, length: usize) -> Vec<u8> {
    (0u64..).flat_map(|block| Sha256::digest(format!("{seed}/{channel}/{block}"))).take(length).collect()
}
