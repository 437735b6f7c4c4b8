//! Vertices in centre coordinates, sorted from top to bottom.

use edgewalk_machine::{Channel, Fill, Plan, PortVertex, Role};

/// A vertex in centre coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner<const C: usize> {
    /// Column, 2^-t px; pixel centres are multiples of P = 2^t.
    pub u: i64,
    /// Line, 2^-t px.
    pub v: i64,
    /// Of every channel, 2^-e LSB, as its kind reads it.
    pub values: [i64; C],
}

/// Three vertices, top first; of equal v the earlier comes first.
#[derive(Clone, Debug)]
pub(crate) struct Sorted<const C: usize> {
    pub corners: [Corner<C>; 3],
    pub role: Role,
}

impl<const C: usize> Default for Sorted<C> {
    fn default() -> Self {
        Sorted { corners: [Corner { u: 0, v: 0, values: [0; C] }; 3], role: Role::Triangle }
    }
}

impl<const C: usize> Sorted<C> {
    pub(crate) fn new(plan: &Plan, vertices: &[PortVertex; 3]) -> Self {
        let mut corners = vertices.map(|v| corner(plan, &v));
        corners.sort_by_key(|c| c.v); // stable
        Sorted { corners, role: Role::of(vertices) }
    }

    /// Twice the area with its sign, 2^-2t px²; negative: the major edge 0-2 lies right.
    #[inline(always)]
    pub(crate) fn area(&self) -> i64 {
        let [a, b, c] = &self.corners;
        (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v) // 2·DW <= 48 bits
    }

    /// The left edge of a part, from its upper to its lower corner: the major edge unless that lies right.
    pub(super) fn left_edge(&self, part: usize) -> (&Corner<C>, &Corner<C>) {
        let [a, b, c] = &self.corners;
        match (self.area() < 0, part) {
            (false, _) => (a, c),
            (true, 0) => (a, b),
            (true, _) => (b, c),
        }
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
        if channel.kind.is_signed() { high >> unused } else { (high as u64 >> unused) as i64 }
    };
    let channels = plan.channels();
    let values = std::array::from_fn(|i| channels.get(i).map_or(0, |c| value(c, vertex.values()[i])));
    Corner { u: centre(vertex.x()), v: centre(vertex.y()), values }
}
