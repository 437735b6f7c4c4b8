//! Vertices in centre coordinates, sorted from top to bottom.

use edgewalk_machine::{Channel, Fill, Plan, PortVertex};

/// A vertex in centre coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner<const C: usize> {
    /// Column, 2^-t px; pixel centres are multiples of P = 2^t.
    pub u: i64,
    /// Line, 2^-t px.
    pub v: i64,
    /// Of every channel, 2^-e LSB, as its kind reads it.
    pub values: [i128; C],
}

/// Three vertices, top first; of equal v the earlier comes first.
#[derive(Clone, Debug)]
pub(super) struct Sorted<const C: usize> {
    pub corners: [Corner<C>; 3],
}

impl<const C: usize> Sorted<C> {
    pub(super) fn new(plan: &Plan, vertices: &[PortVertex; 3]) -> Self {
        let mut corners = vertices.map(|v| corner(plan, &v));
        corners.sort_by_key(|c| c.v); // stable
        Sorted { corners }
    }

    /// Twice the area with its sign, 2^-2t px²; negative: the major edge 0-2 lies right.
    pub(super) fn area(&self) -> i128 {
        let [a, b, c] = self.corners;
        let cross = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v); // 2·DW <= 48 bits
        i128::from(cross)
    }
}

/// Centre coordinates of a vertex. The port has XW and b + e bits; what a caller puts above them is not seen.
fn corner<const C: usize>(plan: &Plan, vertex: &PortVertex) -> Corner<C> {
    let unused = 64 - plan.widths().vertex;
    let centre = |x: i32| {
        let x = i64::from(x) << unused >> unused;
        match (plan.fill, plan.subpixel_bits) {
            (Fill::Textbook, _) => 2 * x,
            (Fill::Exact, 0) => 2 * x - 1,
            (Fill::Exact, s) => x - (1 << (s - 1)),
        }
    };
    let value = |channel: &Channel, value: i64| {
        let unused = 64 - channel.vertex_bits();
        let high = value << unused;
        i128::from(if channel.kind.is_signed() { high >> unused } else { (high as u64 >> unused) as i64 })
    };
    let channels = plan.channels();
    let values = std::array::from_fn(|i| channels.get(i).map_or(0, |c| value(c, vertex.values()[i])));
    Corner { u: centre(vertex.x()), v: centre(vertex.y()), values }
}
