//! The least fraction bits for a screen and an error target, and the triangle that breaks one bit fewer.

use crate::bounds::{range_safe_fraction_bits, triangle_error};
use crate::dyadic::Dyadic;
use crate::rounding::Rounding;
use crate::steps::{Screen, Steps};
use crate::witness::{ChannelBits, Target, Witness};

/// Most fraction bits the solver goes to.
pub const MAX_FRACTION_BITS: u32 = 40;
/// Largest width, height and number of guard columns.
pub const MAX_SIDE: u32 = 1 << 15;

/// The least fraction bits and why it is these.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Solution {
    /// r.
    pub fraction_bits: u32,
    /// Proved magnitude of the error before the output rounding with r bits, LSB (bound 2).
    pub error: Dyadic,
    /// A triangle that misses the target with r - 1 bits. `None` if r is 0, or none was found; r is then known to
    /// suffice, not known to be the least. For [`Target::InRange`] that is so at N + 1 = 2^k and 2^k + 1 only,
    /// where every single rounding would have to err by its full half.
    pub one_bit_fewer: Option<Witness>,
}

/// Why there is no solution.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SolverError {
    /// The bound of this rounding is not reached, so its least bits are not known.
    #[error("{0} is not solved for: the bound is tight for floor and for rounding to nearest only")]
    Rounding(Rounding),
    /// No accumulator of acceptable width meets the target.
    #[error(
        "an error of at most {target} LSB after {max_steps} steps needs more than {MAX_FRACTION_BITS} fraction bits"
    )]
    Unreachable {
        /// The target.
        target: Dyadic,
        /// The steps.
        max_steps: u64,
    },
    /// A screen or channel outside the solver's limits.
    #[error("{name} = {value} is not permitted ({low} to {high})")]
    Limit {
        /// Which number.
        name: &'static str,
        /// Value of the number.
        value: u32,
        /// Least permitted.
        low: u32,
        /// Largest permitted.
        high: u32,
    },
}

/// The least r with which a fragment behind `steps` additions meets the target; start and increments rounded to
/// nearest, or all floored.
///
/// # Errors
/// A rounding whose bound is not tight, or a target out of reach.
pub fn least_fraction_bits(steps: Steps, rounding: Rounding, target: Target) -> Result<u32, SolverError> {
    if !rounding.is_nearest() && rounding != Rounding::Floor {
        return Err(SolverError::Rounding(rounding));
    }
    match target {
        Target::InRange => Ok(range_safe_fraction_bits(rounding, steps)),
        Target::AtMost(target) => (0..=MAX_FRACTION_BITS)
            .find(|bits| triangle_error(rounding, *bits, steps).magnitude() <= target)
            .ok_or(SolverError::Unreachable { target, max_steps: steps.total() }),
    }
}

/// The least r for the longest way to a pixel of `screen`, with the triangle that misses the target with r - 1.
///
/// # Errors
/// As [`least_fraction_bits`], or a screen or channel outside the limits.
pub fn solve(
    screen: Screen,
    channel: ChannelBits,
    rounding: Rounding,
    target: Target,
) -> Result<Solution, SolverError> {
    for (name, value, low, high) in [
        ("width", screen.width, 1, MAX_SIDE),
        ("height", screen.height, 1, MAX_SIDE),
        ("guard columns", screen.guard_columns, 0, MAX_SIDE),
        ("output bits", channel.output, 1, 32),
        ("vertex fraction bits", channel.vertex, 0, 16),
    ] {
        if !(low..=high).contains(&value) {
            return Err(SolverError::Limit { name, value, low, high });
        }
    }
    let steps = screen.max_steps();
    let fraction_bits = least_fraction_bits(steps, rounding, target)?;
    let fewer = fraction_bits.checked_sub(1);
    Ok(Solution {
        fraction_bits,
        error: triangle_error(rounding, fraction_bits, steps).magnitude(),
        one_bit_fewer: fewer.and_then(|bits| Witness::search(screen, channel, rounding, bits, target)),
    })
}
