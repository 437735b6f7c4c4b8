//! The proved bounds 1, 2, 4, 5, 7 and 9, as exact functions. Derivations, and the bounds that no machine
//! needs: `docs/numerics.md`.
//!
//! ```text
//!   start ──RN──> value ──+ increment, n times──> value ──+1/2, floor──> output
//!           ε0              n·ε                              1/2
//! ```
//! u = 2^-r is the last fraction bit of the accumulator, in LSB of the output; RN rounds to nearest. Errors
//! are computed minus exact, in LSB unless stated. Adding is exact, so only what was rounded *before* it is
//! added errs, once for every time that it is added. With more than 64 fraction bits the bound for 64 is
//! given, which holds all the more.

use crate::dyadic::Dyadic;
use crate::interval::Interval;
use crate::rounding::Rounding;
use crate::steps::Steps;

/// Finest u that the bounds distinguish, 2^-64: all of them then fit together into one [`Dyadic`].
const FINEST: u32 = 64;

/// `count · u/2` with u = 2^-bits.
fn half_units(count: i128, bits: u32) -> Dyadic {
    Dyadic::new(count, bits.min(FINEST) + 1).expect("no finer than 2^-65, and counts have 35 bits")
}

/// Bound 2: error of a fragment, n_y steps down the major edge and n_x along the span: ±(1+n_y+n_x)·u/2 for
/// RN, (-(1+n_y+n_x)·u, 0] for floor. A directed rounding never reaches the end that is not 0.
///
/// For a directed rounding the sides hold if the increment that is added was itself rounded so; where a span
/// to the left adds the negative of a floored gradient, the magnitude holds.
///
/// Bound 1, a DDA of n steps, is that of a fragment n lines down. Bound 9, a DDA of quotient and remainder,
/// is that of a fragment without steps, however many it makes.
#[must_use]
pub fn triangle_error(rounding: Rounding, fraction_bits: u32, steps: Steps) -> Interval {
    // The error of one rounding, in halves of u.
    let (low, high) = match rounding {
        Rounding::Floor => (-2, 0),
        Rounding::Ceiling => (0, 2),
        Rounding::TowardZero | Rounding::AwayFromZero => (-2, 2),
        Rounding::NearestHalfUp | Rounding::NearestHalfEven | Rounding::NearestHalfAway => (-1, 1),
    };
    let roundings = i128::from(steps.total()) + 1;
    let end = |halves: i128| Interval::point(half_units(halves * roundings, fraction_bits));
    end(low).hull(end(high))
}

/// Bound 20: error of a bilinear colour n_y lines down its edges and n_x columns from the span's first, where the edges are where
/// they should be: (1 + n_y)·u/2 for the edges' values, (1 + n_x)·u for the first value and the increments, whose
/// quotients are cut and whose products are rounded.
#[must_use]
pub fn bilinear_error(fraction_bits: u32, steps: Steps) -> Dyadic {
    half_units(3 + i128::from(steps.lines) + 2 * i128::from(steps.columns), fraction_bits)
}

/// Bound 4: fraction bits with which N steps stay under 1/2 LSB, so that the rounded output is within 1 LSB
/// and never leaves the range of the vertices, without a clamp: bitlen(N+1) for RN, 1 + ceil(log2(N+1)) for a
/// directed rounding.
#[must_use]
pub fn range_safe_fraction_bits(rounding: Rounding, steps: Steps) -> u32 {
    let roundings = steps.total() + 1; // below 2^33
    if rounding.is_nearest() { roundings.ilog2() + 1 } else { 1 + roundings.next_power_of_two().ilog2() }
}

/// Bound 5: error of a slope edge after n_y lines, start and slope RN to f fraction bits: (n_y+1)·2^-(f+1)
/// px. Only a pixel whose centre lies so near to the edge can fall on its wrong side.
#[must_use]
pub fn slope_edge_error(fraction_bits: u32, lines: u32) -> Dyadic {
    half_units(i128::from(lines) + 1, fraction_bits)
}

/// Bound 7: two depths come out in the right order for sure if their true difference is at least E1 + E2 + 1
/// LSB, where E1 and E2 bound their errors before the output rounding. `None` if the sum does not fit
/// [`Dyadic`].
#[must_use]
pub fn surely_ordered_difference(error_1: Dyadic, error_2: Dyadic) -> Option<Dyadic> {
    error_1.checked_add(error_2)?.checked_add(Dyadic::ONE)
}
