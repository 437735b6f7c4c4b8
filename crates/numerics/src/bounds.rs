//! The proved bounds A1 to A9, as exact functions (A10 is in `normal_cone`). Derivations: `docs/numerics.md`.
//!
//! ```text
//!   start ──RN──> value ──+ increment, n times──> value ──+1/2, floor──> output
//!           ε0              n·ε                              1/2
//! ```
//! u = 2^-r is the last fraction bit of the accumulator, in LSB of the output; RN rounds to nearest. Errors are
//! computed minus exact, in LSB unless stated. Adding is exact, so only what was rounded *before* it is added
//! errs, once for every time that it is added. With more than 64 fraction bits the bound for 64 is given, which holds all the more.

use crate::dyadic::Dyadic;
use crate::interval::Interval;
use crate::rounding::Rounding;
use crate::steps::Steps;

/// Finest u that the bounds distinguish, 2^-64: all of them then fit together into one [`Dyadic`].
const FINEST: u32 = 64;

/// `count · u/2` with u = 2^-bits.
fn half_units(count: i128, bits: u32) -> Dyadic {
    Dyadic::new(count, bits.min(FINEST) + 1).expect("no finer than 2^-65, and counts have 67 bits")
}

/// Where the sum of `count` errors of one rounding each lies.
fn rounded_times(count: u128, rounding: Rounding, fraction_bits: u32) -> Interval {
    // The error of one rounding, in halves of u.
    let (low, high) = match rounding {
        Rounding::Floor => (-2, 0),
        Rounding::Ceiling => (0, 2),
        Rounding::TowardZero | Rounding::AwayFromZero => (-2, 2),
        Rounding::NearestHalfUp | Rounding::NearestHalfEven | Rounding::NearestHalfAway => (-1, 1),
    };
    let end = |halves: i128| half_units(halves * count as i128, fraction_bits); // below 2^67
    Interval::point(end(low)).hull(Interval::point(end(high)))
}

/// A1: error after n steps of a DDA whose start and increment are rounded to r fraction bits:
/// ±(n+1)·u/2 for RN, (-(n+1)·u, 0] for floor (a directed rounding never reaches the end that is not 0).
#[must_use]
pub fn dda_error(rounding: Rounding, fraction_bits: u32, n: u32) -> Interval {
    rounded_times(u128::from(n) + 1, rounding, fraction_bits)
}

/// A2: error of a fragment, n_y steps down the major edge and n_x along the span: ±(1+n_y+n_x)·u/2 for RN.
///
/// For a directed rounding the sides hold if the increment that is added was itself rounded so; where a span to
/// the left adds the negative of a floored gradient, the magnitude holds.
#[must_use]
pub fn triangle_error(rounding: Rounding, fraction_bits: u32, steps: Steps) -> Interval {
    rounded_times(first_order_terms(steps), rounding, fraction_bits)
}

/// What a machine with pre-step and approximate reciprocal adds to the roundings of A2. All magnitudes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Prestep {
    /// f: the distance from edge to pixel centre is truncated to f fraction bits (0: no pre-step at all).
    pub distance_bits: u32,
    /// The edge's x is a slope DDA with this many fraction bits, u_x = 2^-bits px (A5).
    pub edge_bits: u32,
    /// η: relative error of the gradients and slopes through the reciprocal.
    pub reciprocal_error: Dyadic,
    /// |g_x|, LSB/px.
    pub gradient: Dyadic,
    /// |d_e|: change along the edge, LSB/line.
    pub edge_gradient: Dyadic,
    /// |m|: slope of the edge, px/line.
    pub slope: Dyadic,
}

/// A3: magnitude of the error with pre-step, RN:
/// `(3+n_y+n_x)·u/2 + |g_x|·(2^-f + (n_y+1)·u_x/2) + η·(n_y·|d_e| + (n_x+1)·|g_x| + n_y·|m|·|g_x|)`.
/// `None` if the exact value does not fit [`Dyadic`].
#[must_use]
pub fn prestepped_error(fraction_bits: u32, steps: Steps, machine: &Prestep) -> Option<Dyadic> {
    let [lines, columns] = [steps.lines, steps.columns].map(|n| Dyadic::integer(n.into()));
    let roundings = half_units(i128::from(steps.total()) + 3, fraction_bits);
    let distance = half_units(2, machine.distance_bits)
        .checked_add(slope_edge_error(machine.edge_bits, steps.lines))?
        .checked_mul(machine.gradient)?;
    let along_edge = lines.checked_mul(machine.edge_gradient)?;
    let along_span = columns.checked_add(Dyadic::ONE)?.checked_mul(machine.gradient)?;
    let edge_off = lines.checked_mul(machine.slope)?.checked_mul(machine.gradient)?;
    let reciprocal =
        along_edge.checked_add(along_span)?.checked_add(edge_off)?.checked_mul(machine.reciprocal_error)?;
    roundings.checked_add(distance)?.checked_add(reciprocal)
}

/// A4: fraction bits with which N steps stay under 1/2 LSB, so that the rounded output is within 1 LSB and never
/// leaves the range of the vertices, without a clamp: bitlen(N+1) for RN, 1 + ceil(log2(N+1)) for a directed rounding.
#[must_use]
pub fn range_safe_fraction_bits(rounding: Rounding, steps: Steps) -> u32 {
    fraction_bits_for(rounding, first_order_terms(steps))
}

/// Roundings in a value behind N steps of first order: the start, and the increment N times.
fn first_order_terms(steps: Steps) -> u128 {
    u128::from(steps.total()) + 1
}

/// Fraction bits with which `terms` errors of one rounding stay under 1/2.
fn fraction_bits_for(rounding: Rounding, terms: u128) -> u32 {
    if rounding.is_nearest() { terms.ilog2() + 1 } else { 1 + terms.next_power_of_two().ilog2() }
}

/// A5: error of a slope edge after n_y lines, start and slope RN to f fraction bits: (n_y+1)·2^-(f+1) px. Only a
/// pixel whose centre lies so near to the edge can fall on its wrong side.
#[must_use]
pub fn slope_edge_error(fraction_bits: u32, lines: u32) -> Dyadic {
    half_units(i128::from(lines) + 1, fraction_bits)
}

/// A6: the share of fragments whose output differs from the rounded exact value, about u·(0.83·σ + 1/(15·σ)) with
/// σ = sqrt((1 + Σn²)/12), where each n counts the additions of one increment: n_x, and n_y or, if both
/// increments of the edge are used, how often each was.
///
/// A statistic, not a bound: it catches a biased rounding that never shows in the maximum.
#[must_use]
pub fn mismatch_rate(fraction_bits: u32, additions: &[u32]) -> f64 {
    let squares: f64 = additions.iter().map(|n| f64::from(*n).powi(2)).sum();
    let deviation = ((1.0 + squares) / 12.0).sqrt();
    half_units(2, fraction_bits).to_f64() * (0.83 * deviation + 1.0 / (15.0 * deviation))
}

/// A7: two depths come out in the right order for sure if their true difference is at least E1 + E2 + 1 LSB, where
/// E1 and E2 bound their errors before the output rounding. `None` if the sum does not fit [`Dyadic`].
#[must_use]
pub fn surely_ordered_difference(error_1: Dyadic, error_2: Dyadic) -> Option<Dyadic> {
    error_1.checked_add(error_2)?.checked_add(Dyadic::ONE)
}

/// Roundings in a value behind N steps of second order: the start, N first differences and N(N-1)/2 second ones.
fn second_order_terms(steps: Steps) -> u128 {
    let n = u128::from(steps.total());
    (n * n + n + 2) / 2 // n is below 2^33
}

/// A8: error of a quadratic in x and y stepped by second differences, n_y lines down and n_x columns to the right
/// in any order: ±(N²+N+2)/4·u for RN, N = n_y + n_x. Start, two first and three second differences are rounded once.
#[must_use]
pub fn second_order_error(rounding: Rounding, fraction_bits: u32, steps: Steps) -> Interval {
    rounded_times(second_order_terms(steps), rounding, fraction_bits)
}

/// A8: fraction bits with which that stays under 1/2 LSB: bitlen((N²+N+2)/2) for RN. It says nothing of the range: the
/// polynomial itself may leave it.
#[must_use]
pub fn second_order_fraction_bits(rounding: Rounding, steps: Steps) -> u32 {
    fraction_bits_for(rounding, second_order_terms(steps))
}

/// A9: error of a quotient-and-remainder DDA: the one rounding of the result, however many steps.
#[must_use]
pub fn remainder_dda_error(rounding: Rounding, fraction_bits: u32) -> Interval {
    rounded_times(1, rounding, fraction_bits)
}
