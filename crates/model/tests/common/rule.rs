//! The rule and the values in exact integers, written from the definitions, not from the machine.

use super::Triangle;
use edgewalk_machine::{EdgeKind, Plan, PortVertex};
use edgewalk_numerics::Steps;

/// Twice the signed distance of point (px, py) right of the edge a-b, times its height; all in 2^-(s+1) px.
fn right_of(a: [i64; 2], b: [i64; 2], p: [i64; 2]) -> i64 {
    (p[0] - a[0]) * (b[1] - a[1]) - (p[1] - a[1]) * (b[0] - a[0])
}

/// Centre of a pixel and a vertex, both in 2^-(s+1) px.
fn centre(plan: &Plan, x: i64, y: i64) -> [i64; 2] {
    [x, y].map(|c| (2 * c + 1) << plan.subpixel_bits)
}

fn point(v: &PortVertex) -> [i64; 2] {
    [2 * i64::from(v.x()), 2 * i64::from(v.y())]
}

/// Half-open in both axes: an odd number of edges crosses the line through the centre at or left of it.
pub fn inside(plan: &Plan, triangle: &Triangle, x: i64, y: i64) -> bool {
    let p = centre(plan, x, y);
    let crossed = (0..3).filter(|&i| {
        let (a, b) = (point(&triangle[i]), point(&triangle[(i + 1) % 3]));
        let (a, b) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        a[1] <= p[1] && p[1] < b[1] && right_of(a, b, p) >= 0
    });
    crossed.count() % 2 == 1
}

/// Exact value of channel `i` at a pixel's centre, as numerator and positive denominator, in LSB.
pub fn exact_value(plan: &Plan, triangle: &Triangle, i: usize, x: i64, y: i64) -> (i128, i128) {
    let p = centre(plan, x, y);
    let corner = triangle.map(|v| point(&v));
    let weight = |a: usize, b: usize| i128::from(right_of(corner[a], corner[b], p));
    let weights = [weight(1, 2), weight(2, 0), weight(0, 1)];
    let sum: i128 = weights.iter().sum();
    let moment: i128 = (0..3).map(|k| weights[k] * i128::from(triangle[k].values()[i])).sum();
    (moment * sum.signum(), sum.abs() << plan.channels()[i].vertex_fraction)
}

/// Additions from the first value of a triangle to a pixel inside: lines down the major edge, then columns. A slope edge
/// may lie as much further out as bound 5 says.
pub fn steps(plan: &Plan, triangle: &Triangle, x: i64, y: i64) -> Steps {
    let mut corner = triangle.map(|v| point(&v));
    corner.sort_by_key(|c| c[1]);
    let (top, bottom, p) = (corner[0], corner[2], centre(plan, x, y));
    let one = 2i64 << plan.subpixel_bits;
    let first_line = (-(one / 2 - top[1]).div_euclid(one)).max(0); // centre at or below the top
    let (right, height) = (right_of(top, bottom, p), (bottom[1] - top[1]) * one);
    // The first pixel is the first whose centre lies on or right of the edge, or, to the left, the last before it.
    let columns = if right >= 0 { right / height } else { (-right - 1) / height };
    let lines = y - first_line;
    let further = match plan.edge_kind {
        EdgeKind::Exact => 0,
        EdgeKind::Slope => ((lines + 1) >> (plan.edge_fraction + 1)) + 1,
    };
    Steps { lines: lines as u32, columns: (columns + further) as u32 }
}
