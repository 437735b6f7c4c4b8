//! Vertices in centre coordinates, sorted from top to bottom.

use edgewalk_machine::{Fill, Plan, PortVertex};

/// A vertex in centre coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Column, 2^-t px; pixel centres are multiples of P = 2^t.
    pub u: i64,
    /// Line, 2^-t px.
    pub v: i64,
    /// Z, R, G, B, 2^-e LSB.
    pub value: [i128; 4],
}

/// Three vertices, top first; of equal v the earlier comes first.
#[derive(Clone, Debug)]
pub(super) struct Sorted {
    pub corners: [Corner; 3],
}

impl Sorted {
    pub(super) fn new(machine: &Plan, vertices: &[PortVertex; 3]) -> Self {
        let mut corners = vertices.map(|v| corner(machine, &v));
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
fn corner(machine: &Plan, vertex: &PortVertex) -> Corner {
    let unused = 64 - machine.widths().vertex;
    let centre = |x: i32| {
        let x = i64::from(x) << unused >> unused;
        match (machine.fill, machine.subpixel_bits) {
            (Fill::Textbook, _) => 2 * x,
            (Fill::Exact, 0) => 2 * x - 1,
            (Fill::Exact, s) => x - (1 << (s - 1)),
        }
    };
    let channels = machine.channels();
    Corner {
        u: centre(vertex.x),
        v: centre(vertex.y),
        value: std::array::from_fn(|i| i128::from(vertex.value[i] & ((1 << channels[i].vertex_bits()) - 1))),
    }
}
