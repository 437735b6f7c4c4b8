//! Depths that differ from the stored one in a single bit, or by one LSB: a comparator that leaves a bit out shows itself.

use super::pen::{Pen, case};
use super::{Case, Triangle};

/// On one pixel: nearer by a single bit each time, the highest first, and behind each one LSB farther.
pub(super) fn down(pen: &Pen, column: f64, line: f64) -> Case {
    let depths = (0..pen.machine().z.bits).rev().flat_map(|k| [(1 << k) - 1, 1 << k]);
    case("nearer_by_each_bit_and_one_lsb_farther", on(pen, column, line, depths))
}

/// On one pixel, cleared to half of full scale: farther by a single bit each time, the lowest first, and behind each one LSB nearer.
pub(super) fn up(pen: &Pen, column: f64, line: f64) -> Case {
    let top = pen.machine().z.bits - 1;
    let depths = (0..top).map(|k| (1 << top) + (1 << k)).flat_map(|depth| [depth, depth - 1]);
    case("farther_by_each_bit_and_one_lsb_nearer", on(pen, column, line, depths))
}

/// A pixel again and again at these depths, LSB.
fn on(
    pen: &Pen,
    column: f64,
    line: f64,
    depths: impl Iterator<Item = u64>,
) -> impl Iterator<Item = Triangle> {
    let most = pen.machine().z.max() as f64; // at most 2^53: exact
    depths.map(move |depth| pen.dot(column, line, depth as f64 / most))
}
