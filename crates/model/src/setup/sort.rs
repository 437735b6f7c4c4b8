//! Vertices in centre coordinates, sorted from top to bottom.

use edgewalk_machine::{Channel, Fill, Plan, PortVertex, Role, Window};

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
    /// With POLY: the lines that are drawn, and the pixel at which values start.
    pub window: Window,
    /// With POLY: the edges 0-2, 0-1 and 1-2 that count.
    pub counts: [bool; 3],
}

impl<const C: usize> Default for Sorted<C> {
    fn default() -> Self {
        Sorted::of([Corner { u: 0, v: 0, values: [0; C] }; 3], Role::Triangle)
    }
}

impl<const C: usize> Sorted<C> {
    pub(crate) fn new(plan: &Plan, vertices: &[PortVertex; 3]) -> Self {
        let unsorted = vertices.map(|v| corner(plan, &v));
        let mut corners = unsorted;
        corners.sort_by_key(|c| c.v); // stable
        let sorted = Sorted::of(corners, Role::of(vertices));
        if !plan.polygon.is_there() {
            return sorted;
        }
        let mut order = [0, 1, 2];
        order.sort_by_key(|place| unsorted[*place].v); // stable
        Sorted { window: Window::of(vertices), counts: sorted.sides(order), ..sorted }
    }

    /// Sorted corners in a machine without POLY.
    #[inline(always)]
    pub(crate) fn of(corners: [Corner<C>; 3], role: Role) -> Self {
        Sorted { corners, role, window: Window::default(), counts: [true; 3] }
    }

    /// Whether the edges between sorted corners count; `order`: which vertex of the port stands at each place.
    fn sides(&self, order: [usize; 3]) -> [bool; 3] {
        [[0, 2], [0, 1], [1, 2]].map(|ends| match self.role {
            Role::Triangle => true,
            Role::Line { .. } => ends == [0, 2],
            // Sides are named by the vertex that they start at: 0-1, 1-2, 2-0.
            Role::Edges(sides) | Role::Plane(sides) => match ends.map(|place| order[place]) {
                [0, 1] | [1, 0] => sides.has(0),
                [1, 2] | [2, 1] => sides.has(1),
                _ => sides.has(2),
            },
        })
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
